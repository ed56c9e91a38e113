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

// Exits with 1 where a cell has other bits than those of flip_map.
const SAME = `
import json, sys, numpy as np, pendula
theirs = json.load(open(sys.argv[1]))
side = int(sys.argv[2])
system = pendula.DoublePendulum.rods()
ours = pendula.flip_map(system, (-3.0, 2.5), (0.5, 3.0), (side, side), 8.0)
def same(key, values, kind):
    found = np.array(theirs[key], kind).reshape(side, side)
    assert found.tobytes() == np.ascontiguousarray(values, kind).tobytes(), key
same("flipTime", np.nan_to_num(ours["flip_time"].values, nan=-1.0), float)
same("rod", ours["flipped_rod"].values, np.uint8)
same("forbidden", ours["forbidden"].values, np.uint8)
same("resolved", ours["resolved"].values, np.uint8)
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
    const map = await page.evaluate(leave, ["flipCells", "Graphs"] as const);
    await page.getByLabel("Poincaré section").check(); // of 2000 s: one long run
    await page.waitForFunction(sectionRuns);
    const section = await page.evaluate(leave, ["solve", "Measured data"] as const);
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

/** Whether a worker is at the section's run, the one that looks for events. */
function sectionRuns(): boolean {
  const seen = (globalThis as unknown as { watch: Watch }).watch;
  return seen.calls.some(
    ({ name, ended, arguments_ }) =>
      name === "solve" && ended === 0 && "events" in (arguments_[0] as object),
  );
}

/** Looks at another view, until all that this one computes has ended; how long that took. */
async function leave([name, tab]: readonly [string, string]): Promise<{
  ms: number;
  later: number;
}> {
  const seen = (globalThis as unknown as { watch: Watch }).watch;
  const ofTheView = () => seen.calls.filter((call) => call.name === name);
  const before = ofTheView();
  const running = before.filter(({ ended }) => ended === 0);
  if (running.length === 0) throw new Error(`no ${name} is running`);
  const left = performance.now();
  const tabs = [...document.querySelectorAll<HTMLElement>("[role=tab]")];
  tabs.find((each) => each.textContent === tab)!.click();
  while (running.some(({ ended }) => ended === 0)) await new Promise(requestAnimationFrame);
  const ms = Math.max(...running.map(({ ended }) => ended)) - left;
  return { ms, later: ofTheView().length - before.length };
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
