// The motions of the page, and a picture of them at a time: several pendulums over one another.
"use strict";

const data = JSON.parse(document.getElementById("motions").textContent);
const PARTS = { angles: 1e4, rates: 1e3, energies: 1e3 }; // of rad, rad/s and the first energy
const TRAIL = 0.8; // s of the path behind each bob
const FINE = 8; // pieces of the path between two stored points
const SHADES = 12; // of the path, the older the paler
const INK = "#4a525b";

const local = (x, decimals) => x.toFixed(decimals).replace("-", "−").replace(".", data.decimal);

// Each number is stored as the difference from the one before.
function unpack(motion) {
  for (const run of motion.runs) {
    for (const [name, parts] of Object.entries(PARTS)) {
      run[name] = run[name].map((steps) => {
        let sum = 0;
        return Float64Array.from(steps, (step) => (sum += step) / parts);
      });
    }
    run.shown = true;
  }
  motion.points = Math.max(...motion.runs.map((run) => run.angles[0].length));
  motion.end = (motion.points - 1) * motion.interval;
  motion.box = frame(motion);
  return motion;
}

// What the picture has to hold: the pivot and all that is ever reached, [left, top, right, bottom].
function frame(motion) {
  const box = [0, 0, 0, 0];
  for (const run of motion.runs) {
    for (let n = 0; n < run.angles[0].length; n++) {
      for (const [x, y] of joints(motion, run, n * motion.interval)) {
        box[0] = Math.min(box[0], x);
        box[1] = Math.min(box[1], y);
        box[2] = Math.max(box[2], x);
        box[3] = Math.max(box[3], y);
      }
    }
  }
  return box;
}

// Between which stored points a time lies, and which part of the way; null once a run has ended.
function between(motion, run, time) {
  const place = time / motion.interval;
  const last = run.angles[0].length - 1;
  if (place > last + 1e-9) return null;
  const i = Math.min(Math.floor(place), last);
  return [i, Math.min(i + 1, last), place - i];
}

// The cubic with the angles and angular velocities of two points, so that paths have no corners
// (Hermite; Hairer, Norsett, Wanner, Solving ODEs I, II.6).
function angleAt(motion, run, rod, [i, j, s]) {
  const angle = run.angles[rod];
  const rate = run.rates[rod];
  const way = angle[j] - angle[i];
  const first = motion.interval * rate[i] - way;
  const second = way - motion.interval * rate[j];
  return angle[i] + s * way + s * (1 - s) * ((1 - s) * first + s * second);
}

// The pivot and the ends of the rods at a time, or null once a run has ended.
function joints(motion, run, time) {
  const place = between(motion, run, time);
  if (!place) return null;
  const points = [[0, 0]];
  motion.lengths.forEach((length, rod) => {
    const angle = angleAt(motion, run, rod, place);
    const [x, y] = points[rod];
    points.push([x + length * Math.sin(angle), y + length * Math.cos(angle)]);
  });
  return points;
}

function draw(canvas, motion, time) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const pen = canvas.getContext("2d");
  const [left, top, right, bottom] = motion.box;
  const scale = Math.min((width - 28) / (right - left), (height - 28) / (bottom - top));
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.translate(
    width / 2 - ((left + right) / 2) * scale,
    height / 2 - ((top + bottom) / 2) * scale,
  );
  pen.lineJoin = pen.lineCap = "round";
  motion.runs.forEach((run, place) => {
    const points = run.shown && joints(motion, run, time);
    if (!points) return;
    drawTrail(pen, motion, run, time, scale);
    drawRods(pen, points, scale, run.colour, place === 0);
  });
  pen.fillStyle = INK;
  pen.beginPath();
  pen.arc(0, 0, 3, 0, 2 * Math.PI);
  pen.fill();
}

// The path behind the last bob, in pieces of one shade. Its points stay where they are from one
// picture to the next; only the ends move.
function drawTrail(pen, motion, run, time, scale) {
  const start = Math.max(0, time - TRAIL);
  const fine = motion.interval / FINE;
  const times = [start];
  for (let n = Math.floor(start / fine) + 1; n * fine < time; n++) times.push(n * fine);
  times.push(time);
  const ends = times.map((t) => joints(motion, run, t).at(-1));
  pen.strokeStyle = run.colour;
  pen.lineWidth = 1.5;
  pen.lineCap = "butt"; // round ends would show as beads
  for (let shade = 1; shade <= SHADES; shade++) {
    const from = Math.floor(((shade - 1) / SHADES) * (ends.length - 1));
    const to = Math.floor((shade / SHADES) * (ends.length - 1));
    pen.globalAlpha = (0.6 * shade) / SHADES;
    pen.beginPath();
    for (const [x, y] of ends.slice(from, to + 1)) pen.lineTo(x * scale, y * scale);
    pen.stroke();
  }
  pen.globalAlpha = 1;
  pen.lineCap = "round";
}

// The first run, which the others are compared with, is drawn broader, beneath them.
function drawRods(pen, points, scale, colour, first) {
  pen.strokeStyle = pen.fillStyle = colour;
  pen.lineWidth = first ? 4 : 1.8;
  pen.beginPath();
  points.forEach(([x, y]) => pen.lineTo(x * scale, y * scale));
  pen.stroke();
  for (const [x, y] of points.slice(1)) {
    pen.beginPath();
    pen.arc(x * scale, y * scale, first ? 9 : 5.5, 0, 2 * Math.PI);
    pen.fill();
  }
}
