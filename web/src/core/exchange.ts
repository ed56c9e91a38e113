/** What crosses into the module and back: one list of numbers in, lists of numbers and a fault out. */
import type { EnsembleRequest, EventRequest, Fault, MotionRequest, SystemDescription } from "./api";
import { catalogue, formOf, methodNamed, systemNamed } from "./catalogue";

const eventKinds = ["angle", "velocity_zero", "tip_height"];

/** A name that is none, as the core itself would refuse it. */
export function unknownName(argument: string, value: string, choices: readonly string[]): Fault {
  return { argument, rule: "unknown_name", value, details: { choices } };
}

/** The first name of a request that the catalogue does not have; null: it has them all. */
export function faultOfNames(system: SystemDescription, method?: string): Fault | null {
  const row = systemNamed(system.name);
  if (!row) {
    return unknownName(
      "system",
      system.name,
      catalogue.systems.map((each) => each.name),
    );
  }
  if (!formOf(row, system.form)) {
    return unknownName(
      "form",
      system.form,
      row.forms.map((each) => each.name),
    );
  }
  if (method === undefined || methodNamed(method)) return null;
  return unknownName(
    "method",
    method,
    catalogue.methods.map((each) => each.name),
  );
}

/** Writes what is asked, in the order in which bindings/wasm/exchange.cpp reads it. */
export class Writer {
  readonly numbers: number[] = [];

  number(value: number): this {
    this.numbers.push(value);
    return this;
  }

  /** A number that may be left out. */
  option(value: number | undefined): this {
    return this.number(value ?? Number.NaN);
  }

  list(values: ArrayLike<number>): this {
    this.numbers.push(values.length);
    for (let i = 0; i < values.length; i++) this.numbers.push(values[i] as number);
    return this;
  }

  /** A system whose names were looked up before. */
  system(system: SystemDescription): this {
    const place = catalogue.systems.findIndex((row) => row.name === system.name);
    const forms = catalogue.systems[place]?.forms ?? [];
    this.number(place).number(forms.findIndex((row) => row.name === system.form));
    return this.list(system.parameters);
  }

  /** A request whose names were looked up before; times: one end, for outputs at the method's own steps. */
  request(
    request: MotionRequest,
    times: Float64Array | number,
    events: readonly EventRequest[] = [],
  ): this {
    const own = typeof times === "number";
    const options = request.options ?? {};
    this.system(request.system);
    this.number(catalogue.methods.findIndex((row) => row.name === request.method));
    this.number(request.t0 ?? 0).number(own ? 1 : 0);
    this.option(options.step).option(options.tolerance);
    this.option(options.certify).option(options.maxSteps);
    this.list(request.state).list(own ? [times] : times);
    this.number(events.length);
    for (const each of events) {
      this.number(eventKinds.indexOf(each.kind)).number(Math.max(each.index - 1, 0));
      this.number(each.value).number(each.everyTurn ? 1 : 0);
      this.number(each.direction).number(each.terminal);
    }
    return this;
  }

  /** An ensemble: the request, its starts and its parameters. */
  ensemble(request: EnsembleRequest): this {
    this.request(request, request.times, request.events);
    return this.list(request.states).list(request.parameters ?? []);
  }
}

/** The functions that the module exports. */
export interface Exports {
  readonly memory: WebAssembly.Memory;
  _initialize(): void;
  input(count: number): number;
  answer_count(): number;
  answer_data(place: number): number;
  answer_size(place: number): number;
  fault_data(): number;
  fault_size(): number;
}

export type FunctionName =
  | "check"
  | "check_system"
  | "block"
  | "solve"
  | "exact"
  | "periods"
  | "energies"
  | "positions"
  | "rhs"
  | "numbers"
  | "balance"
  | "ensemble"
  | "varied"
  | "flip_cells";

/**
 * What the C library asks of an operating system: a clock, for how long a computation takes, and nothing else. The
 * numbers do not depend on it.
 */
function platform(memory: () => WebAssembly.Memory, wanted: WebAssembly.ModuleImportDescriptor[]) {
  const known: Record<string, (...values: never[]) => number> = {
    clock_time_get: (_clock: number, _precision: bigint, to: number) => {
      const nanoseconds = BigInt(Math.round(performance.now() * 1e6));
      new DataView(memory().buffer).setBigUint64(to, nanoseconds, true);
      return 0;
    },
  };
  const functions: Record<string, (...values: never[]) => number> = {};
  const notThere = 52; // ENOSYS of WASI
  for (const each of wanted) functions[each.name] = known[each.name] ?? (() => notThere);
  return { wasi_snapshot_preview1: functions };
}

/** One instance of the module: asks its functions, and copies their answers. */
export class Exchange {
  private constructor(private readonly exports: Exports & Record<FunctionName, () => number>) {}

  static async open(module: WebAssembly.Module): Promise<Exchange> {
    const imports = platform(() => exports.memory, WebAssembly.Module.imports(module));
    const instance = await WebAssembly.instantiate(module, imports);
    const exports = instance.exports as unknown as Exports & Record<FunctionName, () => number>;
    exports._initialize();
    return new Exchange(exports);
  }

  /** Ask a function: the lists of its answer, or the fault for which it refused. */
  ask(name: FunctionName, writer: Writer): Float64Array[] | Fault {
    const { exports } = this;
    const place = exports.input(writer.numbers.length);
    new Float64Array(exports.memory.buffer, place, writer.numbers.length).set(writer.numbers);
    if (exports[name]() !== 0) {
      const text = new Uint8Array(
        exports.memory.buffer,
        exports.fault_data(),
        exports.fault_size(),
      );
      return JSON.parse(new TextDecoder().decode(text)) as Fault;
    }
    const answers: Float64Array[] = [];
    for (let i = 0; i < exports.answer_count(); i++) {
      const size = exports.answer_size(i);
      const list = new Float64Array(size);
      if (size > 0) {
        list.set(new Float64Array(exports.memory.buffer, exports.answer_data(i), size));
      }
      answers.push(list);
    }
    return answers;
  }
}
