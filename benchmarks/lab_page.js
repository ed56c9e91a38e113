// What is measured within the laboratory's page; benchmarks/lab.py calls one of these functions.

const frame = () => new Promise(requestAnimationFrame);
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/** From the navigation to the first motion of the clock [ms]. */
async function firstMotion() {
  const time = () => Number.parseFloat(document.querySelector(".clock")?.textContent ?? "0");
  while (!(time() > 0)) await frame();
  return performance.now();
}

/** Main thread's time of a frame while three ghosts move, the median [ms]. */
async function ghostFrame() {
  while (document.querySelectorAll(".view tbody tr").length < 3) await pause(50);
  await pause(3000);
  const times = performance.getEntriesByName("render").map((each) => each.duration);
  return times.sort((a, b) => a - b)[Math.floor(times.length / 2)];
}

/** From leaving the graphs, while the section's long run is computed, until that has ended [ms]. */
async function leaving() {
  const named = (selector, text) =>
    [...document.querySelectorAll(selector)].find((each) => each.textContent.includes(text));
  while (!named(".readings", "Right")) await pause(50);
  named("label", "Poincaré").querySelector("input").click();
  await pause(60); // the run takes 120 ms and more, and would have ended by itself
  const { terminate } = Worker.prototype;
  let ended = 0;
  Worker.prototype.terminate = function () {
    terminate.call(this);
    ended = performance.now();
  };
  const left = performance.now();
  named("[role=tab]", "Measured").click();
  while (ended === 0) await frame();
  return ended - left;
}

/** Least time that a worker of the page takes for each of some calls [ms]. */
async function workerTimes(calls) {
  while (!document.querySelector(".readings")?.textContent.includes("Right")) await pause(50);
  document.querySelector(".round.main").click(); // the page rests
  const loaded = performance.getEntriesByType("resource").map(({ name }) => name);
  const module = await WebAssembly.compileStreaming(
    fetch(loaded.find((name) => name.endsWith(".wasm"))),
  );
  const worker = new Worker(
    loaded.find((name) => name.includes("/worker-")),
    { type: "module" },
  );
  const said = () =>
    new Promise((done) => {
      worker.onmessage = ({ data }) => done(data);
    });
  worker.postMessage({ kind: "open", module });
  await said();
  const found = [];
  for (const { name, arguments_ } of calls) {
    const times = [];
    for (let id = 1; id <= 10; ++id) {
      const began = performance.now();
      worker.postMessage({ kind: "call", id, name, arguments_ });
      const { kind } = await said();
      if (kind !== "answer") throw new Error(`${name}: ${kind}`);
      times.push(performance.now() - began);
    }
    found.push(Math.min(...times));
  }
  worker.terminate();
  return found;
}

/** Work for `workerTimes`: RK4 of many pendulums through lanes, and a flip map of which no half mirrors the other. */
function lanesAndMap({ start, many, end, step, side }) {
  const system = { name: "double", form: "rods", parameters: [1, 1, 1, 1, 9.81] };
  const states = Float64Array.from({ length: 4 * many }, (_, i) => start[i % 4]);
  const times = Float64Array.of(end);
  const map = {
    system,
    theta1: [0, Math.PI],
    theta2: [-Math.PI, Math.PI],
    shape: [side, side],
    tMax: 20,
    which: null,
    tolerance: 1e-8,
    resolve: false,
  };
  return [
    {
      name: "ensemble",
      arguments_: [{ system, method: "rk4", state: start, options: { step }, states, times }],
    },
    { name: "flipCells", arguments_: [map, { first: [0, 0], stop: [side, side] }] },
  ];
}
