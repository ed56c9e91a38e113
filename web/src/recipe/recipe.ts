// What the laboratory runs: the arguments of `pendula.solve` or `pendula.exact`, and nothing else.

import type { GridRequest, SystemDescription } from "../core/api";
import {
  type FormRow,
  formOf,
  type MethodRow,
  methodNamed,
  type ParameterRow,
  type SystemRow,
  systemNamed,
} from "../core/catalogue";

export const EXACT = "exact";

/** Options of a run by the catalogue's names; what is left out is not set. */
export interface Options {
  step?: number;
  tolerance?: number;
  max_steps?: number;
  certify?: number;
}

/** A run; SI units and radians. */
export interface Recipe {
  system: string;
  form: string;
  parameters: Record<string, number>; // all of the form's
  state: number[];
  t0: number;
  t_max: number;
  every?: number; // [s] between outputs
  method: string;
  options: Options;
}

/** What the page shows of it; it does not change a run. */
export interface Page {
  lang?: "en" | "es";
  theme?: "light" | "dark";
  embed?: boolean;
  view: "stage" | "compare" | "map" | "data";
  speed: number;
  compare: string[];
  map_theta1?: [number, number];
  map_theta2?: [number, number];
  map_quantity?: "flip_time" | "megno";
  map_t_max?: number; // s
}

export const systemOf = (recipe: Recipe): SystemRow => systemNamed(recipe.system)!;
export const formRowOf = (recipe: Recipe): FormRow => formOf(systemOf(recipe), recipe.form)!;
export const methodOf = (recipe: Recipe): MethodRow | undefined => methodNamed(recipe.method);
export const isDouble = (recipe: Recipe): boolean => recipe.state.length === 4;

/** A parameter's value where none is named: its own, that of another, or what a slider may begin with. */
export function standardOf(form: FormRow, row: ParameterRow): number {
  if (row.standard !== null) return row.standard;
  const other = form.parameters.find((each) => each.name === row.same_as);
  if (other) return standardOf(form, other);
  return BODY[row.name] ?? 1;
}

// What the page begins with where pendula itself asks for a value: two equal uniform rods described
// as bodies, a metre stick about its end, and the drive of Baker and Gollub (1996).
const BODY: Record<string, number> = {
  c1: 0.5,
  c2: 0.5,
  I1: 1 / 12,
  I2: 1 / 12,
  centre: 0.5,
  inertia: 1 / 3,
  q: 2,
  a: 1.07,
  drive_frequency: 2 / 3,
};

/** All parameters of a form, as far as they are known from elsewhere. */
export function parametersOf(form: FormRow, known: Record<string, number> = {}) {
  return Object.fromEntries(
    form.parameters.map((row) => [row.name, known[row.name] ?? standardOf(form, row)]),
  );
}

/** The system as the core takes it. */
export function described(recipe: Recipe): SystemDescription {
  const { system, form, parameters } = recipe;
  const values = formRowOf(recipe).parameters.map((row) => parameters[row.name]);
  return { name: system, form, parameters: values };
}

const FINEST = 1 / 240; // s between the places of the grid: a frame of the fastest common screens
const MOST_PLACES = 2e6; // states kept of one run; with four components 64 MB

/** Time between the places of the page's clock [s]; with a fixed step a whole multiple of it. */
export function spacingOf(recipe: Recipe): number {
  if (recipe.every !== undefined) return recipe.every;
  const span = Math.abs(recipe.t_max - recipe.t0);
  const least = Math.max(span / MOST_PLACES, Math.min(FINEST, span / 100));
  const { step } = recipe.options;
  if (step === undefined) return tidy(least);
  return step * Math.max(1, Math.ceil(least / step - 1e-9));
}

/** The next larger number of 1, 2 or 5 times a power of ten; 0.005, say. */
function tidy(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const digit = [1, 2, 5, 10].find((each) => each * power >= value * (1 - 1e-9))!;
  return power < 1 ? digit / Math.round(1 / power) : digit * power;
}

/** How many places the grid has, the start included. */
export function placesOf(recipe: Recipe): number {
  return Math.floor(Math.abs(recipe.t_max - recipe.t0) / spacingOf(recipe) + 1e-9) + 1;
}

/** The run of a method on the grid, as the core takes it. */
export function gridOf(recipe: Recipe, method = recipe.method): GridRequest {
  const backward = recipe.t_max < recipe.t0;
  const spacing = spacingOf(recipe) * (backward ? -1 : 1);
  const options = optionsOf(recipe, method);
  return {
    system: described(recipe),
    method,
    state: recipe.state,
    t0: recipe.t0,
    spacing,
    options,
  };
}

const STEP_OF_GHOSTS = 0.01; // s, of a fixed-step method compared with an adaptive one

/** The options a method takes, from those of the recipe. */
export function optionsOf(recipe: Recipe, method: string): { step?: number; tolerance?: number } {
  const row = methodNamed(method);
  if (!row) return {};
  if (!row.adaptive) return { step: recipe.options.step ?? stepOfGhosts(recipe) };
  const { tolerance } = recipe.options;
  return tolerance === undefined || method !== recipe.method ? {} : { tolerance };
}

/** A step that fits into the grid's spacing a whole number of times. */
function stepOfGhosts(recipe: Recipe): number {
  const spacing = spacingOf(recipe);
  return spacing / Math.max(1, Math.round(spacing / STEP_OF_GHOSTS));
}

/** Methods that take the system, exact first where it has a closed form. */
export function methodsFor(recipe: Recipe, all: readonly MethodRow[]): string[] {
  const names = all.filter((row) => row.systems.includes(recipe.system)).map((row) => row.name);
  return systemOf(recipe).capabilities.closed_form ? [EXACT, ...names] : names;
}
