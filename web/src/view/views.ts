// What stands beside the stage, one at a time: graphs, comparison, flip map, measured data.

import { el, fill, fresh, tick } from "../controls/dom";
import { MapView } from "../map/view";
import { MeasuredView } from "../measured/view";
import type { Page } from "../recipe/recipe";
import type { Lab } from "../run/lab";
import { t } from "../words/language";
import type { Key } from "../words/words";
import { CompareView } from "./compare";
import { Extras } from "./extras";
import { Figure } from "./figure";
import { GRAPHS, type Graph } from "./graphs";

/** A view: made when it is chosen, left when another is. */
export interface View {
  element: HTMLElement;
  figures: () => Figure[];
  render: () => void;
  tell: () => void;
  leave: () => void;
}

const NAMES: readonly (readonly [Page["view"], Key])[] = [
  ["stage", "view_stage"],
  ["compare", "view_compare"],
  ["map", "view_map"],
  ["data", "view_data"],
];

/** The tabs and the view that is chosen. */
export class Views {
  readonly element: HTMLElement;
  private view!: View;
  private readonly panel = el("div", {
    class: "view",
    role: "tabpanel",
    id: fresh("view"),
    tabindex: -1,
  });
  private readonly tabs: HTMLButtonElement[];
  private readonly end: () => void;

  constructor(private readonly lab: Lab) {
    this.tabs = NAMES.map(([name, key]) => this.tab(name, key));
    const list = el(
      "div",
      { class: "tabs", role: "tablist", "aria-label": t("views") },
      ...this.tabs,
    );
    list.addEventListener("keydown", (event) => this.key(event));
    this.element = el("section", { "aria-label": t("views") }, list, this.panel);
    this.show();
    this.end = lab.on("page", () => {
      if (this.shown !== lab.page.view) this.show();
    });
  }

  private shown = "";

  private tab(name: Page["view"], key: Key): HTMLButtonElement {
    return el(
      "button",
      {
        type: "button",
        role: "tab",
        id: fresh(`tab-${name}`),
        "aria-controls": this.panel.id,
        onclick: () => this.lab.changePage({ view: name }),
      },
      t(key),
    );
  }

  private show(): void {
    const { lab } = this;
    this.view?.leave();
    this.shown = lab.page.view;
    const chosen = NAMES.findIndex(([name]) => name === lab.page.view);
    this.tabs.forEach((tab, i) => {
      tab.setAttribute("aria-selected", String(i === chosen));
      tab.tabIndex = i === chosen ? 0 : -1;
    });
    this.panel.setAttribute("aria-labelledby", this.tabs[chosen].id);
    this.view = made(lab);
    fill(this.panel, this.view.element);
    lab.tell("time");
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    const now = NAMES.findIndex(([name]) => name === this.lab.page.view);
    const next = (now + step + NAMES.length) % NAMES.length;
    this.lab.changePage({ view: NAMES[next][0] });
    this.tabs[next].focus();
  }

  figures(): Figure[] {
    return this.view.figures();
  }

  render(): void {
    this.view.render();
  }

  tell(): void {
    this.view.tell();
  }

  leave(): void {
    this.end();
    this.view.leave();
  }
}

function made(lab: Lab): View {
  if (lab.page.view === "compare") return new CompareView(lab);
  if (lab.page.view === "map") return new MapView(lab);
  if (lab.page.view === "data") return new MeasuredView(lab);
  return new GraphView(lab);
}

/** Graphs, chosen by the person. */
class GraphView implements View {
  readonly element = el("div");
  private static chosen = new Set<Key>(["graph_angles", "graph_phase", "graph_energy"]);
  private drawn: Figure[] = [];
  private kind = "";
  private readonly extras: Extras;

  constructor(private readonly lab: Lab) {
    this.extras = new Extras(lab);
    this.make();
  }

  private graphs(): Graph[] {
    return [...GRAPHS, ...this.extras.graphs].filter((graph) => graph.fits(this.lab));
  }

  private make(): void {
    const { lab } = this;
    const graphs = this.graphs();
    this.kind = graphs.map((graph) => graph.key).join();
    const { chosen } = GraphView;
    const ticks = graphs.map((graph) =>
      tick(t(graph.key), chosen.has(graph.key), (on) => {
        if (on) chosen.add(graph.key);
        else chosen.delete(graph.key);
        this.draw();
        lab.tell("time");
      }),
    );
    const legend = el("legend", { class: "unseen" }, t("shown_graphs"));
    fill(this.element, el("fieldset", { class: "chosen" }, legend, ...ticks), el("div"));
    this.draw();
  }

  private draw(): void {
    const { lab } = this;
    const shown = this.graphs().filter((graph) => GraphView.chosen.has(graph.key));
    this.drawn = shown.map(
      (graph) =>
        new Figure(
          t(graph.key),
          (s, width, height) => graph.draw(lab, s, width, height),
          () => graph.describe(lab),
          HEIGHTS[graph.key] ?? "",
          graph.still && {
            key: () => `${lab.motion.id} ${lab.motion.count}`,
            draw: (s, width, height) => graph.still?.(lab, s, width, height),
          },
        ),
    );
    fill(this.element.lastElementChild!, ...this.drawn.map((figure) => figure.element));
  }

  figures(): Figure[] {
    return this.drawn;
  }

  render(): void {
    if (
      this.kind !==
      this.graphs()
        .map((graph) => graph.key)
        .join()
    )
      this.make();
    this.extras.follow(GraphView.chosen);
    for (const figure of this.drawn) figure.render();
  }

  tell(): void {
    for (const figure of this.drawn) figure.tell();
  }

  leave(): void {
    this.extras.leave();
  }
}

const HEIGHTS: Partial<Record<Key, string>> = {
  graph_energy: "low",
  graph_path: "tall",
  graph_section: "tall",
};
