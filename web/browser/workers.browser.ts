// What the workers do for the page: the flip map's numbers are Python's, a view that is left leaves its
// computations, a worker that breaks down is replaced.

import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import {
  computed,
  hasChromium,
  type Laboratory,
  laboratory,
  PYTHON,
  RODS,
  STILL,
} from "./laboratory";
import { cellsOf, type Watch, watchWorkers } from "./watched";

const MAP = "view=map&map_theta1=-3,2.5&map_theta2=0.5,3&map_t_max=8";
const SIDE = 128; // the first that is run a second time, at a thousandth of the tolerance

// Exits with 1 where a cell has other bits than those of flip_map, asked for what it makes its dataset
// of: a second less, without xarray.
const SAME = `
import json, sys, numpy as np, pendula
from pendula.many.chunks.work import Chunk
from pendula.many.maps.flip import FlipMap
theirs = json.load(open(sys.argv[1]))
side = int(sys.argv[2])
system = pendula.DoublePendulum.rods()
whole = Chunk((0, 0), {"theta1": (0, side), "theta2": (0, side)})
flip_map = FlipMap.checked(system, (-3.0, 2.5), (0.5, 3.0), (side, side), 8.0)
ours = flip_map(whole, None, None)
def same(key, values, kind):
    found = np.array(theirs[key], kind).reshape(side, side)
    assert found.tobytes() == np.ascontiguousarray(values, kind).tobytes(), key
same("flipTime", np.nan_to_num(ours["flip_time"], nan=-1.0), float)
same("rod", ours["flipped_rod"], np.uint8)
same("forbidden", ours["forbidden"], np.uint8)
same("resolved", ours["resolved"], np.uint8)
print(*(int(each.sum()) for each in (ours["forbidden"], ~ours["resolved"], np.isnan(ours["flip_time"]))))
`;

describe.skipIf(!hasChromium)("workers", () => {
  let lab: Laboratory;
  let page: Page;
  beforeAll(async () => {
    lab = await laboratory();
    ({ page } = await lab.open(`#${RODS}&t_max=100&lang=en&${MAP}`, STILL, watchWorkers));
    await page.getByText(/256 × 256/).waitFor(); // the coarser ones are whole
  });
  afterAll(() => lab?.close());

  test("leaving a view ends what it computes", async () => {
    const map = await page.evaluate(leave, ["Flip map", "", "Graphs"] as const);
    const section = await page.evaluate(leave, ["Graphs", "Poincaré", "Measured data"] as const);
    console.info(`ended after leaving: ${[map, section].map(({ ms }) => `${ms.toFixed(0)} ms`)}`);
    expect([map.later, section.later]).toStrictEqual([0, 0]);
  });

  test.skipIf(!existsSync(PYTHON))(
    "the map's cells have the bits of pendula.flip_map",
    async () => {
      const file = join(mkdtempSync(join(tmpdir(), "pendula-map-")), "cells.json");
      writeFileSync(file, JSON.stringify(await page.evaluate(cellsOf, SIDE)));
      const counts = execFileSync(PYTHON, ["-c", SAME, file, String(SIDE)], { encoding: "utf8" });
      const [forbidden, unresolved, none] = counts.split(" ").map(Number);
      expect(Math.min(forbidden, unresolved), "all kinds of cells").toBeGreaterThan(0);
      expect(none).toBeGreaterThan(forbidden + unresolved);
    },
  );

  test("a worker that breaks down gives one message and a new worker", async () => {
    const [made, ended] = await page.evaluate(breakOne);
    await page.getByText("its worker was replaced").waitFor();
    expect(await page.locator(".notice").count()).toBe(1);
    expect(await page.evaluate(count)).toStrictEqual([made + 1, ended + 1]);
    await page.getByRole("button", { name: "Close" }).click();
    for (const label of ["Methods part", "Released at 150°"]) {
      await page.getByLabel("Examples").selectOption({ label });
      expect(await page.locator("header select option:checked").textContent()).toBe(label);
    }
    await computed(page);
    expect(await page.locator(".notice").count()).toBe(0);
  });
});

/**
 * Looks at a view, at a graph of it where one is named, and as soon as it computes at another one; how
 * long its computations go on. It is one script, for a run of 2000 s may end while two are sent.
 */
async function leave([from, graph, to]: readonly [string, string, string]) {
  const seen = (globalThis as unknown as { watch: Watch }).watch;
  const named = (selector: string, text: string) =>
    [...document.querySelectorAll<HTMLElement>(selector)].find((each) =>
      each.textContent?.includes(text),
    )!;
  const own = () =>
    seen.calls.filter(({ name, arguments_ }) =>
      graph ? "events" in (arguments_[0] as object) : name === "flipCells",
    );
  const running = () => own().filter(({ ended }) => ended === 0);
  const pause = () => new Promise((done) => setTimeout(done));
  named("[role=tab]", from).click();
  const tick = graph ? named("label", graph).querySelector("input")! : null;
  if (tick?.checked === false) tick.click();
  while (running().length === 0) await pause();
  const before = own();
  const left = performance.now();
  named("[role=tab]", to).click();
  while (running().length > 0) await pause();
  const ms = Math.max(...before.map(({ ended }) => ended)) - left;
  return { ms, later: own().length - before.length };
}

/** Asks a worker for more than its memory holds, which ends in a trap; workers so far, made and ended. */
function breakOne(): [made: number, ended: number] {
  const seen = (globalThis as unknown as { watch: Watch }).watch;
  const { arguments_ } = seen.calls.find(({ name }) => name === "block")!;
  const made: [number, number] = [seen.workers.length, seen.ended];
  const broken = [arguments_[0], 0, 2 ** 29];
  seen.workers[0].postMessage({ kind: "call", id: -1, name: "block", arguments_: broken });
  return made;
}

function count(): [made: number, ended: number] {
  const seen = (globalThis as unknown as { watch: Watch }).watch;
  return [seen.workers.length, seen.ended];
}
