// The graphs beside the stage, each of the motion up to now: angles, phase portrait, the path
// of the tip. What is still to come is drawn faintly.

import { isDouble, systemOf } from "../recipe/recipe";
import type { Lab } from "../run/lab";
import type { Motion } from "../run/motion";
import { fixed, t } from "../words/language";
import type { Key } from "../words/words";
import { describeEnergies, drawEnergies } from "./energies";
import { lengthsOf } from "./geometry";
import { around, Plot } from "./plot";
import type { Surface } from "./svg";
import { theme } from "./theme";

/** A graph: its name, for whom it is, how it draws itself and what it says. */
export interface Graph {
  key: Key;
  fits: (lab: Lab) => boolean;
  draw: (lab: Lab, s: Surface, width: number, height: number) => void;
  describe: (lab: Lab) => string;
  /** What of it seldom changes, drawn below. */
  still?: (lab: Lab, s: Surface, width: number, height: number) => void;
}

const LONGEST_PATH = 20_000; // places of the tip's path
const RECENT = 12; // s of a curve that are drawn strongly

export const DEGREES = 180 / Math.PI;
const WINDOW = 20; // s of a graph over time

/** The place of the clock, and how many places there are. */
function now(lab: Lab): { motion: Motion; place: number } {
  const { motion, clock } = lab;
  return { motion, place: Math.max(0, Math.min(clock.place, motion.count - 1)) };
}

/** The part of the time that a graph shows. */
export function timeSpan(lab: Lab): [number, number] {
  const { motion, place } = now(lab);
  const end = motion.t0 + (motion.places - 1) * motion.spacing;
  const [low, high] = [Math.min(motion.t0, end), Math.max(motion.t0, end)];
  if (high - low <= WINDOW) return [low, high];
  const time = motion.times[place];
  const from = Math.min(Math.max(low, time - 0.75 * WINDOW), high - WINDOW);
  return [from, from + WINDOW];
}

/** Places within a span of time. */
export function placesWithin(motion: Motion, [low, high]: [number, number]): [number, number] {
  const at = (time: number) => (time - motion.t0) / motion.spacing;
  const ends = [at(low), at(high)].sort((a, b) => a - b);
  return [Math.max(0, Math.floor(ends[0])), Math.min(motion.count, Math.ceil(ends[1]) + 1)];
}

function* column(motion: Motion, j: number, factor: number, [from, to]: [number, number]) {
  const stride = Math.max(1, Math.floor((to - from) / 4000));
  for (let i = from; i < to; i += stride) yield motion.states[i * motion.size + j] * factor;
}

function drawAngles(lab: Lab, s: Surface, width: number, height: number): void {
  const { motion, place } = now(lab);
  const span = timeSpan(lab);
  const places = placesWithin(motion, span);
  const half = motion.size / 2;
  const values = function* () {
    for (let j = 0; j < half; ++j) yield* column(motion, j, DEGREES, places);
    if (lab.measured) for (const value of lab.measured.theta) yield value * DEGREES;
  };
  const [low, high] = around(values(), 1);
  const axis = { low, high, label: half === 1 ? "θ" : "θ₁, θ₂", kind: "degrees" as const };
  const plot = new Plot(s, width, height, { low: span[0], high: span[1], label: "t / s" }, axis);
  plot.frame();
  plot.clipped(() => {
    if (lab.measured) dots(plot, lab.measured);
    if (lab.twin && lab.twinShown)
      angleLine(plot, lab.twin, 0, theme().methods.linear, places, place);
    for (let j = 0; j < half; ++j) {
      angleLine(plot, motion, j, j === 0 ? theme().accent : theme().second, places, place);
    }
    if (lab.horizon !== null) plot.upright(lab.horizon, theme().warm);
  });
  const twin = [
    [t("non_linear"), theme().accent],
    [t("linear_model"), theme().methods.linear],
  ] as const;
  plot.names(half === 2 ? parts("θ") : lab.twin && lab.twinShown ? twin : []);
}

/** The names of a double pendulum's two curves. */
function parts(letter: string): (readonly [string, string])[] {
  return [
    [`${letter}₁`, theme().accent],
    [`${letter}₂`, theme().second],
  ];
}

function dots(plot: Plot, measured: { t: Float64Array; theta: Float64Array }): void {
  const stride = Math.max(1, Math.floor(measured.t.length / 1500));
  for (let i = 0; i < measured.t.length; i += stride) {
    plot.dot(measured.t[i], measured.theta[i] * DEGREES, theme().warm, 1.8);
  }
}

function angleLine(
  plot: Plot,
  motion: Motion,
  j: number,
  colour: string,
  [from, to]: [number, number],
  place: number,
): void {
  const at = (i: number) =>
    [motion.times[i], motion.states[i * motion.size + j] * DEGREES] as const;
  const end = Math.min(to, motion.count);
  plot.surface.globalAlpha = 0.28;
  plot.line(end, at, colour, 1.3, from, true);
  plot.surface.globalAlpha = 1;
  plot.line(Math.min(place + 1, end), at, colour, 1.8, from, true);
  if (place < motion.count) plot.dot(...at(place), colour);
}

