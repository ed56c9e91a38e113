/** The core in the thread it lives in: every question of `Calls`, answered at once. */
import {
  type Balance,
  type Block,
  type Calls,
  type CellRange,
  type Crossings,
  type Energies,
  type Ensemble,
  type EnsembleRequest,
  type Fault,
  type FlipCells,
  type FlipMapRequest,
  type GridRequest,
  type Outcome,
  RefusedError,
  type Run,
  type RunRequest,
  type SystemDescription,
  type SystemNumbers,
  type Varied,
  type VariedRequest,
} from "./api";
import { systemNamed } from "./catalogue";
import { Exchange, type FunctionName, faultOfNames, Writer } from "./exchange";

const outcomes: readonly Outcome[] = [
  "reached_end",
  "event",
  "step_limit",
  "not_finite",
  "interrupted",
];
const uses = ["free", "megno", "orthogonal"];
/** Of the second run of a cell, in parts of the first one's tolerance; and the best tolerance there is. */
const tighter = 1e-3;
const bestTolerance = 2 ** -52;

/** One instance of the module. After a trap it is of no more use. */
export class Instance implements Calls {
  private constructor(private readonly exchange: Exchange) {}

  static async open(module: WebAssembly.Module): Promise<Instance> {
    return new Instance(await Exchange.open(module));
  }

  check(request: RunRequest): Fault | null {
    const fault = faultOfNames(request.system, request.method);
    if (fault) return fault;
    const asked = new Writer().request(request, request.times, request.events);
    const answer = this.exchange.ask("check", asked);
    return Array.isArray(answer) ? null : answer;
  }

  checkSystem(system: SystemDescription): Fault | null {
    const fault = faultOfNames(system);
    if (fault) return fault;
    const answer = this.exchange.ask("check_system", new Writer().system(system));
    return Array.isArray(answer) ? null : answer;
  }

  block(request: GridRequest, first: number, count: number, stride = 1): Block {
    this.checkNames(request.system, request.method);
    const asked = new Writer().request(request, new Float64Array()).number(request.spacing);
    const { spacing, t0 = 0 } = request;
    const [told, states] = this.ask("block", asked.number(first).number(count).number(stride));
    const [ended, steps, there] = told;
    const times = Float64Array.from(
      { length: there },
      (_, i) => t0 + (first + i * stride) * spacing,
    );
    return { count: there, times, states: states, outcome: outcome(ended), steps };
  }

  solve(request: RunRequest): Run {
    this.checkNames(request.system, request.method);
    const asked = new Writer().request(request, request.times, request.events);
    const [told, times, states, changes, senses, ...found] = this.ask("solve", asked);
    const [ended, steps, evaluations, reached, certified, horizon] = told;
    return {
      outcome: outcome(ended),
      steps: steps,
      evaluations: evaluations,
      reached: reached,
      times: times,
      states: states,
      events: pairs(found),
      pieces: { times: changes, senses: senses },
      trustHorizon: certified ? horizon : null,
    };
  }

  exact(
    system: SystemDescription,
    states: Float64Array,
    times: Float64Array,
    t0 = 0,
  ): Float64Array {
    this.checkCan(system, "closed_form");
    return this.one("exact", new Writer().system(system).list(states).number(t0).list(times));
  }

  periods(system: SystemDescription, states: Float64Array): Float64Array {
    this.checkCan(system, "period");
    return this.one("periods", new Writer().system(system).list(states));
  }

  energies(system: SystemDescription, states: Float64Array): Energies {
    this.checkNames(system);
    const [kinetic, potential] = this.ask("energies", new Writer().system(system).list(states));
    return { kinetic: kinetic, potential: potential };
  }

  positions(system: SystemDescription, states: Float64Array): Float64Array {
    this.checkNames(system);
    return this.one("positions", new Writer().system(system).list(states));
  }

  rhs(system: SystemDescription, states: Float64Array, t = 0): Float64Array {
    this.checkNames(system);
    return this.one("rhs", new Writer().number(t).system(system).list(states));
  }

  numbers(system: SystemDescription): SystemNumbers {
    this.checkNames(system);
    const [scales, values] = this.ask("numbers", new Writer().system(system));
    const [energyScale, largestFrequency, sticks] = scales;
    const names = systemNamed(system.name)?.constants ?? [];
    const constants = Object.fromEntries(names.map((name, i) => [name, values[i]]));
    return { constants, energyScale, largestFrequency, sticks: sticks !== 0 };
  }

