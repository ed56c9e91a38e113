// Without a server: the page that was opened once is opened again, at any path; a page that is served
// anew is taken at the next load.

import { cpSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { BUILT, computed, hasChromium, type Laboratory, laboratory, STILL } from "./laboratory";
import { serve } from "./serve";

const RECIPE = "#system=simple&state=2,0&t_max=20&lang=en";

describe.skipIf(!hasChromium)("offline", () => {
  let lab: Laboratory;
  beforeAll(async () => {
    lab = await laboratory();
  });
  afterAll(() => lab?.close());

  test("the stage runs without the server, below any path; what is served anew comes first", async () => {
    const root = mkdtempSync(join(tmpdir(), "pendula-offline-"));
    const folder = join(root, "a", "lab");
    cpSync(BUILT, folder, { recursive: true });
    const server = await serve(root);
    const address = `${server.url}a/lab/`;
    const { page, said, asked } = await lab.open(address + RECIPE, {
      ...STILL,
      serviceWorkers: "allow",
    });
    page.context().on("request", (request) => asked.push(request.url()));
    await computed(page);
    expect(await page.evaluate(kept)).toBe(address);
    const html = readFileSync(join(folder, "index.html"), "utf8");
    writeFileSync(join(folder, "index.html"), html.replace('lang="en"', 'lang="en" data-anew'));
    expect(await again(page)).toBe(true);
    server.close();
    expect(await again(page)).toBe(false);
    await page.keyboard.press("Space");
    await page.waitForFunction(
      () => Number.parseFloat(document.querySelector(".clock")?.textContent ?? "0") > 0.1,
    );
    expect(said).toStrictEqual([]);
    expect(asked.filter((each) => !each.startsWith(address))).toStrictEqual([]);
  });
});

/** Waits until the page is kept; the addresses it is kept for. */
async function kept(): Promise<string> {
  const { scope } = await navigator.serviceWorker.ready;
  return scope;
}

/** Loads the page again and lets it compute; whether it is the one that was served anew. */
async function again(page: Page): Promise<boolean> {
  await page.reload();
  await computed(page);
  return page.evaluate(() => "anew" in document.documentElement.dataset);
}
