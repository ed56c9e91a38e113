// Below the stage: the period beside the exact one, and until when the motion is right.

import { el } from "../controls/dom";
import { described, EXACT } from "../recipe/recipe";
import type { Lab } from "../run/lab";
import type { Motion } from "../run/motion";
import { fixed, shown, t } from "../words/language";

export class Readings {
  readonly element = el("div", { class: "readings" });
  waits = false;
  private exact: number | null = null; // s
  private asked = "";
  private readonly period = el("p");
  private readonly trust = el("p");

  constructor(private readonly lab: Lab) {
    this.element.append(this.period, this.trust);
  }

  follow(): void {
    this.ask();
    write(this.period, this.periodText());
    write(this.trust, this.trustText());
    const { motion, clock, horizon } = this.lab;
    const passed = horizon !== null && motion.times[clock.place] > horizon;
    this.trust.classList.toggle("passed", passed);
  }

  /** Asks the core for the exact period whenever the start or the system is another. */
  private ask(): void {
    const { lab } = this;
    const { recipe } = lab;
    if (recipe.system !== "simple" && recipe.system !== "linear") {
      this.exact = null;
      return;
    }
    const key = JSON.stringify([recipe.parameters, recipe.state]);
    if (key === this.asked) return;
    this.asked = key;
    const states = Float64Array.from(recipe.state);
    lab.core.call("periods", [described(recipe), states], { on: "live" }).then(
      ([period]) => {
        if (key === this.asked) this.exact = period;
        lab.tell("motion");
      },
      (error) => lab.caught(error),
    );
  }

  private periodText(): string {
    if (this.exact === null || this.lab.hidden) return "";
    if (!Number.isFinite(this.exact)) return t("period_never");
    const exact = fixed(this.exact, 4);
    const seen = lastPeriod(this.lab.motion, this.lab.clock.place);
    return seen === null
      ? t("period_exact", { exact })
      : t("period_both", { exact, seen: fixed(seen, 4) });
  }

  private trustText(): string {
    const { lab } = this;
    const { motion, horizon, clock, recipe } = lab;
    if (this.waits) return t("waits");
    if (motion.outcome !== null && motion.outcome !== "reached_end") return this.stoppedText();
    if (recipe.method === EXACT) return t("trust_exact");
    if (recipe.t_max < recipe.t0) return t("trust_not_asked");
    if (horizon === null) return motion.outcome === null ? "" : t("trust_unknown");
    const angle = shown((lab.trusted * 180) / Math.PI, 2);
    if (horizon === Number.POSITIVE_INFINITY) return t("trust_always", { angle });
    const passed = motion.times[clock.place] > horizon;
    return t(passed ? "trust_passed" : "trust_until", { angle, horizon: fixed(horizon, 2) });
  }

  private stoppedText(): string {
    const { motion } = this.lab;
    const known = motion.outcome === "not_finite" || motion.outcome === "step_limit";
    const why = t(known ? `why_${motion.outcome as "not_finite" | "step_limit"}` : "why_other");
    return t("stopped", { time: fixed(motion.times[Math.max(0, motion.count - 1)], 2), why });
  }
}

function write(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** Time of the last whole swing up to a place: between passages of the lowest point to one side. */
export function lastPeriod(motion: Motion, place: number): number | null {
  const found: number[] = [];
  for (let i = Math.min(place, motion.count - 1); i > 0 && found.length < 2; --i) {
    const time = passage(motion, i);
    if (time !== null) found.push(time);
  }
  return found.length === 2 ? found[0] - found[1] : null;
}

/** When θ rises through a whole turn between two places, by Hermite's cubic; null: it does not. */
export function passage(motion: Motion, i: number): number | null {
  const { size, states, times, spacing } = motion;
  if (size !== 2) return null;
  const [a, b] = [states[(i - 1) * 2], states[i * 2]];
  const turn = 2 * Math.PI;
  const level = turn * Math.ceil(a / turn);
  if (!(b > a && a < level && b >= level)) return null;
  const [u, v] = [states[(i - 1) * 2 + 1] * spacing, states[i * 2 + 1] * spacing];
  let part = (level - a) / (b - a);
  for (let k = 0; k < 4; ++k) {
    const [p, q] = [part * part, part * part * part];
    const value =
      a * (2 * q - 3 * p + 1) + u * (q - 2 * p + part) + b * (3 * p - 2 * q) + v * (q - p);
    const slope =
      (a - b) * (6 * p - 6 * part) + u * (3 * p - 4 * part + 1) + v * (3 * p - 2 * part);
    part -= (value - level) / slope;
  }
  return times[i - 1] + part * spacing;
}
