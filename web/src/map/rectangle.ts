// Rectangles of starts: zoomed, moved, and always within one turn of each angle.

import type { Range, Rectangle } from "./level";

export const WHOLE: Range = [-Math.PI, Math.PI];

/** The start at parts of the two ranges, each from 0 to 1. */
export function startAt(
  { theta1, theta2 }: Rectangle,
  first: number,
  second: number,
): [number, number] {
  const at = ([low, high]: Range, part: number) => low + part * (high - low);
  return [at(theta1, first), at(theta2, second)];
}

/** A rectangle so many times as wide, with a start that stays where it is. */
export function zoomed(
  { theta1, theta2 }: Rectangle,
  factor: number,
  [first, second]: [number, number],
): Rectangle {
  const around = ([low, high]: Range, at: number): Range =>
    within([at + (low - at) * factor, at + (high - at) * factor]);
  return { theta1: around(theta1, first), theta2: around(theta2, second) };
}

/** A rectangle moved by parts of its width and height. */
export function moved({ theta1, theta2 }: Rectangle, across: number, up: number): Rectangle {
  const by = ([low, high]: Range, part: number): Range =>
    within([low + part * (high - low), high + part * (high - low)]);
  return { theta1: by(theta1, across), theta2: by(theta2, up) };
}

/** A range inside of the angles there are, as wide as it was where that is possible. */
function within([low, high]: Range): Range {
  const width = Math.min(high - low, 2 * Math.PI);
  const start = Math.min(Math.max(low, -Math.PI), Math.PI - width);
  return [start, start + width];
}
