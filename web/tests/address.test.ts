// The address says the same to the page and to `pendula.lab.address`: both read tests/data.

import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { parsed, written } from "../src/recipe/address";
import { PRESETS } from "../src/recipe/presets";
import { t } from "../src/words/language";
import { Refused } from "../src/words/refused";

interface Cases {
  good: { link: string; recipe: Record<string, unknown> }[];
  "of Python alone": { link: string; names: string }[];
  bad: { link: string; names: string }[];
}
const file = new URL("../../tests/data/addresses.json", import.meta.url);
const cases = JSON.parse(readFileSync(file, "utf8")) as Cases;

function refusal(link: string): Refused | null {
  try {
    parsed(link);
    return null;
  } catch (error) {
    if (error instanceof Refused) return error;
    throw error;
  }
}

/** Without the sign of a zero, which JSON may lose. */
function plain(value: unknown): unknown {
  return JSON.parse(JSON.stringify(value ?? null));
}

describe("good links", () => {
  test.each(cases.good)("$link", ({ link, recipe }) => {
    const read = parsed(link).recipe;
    const all = { ...read, ...read.options, ...read.parameters };
    for (const [key, value] of Object.entries(recipe)) {
      expect(plain(all[key as keyof typeof all]), key).toStrictEqual(plain(value));
    }
  });

  test.each(cases.good)("$link is written as it was read", ({ link }) => {
    const { recipe, page } = parsed(link);
    expect(parsed(written(recipe, page))).toStrictEqual({ recipe, page });
  });
});

describe("bad links are refused in a line that names the key", () => {
  test.each([...cases.bad, ...cases["of Python alone"]])("$link", ({ link, names }) => {
    const refused = refusal(link);
    expect(refused, link).not.toBeNull();
    const line = t(refused!.key, refused!.values);
    expect(line).toContain(names);
    expect(line).not.toContain("\n");
  });
});

test("so many digits for sure are Python's to keep, and the line says so", () => {
  const { key, values } = refusal("#system=simple&t_max=1&digits=12")!;
  expect(t(key, values)).toBe(
    "“digits” = 12 is not kept by the page, which computes in doubles; use pendula rerun LINK, or leave it out.",
  );
});

test("a zero keeps its sign", () => {
  const { recipe } = parsed("#system=simple&state=-0,0&t_max=1");
  expect(recipe.state.map((value) => Object.is(value, -0))).toStrictEqual([true, false]);
  expect(written(recipe)).toContain("state=-0,0");
});

test("every example is a link of its own", () => {
  for (const { recipe } of PRESETS) {
    const again = parsed(written(recipe)).recipe;
    expect(again).toStrictEqual(recipe);
  }
});
