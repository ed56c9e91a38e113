// The page as a whole: what stands where, and what happens in each frame.

import { Bobs } from "./controls/bobs";
import { el, fill } from "./controls/dom";
import { header } from "./controls/header";
import { Panel } from "./controls/panel";
import { Toolbox } from "./controls/toolbox";
import { type Transport, transport } from "./controls/transport";
import { written } from "./recipe/address";
import { isDouble } from "./recipe/recipe";
import type { Lab } from "./run/lab";
import { Figure } from "./view/figure";
import { Readings } from "./view/readings";
import { describeStage, drawStage } from "./view/stage";
import { forgetTheme } from "./view/theme";
import { Views } from "./view/views";
import { t } from "./words/language";

/** Milliseconds between texts for those who do not see the picture. */
const TOLD = 1000;
/** Longest frame that counts [ms]: a tab that was hidden goes on where it stood. */
const LONGEST_FRAME = 250;

export class App {
  private stage!: Figure;
  private bobs!: Bobs;
  private panel!: Panel;
  private transport!: Transport;
  private readings!: Readings;
  private views!: Views;
  private tools!: Toolbox;
  private made = "";
  private dirty = true;
  private last = 0;
  private told = 0;
  private addressTimer = 0;
  private readonly notice = el("div", { class: "notices" });

  constructor(
    private readonly root: HTMLElement,
    readonly lab: Lab,
  ) {
    this.build();
    const again = () => {
      this.dirty = true;
    };
    for (const change of ["motion", "time", "page"] as const) lab.on(change, again);
    lab.on("recipe", () => this.recipeChanged());
    lab.on("page", () => this.address());
    lab.on("refused", () => this.say(lab.refusal));
    lab.core.onTrap = () => this.say(t("core_trapped"));
    new ResizeObserver(again).observe(root);
    document.addEventListener("visibilitychange", () => {
      this.last = 0;
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
    document.addEventListener("keydown", (event) => this.key(event));
    lab.run();
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) lab.clock.play();
    requestAnimationFrame((now) => this.frame(now));
  }

  /** Makes all elements; again where the language or the number of bobs changes. */
  build(): void {
    const { lab } = this;
    this.made = this.kind();
    document.title = `Pendula · ${t("title")}`;
    document.documentElement.classList.toggle("embed", Boolean(lab.page.embed));
    this.tools?.leave();
    this.views?.leave();
    this.tools = new Toolbox(lab);
    this.stage = new Figure(
      "",
      (s, width, height) => drawStage(lab, this.tools.laid(), s, width, height),
      () => describeStage(lab),
    );
    this.stage.canvas.setAttribute("aria-label", t("stage_title"));
    this.bobs = new Bobs(lab, this.stage.canvas);
    this.stage.element.append(this.bobs.element);
    this.panel = new Panel(lab);
    this.transport = transport(lab);
    this.readings = new Readings(lab);
    this.views = new Views(lab);
    const stage = el(
      "section",
      { class: "stage card", id: "stage", tabindex: -1, "aria-label": t("stage") },
      this.stage.element,
      this.transport.element,
      this.readings.element,
    );
    const controls = el(
      "section",
      { class: "controls card", "aria-label": t("settings") },
      this.panel.element,
      this.tools.element,
    );
    const beside = el("div", { class: "beside card" }, this.views.element);
    fill(
      this.root,
      el(
        "a",
        { class: "skip", href: "#stage", onclick: (event: Event) => this.skip(event) },
        t("skip"),
      ),
      el(
        "div",
        { class: "lab" },
        header(this),
        this.notice,
        el("main", { class: "columns" }, stage, ...(lab.page.embed ? [] : [beside, controls])),
      ),
    );
    this.dirty = true;
  }

  /** What the elements depend on. */
  private kind(): string {
    return [document.documentElement.lang, isDouble(this.lab.recipe)].join();
  }

  private skip(event: Event): void {
    event.preventDefault(); // the address is the recipe
    document.getElementById("stage")?.focus();
  }

  private recipeChanged(): void {
    if (this.kind() !== this.made) this.build();
    this.panel.follow();
    this.say("");
    this.address();
    this.dirty = true;
  }

  /** One line that stays until it is closed; empty: none. */
  say(line: string, link?: HTMLElement): void {
    this.notice.replaceChildren();
    if (line === "") return;
    const close = el(
      "button",
      { type: "button", class: "quiet", onclick: () => this.say("") },
      t("close"),
    );
    fill(this.notice, el("p", { class: "notice", role: "status" }, line, link ?? null, close));
  }

  recolour(): void {
    forgetTheme();
    this.dirty = true;
  }

  /** The figures that can be saved. */
  figures(): Figure[] {
    return [this.stage, ...this.views.figures()];
  }

  /** Writes the recipe into the address, a little later: browsers limit how often. */
  private address(): void {
    window.clearTimeout(this.addressTimer);
    this.addressTimer = window.setTimeout(() => {
      if (this.lab.hidden) return;
      history.replaceState(null, "", `#${written(this.lab.recipe, this.lab.page)}`);
    }, 300);
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (
      target.closest("input, select, textarea, button, summary, a, [role=tab], [role=application]")
    )
      return;
    if (event.key === " ") this.transport.toggle();
    else if (event.key === ",") this.transport.step(-1);
    else if (event.key === ".") this.transport.step(1);
    else return;
    event.preventDefault();
  }

  private frame(now: number): void {
    const { lab } = this;
    const passed = this.last === 0 ? 0 : Math.min(now - this.last, LONGEST_FRAME);
    this.last = now;
    const { clock } = lab;
    const before = clock.place;
    const playing = clock.playing;
    const { waits } = clock.tick(passed, lab.motion.count);
    this.readings.waits = waits;
    if (this.dirty || clock.place !== before || playing !== clock.playing) this.render(now);
    requestAnimationFrame((next) => this.frame(next));
  }

  private render(now: number): void {
    this.dirty = false;
    performance.mark("frame");
    this.tools.follow();
    this.stage.element.classList.toggle("pair", this.lab.twin !== null);
    this.stage.render();
    this.bobs.follow();
    this.transport.follow();
    this.views.render();
    this.readings.follow();
    if (now - this.told > TOLD || !this.lab.clock.playing) {
      this.told = now;
      this.stage.tell();
      this.views.tell();
    }
    performance.measure("render", "frame");
    if (performance.getEntriesByName("render").length > 600) {
      performance.clearMeasures("render");
      performance.clearMarks("frame");
    }
  }
}
