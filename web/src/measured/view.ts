// Measured data on the page: a table is dropped or chosen, laid over the run, and the command for the
// fit is shown. The file stays in the browser.

import { choice, el, fill } from "../controls/dom";
import { repr } from "../out/python_text";
import type { Lab } from "../run/lab";
import { Figure } from "../view/figure";
import { DEGREES } from "../view/graphs";
import { around, Plot } from "../view/plot";
import type { Surface } from "../view/svg";
import { theme } from "../view/theme";
import type { View } from "../view/views";
import { fixed, t } from "../words/language";
import { Refused } from "../words/refused";
import { checkText } from "./formats";
import { guess, type Reading, type Series, seriesOf, startOf, type Unit } from "./series";
import { decoded, type Table, tableOf } from "./table";

interface Recording {
  name: string;
  table: Table;
  reading: Reading;
}

let kept: Recording | null = null; // it stays when another view is looked at

export class MeasuredView implements View {
  readonly element = el("div");
  private readonly wrong = el("p", { class: "wrong", role: "alert" });
  private readonly below = el("div");
  private figure: Figure | null = null;

  constructor(private readonly lab: Lab) {
    fill(this.element, this.dropping(), this.wrong, this.below);
    this.show();
  }

  private dropping(): HTMLElement {
    const input = el("input", {
      type: "file",
      class: "unseen",
      tabindex: -1,
      "aria-hidden": "true",
      accept: ".csv,.txt,.tsv,.dat,text/*",
      onchange: () => this.take(input.files?.[0]),
    });
    const zone = el(
      "div",
      { class: "drop" },
      el("span", {}, t("data_drop")),
      el("button", { type: "button", onclick: () => input.click() }, t("data_choose")),
      el("span", { class: "note" }, t("data_private")),
      input,
    );
    zone.addEventListener("dragover", (event) => {
      event.preventDefault();
      zone.classList.add("over");
    });
    zone.addEventListener("dragleave", () => zone.classList.remove("over"));
    zone.addEventListener("drop", (event) => {
      event.preventDefault();
      zone.classList.remove("over");
      void this.take(event.dataTransfer?.files[0]);
    });
    return zone;
  }

  private async take(file: File | undefined): Promise<void> {
    if (!file) return;
    const bytes = new Uint8Array(await file.arrayBuffer());
    const taken = this.attempt(() => {
      checkText(file.name, bytes);
      const table = tableOf(decoded(bytes));
      const reading = guess(table);
      seriesOf(table, reading);
      kept = { name: file.name, table, reading };
    });
    if (taken) this.show(); // else the line stays, and the table before
  }

  /** Does something with the table, or says in one line why not; whether it was done. */
  private attempt(what: () => void): boolean {
    try {
      what();
      this.wrong.textContent = "";
      return true;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      this.wrong.textContent = t(error.key, error.values);
      return false;
    }
  }

  private show(): void {
    const { lab } = this;
    this.figure = null;
    lab.measured = null;
    const recording = kept;
    fill(this.below);
    if (!recording) return;
    this.attempt(() => {
      lab.measured = seriesOf(recording.table, recording.reading);
    });
    this.figure = new Figure(
      t("data_title"),
      (s, width, height) => this.draw(s, width, height),
      () => this.describe(),
      "tall",
    );
    fill(
      this.below,
      this.choices(recording),
      this.figure.element,
      this.buttons(),
      ...command(recording),
    );
    lab.tell("time");
  }

  private choices(recording: Recording): HTMLElement {
    const { table, reading } = recording;
    const columns = table.columns.map(
      (_, i) => [String(i), table.names[i] || t("data_column", { number: i + 1 })] as const,
    );
    const set = (next: Partial<Reading>) => {
      recording.reading = { ...recording.reading, ...next };
      this.show();
    };
    const units = [
      ["deg", t("data_degrees")],
      ["rad", t("data_radians")],
    ] as const;
    const zeros = [
      ["down", t("data_bottom")],
      ["up", t("data_top")],
    ] as const;
    return el(
      "div",
      { class: "fold" },
      choice(t("data_time"), columns, String(reading.time), (value) =>
        set({ time: Number(value) }),
      ),
      choice(t("data_angle"), columns, String(reading.angle), (value) =>
        set({ angle: Number(value) }),
      ),
      choice(t("data_unit"), units, reading.unit, (value) => set({ unit: value as Unit })),
      choice(t("data_from"), zeros, reading.upright ? "up" : "down", (value) =>
        set({ upright: value === "up" }),
      ),
    );
  }

