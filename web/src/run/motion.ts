// A motion on the grid of the clock, computed piece by piece in a worker: the page shows the first
// piece while the others are made, and leaves a run as soon as a person asks for another.

import type { Core, GridRequest, Outcome, Run } from "../core/api";

/** States and what follows from them, at the places of a grid. */
export interface Motion {
  readonly id: number; // no two motions have the same
  readonly method: string;
  readonly size: number; // components of a state
  readonly places: number; // in all
  readonly spacing: number; // s
  readonly t0: number; // s
  readonly times: Float64Array;
  readonly states: Float64Array; // (places, size) [rad, rad/s]
  readonly positions: Float64Array; // (places, size) [m]: x and y of each bob
  readonly kinetic: Float64Array; // J
  readonly potential: Float64Array; // J
  count: number; // computed so far
  outcome: Outcome | null; // null: not at its end
  steps: number;
}

let lastId = 0;

/** Room for a motion that is to be computed. */
export function emptyMotion(
  method: string,
  size: number,
  places: number,
  spacing: number,
  t0: number,
): Motion {
  return {
    id: ++lastId,
    method,
    size,
    places,
    spacing,
    t0,
    times: new Float64Array(places),
    states: new Float64Array(places * size),
    positions: new Float64Array(places * size),
    kinetic: new Float64Array(places),
    potential: new Float64Array(places),
    count: 0,
    outcome: null,
    steps: 0,
  };
}

/** States at some places, from `first` on. */
export interface Piece {
  times: Float64Array;
  states: Float64Array;
  count: number;
  outcome: Outcome;
  steps: number;
}
export type Source = (first: number, count: number, signal: AbortSignal) => Promise<Piece>;

/** The places of a method's run. */
export function gridSource(core: Core, request: GridRequest): Source {
  return (first, count, signal) =>
    core.call("block", [request, first, count], { signal, on: "live" });
}

/** The places of the closed form. */
export function exactSource(core: Core, request: Omit<GridRequest, "method">): Source {
  const { system, state, spacing } = request;
  const t0 = request.t0 ?? 0;
  return async (first, count, signal) => {
    const times = Float64Array.from({ length: count }, (_, i) => t0 + (first + i) * spacing);
    const states = await core.call("exact", [system, Float64Array.from(state), times, t0], {
      signal,
      on: "live",
    });
    return { times, states, count, outcome: "reached_end", steps: 0 };
  };
}

/** All places at once: of a run whose outputs are no whole multiples of its step. */
export function solveSource(core: Core, request: GridRequest, places: number): Source {
  const { spacing, t0 = 0, ...rest } = request;
  const times = Float64Array.from({ length: places - 1 }, (_, i) => t0 + (i + 1) * spacing);
  const size = request.state.length;
  let asked: Promise<Run> | null = null;
  return async (first, count, signal) => {
    asked ??= core.call("solve", [{ ...rest, t0, times }], { signal, on: "live" });
    const run = await asked;
    const states = new Float64Array((run.times.length + 1) * size);
    states.set(request.state);
    states.set(run.states, size);
    const there = Math.min(count, run.times.length + 1 - first);
    return {
      times: Float64Array.from({ length: there }, (_, i) => t0 + (first + i) * spacing),
      states: states.subarray(first * size, (first + there) * size),
      count: there,
      outcome: run.outcome,
      steps: run.steps,
    };
  };
}

const FIRST = 1024; // places of the first piece: the stage moves at once
const PIECE = 8192;

/**
 * Fills a motion from its source.
 * @param grown is called after each piece.
 * @returns when it is whole, or ended before; rejected where the core refuses it or it was left.
 */
export async function compute(
  core: Core,
  motion: Motion,
  source: Source,
  system: GridRequest["system"],
  signal: AbortSignal,
  grown: () => void,
): Promise<void> {
  const options = { signal, on: "live" } as const;
  const { size } = motion;
  while (motion.count < motion.places && motion.outcome === null) {
    const first = motion.count;
    const count = Math.min(first === 0 ? FIRST : PIECE, motion.places - first);
    const piece = await source(first, count, signal);
    const states = piece.states.slice(0, piece.count * size);
    const [energies, positions] = await Promise.all([
      core.call("energies", [system, states], options),
      core.call("positions", [system, states], options),
    ]);
    motion.times.set(piece.times.subarray(0, piece.count), first);
    motion.states.set(states, first * size);
    motion.positions.set(positions, first * size);
    motion.kinetic.set(energies.kinetic, first);
    motion.potential.set(energies.potential, first);
    motion.count = first + piece.count;
    motion.steps = piece.steps;
    if (piece.count < count || motion.count === motion.places) motion.outcome = piece.outcome;
    grown();
  }
}

/** A state of a motion. */
export function stateAt(motion: Motion, place: number): number[] {
  return [...motion.states.subarray(place * motion.size, (place + 1) * motion.size)];
}
