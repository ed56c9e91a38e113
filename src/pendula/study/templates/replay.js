// Replays the motions in true time. Each player draws several pendulums over one another.
"use strict";

const data = JSON.parse(document.getElementById("motions").textContent);
const STEPS = 1e4; // angles come in these parts of a radian
const TRAIL = 0.8; // s of the path behind each bob
const INK = "#4a525b";

const local = (x, decimals) => x.toFixed(decimals).replace("-", "−").replace(".", data.decimal);

// Each angle is stored as the difference from the one before.
function unpack(motion) {
  for (const run of motion.runs) {
    run.angles = run.angles.map((steps) => {
      let sum = 0;
      return Float64Array.from(steps, (step) => (sum += step) / STEPS);
    });
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

// The pivot and the ends of the rods at a time, or null once a run has ended.
function joints(motion, run, time) {
  const place = time / motion.interval;
  const last = run.angles[0].length - 1;
  if (place > last + 1e-9) return null;
  const i = Math.min(Math.floor(place), last);
  const j = Math.min(i + 1, last);
  const points = [[0, 0]];
  motion.lengths.forEach((length, rod) => {
    const angle = run.angles[rod][i] + (run.angles[rod][j] - run.angles[rod][i]) * (place - i);
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

function drawTrail(pen, motion, run, time, scale) {
  const start = Math.max(0, time - TRAIL);
  const parts = Math.ceil((time - start) / motion.interval);
  pen.strokeStyle = run.colour;
  pen.lineWidth = 1.5;
  let before = null;
  for (let n = 0; n <= parts; n++) {
    const points = joints(motion, run, Math.min(start + n * motion.interval, time));
    const end = points[points.length - 1];
    if (before) {
      pen.globalAlpha = (0.5 * n) / parts;
      pen.beginPath();
      pen.moveTo(before[0] * scale, before[1] * scale);
      pen.lineTo(end[0] * scale, end[1] * scale);
      pen.stroke();
    }
    before = end;
  }
  pen.globalAlpha = 1;
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

function element(name, parent, properties = {}) {
  return parent.appendChild(Object.assign(document.createElement(name), properties));
}

function labelled(parent, text, name, properties) {
  const label = element("label", parent, { textContent: text + " " });
  return element(name, label, properties);
}

function chooser(parent, motion, redraw) {
  const group = element("fieldset", parent);
  element("legend", group, { textContent: data.words.show });
  for (const run of motion.runs) {
    const label = element("label", group);
    const box = element("input", label, { type: "checkbox", checked: true });
    const swatch = element("span", label, { className: "swatch" });
    swatch.style.background = run.colour;
    label.append(run.name);
    box.addEventListener("change", () => {
      run.shown = box.checked;
      redraw();
    });
  }
}

// Button, time, clock and speed of a player.
function controls(box, end) {
  const bar = element("div", box, { className: "bar" });
  const button = element("button", bar, { type: "button", textContent: data.words.play });
  const slider = labelled(bar, data.words.time, "input", { type: "range", min: 0, step: "any" });
  slider.max = end;
  slider.value = 0;
  const clock = element("output", bar);
  const speed = labelled(bar, data.words.speed, "select", {});
  for (const factor of [0.1, 0.25, 0.5, 1, 2]) {
    const text = String(factor).replace(".", data.decimal) + "×";
    element("option", speed, { value: factor, textContent: text, selected: factor === 1 });
  }
  return { button, slider, clock, speed };
}

// Lets the time run or be set; `redraw` draws the pendulums at a time. Returns what shows it all.
function animate({ button, slider, clock, speed }, end, redraw) {
  let time = 0;
  let before = null; // the page's clock at the last picture [ms]; null: not playing
  const show = () => {
    slider.value = time;
    clock.value = local(time, 2) + " s";
    slider.setAttribute("aria-valuetext", clock.value);
    redraw(time);
  };
  const play = (on) => {
    if (on && time >= end) time = 0;
    before = on ? performance.now() : null;
    button.textContent = on ? data.words.pause : data.words.play;
    if (on) requestAnimationFrame(tick);
    show();
  };
  const tick = (now) => {
    if (before === null) return;
    time = Math.min(time + (Math.max(0, now - before) / 1000) * Number(speed.value), end);
    before = now;
    if (time >= end) play(false);
    else requestAnimationFrame(tick);
    show();
  };
  button.addEventListener("click", () => play(before === null));
  slider.addEventListener("input", () => {
    time = Number(slider.value);
    show();
  });
  return show;
}

function player(box) {
  const motion = unpack(data.motions[box.dataset.motion]);
  box.textContent = "";
  const canvas = element("canvas", box, { role: "img", ariaLabel: data.words.picture });
  const bar = controls(box, motion.end);
  const show = animate(bar, motion.end, (time) => draw(canvas, motion, time));
  chooser(box, motion, show);
  new ResizeObserver(show).observe(canvas);
  show();
}

document.querySelectorAll(".player").forEach(player);
