// Axes and lines of a graph, on any surface: linear or logarithmic, with ticks at round numbers, or
// at parts of a turn for angles in degrees.

import { shown, superscript } from "../words/language";
import type { Surface } from "./svg";
import { theme } from "./theme";

/** An axis. */
export interface Axis {
  low: number;
  high: number;
  label: string;
  kind?: "linear" | "logarithmic" | "degrees";
}

const LEFT = 46;
const BOTTOM = 30;
const TOP = 8;
const RIGHT = 14;
const ANGLE_STEPS = [1, 2, 5, 10, 15, 30, 45, 90, 180, 360, 720, 1440, 3600];

export class Plot {
  readonly left = LEFT;
  readonly top = TOP;
  readonly right: number;
  readonly bottom: number;

  constructor(
    readonly surface: Surface,
    width: number,
    height: number,
    readonly x: Axis,
    readonly y: Axis,
  ) {
    this.right = width - RIGHT;
    this.bottom = height - BOTTOM;
  }

  /** Place of a value on the surface [px]. */
  px(value: number): number {
    return this.left + part(this.x, value) * (this.right - this.left);
  }

  py(value: number): number {
    return this.bottom - part(this.y, value) * (this.bottom - this.top);
  }

  /** Value at a place [px]. */
  xAt(px: number): number {
    const { low, high } = this.x;
    return low + ((px - this.left) / (this.right - this.left)) * (high - low);
  }

  /** Grid, numbers and labels. */
  frame(): void {
    const { surface: s } = this;
    const colours = theme();
    s.lineWidth = 1;
    s.font = `11px ${colours.font}`;
    s.fillStyle = colours.soft;
    const across = this.right - this.left;
    for (const value of ticks(this.x, Math.max(2, Math.floor(across / 62)))) {
      const at = this.px(value);
      this.stroke(colours.grid, [
        [at, this.top],
        [at, this.bottom],
      ]);
      if (this.x.label && at > this.right - 16 - 6 * this.x.label.length) continue;
      s.textAlign = "center";
      s.textBaseline = "top";
      s.fillText(tickText(this.x, value), at, this.bottom + 5);
    }
    for (const value of ticks(this.y, Math.max(2, Math.floor((this.bottom - this.top) / 34)))) {
      const at = this.py(value);
      this.stroke(colours.grid, [
        [this.left, at],
        [this.right, at],
      ]);
      s.textAlign = "right";
      s.textBaseline = "middle";
      s.fillText(tickText(this.y, value), this.left - 6, at);
    }
    this.stroke(colours.line, [
      [this.left, this.bottom],
      [this.right, this.bottom],
    ]);
    this.labels();
  }

  private labels(): void {
    const { surface: s } = this;
    const colours = theme();
    s.fillStyle = colours.soft;
    s.textBaseline = "top";
    s.textAlign = "right";
    s.fillText(this.x.label, this.right, this.bottom + 5);
    s.textAlign = "left";
    s.textBaseline = "top";
    s.fillText(this.y.label, this.left + 5, this.top);
  }

  private stroke(colour: string, points: [number, number][]): void {
    const { surface: s } = this;
    s.strokeStyle = colour;
    s.beginPath();
    points.forEach(([x, y], i) => {
      if (i === 0) s.moveTo(x, y);
      else s.lineTo(x, y);
    });
    s.stroke();
  }

  /** Draws only within the axes until `inside` is done. */
  clipped(inside: () => void): void {
    const { surface: s } = this;
    s.save();
    s.beginPath();
    s.rect(this.left, this.top, this.right - this.left, this.bottom - this.top);
    s.clip();
    inside();
    s.restore();
  }

