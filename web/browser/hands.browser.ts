// Fingers on a phone, and a tab that was hidden.

import type { CDPSession, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { computed, hasChromium, type Laboratory, laboratory, RODS, STILL } from "./laboratory";

const PHONE = { ...STILL, hasTouch: true, isMobile: true, viewport: { width: 390, height: 844 } };
type Place = readonly [x: number, y: number];

describe.skipIf(!hasChromium)("a phone", () => {
  let lab: Laboratory;
  let page: Page;
  let fingers: CDPSession;
  beforeAll(async () => {
    lab = await laboratory();
    ({ page } = await lab.open(`#${RODS}&t_max=20&lang=en&view=map&map_t_max=2`, PHONE, hideable));
    fingers = await page.context().newCDPSession(page);
    await computed(page);
  });
  afterAll(() => lab?.close());

  /** Fingers that go along straight lines together, and are lifted. */
  async function touch(...ways: (readonly [from: Place, to: Place])[]): Promise<void> {
    const steps = 6;
    for (let i = 0; i <= steps; ++i) {
      const touchPoints = ways.map(([from, to], id) => {
        const [x, y] = [0, 1].map((k) => from[k] + ((to[k] - from[k]) * i) / steps);
        return { x, y, id };
      });
      const type = i === 0 ? "touchStart" : "touchMove";
      await fingers.send("Input.dispatchTouchEvent", { type, touchPoints });
    }
    await fingers.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  }

  /** The middle of an element that is scrolled into view. */
  async function middle(selector: string): Promise<Place> {
    const element = page.locator(selector).last();
    await element.scrollIntoViewIfNeeded();
    const { x, y, width, height } = (await element.boundingBox())!;
    return [x + width / 2, y + height / 2];
  }

  test("a finger drags the bob, and the page stays where it is", async () => {
    const [x, y] = await middle(".bob");
    const scrolled = await page.evaluate(() => scrollY);
    await touch([
      [x, y],
      [x - 40, y - 60],
    ]);
    await page.waitForFunction(() => !location.hash.includes("state=2.0943951023931953,-0.17"));
    expect(await page.evaluate(() => scrollY)).toBe(scrolled);
    expect(await page.evaluate(() => /state=2.0943951023931953,/.test(location.hash))).toBe(true);
  });

  test("two fingers zoom the map about what is between them", async () => {
    const [x, y] = await middle(".map canvas");
    await touch(
      [
        [x - 20, y],
        [x - 80, y],
      ],
      [
        [x + 20, y],
        [x + 80, y],
      ],
    );
    await page.waitForFunction(() => location.hash.includes("map_theta1"));
    const [low, high] = /map_theta1=([^&]+)/.exec(page.url())![1].split(",").map(Number);
    expect(high - low).toBeCloseTo((2 * Math.PI) / 4, 1);
    expect((high + low) / 2).toBeLessThan(0.5);
    expect((high + low) / 2).toBeGreaterThan(-0.5);
  });

  test("a tab that was hidden goes on where it stood, on the same places", async () => {
    const before = await stood(page);
    await page.evaluate(() => document.querySelector<HTMLElement>(".round.main")!.click());
    const [left, found] = await page.evaluate(hideFor, 1000);
    await page.evaluate(() => document.querySelector<HTMLElement>(".round.main")!.click());
    expect(found - left).toBeLessThan(0.7); // the hidden second was not made up for
    expect(await stood(page)).toBe(before);
  });
});

/**
 * Lets a script hide the page, which a browser without windows does not: then it draws no frames. Runs
 * before the page's own scripts.
 */
function hideable(): void {
  const draw = window.requestAnimationFrame.bind(window);
  const kept: FrameRequestCallback[] = [];
  let hidden = false;
  window.requestAnimationFrame = (frame) => (hidden ? kept.push(frame) : draw(frame));
  Object.defineProperty(document, "visibilityState", {
    get: () => (hidden ? "hidden" : "visible"),
  });
  window.addEventListener("hide", () => {
    hidden = !hidden;
    document.dispatchEvent(new Event("visibilitychange"));
    if (!hidden) for (const frame of kept.splice(0)) draw(frame);
  });
}

/** Hides the page for some time; the clock before, and a frame after [s]. */
async function hideFor(ms: number): Promise<[number, number]> {
  const clock = () => Number.parseFloat(document.querySelector(".clock")!.textContent!);
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  const left = clock();
  window.dispatchEvent(new Event("hide"));
  await new Promise((done) => setTimeout(done, ms));
  window.dispatchEvent(new Event("hide"));
  await frame();
  await frame();
  return [left, clock()];
}

/** What is on the stage at the 400th place of the grid, to every digit that the bob is told with. */
function stood(page: Page): Promise<string> {
  return page.evaluate(async () => {
    const time = document.querySelector<HTMLInputElement>(".time")!;
    time.value = "400";
    time.dispatchEvent(new Event("input"));
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const bobs = [...document.querySelectorAll(".bob")].map((each) => each.getAttribute("style"));
    time.value = "0";
    time.dispatchEvent(new Event("input"));
    return bobs.join();
  });
}
