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

import type {
  Balance,
  Block,
  Energies,
  Ensemble,
  Fault,
  FlipCells,
  Run,
  SystemNumbers,
  Varied,
} from "./answers";
import type {
  CellRange,
  EnsembleRequest,
  FlipMapRequest,
  GridRequest,
  RunRequest,
  SystemDescription,
  VariedRequest,
} from "./requests";

export * from "./answers";
export * from "./requests";

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
  /** Of states (n, d). */
  energies(system: SystemDescription, states: Float64Array): Energies;
  /** Bob, or end of each rod, (n, d/2, 2): (x, y) with the pivot at the origin, y upward [m]. */
  positions(system: SystemDescription, states: Float64Array): Float64Array;
  /** Time derivatives of states (n, d) at time t. */
  rhs(system: SystemDescription, states: Float64Array, t?: number): Float64Array;
  numbers(system: SystemDescription): SystemNumbers;
  /** Where the energy of a run went, at its output times (not own steps). */
  balance(request: RunRequest): Balance;
  ensemble(request: EnsembleRequest): Ensemble;
  /** Of the double pendulum, by the Taylor method. */
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
