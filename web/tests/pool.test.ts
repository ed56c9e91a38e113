// A computation that is left ends within 100 ms: by itself, or with its worker. The clock is a false one.

import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { Core } from "../src/core/api";
import type { FromWorker, ToWorker } from "../src/core/messages";
import { openCore } from "../src/core/pool";

const NOTHING = new Uint8Array([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0]); // a module without anything in it

/** A worker that answers when it is told to. */
class Idle {
  static all: Idle[] = [];
  onmessage: ((event: { data: FromWorker }) => void) | null = null;
  asked: number[] = [];
  ended = false;

  constructor() {
    Idle.all.push(this);
  }
  postMessage(message: ToWorker): void {
    if (message.kind === "call") this.asked.push(message.id);
    else queueMicrotask(() => this.says({ kind: "ready" }));
  }
  terminate(): void {
    this.ended = true;
  }
  says(data: FromWorker): void {
    this.onmessage?.({ data });
  }
}

let core: Core;
beforeEach(async () => {
  Idle.all = [];
  vi.useFakeTimers();
  core = await openCore({ module: NOTHING, worker: () => new Idle() as never, workers: 2 });
  await Promise.resolve();
});
afterEach(() => {
  core.close();
  vi.useRealTimers();
});

/** Asks for something, and what leaves it; its promise ends in "left". */
function ask(): { leave: () => void; end: Promise<unknown> } {
  const work = new AbortController();
  const end = core
    .call("numbers", [{} as never], { signal: work.signal })
    .catch((error: DOMException) => error.name);
  return { leave: () => work.abort(), end };
}

test("one that has just begun may end by itself: its worker is kept", async () => {
  const { leave, end } = ask();
  leave();
  expect(await end).toBe("AbortError");
  const [, worker] = Idle.all;
  worker.says({ kind: "answer", id: worker.asked[0], value: {} });
  vi.advanceTimersByTime(1000);
  expect([worker.ended, Idle.all.length]).toStrictEqual([false, 2]);
});

test("one that does not is ended within 100 ms, and what waits is not begun", () => {
  const first = ask();
  const second = ask();
  first.leave();
  second.leave();
  vi.advanceTimersByTime(100);
  const [, worker, next] = Idle.all;
  expect(worker.ended).toBe(true);
  expect(worker.asked.length).toBe(1);
  expect(next.asked.length).toBe(0);
});

test("one that has long been running is ended at once, however busy the page is", () => {
  const { leave } = ask();
  vi.advanceTimersByTime(100);
  leave();
  expect(Idle.all[1].ended).toBe(true);
  expect(Idle.all.length).toBe(3);
});
