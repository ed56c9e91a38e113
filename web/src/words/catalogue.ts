// The catalogue's words: symbols of its parameters, units as they are written, its English phrases
// in Spanish, which stand once, in docs/words.toml.

import spanish from "../../../docs/words.toml?raw";
import { current } from "./language";
import type { Key } from "./words";

const SPANISH = new Map(
  [...spanish.matchAll(/^"(.+)" = "(.+)"$/gm)].map((found) => [found[1], found[2]]),
);

/** A phrase of the catalogue in the page's language. */
export function meaning(english: string): string {
  return current() === "es" ? (SPANISH.get(english) ?? english) : english;
}

const SYSTEMS: Record<string, Key> = {
  linear: "system_linear",
  simple: "system_simple",
  double: "system_double",
  "driven-linear": "system_driven_linear",
  driven: "system_driven",
  "damped-double": "system_damped_double",
};

/** The key of a system's name. */
export const named = (system: string): Key => SYSTEMS[system];

const SYMBOLS: Record<string, string> = {
  theta: "θ",
  omega: "ω",
  theta1: "θ₁",
  theta2: "θ₂",
  omega1: "ω₁",
  omega2: "ω₂",
  length: "L",
  gravity: "g",
  mass: "m",
  m1: "m₁",
  m2: "m₂",
  l1: "l₁",
  l2: "l₂",
  c1: "c₁",
  c2: "c₂",
  I1: "I₁",
  I2: "I₂",
  centre: "c",
  inertia: "I",
  viscous: "b",
  viscous1: "b₁",
  viscous2: "b₂",
  coulomb: "τc",
  coulomb1: "τ₁",
  coulomb2: "τ₂",
  quadratic: "d",
  cubic: "r",
  torque: "τ",
  drive_frequency: "Ω",
  drive_phase: "φ",
  pivot_amplitude: "a",
  pivot_frequency: "Ωp",
  pivot_phase: "φp",
  pivot_direction: "α",
  q: "q",
  a: "a",
};

/** A letter for a component or parameter. */
export const symbolOf = (name: string): string => SYMBOLS[name] ?? name;

/** A unit as it is written: m/s², kg m². */
export function unitText(unit: string): string {
  return unit.replace("^2", "²").replace("^3", "³");
}
