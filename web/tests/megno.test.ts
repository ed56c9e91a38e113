// MEGNO of cells: the bits of `indicator_map(DoublePendulum.rods(), (-3, 3), (-2, 1), (4, 3),
// 10.0, "megno", tolerance=1e-8)`, by the module itself.

import { existsSync, readFileSync } from "node:fs";
import { expect, test } from "vitest";
import type { Calls, Core, FlipMapRequest } from "../src/core/api";
import { Instance } from "../src/core/instance";
import { centres, megnoCells } from "../src/map/megno";

const built = new URL("../../build/wasm/lab.wasm", import.meta.url);
const MEGNO = [
  7.2518640244113355, 3.4444118006076065, 4.3258894432091575, 1.1606298379177522,
  0.46920920453862947, 0.7324121811054819, 1.998682132624263, 0.7324121811054819,
  0.46920920453862947, 6.684854704313418, 4.3258894432091575, 3.4444118006076065,
];

test("centres are antisymmetric where the range is", () => {
  const all = [...centres([-1, 1], 6, 0, 6)];
  expect(all.map((value) => -value).reverse()).toEqual(all);
});

test.skipIf(!existsSync(built))("the module's MEGNO has Python's bits", async () => {
  const instance = await Instance.open(new WebAssembly.Module(readFileSync(built)));
  const call = async (name: keyof Calls, values: unknown[]) =>
    (instance[name] as (...all: unknown[]) => unknown)(...values);
  const request: FlipMapRequest = {
    system: { name: "double", form: "rods", parameters: [1, 1, 1, 1, 9.80665] },
    theta1: [-3, 3],
    theta2: [-2, 1],
    shape: [4, 3],
    tMax: 10,
    which: null,
    tolerance: 1e-8,
    resolve: false,
  };
  const cells = { first: [0, 0], stop: [4, 3] } as const;
  const core = { call } as unknown as Core;
  const found = await megnoCells(core, request, cells, new AbortController().signal);
  expect([...found]).toStrictEqual(MEGNO);
});
