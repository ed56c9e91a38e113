// What a map is asked to show, and a picture of it at one resolution.

import type { SystemDescription } from "../core/api";

export type Range = readonly [low: number, high: number];

/** A rectangle of starts [rad]. */
export interface Rectangle {
  theta1: Range;
  theta2: Range;
}

export const NEVER = 0;
export const FLIPS = 1;
export const FORBIDDEN = 2;
export const UNRESOLVED = 3;
export const WAITS = 4;

/** What a map shows: the time until a rod turns over, or how chaotic the motion is. */
export type Quantity = "flip_time" | "megno";

/** What is to be shown. */
export interface Asked {
  system: SystemDescription;
  rectangle: Rectangle;
  quantity: Quantity;
  tMax: number; // s
}

/** A picture of one resolution. */
export class Level {
  readonly kinds: Uint8Array; // (side, side), theta1 outermost
  readonly values: Float64Array; // s, or MEGNO
  readonly rods: Uint8Array;
  readonly canvas = document.createElement("canvas");
  done = 0; // cells

  constructor(
    readonly asked: Asked,
    readonly side: number,
  ) {
    this.kinds = new Uint8Array(side * side).fill(WAITS);
    this.values = new Float64Array(side * side);
    this.rods = new Uint8Array(side * side);
    this.canvas.width = side;
    this.canvas.height = side;
  }

  get rectangle(): Rectangle {
    return this.asked.rectangle;
  }

  get whole(): boolean {
    return this.done === this.side * this.side;
  }

  /** The cell at a start; −1: outside. */
  cell(theta1: number, theta2: number): number {
    const place = (value: number, [low, high]: Range) =>
      Math.floor(((value - low) / (high - low)) * this.side);
    const i = place(theta1, this.rectangle.theta1);
    const j = place(theta2, this.rectangle.theta2);
    return i < 0 || j < 0 || i >= this.side || j >= this.side ? -1 : i * this.side + j;
  }
}
