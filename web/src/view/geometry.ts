// Where things are on the stage: metres to pixels and back, the pivot, the parts of a pendulum.

import type { Recipe } from "../recipe/recipe";

/** Lengths of the rods as they are drawn [m]. */
export function lengthsOf({ system, form, parameters: p }: Recipe): number[] {
  if (system === "double" || system === "damped-double") {
    return [p.l1, form === "bodies" ? p.l2 || p.c2 || p.l1 : p.l2];
  }
  if (form === "body") return [2 * p.centre];
  return [form === "scaled" ? 1 : p.length];
}

/** Masses, for the size of the bobs [kg]. */
export function massesOf({ parameters: p }: Recipe): number[] {
  return "m1" in p ? [p.m1, p.m2] : [p.mass ?? 1];
}

/** Whether the parts are bars, and not bobs on rods without mass. */
export function barred({ form }: Recipe): boolean {
  return form === "rods" || form === "bodies" || form === "body";
}

/** Where the pivot is at a time, (x, y) [m]: a (cos α, sin α) cos(Ωp t + φp). */
export function pivotAt({ parameters: p }: Recipe, t: number): [number, number] {
  if (!p.pivot_amplitude) return [0, 0];
  const size = p.pivot_amplitude * Math.cos(p.pivot_frequency * t + p.pivot_phase);
  return [size * Math.cos(p.pivot_direction), size * Math.sin(p.pivot_direction)];
}

/** Ends of the rods of a state, (x, y) from the pivot [m]; only for what is drawn by hand. */
export function endsOf(lengths: number[], angles: readonly number[]): [number, number][] {
  let [x, y] = [0, 0];
  return lengths.map((length, i) => {
    x += length * Math.sin(angles[i]);
    y -= length * Math.cos(angles[i]);
    return [x, y];
  });
}

/** A pane of the stage. */
export interface Pane {
  x: number; // of the pivot [px]
  y: number;
  scale: number; // px in a metre
}

const MARGIN = 34; // px

/** Panes side by side, with room for a whole turn. */
export function panes(recipe: Recipe, count: number, width: number, height: number): Pane[] {
  const reach = lengthsOf(recipe).reduce((sum, length) => sum + length, 0);
  const moved = Math.abs(recipe.parameters.pivot_amplitude ?? 0);
  const across = width / count;
  const half = Math.max(20, Math.min(across, height) / 2 - MARGIN);
  return Array.from({ length: count }, (_, i) => ({
    x: across * (i + 0.5),
    y: height / 2,
    scale: half / (reach + moved),
  }));
}

/** Pixels of a place [m]. */
export function toScreen(pane: Pane, x: number, y: number): [number, number] {
  return [pane.x + pane.scale * x, pane.y - pane.scale * y];
}

/** Whole turns of `near` and the rest of `angle`, so that dragging never jumps a turn. */
export function unwrapped(angle: number, near: number): number {
  const turn = 2 * Math.PI;
  return angle + turn * Math.round((near - angle) / turn);
}
