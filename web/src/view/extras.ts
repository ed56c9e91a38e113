// Graphs that need runs of their own: the Poincaré section, and the balance of energy where friction
// and a drive act. They are computed while they are looked at, and left when they are not.

import { angle } from "../core/api";
import { gridOf, isDouble } from "../recipe/recipe";
import { balanceOf, entryNow, exchanges } from "../run/balance";
import type { Lab } from "../run/lab";
import type { Motion } from "../run/motion";
import { fixed, t } from "../words/language";
import type { Key } from "../words/words";
import { DEGREES, type Graph, placesWithin, timeSpan } from "./graphs";
import { around, Plot } from "./plot";
import type { Surface } from "./svg";
import { theme } from "./theme";

const LONGEST = 2000; // s of a section's run

interface Points {
  times: Float64Array;
  x: Float64Array; // degrees
  y: Float64Array; // rad/s
}

export class Extras {
  readonly graphs: readonly Graph[];
  private points: Points | null = null;
  private asked = new Map<string, Motion>();
  private readonly works = new Map<string, AbortController>();

  constructor(private readonly lab: Lab) {
    this.graphs = [
      {
        key: "graph_section",
        fits: (each) => isDouble(each.recipe) || driveFrequency(each) > 0,
        draw: (each, s, width, height) => this.drawSection(each, s, width, height),
        describe: () =>
          `${t(isDouble(lab.recipe) ? "section_double" : "section_driven")} ${t("section_text", { count: this.points?.times.length ?? 0 })}`,
      },
      {
        key: "graph_balance",
        fits: exchanges,
        draw: (each, s, width, height) => this.drawBalance(each, s, width, height),
        describe: () => t("balance_text"),
      },
    ];
  }

  leave(): void {
    for (const work of this.works.values()) work.abort();
  }

  /** Computes what is looked at, once for each motion; a section that is no longer chosen is left. */
  follow(chosen: ReadonlySet<Key>): void {
    const { motion } = this.lab;
    if (!chosen.has("graph_section") && this.points === null) {
      this.works.get("graph_section")?.abort();
      this.asked.delete("graph_section");
    }
    const due = (key: Key) => {
      const fits = this.graphs.find((each) => each.key === key)?.fits ?? exchanges;
      if (!chosen.has(key) || !fits(this.lab) || motion.outcome === null) return false;
      if (this.asked.get(key) === motion) return false;
      this.asked.set(key, motion);
      return true;
    };
    if (due("graph_section")) this.section().catch((error) => this.lab.caught(error));
    const bars = due("graph_energy");
    if (due("graph_balance") || bars) this.takeBalance().catch((error) => this.lab.caught(error));
  }

  private begun(key: string): AbortSignal {
    const work = new AbortController();
    this.works.set(key, work);
    return work.signal;
  }

  private async section(): Promise<void> {
    const { lab } = this;
    const { recipe } = lab;
    this.points = null;
    const signal = this.begun("graph_section");
    const { spacing: _, options, ...request } = gridOf(recipe, "taylor");
    const end = recipe.t0 + Math.min(LONGEST, 20 * Math.abs(recipe.t_max - recipe.t0));
    if (isDouble(recipe)) {
      const events = [angle(1, 0, 1, 0, true)];
      const times = Float64Array.of(end);
      const run = await lab.core.call("solve", [{ ...request, times, events }], { signal });
      const { times: at, states } = run.events[0];
      this.points = pointsOf(at, states, 4, 1, 3);
    } else {
      const period = (2 * Math.PI) / driveFrequency(lab);
      const count = Math.min(4000, Math.floor((end - recipe.t0) / period));
      const times = Float64Array.from({ length: count }, (_, i) => recipe.t0 + (i + 1) * period);
      const run = await lab.core.call("solve", [{ ...request, options, times }], { signal });
      this.points = pointsOf(run.times, run.states, 2, 0, 1);
    }
    lab.tell("time");
  }

  private async takeBalance(): Promise<void> {
    const { lab } = this;
    if (lab.balance?.motion === lab.motion) return;
    lab.balance = await balanceOf(lab, this.begun("graph_balance"));
    lab.tell("time");
  }

  private drawSection(lab: Lab, s: Surface, width: number, height: number): void {
    const { points } = this;
    const double = isDouble(lab.recipe);
    const [low, high] = double ? [-180, 180] : around(points?.x ?? [], 1);
    const speeds = around(points?.y ?? [], 0.1);
    const x = { low, high, label: double ? "θ₂" : "θ", kind: "degrees" as const };
    const y = { low: speeds[0], high: speeds[1], label: double ? "ω₂ / (rad/s)" : "ω / (rad/s)" };
    const plot = new Plot(s, width, height, x, y);
    plot.frame();
    if (!points) return;
    const now = lab.motion.times[lab.clock.place];
    plot.clipped(() => {
      for (let i = 0; i < points.times.length; ++i) {
        const past = points.times[i] <= now;
        plot.dot(
          points.x[i],
          points.y[i],
          past ? theme().accent : theme().second,
          past ? 2.4 : 1.1,
        );
      }
    });
  }

  private drawBalance(lab: Lab, s: Surface, width: number, height: number): void {
    const { motion } = lab;
    const now = entryNow(lab);
    const balance = now === null ? null : lab.balance;
    const span = timeSpan(lab);
    const { change = [], work = [], heat = [], stride = 1 } = balance ?? {};
    const places = placesWithin(motion, span).map((place) => Math.floor(place / stride));
    const seen = [work, heat, change].flatMap((values) => [...values.slice(...places)]);
    const [low, high] = around(seen, 1e-12);
    const x = { low: span[0], high: span[1], label: "t / s" };
    const plot = new Plot(s, width, height, x, { low, high, label: "J" });
    plot.frame();
    if (now === null) return;
    const rows: [string, ArrayLike<number>, string][] = [
      ["ΔE", change, theme().ink],
      [t("work"), work, theme().methods.linear],
      [t("heat"), heat, theme().warm],
    ];
    plot.clipped(() => {
      for (const [, values, colour] of rows) {
        plot.line(values.length, (i) => [motion.times[i * stride], values[i]], colour, 1.5);
      }
      plot.upright(motion.times[lab.clock.place], theme().line);
    });
    plot.names(
      rows.map(([name, values, colour]) => [`${name} ${fixed(values[now], 3)} J`, colour]),
    );
  }
}

function pointsOf(
  times: Float64Array,
  states: Float64Array,
  size: number,
  x: number,
  y: number,
): Points {
  const folded = (value: number) => value - 360 * Math.round(value / 360);
  const column = (j: number) => Float64Array.from(times, (_, i) => states[i * size + j]);
  return { times, x: column(x).map((value) => folded(value * DEGREES)), y: column(y) };
}

/** Angular frequency of the drive, or else of the pivot [rad/s]; 0: there is none. */
function driveFrequency(lab: Lab): number {
  const p = lab.recipe.parameters;
  const drive = p.torque || lab.recipe.form === "scaled" ? p.drive_frequency : 0;
  return drive || (p.pivot_amplitude ? p.pivot_frequency : 0) || 0;
}
