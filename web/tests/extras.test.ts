// A section is computed while it is looked at: it ends when its graph is no longer chosen, or its view is left.

import { expect, test } from "vitest";
import type { Recipe } from "../src/recipe/recipe";
import type { Lab } from "../src/run/lab";
import { emptyMotion } from "../src/run/motion";
import { Extras } from "../src/view/extras";
import type { Key } from "../src/words/words";

const recipe = {
  system: "double",
  form: "rods",
  state: [2, 2.5, 0, 0],
  t0: 0,
  t_max: 100,
  options: {},
  parameters: {},
  method: "taylor",
} as unknown as Recipe;

/** Graphs of a motion that is known, whose section never comes. */
function extras() {
  const asked: AbortSignal[] = [];
  const some = {
    recipe,
    motion: { ...emptyMotion("taylor", 4, 1, 0.1, 0), outcome: "reached_end" },
    tell: () => {},
    caught: () => {},
    core: {
      call: (_: string, __: unknown, { signal }: { signal: AbortSignal }) => {
        asked.push(signal);
        return new Promise(() => {});
      },
    },
  };
  return { asked, graphs: new Extras(some as unknown as Lab) };
}

const chosen = (...keys: Key[]) => new Set<Key>(keys);
const aborted = (asked: AbortSignal[]) => asked.map((each) => each.aborted);

test("a section that is no longer chosen ends, and is asked for anew when it is chosen again", () => {
  const { asked, graphs } = extras();
  graphs.follow(chosen("graph_section"));
  graphs.follow(chosen("graph_section"));
  expect(aborted(asked)).toStrictEqual([false]);
  graphs.follow(chosen());
  expect(aborted(asked)).toStrictEqual([true]);
  graphs.follow(chosen("graph_section"));
  expect(aborted(asked)).toStrictEqual([true, false]);
});

test("leaving the view ends it", () => {
  const { asked, graphs } = extras();
  graphs.follow(chosen("graph_section"));
  graphs.leave();
  expect(aborted(asked)).toStrictEqual([true]);
});
