// Tools of the stage: the linear pendulum beside it, a ruler, a timer of one period, a cloud of
// neighbours.

import { Cloud } from "../run/cloud";
import type { Lab } from "../run/lab";
import { passage } from "../view/readings";
import type { Tools } from "../view/stage";
import { fixed, shown, t } from "../words/language";
import { el, fill, tick, unfolds } from "./dom";

const DEGREES = 180 / Math.PI;

export class Toolbox {
  readonly element = el("div", { class: "panel" });
  private ruler = false;
  private cloud: Cloud | null = null;
  private readonly cloudNote = el("p", { class: "note" });
  private readonly timerNote = el("span", { class: "note", role: "status" });
  private from: number | null = null; // place at which the timer last looked; null: it does not run
  private begun: number | null = null; // s: the first passage
  private made = "";
  private readonly ends: (() => void)[];

  constructor(private readonly lab: Lab) {
    this.make();
    this.ends = [lab.on("recipe", () => this.renew())];
  }

  /** Lets go of the laboratory. */
  leave(): void {
    this.cloud?.stop();
    for (const end of this.ends) end();
  }

  /** What lies on the stage. */
  laid(): Tools {
    const { cloud } = this;
    return { ruler: this.ruler, cloud: cloud ? (place) => cloud.tips(place) : null };
  }

  private make(): void {
    const { lab } = this;
    const simple = lab.recipe.system === "simple";
    this.made = lab.recipe.system;
    const single = lab.recipe.state.length === 2;
    fill(
      this.element,
      unfolds(
        t("tools"),
        lab.cloudWanted,
        simple &&
          tick(t("twin"), lab.twinShown, (on) => {
            lab.twinShown = on;
            lab.run();
          }),
        tick(t("ruler"), this.ruler, (on) => {
          this.ruler = on;
          lab.tell("time");
        }),
        single &&
          el(
            "div",
            { class: "field" },
            el("button", { type: "button", onclick: () => this.startTimer() }, t("timer")),
            this.timerNote,
          ),
        tick(t("cloud"), lab.cloudWanted, (on) => {
          lab.cloudWanted = on;
          this.renew();
        }),
        this.cloudNote,
      ),
    );
    this.renewCloud();
  }

  private renew(): void {
    if (this.made !== this.lab.recipe.system) this.make();
    else this.renewCloud();
    this.from = null;
    this.begun = null;
  }

  private renewCloud(): void {
    this.cloud?.stop();
    this.cloud = this.lab.cloudWanted ? new Cloud(this.lab) : null;
    this.cloudNote.textContent = "";
  }

  private startTimer(): void {
    this.from = this.lab.clock.place;
    this.begun = null;
    this.timerNote.textContent = t("timer_waits");
    this.lab.clock.play();
  }

  /** Looks at what went by since the last frame. */
  follow(): void {
    const { cloud, lab } = this;
    if (cloud) {
      const now = cloud.spread(lab.clock.place);
      const spread = shown(cloud.start * DEGREES, 2);
      const text = now === null ? "" : t("cloud_spread", { spread, now: fixed(now * DEGREES, 2) });
      if (this.cloudNote.textContent !== text) this.cloudNote.textContent = text;
    }
    if (this.from !== null) this.time(this.from);
  }

  private time(from: number): void {
    const { motion, clock } = this.lab;
    for (let i = from + 1; i <= Math.min(clock.place, motion.count - 1); ++i) {
      const at = passage(motion, i);
      if (at === null) continue;
      if (this.begun !== null) {
        this.timerNote.textContent = t("timer_done", { time: fixed(at - this.begun, 3) });
        this.from = null;
        return;
      }
      this.begun = at;
    }
    this.from = Math.max(from, clock.place);
    if (this.begun === null) return;
    const time = fixed(Math.max(0, motion.times[clock.place] - this.begun), 1);
    const text = t("timer_runs", { time });
    if (this.timerNote.textContent !== text) this.timerNote.textContent = text;
  }
}
