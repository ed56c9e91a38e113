// Examples: recipes worth a look, each with what the page shows of it.

import { formOf, systemNamed } from "../core/catalogue";
import type { Key } from "../words/words";
import { radians } from "./angles";
import { type Page, parametersOf, type Recipe } from "./recipe";

/** An example. */
export interface Preset {
  key: Key;
  recipe: Recipe;
  page: Partial<Page>;
  cloud?: boolean;
}

function recipe(
  system: string,
  form: string,
  state: number[],
  t_max: number,
  more: Partial<Recipe> = {},
  parameters: Record<string, number> = {},
): Recipe {
  return {
    system,
    form,
    state,
    t_max,
    t0: 0,
    method: "taylor",
    options: {},
    ...more,
    parameters: parametersOf(formOf(systemNamed(system)!, form)!, parameters),
  };
}

const STAGE: Partial<Page> = { view: "stage", compare: [] };
const NATURAL = Math.sqrt(9.80665); // rad/s, of a pendulum one metre long

export const PRESETS: readonly Preset[] = [
  // The start of the paper's double pendulum: rods of 1 kg and 1 m at 120° and −10°.
  {
    key: "preset_paper",
    recipe: recipe("double", "rods", [radians(120), radians(-10), 0, 0], 30),
    page: STAGE,
  },
  { key: "preset_small", recipe: recipe("simple", "", [radians(10), 0], 30), page: STAGE },
  { key: "preset_150", recipe: recipe("simple", "", [radians(150), 0], 30), page: STAGE },
  {
    key: "preset_separatrix",
    recipe: recipe("simple", "", [0, 2 * NATURAL], 20, { method: "exact" }),
    page: STAGE,
  },
  {
    key: "preset_flip",
    recipe: recipe("double", "bobs", [radians(150), radians(165), 0, 0], 30),
    page: STAGE,
  },
  {
    key: "preset_pair",
    recipe: recipe("double", "rods", [radians(120), radians(-10), 0, 0], 30),
    page: { view: "compare", compare: ["rk4", "dop853", "gauss4"] },
    cloud: true,
  },
  // Upright on a pivot that shakes fast: a Ωp = 8 m/s is above √(2 g L) = 4.4 m/s (Kapitza, 1951).
  {
    key: "preset_kapitza",
    recipe: recipe(
      "driven",
      "bob",
      [radians(165), 0],
      20,
      {},
      {
        viscous: 0.3,
        pivot_amplitude: 0.1,
        pivot_frequency: 80,
      },
    ),
    page: STAGE,
  },
  // Baker & Gollub, Chaotic Dynamics (1996), q = 2 and Ω = 2/3: at a = 1.07 the period has doubled.
  {
    key: "preset_doubling",
    recipe: recipe(
      "driven",
      "scaled",
      [0.2, 0],
      300,
      {},
      { q: 2, a: 1.07, drive_frequency: 2 / 3 },
    ),
    page: { ...STAGE, speed: 5 },
  },
  {
    key: "preset_damped",
    recipe: recipe("driven", "bob", [radians(120), 0], 40, {}, { viscous: 0.2 }),
    page: STAGE,
  },
];
