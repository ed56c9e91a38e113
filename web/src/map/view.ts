// The flip map on the page: wheel, pinch, keys and buttons zoom, dragging moves it, a click or Enter
// puts a start on the stage.

import { el, fill, fresh } from "../controls/dom";
import { button } from "../controls/transport";
import { PRESETS } from "../recipe/presets";
import { described, systemOf } from "../recipe/recipe";
import type { Lab } from "../run/lab";
import { Figure } from "../view/figure";
import { DEGREES } from "../view/graphs";
import { Plot } from "../view/plot";
import type { Surface } from "../view/svg";
import type { View } from "../view/views";
import { fixed, t } from "../words/language";
import { choices, quantityOf, untilOf } from "./asked";
import { axis, drawMap } from "./drawing";
import { distinct, Explorer } from "./explorer";
import { legend } from "./legend";
import type { Range, Rectangle } from "./level";
import { Pointers } from "./pointers";
import { moved, startAt, WHOLE, zoomed } from "./rectangle";
import { inWords, whatAt } from "./telling";

const COARSEST = 32; // cells that must be different doubles

export class MapView implements View {
  readonly element = el("div");
  private rectangle: Rectangle;
  private cross: [number, number];
  private explorer: Explorer;
  private plot: Plot | null = null;
  private figure: Figure | null = null;
  private system = "";
  private readonly status = el("p", { class: "note", role: "status" });
  private readonly colours = el("div");
  private readonly progress = el("p", { class: "note" });
  private timer = 0;

  constructor(private readonly lab: Lab) {
    this.explorer = new Explorer(lab.core, () => this.changed());
    const { map_theta1, map_theta2 } = lab.page;
    this.rectangle = { theta1: map_theta1 ?? WHOLE, theta2: map_theta2 ?? WHOLE };
    this.cross = [lab.recipe.state[0], lab.recipe.state[1]];
    this.make();
  }

  private make(): void {
    const { lab } = this;
    this.system = JSON.stringify(described(lab.recipe));
    if (systemOf(lab.recipe).capabilities.mapped) {
      if (!this.figure) this.lay();
      this.compute(false);
    } else this.offer();
  }

  /** For systems without a map: one that has it. */
  private offer(): void {
    this.figure = null;
    const take = () => this.lab.change(PRESETS.find((each) => each.key === "preset_paper")!.recipe);
    fill(
      this.element,
      el("p", { class: "note" }, t("map_not")),
      el("button", { type: "button", onclick: take }, t("map_take")),
    );
  }

