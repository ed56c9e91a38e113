// Which columns of a table are the time and the angle, in which unit, from where it counts.

import { Refused } from "../words/refused";
import type { Table } from "./table";

export type Unit = "deg" | "rad";

/** How a table is read. */
export interface Reading {
  time: number; // columns, from 0
  angle: number;
  unit: Unit;
  upright: boolean; // the angle counts from the top
}

/** Times [s] and angles [rad] from the downward vertical. */
export interface Series {
  t: Float64Array;
  theta: Float64Array;
}

const TIME = /^(t|time|tiempo|temps|zeit|s)(?![a-z]{3})|time|tiempo|temps/i;
const ANGLE = /th(eta)?|θ|ϑ|phi|φ|angle|[aá]ngulo|angulo|winkel|position/i;
const NO_ANGLE = /omega|ω|rate|vel|error|erreur|dot/i;
const DEGREES = /deg|°|grad(?:os)?\b|º/i;
const RADIANS = /rad(?!o)/i;
const LARGEST_IN_RADIANS = 7; // beyond a turn, an angle without a unit is one in degrees

/** A first guess at how a table is to be read; a person may change it. */
export function guess(table: Table): Reading {
  if (table.columns.length < 2) throw new Refused("data_one_column");
  const { names } = table;
  const time = Math.max(
    0,
    names.findIndex((name) => TIME.test(name)),
  );
  const named = names.findIndex(
    (name, i) => i !== time && ANGLE.test(name) && !NO_ANGLE.test(name),
  );
  if (names.length > 0 && named < 0)
    throw new Refused("data_no_angle", { names: names.join(", ") });
  const angle = named < 0 ? (time === 0 ? 1 : 0) : named;
  const name = names[angle] ?? "";
  const largest = table.columns[angle].reduce(
    (most, value) => Math.max(most, Math.abs(value) || 0),
    0,
  );
  const inDegrees = DEGREES.test(name) || (!RADIANS.test(name) && largest > LARGEST_IN_RADIANS);
  return { time, angle, unit: inDegrees ? "deg" : "rad", upright: /upright/i.test(name) };
}

/** Times and angles, the time from 0; rows with an empty cell in either are left out. */
export function seriesOf(table: Table, reading: Reading): Series {
  const { time, angle } = reading;
  const rows = [...table.lines.keys()].filter(
    (row) => !Number.isNaN(table.columns[time][row]) && !Number.isNaN(table.columns[angle][row]),
  );
  if (rows.length < 2) throw new Refused("data_empty");
  for (let i = 1; i < rows.length; ++i) {
    const [before, now] = [table.columns[time][rows[i - 1]], table.columns[time][rows[i]]];
    if (now < before)
      throw new Refused("data_backwards", { line: table.lines[rows[i]], before, now });
  }
  const start = table.columns[time][rows[0]];
  const factor = reading.unit === "deg" ? Math.PI / 180 : 1;
  const t = Float64Array.from(rows, (row) => table.columns[time][row] - start);
  const theta = Float64Array.from(rows, (row) => table.columns[angle][row] * factor);
  if (reading.upright) {
    // The half turn towards the first angle, so that the motion starts near the lowest point.
    const half = theta[0] > 0 ? Math.PI : -Math.PI;
    for (let i = 0; i < theta.length; ++i) theta[i] -= half;
  }
  return { t, theta };
}

/** A start for the run beside the recording: the first angle, and its rate of change. */
export function startOf(series: Series): [number, number] {
  const { t, theta } = series;
  const last = t.findIndex((time, i) => i >= 4 && time > t[0]);
  const at = last < 0 ? t.length - 1 : last;
  return [theta[0], t[at] > t[0] ? (theta[at] - theta[0]) / (t[at] - t[0]) : 0];
}
