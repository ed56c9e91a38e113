// Colours of the flip map: the sooner, the lighter; forbidden, never and unresolved have their own.

import type { CellRange } from "../core/api";
import { type Asked, FORBIDDEN, type Level, NEVER, UNRESOLVED } from "./level";

type Colour = readonly [number, number, number];

export const SHADES: Record<number, Colour> = {
  [FORBIDDEN]: [214, 210, 202],
  [NEVER]: [24, 26, 32],
  [UNRESOLVED]: [232, 86, 150],
};

// Steps of "viridis" (van der Walt & Smith, 2015), even in lightness and seen alike by most eyes; from
// soon to late.
const STEPS: readonly Colour[] = [
  [253, 231, 37],
  [160, 218, 57],
  [74, 193, 109],
  [31, 161, 135],
  [39, 127, 142],
  [54, 92, 141],
  [70, 50, 127],
  [68, 1, 84],
];
export const SOONEST = 0.3; // s: the lightest

/** The colour of a part from 0, soon or chaotic, to 1. */
export function colourAt(part: number): Colour {
  const place = Math.min(Math.max(part, 0), 1) * (STEPS.length - 1);
  const i = Math.min(Math.floor(place), STEPS.length - 2);
  const [a, b, rest] = [STEPS[i], STEPS[i + 1], place - i];
  return [0, 1, 2].map((k) => Math.round(a[k] + (b[k] - a[k]) * rest)) as unknown as Colour;
}

export const REGULAR = 2; // MEGNO of a regular motion: the darkest
export const CHAOTIC = 20; // the lightest

/** Where a value stands between the ends of its scale, on logarithms. */
function partOf({ quantity, tMax }: Asked, value: number): number {
  if (quantity === "megno")
    return Math.log(CHAOTIC / Math.max(value, REGULAR)) / Math.log(CHAOTIC / REGULAR);
  return Math.log(Math.max(value, SOONEST) / SOONEST) / Math.log(tMax / SOONEST);
}

/** Paints some cells of a level; theta2 grows upward. */
export function paint(level: Level, { first, stop }: CellRange): void {
  const { side, kinds, values, canvas, asked } = level;
  const [wide, high] = [stop[0] - first[0], stop[1] - first[1]];
  const image = new ImageData(wide, high);
  for (let i = 0; i < wide; ++i) {
    for (let j = 0; j < high; ++j) {
      const at = (first[0] + i) * side + first[1] + j;
      const colour = SHADES[kinds[at]] ?? colourAt(partOf(asked, values[at]));
      const to = 4 * ((high - 1 - j) * wide + i);
      image.data.set(colour, to);
      image.data[to + 3] = 255;
    }
  }
  canvas.getContext("2d")!.putImageData(image, first[0], side - stop[1]);
}
