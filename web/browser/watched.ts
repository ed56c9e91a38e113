// Workers that are watched: what each was asked, answered and when it was ended. Runs in the page.

import type { CellRange, FlipCells, FlipMapRequest } from "../src/core/api";

/** What a worker was asked. */
export interface Call {
  name: string;
  arguments_: readonly unknown[];
  asked: number; // ms
  ended: number; // ms; 0: not yet
  value: unknown; // null: none came
}
export interface Watch {
  calls: Call[];
  workers: Worker[];
  ended: number; // workers
}

/** Takes the place of `Worker`; a script that runs before the page's own. */
export function watchWorkers(): void {
  const seen: Watch = { calls: [], workers: [], ended: 0 };
  class Watched extends Worker {
    private readonly open = new Map<number, Call>();

    constructor(...given: ConstructorParameters<typeof Worker>) {
      super(...given);
      seen.workers.push(this);
      this.addEventListener("message", ({ data }) => this.end(data.id, data.value ?? null));
    }

    override postMessage(message: unknown): void {
      const { id, name, arguments_ = [] } = message as Partial<Call> & { id?: number };
      if (id !== undefined) {
        const call = { name: name!, arguments_, asked: performance.now(), ended: 0, value: null };
        this.open.set(id, call);
        seen.calls.push(call);
      }
      super.postMessage(message);
    }

    override terminate(): void {
      super.terminate();
      seen.ended += 1;
      for (const id of [...this.open.keys()]) this.end(id, null);
    }

    private end(id: number, value: unknown): void {
      const call = this.open.get(id);
      if (!call) return;
      Object.assign(call, { value, ended: performance.now() });
      this.open.delete(id);
    }
  }
  Object.assign(globalThis, { watch: seen, Worker: Watched });
}

/** A flip map as it came from the workers, theta1 outermost. */
export interface Cells {
  flipTime: number[]; // s; −1: none
  rod: number[];
  forbidden: number[];
  resolved: number[];
}

/** Puts the answers for one resolution together; runs in the page. */
export function cellsOf(side: number): Cells {
  const seen = (globalThis as unknown as { watch: Watch }).watch;
  const parts = seen.calls.filter(
    ({ name, arguments_, value }) =>
      name === "flipCells" && value && (arguments_[0] as FlipMapRequest).shape[0] === side,
  );
  const empty = () => new Array<number>(side * side).fill(Number.NaN);
  const all = { flipTime: empty(), rod: empty(), forbidden: empty(), resolved: empty() };
  for (const { arguments_, value } of parts) {
    const { first, stop } = arguments_[1] as CellRange;
    const cells = value as FlipCells;
    for (let k = 0, i = first[0]; i < stop[0]; ++i) {
      for (let j = first[1]; j < stop[1]; ++j, ++k) {
        const at = i * side + j;
        all.flipTime[at] = Number.isNaN(cells.flipTime[k]) ? -1 : cells.flipTime[k];
        all.rod[at] = cells.flippedRod[k];
        all.forbidden[at] = cells.forbidden[k];
        all.resolved[at] = cells.resolved[k];
      }
    }
  }
  return all;
}
