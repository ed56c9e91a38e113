// A run as the CSV file that `pendula.load` reads and `pendula rerun` repeats: the recipe in the first
// line, with checksums, then a table. It is what `pendula.io.csv_files` writes.

import type { Core, MotionRequest } from "../core/api";
import { catalogue } from "../core/catalogue";
import { described, EXACT, formRowOf, gridOf, type Recipe, systemOf } from "../recipe/recipe";
import type { Motion } from "../run/motion";
import { blake2b } from "./blake2b";
import { type Data, dumps, repr, Whole } from "./python_text";

/** Text of the file of a motion that is at its end. */
export async function csvOf(core: Core, recipe: Recipe, motion: Motion): Promise<string> {
  const table = await columnsOf(core, recipe, motion);
  const known: Record<string, Data> = {
    pendula: catalogue.version,
    system: systemData(recipe),
    method: recipe.method,
    state: recipe.state,
    t: null,
    t0: recipe.t0,
    ...optionsData(recipe),
    events: [],
    ...(await ending(core, recipe, motion)),
    crossings: [],
    trust_horizon: null,
    precision: null,
    n_times: new Whole(motion.count),
    columns: Object.fromEntries(table.map(([name, values]) => [name, checksum(values)])),
  };
  const text = new TextEncoder();
  const recipeSum = blake2b(text.encode(dumps(known)));
  const first = `# pendula: ${dumps({ ...known, checksum: recipeSum })}`;
  const lines = [first, table.map(([name]) => name).join(",")];
  for (let i = 0; i < motion.count; ++i) {
    lines.push(table.map(([, values]) => repr(values[i])).join(","));
  }
  return `${lines.join("\n")}\n`;
}

function systemData(recipe: Recipe): Data {
  const rows = formRowOf(recipe).parameters;
  const parameters = Object.fromEntries(rows.map((row) => [row.name, recipe.parameters[row.name]]));
  return { name: recipe.system, form: recipe.form, parameters };
}

function optionsData(recipe: Recipe): Record<string, Data> {
  const { step, tolerance, max_steps } = recipe.options;
  return {
    step: step ?? null,
    tolerance: tolerance ?? null,
    max_steps: max_steps === undefined ? null : new Whole(max_steps),
    certify: null,
    digits: null,
  };
}

/** How the run ended, with the counts of a run to the same times. */
async function ending(core: Core, recipe: Recipe, motion: Motion): Promise<Record<string, Data>> {
  if (recipe.method === EXACT) {
    const counts = { n_steps: new Whole(0), n_evaluations: new Whole(0) };
    return { outcome: "reached_end", ...counts, reached: "inf" };
  }
  const run = await core.call("solve", [{ ...requestOf(recipe), times: outputs(motion) }]);
  return {
    outcome: run.outcome,
    n_steps: new Whole(run.steps),
    n_evaluations: new Whole(run.evaluations),
    reached: run.reached,
  };
}

function requestOf(recipe: Recipe): MotionRequest {
  const { system, method, state, t0, options } = gridOf(recipe);
  return { system, method, state, t0, options };
}

const outputs = (motion: Motion): Float64Array => motion.times.slice(0, motion.count);

/** BLAKE2b of the shape and the bits, as `pendula.io.checksums.of_column`. */
function checksum(values: Float64Array): string {
  const shape = new TextEncoder().encode(`(${values.length},)`);
  const bytes = new Uint8Array(shape.length + 8 * values.length);
  bytes.set(shape);
  const view = new DataView(bytes.buffer, shape.length);
  for (const [i, value] of values.entries()) view.setFloat64(8 * i, value, true);
  return blake2b(bytes);
}

/** Names with units, and values, in the order of a file. */
async function columnsOf(
  core: Core,
  recipe: Recipe,
  motion: Motion,
): Promise<[string, Float64Array][]> {
  const { size, count } = motion;
  const components = systemOf(recipe).components.map((row, j): [string, Float64Array] => [
    `${row.name} [${row.unit}]`,
    Float64Array.from({ length: count }, (_, i) => motion.states[i * size + j]),
  ]);
  const kinetic = motion.kinetic.slice(0, count);
  const potential = motion.potential.slice(0, count);
  const rest = await energyColumns(core, recipe, motion);
  return [
    ["t [s]", outputs(motion)],
    ...components,
    ["kinetic_energy [J]", kinetic],
    ["potential_energy [J]", potential],
    ...rest,
  ];
}

/** The error of the energy, as `Trajectory.energy_error`; with friction or a drive work and heat. */
async function energyColumns(
  core: Core,
  recipe: Recipe,
  motion: Motion,
): Promise<[string, Float64Array][]> {
  const total = (i: number) => motion.kinetic[i] + motion.potential[i];
  const { count } = motion;
  const { energyScale } = await core.call("numbers", [described(recipe)]);
  if (systemOf(recipe).capabilities.conservative) {
    const scale = await scaleOf(core, recipe, total(0), energyScale);
    const error = Float64Array.from({ length: count }, (_, i) => (total(i) - total(0)) / scale);
    return [["energy_error [1]", error]];
  }
  const method = recipe.method === EXACT ? "taylor" : recipe.method;
  const request = { ...requestOf(recipe), method, times: outputs(motion) };
  const { works, heats, parts, net, netTails } = await core.call("balance", [request]);
  const width = works.length + heats.length;
  const sum = (from: number, to: number) =>
    Float64Array.from({ length: count }, (_, i) =>
      parts.subarray(i * width + from, i * width + to).reduce((all, part) => all + part, 0),
    );
  const error = Float64Array.from(
    { length: count },
    (_, i) => (total(i) - total(0) - net[i] - netTails[i]) / energyScale,
  );
  return [
    ["energy_error [1]", error],
    ["work [J]", sum(0, works.length)],
    ["heat [J]", sum(works.length, width)],
  ];
}

const TINY = 2.2250738585072014e-308;
const ROUNDINGS = 2 ** 43; // of an angle, as in `Trajectory.energy_error`

/** What the error is relative to: the start's energy or, at rest at the bottom, the system's scale. */
async function scaleOf(core: Core, recipe: Recipe, start: number, energyScale: number) {
  const scale = start < TINY ? energyScale : start;
  if (!systemOf(recipe).capabilities.periodic) return scale;
  const half = recipe.state.length / 2;
  const beside = recipe.state.map((value, j) =>
    j < half ? Math.min(1, spacingAt(Math.abs(value)) * ROUNDINGS) : 0,
  );
  const found = await core.call("energies", [described(recipe), Float64Array.from(beside)]);
  return Math.max(scale, found.kinetic[0] + found.potential[0]);
}

/** The distance to the next larger double. */
function spacingAt(value: number): number {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, value);
  view.setBigUint64(0, view.getBigUint64(0) + 1n);
  return view.getFloat64(0) - value;
}
