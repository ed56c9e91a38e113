// axe (Deque) finds no violation: in both languages, light and dark, on a phone and a desk, in each view.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { computed, hasChromium, type Laboratory, laboratory, RODS, STILL } from "./laboratory";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

interface Found {
  violations: { id: string; nodes: { html: string }[] }[];
}

describe.skipIf(!hasChromium)("axe", () => {
  let lab: Laboratory;
  beforeAll(async () => {
    lab = await laboratory();
  });
  afterAll(() => lab?.close());

  const pages = (["en", "es"] as const).flatMap((lang) =>
    (["light", "dark"] as const).flatMap((colorScheme) =>
      [390, 1280].map((width) => ({ lang, colorScheme, width })),
    ),
  );

  test.each(pages)("$lang $colorScheme $width", async ({ lang, colorScheme, width }) => {
    const options = { ...STILL, colorScheme, viewport: { width, height: 844 }, bypassCSP: true };
    const { page } = await lab.open(`#${RODS}&t_max=10&map_t_max=1&lang=${lang}`, options);
    await computed(page);
    await page.addScriptTag({ content: axe });
    for (const view of [0, 1, 2, 3]) {
      await page.evaluate((place) => {
        document.querySelectorAll<HTMLElement>("[role=tab]")[place].click();
        for (const each of document.querySelectorAll("details")) each.open = true;
      }, view);
      const { violations } = await page.evaluate<Found>("axe.run()");
      const found = violations.flatMap(({ id, nodes }) =>
        nodes.map((node) => `view ${view}: ${id}: ${node.html}`),
      );
      expect(found).toStrictEqual([]);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      expect(wide, `view ${view}: scrolls sideways`).toBeLessThanOrEqual(width);
    }
    await page.context().close();
  });
});
