/**
 * The core as a page sees it: what can be asked, and what comes back. The numbers are computed by the C++ core in
 * WebAssembly and have the bits of the Python package. SI units and radians everywhere; angles are never wrapped.
 *
 * `Calls` lists every question. `Instance` (instance.ts) answers them at once, in the thread it lives in; `Core` (pool.ts)
 * answers them as promises, from workers that share one compiled module. A page uses `Core`:
 *
 *     const core = await openCore({ module: fetch(wasmUrl), worker: () => new Worker(workerUrl, { type: "module" }) });
 *     const block = await core.call("block", [{ system, method: "taylor", state, spacing: 1 / 240 }, 0, 240]);
 */

/** A system of the catalogue, one of its forms, and values for all parameters of that form, in its order. */
export interface SystemDescription {
  /** Name in the catalogue: "linear", "simple", "double", "driven-linear", "driven", "damped-double". */
  readonly name: string;
  /** Name of the form; "" where the system has one only. */
  readonly form: string;
  readonly parameters: readonly number[];
}

/** What to look for inside the steps of an adaptive method; pendula.events makes the same. */
export interface EventRequest {
  readonly kind: "angle" | "velocity_zero" | "tip_height";
  /** The rod, from 1; of no meaning for "tip_height". */
  readonly index: number;
  /** That is passed [rad or m]. */
  readonly value: number;
  /** Whether an angle also passes it whole turns away; with value Math.PI it is a flip. */
  readonly everyTurn: boolean;
  /** 1: growing with time, −1: falling, 0: both. */
  readonly direction: -1 | 0 | 1;
  /** So many end the run; 0: none does. */
  readonly terminal: number;
}

/** A rod's passage through the top, as pendula.events.flip. */
export function flip(index: number, direction: -1 | 0 | 1 = 0, terminal = 0): EventRequest {
  return { kind: "angle", index, value: Math.PI, everyTurn: true, direction, terminal };
}

/** A turning point of a rod, as pendula.events.velocity_zero. */
export function velocityZero(index: number, direction: -1 | 0 | 1 = 0, terminal = 0): EventRequest {
  return { kind: "velocity_zero", index, value: 0, everyTurn: false, direction, terminal };
}

/** The passage of an angle through a value, as pendula.events.angle; `everyTurn` makes a section of it. */
export function angle(
  index: number,
  value: number,
  direction: -1 | 0 | 1 = 0,
  terminal = 0,
  everyTurn = false,
): EventRequest {
  return { kind: "angle", index, value, everyTurn, direction, terminal };
}

/** Options of a run, as pendula.solve takes them; what is left out is not set. */
export interface RunOptions {
  /** Of a fixed-step method [s]. */
  readonly step?: number;
  /** Of an adaptive method. */
  readonly tolerance?: number;
  readonly maxSteps?: number;
  /** Asks for the trust horizon: the angle that the run may be off by [rad]. */
  readonly certify?: number;
}

/** What to run, from which state. */
export interface MotionRequest {
  readonly system: SystemDescription;
  /** Name in the catalogue, such as "rk4", "dop853" or "taylor". */
  readonly method: string;
  /** (θ, ω) or (θ1, θ2, ω1, ω2) at t0 [rad, rad/s]. */
  readonly state: readonly number[];
  /** Time of the state [s]; 0 where it is left out. */
  readonly t0?: number;
  readonly options?: RunOptions;
}

/** A run with outputs at given times, or at its own steps. */
export interface RunRequest extends MotionRequest {
  /** Output times, strictly monotonic from t0 on [s]; or one end time: the outputs are then the method's own steps. */
  readonly times: Float64Array | number;
  readonly events?: readonly EventRequest[];
}

/**
 * A motion on the grid t0 + n·spacing, n = 0, 1, 2 …, without an end. With a fixed-step method the spacing is a whole
 * multiple of the step. The state at place n has the bits of
 * `pendula.solve(system, state, [t0 + n * spacing], method, t0=t0, …)` however the grid is asked for: in whatever pieces,
 * forwards and back. `maxSteps` and `certify` are not looked at here.
 */
export interface GridRequest extends MotionRequest {
  readonly spacing: number;
}

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

