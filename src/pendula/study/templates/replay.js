// Replays the motions in true time, and sets them by hand and by keys.
"use strict";

const WIDEST = 1.5; // first energies that the bar of a run is wide

function element(name, parent, properties = {}) {
  return parent.appendChild(Object.assign(document.createElement(name), properties));
}

function labelled(parent, text, name, properties) {
  const label = element("label", parent, { textContent: text + " " });
  return element(name, label, properties);
}

// Which runs are shown, each with a bar of its energy. Returns what shows these at a time.
function chooser(parent, motion, redraw) {
  const group = element("fieldset", parent);
  element("legend", group, { textContent: data.words.show });
  const bars = motion.runs.map((run) => {
    const label = element("label", group);
    const box = element("input", label, { type: "checkbox", checked: true });
    const swatch = element("span", label, { className: "swatch" });
    swatch.style.background = run.colour;
    label.append(run.name);
    box.addEventListener("change", () => {
      run.shown = box.checked;
      redraw();
    });
    return energyBar(label, motion, run);
  });
  element("p", group, { className: "hint", textContent: data.words.energy });
  return (time) => bars.forEach((show) => show(time));
}

// Kinetic and potential energy in parts of the run's first energy, with a mark at that.
function energyBar(parent, motion, run) {
  const bar = element("span", parent, { className: "energy", ariaHidden: true });
  bar.style.setProperty("--colour", run.colour);
  bar.style.setProperty("--mark", `${100 / WIDEST}%`);
  const parts = ["kinetic", "potential"].map((name) => element("span", bar, { className: name }));
  const number = element("output", parent, { className: "share", title: "E/E₀" });
  return (time) => {
    const place = between(motion, run, time);
    const energies = place && energiesAt(run, place);
    parts.forEach((part, n) => {
      part.style.width = `${(100 * Math.max(0, energies?.[n] ?? 0)) / WIDEST}%`;
    });
    number.value = energies ? local(energies[0] + energies[1], 2) : "–";
  };
}

function energiesAt(run, [i, j, s]) {
  return run.energies.map((energy) => energy[i] + s * (energy[j] - energy[i]));
}

// Buttons, time, clock and speed of a player.
function controls(box, end) {
  const bar = element("div", box, { className: "bar" });
  const button = (textContent, ariaLabel) =>
    element("button", bar, { type: "button", textContent, ariaLabel });
  const play = button(data.words.play, null);
  const back = button("‹", data.words.back);
  const forward = button("›", data.words.forward);
  const slider = labelled(bar, data.words.time, "input", { type: "range", min: 0, step: "any" });
  slider.max = end;
  slider.value = 0;
  const clock = element("output", bar);
  const speed = labelled(bar, data.words.speed, "select", {});
  for (const factor of [0.1, 0.25, 0.5, 1, 2]) {
    const text = String(factor).replace(".", data.decimal) + "×";
    element("option", speed, { value: factor, textContent: text, selected: factor === 1 });
  }
  const full = button(data.words.full, null);
  full.hidden = !document.fullscreenEnabled;
  return { play, back, forward, slider, clock, speed, full };
}

// Lets the time run or be set; `redraw` draws the pendulums at a time. Returns what shows it all,
// and what plays, pauses and sets the time.
function animate({ play, slider, clock, speed }, end, redraw) {
  let time = 0;
  let before = null; // the page's clock at the last picture [ms]; null: not playing
  const show = () => {
    slider.value = time;
    clock.value = local(time, 2) + " s";
    slider.setAttribute("aria-valuetext", clock.value);
    redraw(time);
  };
  const run = (on) => {
    if (on && time >= end) time = 0;
    before = on ? performance.now() : null;
    play.textContent = on ? data.words.pause : data.words.play;
    if (on) requestAnimationFrame(tick);
    show();
  };
  const tick = (now) => {
    if (before === null) return;
    time = Math.min(time + (Math.max(0, now - before) / 1000) * Number(speed.value), end);
    before = now;
    if (time >= end) run(false);
    else requestAnimationFrame(tick);
    show();
  };
  const set = (moment) => {
    time = Math.min(Math.max(moment, 0), end);
    show();
  };
  slider.addEventListener("input", () => set(Number(slider.value)));
  const toggle = () => run(before === null);
  return { show, toggle, pause: () => run(false), set, now: () => time };
}

// One step: to the stored point before or after, or so many of them.
function step(film, interval, count) {
  film.pause();
  film.set(interval * (Math.round(film.now() / interval) + count));
}

function fullScreen(box) {
  if (document.fullscreenElement) document.exitFullscreen();
  else if (document.fullscreenEnabled) box.requestFullscreen();
}

// What the keys do in a player; a list keeps its own, a button and a box the space bar.
function keys(box, film, motion) {
  const actions = {
    " ": () => film.toggle(),
    ArrowLeft: (event) => step(film, motion.interval, event.shiftKey ? -10 : -1),
    ArrowRight: (event) => step(film, motion.interval, event.shiftKey ? 10 : 1),
    Home: () => film.set(0),
    End: () => film.set(motion.end),
    f: () => fullScreen(box),
  };
  box.addEventListener("keydown", (event) => {
    const action = actions[event.key.length > 1 ? event.key : event.key.toLowerCase()];
    const own = event.key === " " ? "select, button, [type=checkbox]" : "select";
    if (!action || event.target.matches(own)) return;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    action(event);
  });
}

function player(box) {
  const motion = unpack(data.motions[box.dataset.motion]);
  box.textContent = "";
  const shown = { role: "img", ariaLabel: data.words.picture, tabIndex: 0 };
  const canvas = element("canvas", box, shown);
  const bar = controls(box, motion.end);
  let energies = () => {};
  const film = animate(bar, motion.end, (time) => {
    draw(canvas, motion, time);
    energies(time);
  });
  energies = chooser(box, motion, film.show);
  element("p", box, { className: "hint", textContent: data.words.keys });
  bar.play.addEventListener("click", film.toggle);
  bar.back.addEventListener("click", () => step(film, motion.interval, -1));
  bar.forward.addEventListener("click", () => step(film, motion.interval, 1));
  bar.full.addEventListener("click", () => fullScreen(box));
  keys(box, film, motion);
  new ResizeObserver(film.show).observe(canvas);
  film.show();
}

document.querySelectorAll(".player").forEach(player);
