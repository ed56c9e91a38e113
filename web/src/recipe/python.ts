// The recipe as a program in Python, which gives the same bits.

import { repr } from "../out/python_text";
import { described, EXACT, formRowOf, placesOf, type Recipe, systemOf } from "./recipe";

const CLASSES: Record<string, string> = {
  linear: "LinearPendulum",
  simple: "SimplePendulum",
  double: "DoublePendulum",
  "driven-linear": "LinearPendulum",
  driven: "DrivenPendulum",
  "damped-double": "DampedDoublePendulum",
};

/** A call that makes the system. */
export function systemInPython(recipe: Recipe): string {
  const values = described(recipe).parameters;
  const rows = formRowOf(recipe).parameters;
  const pairs = recipe.system === "damped-double" ? ["viscous", "coulomb"] : [];
  const given = rows
    .map((row, i) => [row.name, values[i], row.standard] as const)
    .filter(([name, value, standard]) => !(value === 0 && standard === 0) && !inPair(name, pairs));
  const parts = given.map(([name, value]) => `${name}=${repr(value)}`);
  for (const pair of pairs) {
    const [first, second] = [recipe.parameters[`${pair}1`], recipe.parameters[`${pair}2`]];
    if (first !== 0 || second !== 0) parts.push(`${pair}=(${repr(first)}, ${repr(second)})`);
  }
  const form = systemOf(recipe).forms.length > 1 ? `.${recipe.form}` : "";
  return `pendula.${CLASSES[recipe.system]}${form}(${parts.join(", ")})`;
}

function inPair(name: string, pairs: string[]): boolean {
  return pairs.some((pair) => name === `${pair}1` || name === `${pair}2`);
}

/** The whole program. */
export function inPython(recipe: Recipe): string {
  const { state, t0, t_max, every, method, options } = recipe;
  const exact = method === EXACT;
  const grid = every !== undefined || exact;
  const spacing = every ?? Math.abs(t_max - t0) / 500;
  const sign = t_max < t0 ? " - " : " + ";
  const count = every === undefined ? 501 : placesOf(recipe);
  const times = grid ? `${repr(t0)}${sign}${repr(spacing)} * numpy.arange(${count})` : repr(t_max);
  const named = [
    ...(exact ? [] : [`method="${method}"`]),
    ...(t0 === 0 ? [] : [`t0=${repr(t0)}`]),
    ...Object.entries(options).map(([name, value]) => `${name}=${optionText(name, value)}`),
  ];
  const call = exact ? "exact" : "solve";
  return [
    ...(grid ? ["import numpy", ""] : []),
    "import pendula",
    "",
    `system = ${systemInPython(recipe)}`,
    `state = (${state.map(repr).join(", ")})`,
    `run = pendula.${call}(system, state, ${[times, ...named].join(", ")})`,
    "run.plot()",
    "",
  ].join("\n");
}

function optionText(name: string, value: number): string {
  return name === "max_steps" ? String(value) : repr(value);
}
