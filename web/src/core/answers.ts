/** What comes back from the core. */

/** How a run ended; names as in Python. */
export type Outcome = "reached_end" | "event" | "step_limit" | "not_finite" | "interrupted";

/** What is wrong with a request: `sentence` in fault.ts makes one line of it, in either language. */
export interface Fault {
  /** As Python names it: "step", "state", a parameter. */
  readonly argument: string;
  /** Key of the rule among the catalogue's rules. */
  readonly rule: string;
  readonly value: FaultValue;
  /** What else the sentence names. */
  readonly details: Readonly<Record<string, FaultValue>>;
}
export type FaultValue = null | number | string | readonly string[];

/** A promise is rejected with this where the core refuses what is asked. */
export class RefusedError extends Error {
  constructor(readonly fault: Fault) {
    super(`${fault.argument}: ${fault.rule}`);
    this.name = "RefusedError";
  }
}

/** A promise is rejected with this where the module broke down; the worker was replaced, the next call is answered. */
export class TrappedError extends Error {
  override name = "TrappedError";
}

/** States of a motion at places of its grid. */
export interface Block {
  /** So many of the places asked for, from the first one on; fewer where the motion cannot be computed any further. */
  readonly count: number;
  /** t0 + n·spacing, (count,) [s]. */
  readonly times: Float64Array;
  /** (count, d), one state after the other [rad, rad/s]. */
  readonly states: Float64Array;
  /** "reached_end" where all places came; else why not. */
  readonly outcome: Outcome;
  /** Steps and evaluations of the right-hand side that the motion took up to the furthest place asked for so far. */
  readonly steps: number;
}

/** Where an event took place. */
export interface Crossings {
  /** (k,) [s]. */
  readonly times: Float64Array;
  /** (k, d) [rad, rad/s]. */
  readonly states: Float64Array;
  /** Of an ensemble: the trajectory of each, (k,); empty for one run. */
  readonly trajectories: Float64Array;
}

/** When dry friction in a joint changed: the first entry is the start's. */
export interface Pieces {
  /** (k,) [s]. */
  readonly times: Float64Array;
  /** Which way each joint slips from then on, 1 or −1, or 0: it sticks, (k, joints). */
  readonly senses: Float64Array;
}

/** One run. */
export interface Run {
  readonly outcome: Outcome;
  readonly steps: number;
  readonly evaluations: number;
  /** The time up to which the run was made [s]. */
  readonly reached: number;
  /** Of the outputs, (n,) [s]. */
  readonly times: Float64Array;
  /** (n, d) [rad, rad/s]. */
  readonly states: Float64Array;
  /** One for each event asked for. */
  readonly events: readonly Crossings[];
  readonly pieces: Pieces;
  /** [s]; Infinity: not passed within the run; null: not asked (`options.certify`). */
  readonly trustHorizon: number | null;
}

/** What came of them. */
export interface Ensemble {
  readonly outcomes: readonly Outcome[];
  readonly steps: Float64Array;
  readonly reached: Float64Array;
  /** (n, m, d); NaN where a run did not come so far. */
  readonly states: Float64Array;
  readonly events: readonly Crossings[];
  /** (n,) [s]; null: not asked. */
  readonly trustHorizon: Float64Array | null;
}

/**
 * `states` tells of each run at each time: the state (d); of each variation d components and one number more, how often
 * 2^300 was taken off it (or, orthogonal, the logarithm of its growth); for the MEGNO ∫L dt and ∫Y dt.
 */
export interface Varied extends Ensemble {
  /** Numbers for each run and time. */
  readonly size: number;
}

/** Work and heat since t0 at the request's times [J], as far as the run comes. */
export interface Balance {
  /** Names of the works, then of the heats. */
  readonly works: readonly string[];
  readonly heats: readonly string[];
  /** (n, works + heats). */
  readonly parts: Float64Array;
  /** Works less heats, (n,), and what they go on with below their last bit. */
  readonly net: Float64Array;
  readonly netTails: Float64Array;
}

/** Energies of states (n, d), each (n,) [J]. */
export interface Energies {
  readonly kinetic: Float64Array;
  readonly potential: Float64Array;
}

/** Scales of a system, and the constants that its equations are written in. */
export interface SystemNumbers {
  readonly constants: Readonly<Record<string, number>>;
  /** [J]. */
  readonly energyScale: number;
  /** Of small oscillations, and of what drives them [rad/s]. */
  readonly largestFrequency: number;
  /** Whether dry friction can hold a joint: then nothing can be run backward. */
  readonly sticks: boolean;
}

/** The variables of pendula.flip_map at these cells, theta1 outermost, bit for bit. */
export interface FlipCells {
  /** Centres along each angle [rad]. */
  readonly theta1: Float64Array;
  readonly theta2: Float64Array;
  /** [s]; NaN: no flip until tMax. */
  readonly flipTime: Float64Array;
  /** 0: none. */
  readonly flippedRod: Uint8Array;
  /** 1: its energy is too small for a flip. */
  readonly forbidden: Uint8Array;
  /** 1: the second run agrees; all 0 where `resolve` was not asked. */
  readonly resolved: Uint8Array;
}
