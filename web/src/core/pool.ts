/** Workers that answer questions: one instance in each, of one compiled module. */
import {
  type CallOptions,
  type Calls,
  type Core,
  type CoreSource,
  RefusedError,
  TrappedError,
} from "./api";
import type { FromWorker, ToWorker } from "./messages";

/** How old a computation that was left may grow before its worker is ended [ms]; a new worker costs some 20 ms. */
const grace = 50;
const fewest = 2;
const most = 8;

interface Task {
  readonly id: number;
  readonly name: keyof Calls;
  readonly arguments_: readonly unknown[];
  readonly live: boolean;
  readonly signal: AbortSignal | undefined;
  readonly resolve: (value: never) => void;
  readonly reject: (error: unknown) => void;
  readonly leave: () => void;
}

interface Slot {
  worker: Worker;
  ready: boolean;
  task: Task | null;
  since: number; // when the task was begun [ms]
}

/** Compile the module and start the workers. */
export async function openCore(source: CoreSource): Promise<Core> {
  const module = await compiled(source.module);
  const processors = globalThis.navigator?.hardwareConcurrency ?? fewest;
  const count = source.workers ?? Math.min(Math.max(processors, fewest), most);
  return new Pool(module, source.worker, Math.max(1, count));
}

async function compiled(source: CoreSource["module"]): Promise<WebAssembly.Module> {
  const given = await source;
  if (given instanceof WebAssembly.Module) return given;
  if (!(given instanceof Response)) return WebAssembly.compile(given);
  if (!given.ok) throw new Error(`${given.url}: ${given.status}`);
  if (given.headers.get("content-type") === "application/wasm") {
    return WebAssembly.compileStreaming(given);
  }
  return WebAssembly.compile(await given.arrayBuffer());
}

class Pool implements Core {
  onTrap: ((message: string) => void) | null = null;
  private readonly slots: Slot[] = [];
  private waiting: Task[] = [];
  private lastId = 0;
  private closed = false;

  constructor(
    private readonly module: WebAssembly.Module,
    private readonly makeWorker: () => Worker,
    count: number,
  ) {
    for (let i = 0; i < count; i++) this.slots.push(this.started());
  }

  get workers(): number {
    return this.slots.length;
  }

  call<Name extends keyof Calls>(
    name: Name,
    arguments_: Parameters<Calls[Name]>,
    options: CallOptions = {},
  ): Promise<ReturnType<Calls[Name]>> {
    return new Promise((resolve, reject) => {
      const { signal } = options;
      if (this.closed) return reject(new Error("the core was closed"));
      if (signal?.aborted) return reject(leftBecause(signal));
      const leave = () => this.leave(task);
      const task: Task = {
        id: ++this.lastId,
        name,
        arguments_,
        live: options.on === "live",
        signal,
        resolve,
        reject,
        leave,
      };
      signal?.addEventListener("abort", leave, { once: true });
      this.waiting.push(task);
      this.dispatch();
    });
  }

  close(): void {
    this.closed = true;
    for (const slot of this.slots) {
      slot.worker.terminate();
      if (slot.task) this.ended(slot, (task) => task.reject(new Error("the core was closed")));
    }
    for (const task of this.waiting) task.reject(new Error("the core was closed"));
    this.waiting = [];
  }

  private started(): Slot {
    const slot: Slot = { worker: this.makeWorker(), ready: false, task: null, since: 0 };
    const { worker } = slot;
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.heard(slot, data);
    worker.onerror = (event) => this.heard(slot, { kind: "trapped", message: event.message });
    worker.postMessage({ kind: "open", module: this.module } satisfies ToWorker);
    return slot;
  }

  /** The first slot is for what is on the stage; where it is the only one, it is for everything. */
  private takes(place: number, task: Task): boolean {
    return this.slots.length === 1 || task.live === (place === 0);
  }

  private dispatch(): void {
    this.slots.forEach((slot, place) => {
      if (!slot.ready || slot.task) return;
      const next = this.waiting.find((task) => this.takes(place, task));
      if (!next) return;
      this.waiting = this.waiting.filter((task) => task !== next);
      slot.task = next;
      slot.since = performance.now();
      const { id, name, arguments_ } = next;
      slot.worker.postMessage({ kind: "call", id, name, arguments_ } satisfies ToWorker);
    });
  }

  private heard(slot: Slot, message: FromWorker): void {
    if (message.kind === "trapped") {
      this.trapped(slot, message.message);
      return;
    }
    if (message.kind === "ready") {
      slot.ready = true;
    } else if (slot.task?.id === message.id) {
      this.ended(slot, (task) => {
        if (message.kind === "answer") task.resolve(message.value as never);
        if (message.kind === "refused") task.reject(new RefusedError(message.fault));
        if (message.kind === "failed") task.reject(new RangeError(message.message));
      });
    }
    this.dispatch();
  }

  /** What a slot was at has come to an end. */
  private ended(slot: Slot, how: (task: Task) => void): void {
    const { task } = slot;
    slot.task = null;
    if (!task) return;
    task.signal?.removeEventListener("abort", task.leave);
    how(task);
  }

  private trapped(slot: Slot, message: string): void {
    // a worker that never was ready would only break down again
    const again = slot.ready;
    this.ended(slot, (task) => task.reject(new TrappedError(message)));
    slot.worker.terminate();
    slot.ready = false;
    if (again && !this.closed) this.replace(slot);
    this.onTrap?.(message);
    if (!again) this.giveUp(message);
  }

  /** Where no worker can be started nothing will be answered. */
  private giveUp(message: string): void {
    if (this.slots.some((slot) => slot.ready)) return;
    for (const task of this.waiting) task.reject(new TrappedError(message));
    this.waiting = [];
  }

  private replace(slot: Slot): void {
    const place = this.slots.indexOf(slot);
    if (place >= 0) this.slots[place] = this.started();
  }

  private leave(task: Task): void {
    this.waiting = this.waiting.filter((each) => each !== task);
    task.reject(leftBecause(task.signal));
    const slot = this.slots.find((each) => each.task === task);
    if (!slot) return;
    const end = () => {
      if (slot.task !== task || this.closed) return;
      slot.worker.terminate();
      slot.task = null;
      this.replace(slot);
    };
    const left = slot.since + grace - performance.now();
    if (left > 0) setTimeout(end, left);
    else end(); // at once: the page may be too busy for a timer
  }
}

function leftBecause(signal: AbortSignal | undefined): unknown {
  return signal?.reason ?? new DOMException("left", "AbortError");
}
