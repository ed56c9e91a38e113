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
    for (const view of ["stage", "compare", "map", "data"]) {
      const hash = `#${RODS}&t_max=10&lang=${lang}&view=${view}`;
      const options = { ...STILL, colorScheme, viewport: { width, height: 844 }, bypassCSP: true };
      const { page } = await lab.open(hash, options);
      await computed(page);
      await page.evaluate(() => {
        for (const each of document.querySelectorAll("details")) each.open = true;
      });
      await page.addScriptTag({ content: axe });
      const { violations } = await page.evaluate<Found>("axe.run()");
      const found = violations.flatMap(({ id, nodes }) =>
        nodes.map((node) => `${view}: ${id}: ${node.html}`),
      );
      expect(found).toStrictEqual([]);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      expect(wide, `${view}: scrolls sideways`).toBeLessThanOrEqual(width);
      await page.context().close();
    }
  });
});
