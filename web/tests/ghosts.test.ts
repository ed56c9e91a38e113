// Until when each ghost is right is asked while the comparison is looked at, and left with it.

import { expect, test } from "vitest";
import type { Page, Recipe } from "../src/recipe/recipe";
import { Ghosts } from "../src/run/ghosts";
import type { Lab } from "../src/run/lab";
import { emptyMotion } from "../src/run/motion";

const recipe = { system: "simple", form: "", state: [1, 0], t0: 0, t_max: 1 } as Partial<Recipe>;
const options = { options: {}, parameters: {}, method: "taylor" } as Partial<Recipe>;

/** A laboratory with motions that are computed at once, and horizons that never come. */
function lab(view: Page["view"]) {
  const asked: AbortSignal[] = [];
  const some = {
    recipe: { ...recipe, ...options },
    page: { view, speed: 1, compare: ["rk4", "gauss4"] },
    methods: () => ["rk4", "gauss4"],
    fresh: (method: string) => emptyMotion(method, 2, 1, 0.1, 0),
    source: () => null,
    fill: async () => {},
    tell: () => {},
    caught: () => {},
    horizonOf: (_: string, __: object, signal: AbortSignal) => {
      asked.push(signal);
      return new Promise(() => {});
    },
  };
  return { asked, ghosts: new Ghosts(some as unknown as Lab) };
}

const settled = () => new Promise((done) => setTimeout(done));

test("nobody looks: none is asked, until somebody does", async () => {
  const { asked, ghosts } = lab("stage");
  void ghosts.run();
  await settled();
  expect(ghosts.list.map(({ method }) => method)).toStrictEqual(["rk4", "gauss4"]);
  expect(asked.length).toBe(0);
  void ghosts.judge();
  await settled();
  expect(asked.length).toBe(1);
});

test("leaving the comparison leaves what is asked; the ghosts stay on the stage", async () => {
  const { asked, ghosts } = lab("compare");
  void ghosts.run();
  await settled();
  expect(asked.map(({ aborted }) => aborted)).toStrictEqual([false]);
  ghosts.leave();
  expect(asked.map(({ aborted }) => aborted)).toStrictEqual([true]);
  expect(ghosts.list.length).toBe(2);
});
