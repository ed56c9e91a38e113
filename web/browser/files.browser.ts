// What leaves the page: a CSV that pendula in Python reads and runs again to the same bits; the page in
// one file, from a disk and in a sandboxed frame.

import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import {
  BUILT,
  computed,
  hasChromium,
  type Laboratory,
  laboratory,
  PYTHON,
  RODS,
  STILL,
} from "./laboratory";

const folder = mkdtempSync(join(tmpdir(), "pendula-lab-"));

// Exits with 1 where a column of the file has other bits than the run made again.
const AGAIN = `
import sys, numpy, pendula
file = pendula.load(sys.argv[1])
run = pendula.rerun(sys.argv[1])
for name in ("t", "states", "kinetic_energy", "potential_energy", "energy_error"):
    assert getattr(file, name).tobytes() == getattr(run, name).tobytes(), name
print(file.method, file.t.size, run.outcome)
`;

async function saved(page: Page, item: string): Promise<string> {
  await page.locator("summary", { hasText: "Share" }).click();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByText(item).click(),
  ]);
  const path = join(folder, `${Math.random()}-${download.suggestedFilename()}`);
  await download.saveAs(path);
  return path;
}

describe.skipIf(!hasChromium)("files", () => {
  let lab: Laboratory;
  beforeAll(async () => {
    lab = await laboratory();
  });
  afterAll(() => lab?.close());

  test.skipIf(!existsSync(PYTHON)).each([
    ["the Taylor method", `${RODS}&t_max=10`],
    ["RK4", `${RODS}&t_max=10&method=rk4&step=0.001`],
    [
      "a step that the outputs do not fit",
      "system=simple&state=1,0&t_max=5&every=0.1&method=gauss4&step=0.03",
    ],
    ["the closed form", "system=simple&state=3,0&t_max=10&method=exact"],
    [
      "friction and a drive",
      "system=driven&form=bob&viscous=0.2&torque=1&drive_frequency=2&state=1,0&t_max=10",
    ],
    [
      "friction in the joints",
      "system=damped-double&form=rods&viscous1=0.1&coulomb2=0.02&t_max=5&method=dop853",
    ],
    ["time that runs back", "system=simple&state=1,0.5&t_max=-5&method=dop853"],
  ])("CSV of %s is read and run again by pendula, with the same bits", async (_, recipe) => {
    const { page, said } = await lab.open(`#${recipe}&lang=en`, STILL);
    await computed(page);
    const path = await saved(page, "Numbers (CSV)");
    expect(said).toStrictEqual([]);
    expect(execFileSync(PYTHON, ["-c", AGAIN, path], { encoding: "utf8" })).toContain(
      "reached_end",
    );
  });

  test("the same numbers at any speed, after pauses, steps and another size of the window", async () => {
    const recipe = `#${RODS}&t_max=10&method=rk4&step=0.001&lang=en`;
    const texts = [];
    for (const speed of ["0.1", "1", "30"]) {
      const { page } = await lab.open(`${recipe}&speed=${speed}`);
      await computed(page);
      await page
        .getByRole("button", { name: "Pause" })
        .click({ timeout: 2000 })
        .catch(() => null);
      await page.getByRole("button", { name: "A step on" }).click();
      await page.setViewportSize({ width: 500, height: 700 });
      await page.getByRole("button", { name: "Play" }).click();
      await page.waitForTimeout(600);
      texts.push(readFileSync(await saved(page, "Numbers (CSV)"), "utf8"));
    }
    expect(texts[0].length).toBeGreaterThan(1000);
    expect(texts[1]).toBe(texts[0]);
    expect(texts[2]).toBe(texts[0]);
  });

  test("one picture of all figures, as PNG and SVG", async () => {
    const { page } = await lab.open(`#${RODS}&t_max=10&lang=en`, STILL);
    await computed(page);
    const svg = readFileSync(await saved(page, "Picture (SVG)"), "utf8");
    expect(svg.match(/<title>/g)?.length).toBe(4);
    const wrong = await page.evaluate(
      (text) =>
        new DOMParser().parseFromString(text, "image/svg+xml").querySelector("parsererror")
          ?.textContent,
      svg,
    );
    expect(wrong).toBeUndefined();
    await page.keyboard.press("Escape");
    const png = readFileSync(await saved(page, "Picture (PNG)"));
    expect(png.subarray(1, 4).toString()).toBe("PNG");
  });

  test("from a disk, and in a sandboxed frame", async () => {
    const one = pathToFileURL(join(BUILT, "lab.html")).href;
    const frame = join(folder, "frame.html");
    writeFileSync(
      frame,
      `<iframe sandbox="allow-scripts" src="${one}#lang=en" width="900" height="700"></iframe>`,
    );
    for (const address of [`${one}#lang=en`, pathToFileURL(frame).href]) {
      const { page, said } = await lab.open(address);
      const inside = page.frames().at(-1)!;
      await inside.waitForFunction(
        () => Number.parseFloat(document.querySelector(".clock")?.textContent ?? "0") > 0.1,
      );
      await inside.getByText(/Right to/).waitFor();
      expect(said).toStrictEqual([]);
    }
  });
});
