// The flip map in words: what a start does, and what the picture shows.

import { DEGREES } from "../view/graphs";
import { fixed, shown, t } from "../words/language";
import { FLIPS, FORBIDDEN, type Level, NEVER, UNRESOLVED, WAITS } from "./level";

const CERTAIN = 4; // MEGNO above which a motion is called chaotic in words

/** What the pendulum does from a start, by the finest picture that has its cell. */
export function whatAt(levels: readonly Level[], start: [number, number], until: number): string {
  for (const level of [...levels].reverse()) {
    const cell = level.cell(...start);
    if (cell < 0 || level.kinds[cell] === WAITS) continue;
    const kind = level.kinds[cell];
    const value = level.values[cell];
    if (level.asked.quantity === "megno") return t("map_megno", { value: shown(value, 4) });
    if (kind === FORBIDDEN) return t("map_forbidden");
    if (kind === UNRESOLVED) return t("map_unresolved");
    if (kind === NEVER) return t("map_never", { time: until });
    return t("map_flip", { rod: level.rods[cell], time: shown(value, 5) });
  }
  return t("map_waits");
}

/** How many starts turn over, do not, and cannot. */
export function inWords(level: Level | undefined, until: number): string {
  if (!level || level.done === 0) return t("map_waits");
  const degrees = (angle: number) => fixed(angle * DEGREES, 1);
  const { theta1, theta2 } = level.rectangle;
  const ends = {
    low1: degrees(theta1[0]),
    high1: degrees(theta1[1]),
    low2: degrees(theta2[0]),
    high2: degrees(theta2[1]),
  };
  if (level.asked.quantity === "megno") {
    const chaotic = level.values.filter((value) => value > CERTAIN).length;
    return t("map_text_megno", { ...ends, chaotic: shown((100 * chaotic) / level.done, 2) });
  }
  const percent = (kind: number) =>
    shown((100 * level.kinds.filter((each) => each === kind).length) / level.done, 2);
  return t("map_text", {
    ...ends,
    flipped: percent(FLIPS),
    never: percent(NEVER),
    forbidden: percent(FORBIDDEN),
    time: until,
  });
}