/** Many runs at the same output times, through lanes. */
export interface EnsembleRequest extends MotionRequest {
  /** Starts (n, d), one after the other; the request's own `state` is not looked at, but has d components. */
  readonly states: Float64Array;
  /** (n, p), for systems that differ; left out: those of `system` for all. */
  readonly parameters?: Float64Array;
  /** Output times (m,) [s]. To go on later, ask again with the last states as starts and the last time as t0: with the
   * explicit methods these are the bits of one long run. */
  readonly times: Float64Array;
  readonly events?: readonly EventRequest[];
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

/** An ensemble with variations of its motions: see pendula.chaos. */
export interface VariedRequest extends EnsembleRequest {
  /** Themselves; the MEGNO of the one; or made orthogonal to one another, which gives exponents. */
  readonly use: "free" | "megno" | "orthogonal";
  /** At t0, (k, d): one for the MEGNO, d to be made orthogonal. */
  readonly variations: Float64Array;
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

/** How a run's states change with what is named. */
export interface Derivatives {
  /** (n, d, k). */
  readonly states: Float64Array;
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

/** A flip map, as pendula.flip_map takes it. */
export interface FlipMapRequest {
  readonly system: SystemDescription;
  /** Ranges of the angles at the start, at rest [rad]. */
  readonly theta1: readonly [number, number];
  readonly theta2: readonly [number, number];
  /** Cells along each. */
  readonly shape: readonly [number, number];
  /** [s]. */
  readonly tMax: number;
  /** The rod that has to flip; null: the first that does. */
  readonly which: 1 | 2 | null;
  /** 1e-8 in Python. */
  readonly tolerance: number;
  /** Whether each cell is run again at a thousandth of the tolerance. */
  readonly resolve: boolean;
}

/** Cells first[0] … stop[0]−1 along theta1, and first[1] … stop[1]−1 along theta2. */
export interface CellRange {
  readonly first: readonly [number, number];
  readonly stop: readonly [number, number];
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

/** Every question. Arrays in answers belong to who asked. Each refuses bad input with a `RefusedError`. */
export interface Calls {
  /** The first fault of a request; null: it is sound. */
  check(request: RunRequest): Fault | null;
  /** The first fault of a system's parameters. */
  checkSystem(system: SystemDescription): Fault | null;
  /**
   * A motion at the places first, first + stride … of its grid, `count` of them. An instance keeps the last motions and
   * goes on from where they stand, so that asking piece by piece costs no more than asking at once.
   */
  block(request: GridRequest, first: number, count: number, stride?: number): Block;
  /** One run, with events and, by `options.certify`, its trust horizon: what pendula.solve gives. */
  solve(request: RunRequest): Run;
  /** The closed form, (m, n, 2), from states (m, 2) at t0: what pendula.exact gives. */
  exact(
    system: SystemDescription,
    states: Float64Array,
    times: Float64Array,
    t0?: number,
  ): Float64Array;
  /** Exact periods of states (m, 2), (m,) [s]; Infinity on the separatrix. */
  periods(system: SystemDescription, states: Float64Array): Float64Array;
  /** When each state (m, 2), with ω ≥ 0 or ω < 0 alike, is first at its angle (m,) [s]. */
  timesAt(system: SystemDescription, states: Float64Array, theta: Float64Array): Float64Array;
  /** Of states (n, d). */
  energies(system: SystemDescription, states: Float64Array): Energies;
  /** Bob, or end of each rod, (n, d/2, 2): (x, y) with the pivot at the origin, y upward [m]. */
  positions(system: SystemDescription, states: Float64Array): Float64Array;
  /** Time derivatives of states (n, d) at time t. */
  rhs(system: SystemDescription, states: Float64Array, t?: number): Float64Array;
  numbers(system: SystemDescription): SystemNumbers;
  /** Where the energy of a run went, at its output times (not own steps). */
  balance(request: RunRequest): Balance;
  /** Of a run of the Taylor method, at its outputs: by components of the start, from 0, and from d on parameters. */
  derivatives(request: RunRequest, columns: readonly number[]): Derivatives;
  ensemble(request: EnsembleRequest): Ensemble;
  varied(request: VariedRequest): Varied;
  flipCells(request: FlipMapRequest, cells: CellRange): FlipCells;
}

/** How a call is treated. */
export interface CallOptions {
  /** Leaves the call: its promise is rejected with an AbortError at once; its computation ends within 100 ms. */
  readonly signal?: AbortSignal;
  /** "live": the worker that is kept for what is on the stage; left out: any other one. */
  readonly on?: "live" | "any";
}

/** A pool of workers: one instance in each, of one compiled module. */
export interface Core {
  /** How many, the live one included. */
  readonly workers: number;
  /** Ask: `core.call("block", [request, 0, 240], { on: "live" })`. */
  call<Name extends keyof Calls>(
    name: Name,
    arguments_: Parameters<Calls[Name]>,
    options?: CallOptions,
  ): Promise<ReturnType<Calls[Name]>>;
  /** Called with one message whenever a worker broke down and was replaced. */
  onTrap: ((message: string) => void) | null;
  /** Ends all workers. */
  close(): void;
}

/** What opens a pool. */
export interface CoreSource {
  /** The module: where it is fetched from, its bytes, or itself. */
  readonly module: Response | Promise<Response> | BufferSource | WebAssembly.Module;
  /** Makes a worker that runs web/src/core/worker.ts. */
  readonly worker: () => Worker;
  /** How many; left out: one for each processor, from 2 to 8. */
  readonly workers?: number;
}
