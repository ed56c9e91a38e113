// The explorer's pictures hold, cell by cell, what one map of their shape holds: chunks, order and
// refinement change nothing.

import { existsSync, readFileSync } from "node:fs";
import { expect, test } from "vitest";
import type { Calls, CellRange, Core, FlipCells, FlipMapRequest } from "../src/core/api";
import { Instance } from "../src/core/instance";
import { Explorer } from "../src/map/explorer";
import { FLIPS, FORBIDDEN, type Level, NEVER, UNRESOLVED } from "../src/map/level";

const built = new URL("../../build/wasm/lab.wasm", import.meta.url);
const SYSTEM = { name: "double", form: "rods", parameters: [1, 1, 1, 1, 9.80665] };
const RECTANGLE = { theta1: [-3, 2.5], theta2: [0.5, 3] } as const;

/** What a level draws itself on. */
class Blank {
  readonly data: Uint8ClampedArray;
  constructor(wide = 0, high = 0) {
    this.data = new Uint8ClampedArray(4 * wide * high);
  }
  getContext = () => ({ putImageData: () => {} });
}

const PATIENCE = { timeout: 30_000 }; // ms: the machine may be busy

test.skipIf(!existsSync(built))("each level is the flip map of its shape", PATIENCE, async () => {
  Object.assign(globalThis, { ImageData: Blank, document: { createElement: () => new Blank() } });
  const instance = await Instance.open(new WebAssembly.Module(readFileSync(built)));
  const call = async (
    name: keyof Calls,
    values: unknown[],
    { signal }: { signal: AbortSignal },
  ) => {
    signal.throwIfAborted();
    return (instance[name] as (...all: unknown[]) => unknown)(...values);
  };
  const core = { workers: 3, call } as unknown as Core;
  const levels: Level[] = [];
  const explorer = new Explorer(core, () => {
    const { last } = explorer;
    if (last?.whole && !levels.includes(last)) levels.push(last);
    if (last?.whole && last.side === 128) explorer.leave();
  });
  const asked = { system: SYSTEM, rectangle: RECTANGLE, quantity: "flip_time", tMax: 2 } as const;
  await expect(explorer.show(asked, false)).rejects.toThrow(/aborted/);
  expect(levels.map(({ side }) => side)).toStrictEqual([32, 64, 128]);
  for (const level of levels) {
    const whole = instance.flipCells(requestOf(level.side), rangeOf(level.side));
    expect(level.values).toStrictEqual(whole.flipTime);
    expect(level.rods).toStrictEqual(whole.flippedRod);
    expect(level.kinds).toStrictEqual(kindsOf(whole, level.side >= 128));
  }
});

function requestOf(side: number): FlipMapRequest {
  const shape = [side, side] as const;
  const how = { tMax: 2, which: null, tolerance: 1e-8, resolve: side >= 128 };
  return { system: SYSTEM, ...RECTANGLE, shape, ...how };
}

function rangeOf(side: number): CellRange {
  return { first: [0, 0], stop: [side, side] };
}

function kindsOf({ flipTime, forbidden, resolved }: FlipCells, resolve: boolean): Uint8Array {
  return Uint8Array.from(flipTime, (time, k) => {
    if (forbidden[k]) return FORBIDDEN;
    if (resolve && !resolved[k]) return UNRESOLVED;
    return Number.isNaN(time) ? NEVER : FLIPS;
  });
}
