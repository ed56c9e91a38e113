/** What can be asked of the core. SI units and radians; angles are never wrapped. */

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

/** An ensemble with variations of its motions: see pendula.chaos. */
export interface VariedRequest extends EnsembleRequest {
  /** Themselves; the MEGNO of the one; or made orthogonal to one another, which gives exponents. */
  readonly use: "free" | "megno" | "orthogonal";
  /** At t0, (k, d): one for the MEGNO, d to be made orthogonal. */
  readonly variations: Float64Array;
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
