// The clock stands on places of the grid whatever happens to frames, and never passes what is computed.

import { expect, test } from "vitest";
import { Clock } from "../src/run/clock";

function played(speed: number, frames: number[], until: number): number[] {
  const clock = new Clock(0.01, 1000);
  clock.setSpeed(speed);
  clock.play();
  const places = [];
  for (let i = 0; clock.playing && clock.place < until; ++i) {
    places.push(clock.tick(frames[i % frames.length], 1001).place);
  }
  return places;
}

test.each([0.1, 1, 30])("speed %d: whole places that grow to the end", (speed) => {
  const places = played(speed, [16.7, 16.6, 33.3, 7], 1000);
  expect(places.every(Number.isInteger)).toBe(true);
  expect(places.every((place, i) => i === 0 || place >= places[i - 1])).toBe(true);
  expect(places.at(-1)).toBe(1000);
});

test("a second of frames is a second of the motion, however it is cut", () => {
  for (const frame of [1, 4, 16, 50]) {
    const clock = new Clock(0.01, 1000);
    clock.play();
    for (let ms = 0; ms < 2000; ms += frame) clock.tick(frame, 1001);
    expect(clock.place).toBe(200);
  }
});

test("it waits for what is not computed, says so, and does not make up for it", () => {
  const clock = new Clock(0.01, 1000);
  clock.play();
  expect(clock.tick(500, 21)).toStrictEqual({ place: 20, waits: true, ended: false });
  expect(clock.tick(100, 1001)).toStrictEqual({ place: 30, waits: false, ended: false });
});

test("the end stops it; playing again begins at the start", () => {
  const clock = new Clock(0.01, 10);
  clock.play();
  expect(clock.tick(1000, 11)).toStrictEqual({ place: 10, waits: false, ended: true });
  expect(clock.playing).toBe(false);
  clock.play();
  expect(clock.place).toBe(0);
});

test("time runs back on a grid that does", () => {
  const clock = new Clock(-0.01, 100);
  clock.play();
  expect(clock.tick(500, 101).place).toBe(50);
});