  /**
   * A line through values; it is broken where one is no number, and points that fall on the same
   * spot of the screen as the one before are left out.
   * @param overTime whether x only grows.
   */
  line(
    count: number,
    at: (i: number) => readonly [number, number],
    colour: string,
    width = 1.5,
    from = 0,
    overTime = false,
  ): void {
    const { surface: s } = this;
    s.strokeStyle = colour;
    s.lineWidth = width;
    s.lineJoin = "round";
    s.beginPath();
    // Over time four points a pixel are more than an eye can tell apart.
    const most = overTime ? 4 * (this.right - this.left) : Number.POSITIVE_INFINITY;
    const stride = Math.max(1, Math.floor((count - from) / most));
    let pen = false;
    let [lastX, lastY] = [Number.NaN, Number.NaN];
    for (let i = from; i < count; i = nextOf(i, stride, count)) {
      const [x, y] = at(i);
      const [px, py] = [this.px(x), this.py(y)];
      if (!Number.isFinite(px) || !Number.isFinite(py)) {
        pen = false;
        continue;
      }
      if (pen && i < count - 1 && Math.abs(px - lastX) + Math.abs(py - lastY) < 0.7) continue;
      if (pen) s.lineTo(px, py);
      else s.moveTo(px, py);
      pen = true;
      [lastX, lastY] = [px, py];
    }
    s.stroke();
  }

  dot(x: number, y: number, colour: string, radius = 4): void {
    const { surface: s } = this;
    const [px, py] = [this.px(x), this.py(y)];
    if (!Number.isFinite(px) || !Number.isFinite(py)) return;
    s.fillStyle = colour;
    s.beginPath();
    s.arc(px, py, radius, 0, 2 * Math.PI);
    s.fill();
  }

  /** What each colour is, in the upper right corner. */
  names(rows: readonly (readonly [name: string, colour: string])[]): void {
    const { surface: s } = this;
    s.font = `12px ${theme().font}`;
    s.textAlign = "right";
    s.textBaseline = "top";
    rows.forEach(([name, colour], i) => {
      s.fillStyle = colour;
      s.fillText(name, this.right - 4, this.top + 2 + 16 * i);
    });
  }

  /** An upright line, dashed. */
  upright(x: number, colour: string): void {
    this.surface.save();
    this.surface.setLineDash([3, 3]);
    this.stroke(colour, [
      [this.px(x), this.top],
      [this.px(x), this.bottom],
    ]);
    this.surface.restore();
  }
}

/** The next point, and the last one always. */
function nextOf(i: number, stride: number, count: number): number {
  return i < count - 1 ? Math.min(i + stride, count - 1) : count;
}

function part(axis: Axis, value: number): number {
  if (axis.kind === "logarithmic") {
    const [low, high] = [Math.log10(axis.low), Math.log10(axis.high)];
    return value > 0 ? (Math.log10(value) - low) / (high - low) : Number.NaN;
  }
  return (value - axis.low) / (axis.high - axis.low);
}

function ticks(axis: Axis, most: number): number[] {
  if (axis.kind === "logarithmic") {
    const [low, high] = [Math.ceil(Math.log10(axis.low)), Math.floor(Math.log10(axis.high))];
    const step = Math.max(1, Math.ceil((high - low) / most));
    const found = [];
    for (let power = low; power <= high; power += step) found.push(10 ** power);
    return found;
  }
  const step = stepOf(axis, most);
  const found = [];
  for (let i = Math.ceil(axis.low / step); i <= Math.floor(axis.high / step + 1e-9); ++i) {
    found.push(i * step);
  }
  return found;
}

function stepOf(axis: Axis, most: number): number {
  const least = (axis.high - axis.low) / most;
  if (axis.kind === "degrees" && least >= 0.5) {
    return ANGLE_STEPS.find((each) => each >= least) ?? 3600 * Math.ceil(least / 3600);
  }
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((digit) => digit * power).find((each) => each >= least * 0.999)!;
}

function tickText(axis: Axis, value: number): string {
  if (axis.kind === "logarithmic") return `10${superscript(Math.round(Math.log10(value)))}`;
  const rounded = Number(value.toPrecision(6));
  return shown(Object.is(rounded, -0) ? 0 : rounded, 6) + (axis.kind === "degrees" ? "°" : "");
}

/** A range with some room around values; of one value, a unit. */
export function around(values: Iterable<number>, least = 1e-9, room = 0.06): [number, number] {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (!(low <= high)) return [-1, 1];
  const extra = Math.max((high - low) * room, least);
  return [low - extra, high + extra];
}