/** The axes of the phase portrait, and the place of a state in it. */
function phase(lab: Lab, s: Surface, width: number, height: number) {
  const { motion } = now(lab);
  const half = motion.size / 2;
  const all: [number, number] = [0, motion.count];
  const fold = systemOf(lab.recipe).capabilities.periodic && half === 1 && turns(motion);
  const [low, high] = fold ? [-180, 180] : around(span(motion, 0, half, DEGREES, all), 4);
  const speeds = around(span(motion, half, 2 * half, 1, all), 0.2, 0.1);
  const x = { low, high, label: half === 1 ? "θ" : "θ₁, θ₂", kind: "degrees" as const };
  const label = half === 1 ? "ω / (rad/s)" : "ω₁, ω₂ / (rad/s)";
  const plot = new Plot(s, width, height, x, { low: speeds[0], high: speeds[1], label });
  const curves = Array.from({ length: half }, (_, j) => {
    const at = (i: number) => {
      const angle = motion.states[i * motion.size + j] * DEGREES;
      return [fold ? folded(angle) : angle, motion.states[i * motion.size + half + j]] as const;
    };
    return { at, line: () => broken(at, fold), colour: j === 0 ? theme().accent : theme().second };
  });
  return { plot, curves };
}

/** The whole curve, faintly, with the separatrix. */
function stillPhase(lab: Lab, s: Surface, width: number, height: number): void {
  const { plot, curves } = phase(lab, s, width, height);
  plot.frame();
  plot.clipped(() => {
    separatrix(plot, lab);
    s.globalAlpha = 0.28;
    for (const { line, colour } of curves) plot.line(lab.motion.count, line(), colour, 1.2);
    s.globalAlpha = 1;
  });
  if (curves.length === 2) plot.names(parts("ω"));
}

function drawPhase(lab: Lab, s: Surface, width: number, height: number): void {
  const { motion, place } = now(lab);
  const { plot, curves } = phase(lab, s, width, height);
  const from = Math.max(0, place - Math.round(RECENT / Math.abs(motion.spacing)));
  plot.clipped(() => {
    for (const { at, line, colour } of curves) {
      plot.line(place + 1, line(), colour, 1.6, from);
      if (motion.count > 0) plot.dot(...at(place), colour);
    }
  });
}

function* span(motion: Motion, from: number, to: number, factor: number, places: [number, number]) {
  for (let j = from; j < to; ++j) yield* column(motion, j, factor, places);
}

function folded(angle: number): number {
  return angle - 360 * Math.round(angle / 360);
}

/** Breaks a line where the angle passes the top. */
function broken(at: (i: number) => readonly [number, number], fold: boolean) {
  let before = Number.NaN;
  return (i: number): readonly [number, number] => {
    const [x, y] = at(i);
    const jumped = fold && Math.abs(x - before) > 180;
    before = x;
    return jumped ? [Number.NaN, y] : [x, y];
  };
}

function turns(motion: Motion): boolean {
  for (let i = 0; i < motion.count; i += 16) {
    if (Math.abs(motion.states[i * motion.size]) > Math.PI) return true;
  }
  return false;
}

/** Between swinging and turning over: ω² = 2 ωn² (1 + cos θ). */
function separatrix(plot: Plot, lab: Lab): void {
  if (lab.recipe.system !== "simple") return;
  const { gravity, length } = lab.recipe.parameters;
  const natural = Math.sqrt(gravity / length);
  for (const sign of [-1, 1]) {
    const at = (i: number) => {
      const angle = plot.x.low + ((plot.x.high - plot.x.low) * i) / 200;
      return [angle, sign * 2 * natural * Math.abs(Math.cos(angle / DEGREES / 2))] as const;
    };
    plot.surface.setLineDash([4, 4]);
    plot.line(201, at, theme().warm, 1.2);
    plot.surface.setLineDash([]);
  }
}

function drawPath(lab: Lab, s: Surface, width: number, height: number): void {
  const { motion, place } = now(lab);
  const reach = lengthsOf(lab.recipe).reduce((sum, each) => sum + each, 0) * 1.06;
  const ratio = (width - 56) / (height - 38);
  const wide = Math.max(1, ratio);
  const tall = Math.max(1, 1 / ratio);
  const x = { low: -reach * wide, high: reach * wide, label: "x / m" };
  const y = { low: -reach * tall, high: reach * tall, label: "y / m" };
  const plot = new Plot(s, width, height, x, y);
  plot.frame();
  const { size, positions } = motion;
  const at = (i: number) => [positions[(i + 1) * size - 2], positions[(i + 1) * size - 1]] as const;
  plot.clipped(() => {
    plot.line(place + 1, at, theme().accent, 1.1, Math.max(0, place - LONGEST_PATH));
    if (motion.count > 0) plot.dot(...at(place), theme().accent);
  });
}

const describeAngles = (lab: Lab): string => {
  const { motion } = now(lab);
  const [low, high] = around(column(motion, 0, DEGREES, [0, motion.count]), 0, 0);
  return t("angles_text", { low: fixed(low, 1), high: fixed(high, 1), end: lab.recipe.t_max });
};

export const GRAPHS: readonly Graph[] = [
  { key: "graph_angles", fits: () => true, draw: drawAngles, describe: describeAngles },
  {
    key: "graph_phase",
    fits: () => true,
    draw: drawPhase,
    still: stillPhase,
    describe: (lab) => t(lab.recipe.system === "simple" ? "phase_text_separatrix" : "phase_text"),
  },
  { key: "graph_energy", fits: () => true, draw: drawEnergies, describe: describeEnergies },
  {
    key: "graph_path",
    fits: (lab) => isDouble(lab.recipe),
    draw: drawPath,
    describe: () => t("path_text"),
  },
];