  balance(request: RunRequest): Balance {
    this.checkNames(request.system, request.method);
    if (typeof request.times === "number") throw new RangeError("a balance needs output times");
    const asked = new Writer().request(request, request.times);
    const [parts, net, netTails] = this.ask("balance", asked);
    const { works = [], heats = [] } = systemNamed(request.system.name) ?? {};
    return { works, heats, parts, net, netTails };
  }

  ensemble(request: EnsembleRequest): Ensemble {
    this.checkNames(request.system, request.method);
    return ensembleOf(this.ask("ensemble", new Writer().ensemble(request)));
  }

  varied(request: VariedRequest): Varied {
    this.checkNames(request.system, request.method);
    this.checkCan(request.system, "mapped");
    const { use, variations, state } = request;
    const count = variations.length / state.length;
    if (!Number.isInteger(count) || count < 1 || count > state.length) {
      throw new RangeError("variations are from one to d rows of d numbers");
    }
    const asked = new Writer().ensemble(request).number(uses.indexOf(use)).list(variations);
    const found = ensembleOf(this.ask("varied", asked));
    const size = state.length + (state.length + 1) * count + (use === "megno" ? 2 : 0);
    return { ...found, size };
  }

  flipCells(request: FlipMapRequest, cells: CellRange): FlipCells {
    this.checkCan(request.system, "mapped");
    if (request.resolve && request.tolerance * tighter < bestTolerance) {
      throw new RangeError("a tolerance that small leaves no room for a second run");
    }
    const asked = new Writer().system(request.system).number(request.tMax);
    asked
      .number(request.tolerance)
      .number(request.which ?? 0)
      .number(request.resolve ? 1 : 0);
    [request.theta1, request.theta2].forEach(([lo, hi], i) => {
      asked.number(lo).number(hi).number(request.shape[i]);
      asked.number(cells.first[i]).number(cells.stop[i]);
    });
    const answer = this.ask("flip_cells", asked);
    const [theta1, theta2, flipTime, rod, forbidden, resolved] = answer;
    return {
      theta1: theta1,
      theta2: theta2,
      flipTime: flipTime,
      flippedRod: Uint8Array.from(rod),
      forbidden: Uint8Array.from(forbidden),
      resolved: request.resolve ? Uint8Array.from(resolved) : new Uint8Array(flipTime.length),
    };
  }

  private checkNames(system: SystemDescription, method?: string): void {
    const fault = faultOfNames(system, method);
    if (fault) throw new RefusedError(fault);
  }

  /** Which systems can what a page knows from the catalogue: to ask others is a mistake of the page. */
  private checkCan(system: SystemDescription, what: "closed_form" | "period" | "mapped"): void {
    this.checkNames(system);
    if (!systemNamed(system.name)?.capabilities[what]) {
      throw new RangeError(`${system.name}: not a system that can ${what}`);
    }
  }

  private ask(name: FunctionName, writer: Writer): Float64Array[] {
    const answer = this.exchange.ask(name, writer);
    if (!Array.isArray(answer)) throw new RefusedError(answer);
    return answer;
  }

  private one(name: FunctionName, writer: Writer): Float64Array {
    return this.ask(name, writer)[0];
  }
}

function outcome(number: number): Outcome {
  return outcomes[number];
}

/** Times and states of each event. */
function pairs(lists: readonly Float64Array[]): Crossings[] {
  const events: Crossings[] = [];
  for (let i = 0; i < lists.length; i += 2) {
    const [times, states] = [lists[i], lists[i + 1]];
    events.push({ times, states, trajectories: new Float64Array() });
  }
  return events;
}

function ensembleOf(lists: readonly Float64Array[]): Ensemble {
  const [ended, steps, reached, states, horizons, ...found] = lists;
  const events: Crossings[] = [];
  for (let i = 0; i < found.length; i += 3) {
    const [trajectories, times, crossed] = found.slice(i, i + 3);
    events.push({ trajectories, times, states: crossed });
  }
  return {
    outcomes: Array.from(ended, (each) => outcome(each)),
    steps: steps,
    reached: reached,
    states: states,
    events,
    trustHorizon: horizons.length > 0 ? horizons : null,
  };
}
