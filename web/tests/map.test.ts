// Rectangles of the flip map, and until where neighbouring cells are different doubles.

import { expect, test } from "vitest";
import { distinct } from "../src/map/explorer";
import { moved, startAt, WHOLE, zoomed } from "../src/map/rectangle";

const whole = { theta1: WHOLE, theta2: WHOLE };

test("zooming leaves the start under the hand where it is", () => {
  const at: [number, number] = [1, -2];
  const near = zoomed(whole, 0.25, at);
  expect(near.theta1[1] - near.theta1[0]).toBeCloseTo(Math.PI / 2, 12);
  const part = (1 + Math.PI) / (2 * Math.PI);
  expect(startAt(near, part, 0.5)[0]).toBeCloseTo(1, 12);
});

test("no rectangle leaves the turn, nor is wider", () => {
  expect(zoomed(whole, 3, [1, 1])).toStrictEqual(whole);
  const edge = moved(zoomed(whole, 0.5, [3, 3]), 10, -10);
  expect(edge.theta1[1]).toBeCloseTo(Math.PI, 12);
  expect(edge.theta2[0]).toBeCloseTo(-Math.PI, 12);
});

test("cells are different doubles until some 2^-43 of the angle", () => {
  // Near 2 rad doubles are 2^-51 apart: pendula.flip_map asks for two of them in a cell.
  const width = (cells: number) => 2 * cells * 2 ** -51;
  const rectangle = (cells: number) => ({
    theta1: [2, 2 + width(cells)] as const,
    theta2: [2, 2 + width(cells)] as const,
  });
  expect(distinct(rectangle(64), 64)).toBe(true);
  expect(distinct(rectangle(63), 64)).toBe(false);
});