  private lay(): void {
    this.figure = new Figure(
      t("map_title"),
      (s, width, height) => this.draw(s, width, height),
      () => inWords(this.explorer.last, untilOf(this.lab.page)),
      "map",
    );
    const help = fresh("help");
    const { canvas } = this.figure;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "application");
    canvas.setAttribute("aria-describedby", `${help} ${canvas.getAttribute("aria-describedby")}`);
    canvas.addEventListener("keydown", (event) => this.key(event));
    new Pointers(canvas, {
      zoom: (factor, x, y) => this.zoom(factor, this.angleAt(x, y)),
      move: (dx, dy) => this.move(dx, dy),
      click: (x, y) => this.put(this.angleAt(x, y)),
      over: (x, y) => this.say(this.angleAt(x, y)),
    });
    const buttons = el(
      "div",
      { class: "buttons" },
      button("map_in", "plus", () => this.zoom(0.5, this.middle())),
      button("map_out", "minus", () => this.zoom(2, this.middle())),
      button("map_home", "home", () => this.go({ theta1: WHOLE, theta2: WHOLE })),
    );
    this.figure.element.append(buttons);
    fill(
      this.element,
      el("p", { class: "note" }, t("map_intro")),
      choices(this.lab, () => this.later(false)),
      this.figure.element,
      this.colours,
      this.status,
      this.progress,
      el("p", { class: "note", id: help }, t("map_keys")),
    );
  }

  /** Computes when the hand rests. */
  private later(keep: boolean): void {
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.compute(keep), 120);
  }

  private compute(keep: boolean): void {
    fill(this.colours, legend(quantityOf(this.lab.page), untilOf(this.lab.page)));
    this.explorer
      .show(
        {
          system: described(this.lab.recipe),
          rectangle: this.rectangle,
          quantity: quantityOf(this.lab.page),
          tMax: untilOf(this.lab.page),
        },
        keep,
      )
      .catch((error) => this.lab.caught(error));
  }

  private changed(): void {
    const { last, deep } = this.explorer;
    if (last) {
      const percent = Math.floor((100 * last.done) / last.side ** 2);
      const text = last.whole ? "map_done" : "map_progress";
      this.progress.textContent = `${t(text, { shape: last.side, percent })}${deep ? ` · ${t("map_depth")}` : ""}`;
    }
    this.lab.tell("time");
  }

  private draw(s: Surface, width: number, height: number): void {
    const { theta1, theta2 } = this.rectangle;
    this.plot = new Plot(s, width, height, axis(theta1), axis(theta2));
    drawMap(this.plot, this.explorer.levels, this.cross);
  }

  private angleAt(x: number, y: number): [number, number] {
    const { plot, rectangle } = this;
    if (!plot) return this.middle();
    const across = (x - plot.left) / (plot.right - plot.left);
    return startAt(rectangle, across, (plot.bottom - y) / (plot.bottom - plot.top));
  }

  private middle(): [number, number] {
    return startAt(this.rectangle, 0.5, 0.5);
  }

  private zoom(factor: number, at: [number, number]): void {
    this.go(zoomed(this.rectangle, factor, at));
  }

  private move(dx: number, dy: number): void {
    const { plot } = this;
    if (!plot) return;
    const [across, up] = [-dx / (plot.right - plot.left), dy / (plot.bottom - plot.top)];
    this.go(moved(this.rectangle, across, up));
  }

  /** Another rectangle, if its cells are different doubles; computed when the hand rests. */
  private go(rectangle: Rectangle): void {
    if (!distinct(rectangle, COARSEST)) {
      this.progress.textContent = t("map_depth");
      return;
    }
    this.rectangle = rectangle;
    const whole = rectangle.theta1 === WHOLE && rectangle.theta2 === WHOLE;
    const range = (each: Range): [number, number] | undefined => (whole ? undefined : [...each]);
    this.lab.changePage({
      map_theta1: range(rectangle.theta1),
      map_theta2: range(rectangle.theta2),
    });
    this.later(true);
    this.lab.tell("time");
  }

  private put(at: [number, number]): void {
    this.cross = at;
    this.say(at);
    this.lab.change({ state: [...at, 0, 0] });
    this.lab.clock.play();
  }

  private say([theta1, theta2]: [number, number]): void {
    const what = whatAt(this.explorer.levels, [theta1, theta2], untilOf(this.lab.page));
    const digits = Math.min(
      12,
      Math.max(1, 2 - Math.floor(Math.log10((this.width() * DEGREES) / 100))),
    );
    const values = {
      theta1: fixed(theta1 * DEGREES, digits),
      theta2: fixed(theta2 * DEGREES, digits),
    };
    this.status.textContent = t("map_at", { ...values, what });
  }

  private width(): number {
    return this.rectangle.theta1[1] - this.rectangle.theta1[0];
  }

  private key(event: KeyboardEvent): void {
    const step = (this.width() / 40) * (event.shiftKey ? 0.1 : 1);
    const moves: Record<string, [number, number]> = {
      ArrowRight: [step, 0],
      ArrowLeft: [-step, 0],
      ArrowUp: [0, step],
      ArrowDown: [0, -step],
    };
    const move = moves[event.key];
    if (move) {
      this.cross = [this.cross[0] + move[0], this.cross[1] + move[1]];
      this.say(this.cross);
      this.lab.tell("time");
    } else if (event.key === "+" || event.key === "=") this.zoom(0.5, this.cross);
    else if (event.key === "-") this.zoom(2, this.cross);
    else if (event.key === "Enter") this.put(this.cross);
    else if (event.key === "Home") this.go({ theta1: WHOLE, theta2: WHOLE });
    else return;
    event.preventDefault();
  }

  figures(): Figure[] {
    return this.figure ? [this.figure] : [];
  }

  render(): void {
    if (this.system !== JSON.stringify(described(this.lab.recipe))) this.make();
    this.figure?.render();
  }

  tell(): void {
    this.figure?.tell();
  }

  leave(): void {
    window.clearTimeout(this.timer);
    this.explorer.leave();
  }
}
