// Up to four methods of one release: ghosts on the stage, the drift of their energy and their distance
// from the reference on logarithmic axes, and until when each is right.

import { el, fill, tick } from "../controls/dom";
import { EXACT, systemOf } from "../recipe/recipe";
import type { Ghost } from "../run/ghosts";
import { conservative, type Lab } from "../run/lab";
import { fixed, powerOfTen, shown, t } from "../words/language";
import type { Key } from "../words/words";
import { Figure } from "./figure";
import { placesWithin, timeSpan } from "./graphs";
import { Plot } from "./plot";
import type { Surface } from "./svg";
import { theme } from "./theme";
import type { View } from "./views";

const MOST = 4;
const LEAST_SHOWN = 1e-17;

export class CompareView implements View {
  readonly element = el("div");
  private readonly ticks = el("fieldset", { class: "chosen" });
  private readonly table = el("div", { class: "scroll" });
  private drawn: Figure[] = [];
  private system = "";
  private made = "";
  private told = 0; // ms: when the table was last renewed

  constructor(private readonly lab: Lab) {
    this.lay();
    if (lab.page.compare.length === 0) lab.changePage({ compare: this.first() });
    else void lab.ghosts.judge();
  }

  /** Makes what depends on the system. */
  private lay(): void {
    const { lab } = this;
    this.system = lab.recipe.system;
    // Where friction and a drive act the energy changes anyway.
    const drift = conservative(lab)
      ? [this.figure("drift", "drift_axis", (ghost) => ghost.drift)]
      : [];
    this.drawn = [...drift, this.figure("distance", "distance_axis", (ghost) => ghost.distance)];
    const closed = systemOf(lab.recipe).capabilities.closed_form;
    const reference = closed ? t("exact") : "taylor";
    fill(
      this.element,
      el("p", { class: "note" }, t("compare_intro", { reference })),
      this.ticks,
      ...this.drawn.map((figure) => figure.element),
      this.table,
    );
    this.choices();
  }

  /** What is compared before a person chooses. */
  private first(): string[] {
    const wanted = ["euler", "rk4", "verlet", "gauss4"];
    return this.lab
      .methods()
      .filter((name) => wanted.includes(name))
      .slice(0, 3);
  }

  private figure(title: Key, label: Key, values: (ghost: Ghost) => Float64Array): Figure {
    return new Figure(
      t(title),
      (s, width, height) => {
        const plot = this.plot(s, width, height, t(label));
        plot.upright(this.lab.motion.times[this.lab.clock.place], theme().line);
      },
      () => this.describe(values),
      "",
      {
        key: () => this.key(),
        draw: (s, width, height) => this.draw(this.plot(s, width, height, t(label)), values),
      },
    );
  }

  /** What the curves depend on. */
  private key(): string {
    const ghosts = this.lab.ghosts.list.map(({ motion, method }) => `${method}${motion.id}`);
    return [...timeSpan(this.lab), ...ghosts].join();
  }

  private plot(s: Surface, width: number, height: number, label: string): Plot {
    const [low, high] = timeSpan(this.lab);
    const x = { low, high, label: "t / s" };
    const y = { low: LEAST_SHOWN, high: 1e2, label, kind: "logarithmic" as const };
    return new Plot(s, width, height, x, y);
  }

  private choices(): void {
    const { lab } = this;
    this.made = [...lab.methods(), ...lab.page.compare].join();
    const full = lab.page.compare.length >= MOST;
    const boxes = lab.methods().map((name) => {
      const on = lab.page.compare.includes(name);
      const box = tick(name === EXACT ? t("exact") : name, on, (now) => {
        const others = lab.page.compare.filter((each) => each !== name);
        lab.changePage({ compare: now ? [...others, name] : others });
        this.choices();
      });
      const input = box.querySelector("input")!;
      input.disabled = full && !on;
      if (input.disabled) box.title = t("compare_full");
      return box;
    });
    const focused = [...this.ticks.querySelectorAll("input")].indexOf(
      document.activeElement as HTMLInputElement,
    );
    fill(this.ticks, el("legend", { class: "unseen" }, t("method_heading")), ...boxes);
    if (focused >= 0) this.ticks.querySelectorAll("input")[focused]?.focus();
  }

  private draw(plot: Plot, values: (ghost: Ghost) => Float64Array): void {
    const { lab } = this;
    plot.frame();
    plot.clipped(() => {
      for (const ghost of lab.ghosts.list) {
        const { motion } = ghost;
        const of = values(ghost);
        const [from, to] = placesWithin(motion, timeSpan(lab));
        const at = (i: number) => [motion.times[i], Math.max(of[i], LEAST_SHOWN)] as const;
        plot.line(Math.min(to, of.length), at, theme().methods[ghost.method], 1.6, from, true);
      }
    });
  }

  private describe(values: (ghost: Ghost) => Float64Array): string {
    const { lab } = this;
    const parts = lab.ghosts.list.map((ghost) => {
      const of = values(ghost);
      return `${ghost.method} ${powerOfTen(of[of.length - 1] ?? 0)}`;
    });
    if (parts.length === 0) return t("compare_none");
    return t("compare_text", { end: lab.recipe.t_max, methods: parts.join(", ") });
  }

  private rows(): void {
    const { lab } = this;
    const place = lab.clock.place;
    const kept = conservative(lab);
    const columns: Key[] = [
      "method",
      ...(kept ? (["drift_now"] as const) : []),
      "distance_now",
      "right_until",
    ];
    const head = el("tr", {}, ...columns.map((key) => el("th", { scope: "col" }, t(key))));
    const rows = lab.ghosts.list.map((ghost) => {
      const name = el("th", { scope: "row" }, el("span", { class: "key" }, ghost.method));
      (name.firstChild as HTMLElement).style.setProperty("--shade", theme().methods[ghost.method]);
      const at = Math.min(place, ghost.motion.count - 1);
      return el(
        "tr",
        {},
        name,
        kept && el("td", {}, shown(ghost.drift[at] ?? 0, 2)),
        el("td", {}, shown(ghost.distance[at] ?? 0, 2)),
        el("td", {}, until(ghost)),
      );
    });
    fill(this.table, el("table", {}, el("thead", {}, head), el("tbody", {}, ...rows)));
  }

  figures(): Figure[] {
    return this.drawn;
  }

  render(): void {
    const { lab } = this;
    if (this.system !== lab.recipe.system) this.lay();
    if (this.made !== [...lab.methods(), ...lab.page.compare].join()) this.choices();
    for (const figure of this.drawn) figure.render();
    if (!lab.clock.playing || performance.now() - this.told > 250) {
      this.told = performance.now();
      this.rows();
    }
  }

  tell(): void {
    for (const figure of this.drawn) figure.tell();
  }

  leave(): void {
    this.lab.ghosts.leave();
  }
}

function until(ghost: Ghost): string {
  if (ghost.method === EXACT) return t("to_the_end");
  if (ghost.horizon === null) return "…";
  return ghost.horizon === Number.POSITIVE_INFINITY
    ? t("to_the_end")
    : `${fixed(ghost.horizon, 2)} s`;
}