  private buttons(): HTMLElement {
    const { lab } = this;
    const begin = () => {
      if (!lab.measured) return;
      const span = lab.measured.t[lab.measured.t.length - 1];
      lab.change({ state: startOf(lab.measured), t0: 0, t_max: Number(span.toPrecision(6)) });
    };
    const forget = () => {
      kept = null;
      this.show();
    };
    const single = lab.recipe.state.length === 2;
    return el(
      "div",
      { class: "field" },
      single && el("button", { type: "button", onclick: begin }, t("data_start")),
      el("button", { type: "button", onclick: forget }, t("data_forget")),
    );
  }

  private draw(s: Surface, width: number, height: number): void {
    const { measured, motion, clock } = this.lab;
    if (!measured) return;
    const end = measured.t[measured.t.length - 1];
    const [low, high] = around(
      measured.theta.map((value) => value * DEGREES),
      1,
    );
    const x = { low: 0, high: end, label: "t / s" };
    const plot = new Plot(s, width, height, x, { low, high, label: "θ", kind: "degrees" });
    plot.frame();
    const stride = Math.max(1, Math.floor(measured.t.length / 1500));
    plot.clipped(() => {
      for (let i = 0; i < measured.t.length; i += stride) {
        plot.dot(measured.t[i], measured.theta[i] * DEGREES, theme().warm, 1.8);
      }
      const at = (i: number) =>
        [motion.times[i], motion.states[i * motion.size] * DEGREES] as const;
      plot.line(motion.count, at, theme().accent, 1.5);
      plot.upright(motion.times[clock.place], theme().line);
    });
  }

  private describe(): string {
    const { measured, motion } = this.lab;
    if (!measured) return "";
    const span = fixed(measured.t[measured.t.length - 1], 2);
    const rms = fixed(difference(measured, motion) * DEGREES, 2);
    return t("data_text", { count: measured.t.length, span, rms });
  }

  figures(): Figure[] {
    return this.figure ? [this.figure] : [];
  }

  render(): void {
    this.figure?.render();
  }

  tell(): void {
    this.figure?.tell();
  }

  leave(): void {}
}

/** Root mean square of measured minus computed, at the computed places nearest in time [rad]. */
function difference(
  { t: times, theta }: Series,
  motion: { t0: number; spacing: number; count: number; size: number; states: Float64Array },
): number {
  let [sum, count] = [0, 0];
  for (let i = 0; i < times.length; ++i) {
    const place = Math.round((times[i] - motion.t0) / motion.spacing);
    if (place < 0 || place >= motion.count) continue;
    sum += (theta[i] - motion.states[place * motion.size]) ** 2;
    ++count;
  }
  return Math.sqrt(sum / Math.max(1, count));
}

/** How Python reads and fits the recording. */
function command({ name, table, reading }: Recording): HTMLElement[] {
  const column = (i: number) => (table.names[i] ? JSON.stringify(table.names[i]) : String(i));
  const given = [
    JSON.stringify(name),
    `time=${column(reading.time)}`,
    `angle=${column(reading.angle)}`,
    `unit="${reading.unit}"`,
    ...(reading.upright ? ['zero="up"'] : []),
  ];
  const text = [
    "from pendula.measured import fit, read",
    "",
    `recording = read(${given.join(", ")})`,
    `print(fit(recording, "viscous", gravity=${repr(9.80665)}))`,
  ].join("\n");
  return [
    el("p", { class: "note" }, t("data_fit")),
    el("pre", { class: "code", tabindex: 0 }, text),
  ];
}
