// The bobs as handles: dragged with mouse or finger to set the start, thrown when let go in motion,
// moved by arrow keys, where each change is spoken with its unit.

import { radians } from "../recipe/angles";
import { isDouble } from "../recipe/recipe";
import type { Lab } from "../run/lab";
import { stateAt } from "../run/motion";
import { lengthsOf, pivotAt, toScreen, unwrapped } from "../view/geometry";
import { stagePanes } from "../view/stage";
import { fixed, t } from "../words/language";
import { el } from "./dom";

const DEGREES = 180 / Math.PI;
const HANDLE = 44; // px, across: what a finger hits
const THROWN = 90; // ms: over how long a throw is measured
const HELD = 200; // ms without a movement before letting go: it was not thrown
const REST = 0.15; // rad/s, below which nothing was thrown

/** Lays handles on the stage; they follow the bobs. */
export class Bobs {
  readonly element = el("div", { class: "bobs" });
  private readonly handles: HTMLElement[];
  private held: { index: number; path: { at: number; angle: number }[]; played: boolean } | null =
    null;

  constructor(
    private readonly lab: Lab,
    private readonly canvas: HTMLCanvasElement,
  ) {
    const count = isDouble(lab.recipe) ? 2 : 1;
    this.handles = Array.from({ length: count }, (_, index) => this.handle(index));
    this.element.append(...this.handles);
  }

  private handle(index: number): HTMLElement {
    const name =
      this.handles?.length || isDouble(this.lab.recipe) ? `${t("bob")} ${index + 1}` : t("bob");
    const handle = el("div", {
      class: "bob",
      role: "slider",
      tabindex: 0,
      "aria-label": `${name}: ${t("bob_help")}`,
      "aria-valuemin": -180,
      "aria-valuemax": 180,
      onkeydown: (event: KeyboardEvent) => this.key(event, index),
      onpointerdown: (event: PointerEvent) => this.grasp(event, index),
      onpointermove: (event: PointerEvent) => this.drag(event),
      onpointerup: (event: PointerEvent) => this.release(event),
      onpointercancel: (event: PointerEvent) => this.release(event),
    });
    return handle;
  }

  /** Moves the handles to where the bobs are. */
  follow(): void {
    const { lab, canvas } = this;
    const { motion, clock } = lab;
    if (motion.count === 0) return;
    const [pane] = stagePanes(lab, canvas.clientWidth, canvas.clientHeight);
    const place = Math.min(clock.place, motion.count - 1);
    const pivot = pivotAt(lab.recipe, motion.times[place]);
    this.handles.forEach((handle, i) => {
      const at = place * motion.size + 2 * i;
      const [x, y] = toScreen(
        pane,
        motion.positions[at] + pivot[0],
        motion.positions[at + 1] + pivot[1],
      );
      handle.style.transform = `translate(${x - HANDLE / 2}px, ${y - HANDLE / 2}px)`;
    });
    if (!clock.playing) this.speak(place);
  }

  private speak(place: number): void {
    const { motion } = this.lab;
    this.handles.forEach((handle, i) => {
      const degrees = motion.states[place * motion.size + i] * DEGREES;
      handle.setAttribute("aria-valuenow", degrees.toFixed(1));
      const text = t("angle_text", { angle: fixed(degrees, 1) });
      if (handle.getAttribute("aria-valuetext") !== text)
        handle.setAttribute("aria-valuetext", text);
    });
  }

  /** The angles shown now: what a change of one begins from. */
  private angles(): number[] {
    const { motion, clock } = this.lab;
    if (motion.count === 0) return this.lab.recipe.state.slice(0, this.handles.length);
    const place = Math.min(clock.place, motion.count - 1);
    return stateAt(motion, place).slice(0, this.handles.length);
  }

  private set(index: number, angle: number, rate = 0): void {
    const angles = this.angles();
    const rates = angles.map((_, i) => (i === index ? rate : 0));
    angles[index] = angle;
    this.lab.change({ state: [...angles, ...rates] });
  }

  private key(event: KeyboardEvent, index: number): void {
    const steps: Record<string, number> = {
      ArrowRight: 1,
      ArrowUp: 1,
      ArrowLeft: -1,
      ArrowDown: -1,
      PageUp: 10,
      PageDown: -10,
    };
    const step = steps[event.key];
    if (step === undefined && event.key !== "Home" && event.key !== "End") return;
    event.preventDefault();
    this.lab.clock.pause();
    if (step === undefined) {
      this.set(index, event.key === "Home" ? 0 : Math.PI);
      return;
    }
    const size = event.shiftKey ? step / 10 : step;
    const tenth = Math.round((this.angles()[index] * DEGREES + size) * 10);
    this.set(index, radians(tenth / 10));
  }

  private grasp(event: PointerEvent, index: number): void {
    (event.target as HTMLElement).setPointerCapture(event.pointerId);
    this.held = { index, path: [], played: this.lab.clock.playing };
    this.lab.clock.pause();
  }

  private drag(event: PointerEvent): void {
    if (!this.held) return;
    const { index, path } = this.held;
    // Browsers join the events of a frame into one: a throw is measured by all of them.
    const events = event.getCoalescedEvents();
    for (const each of events.length > 0 ? events : [event]) {
      path.push({ at: each.timeStamp, angle: this.angleOf(each, index) });
    }
    this.set(index, path[path.length - 1].angle);
  }

  /** The angle towards a pointer, from the pivot or the joint. */
  private angleOf(event: PointerEvent, index: number): number {
    const { lab, canvas } = this;
    const box = canvas.getBoundingClientRect();
    const [pane] = stagePanes(lab, canvas.clientWidth, canvas.clientHeight);
    const angles = this.angles();
    const lengths = lengthsOf(lab.recipe);
    const pivot = pivotAt(lab.recipe, lab.recipe.t0);
    let [x, y] = toScreen(pane, ...pivot);
    for (let i = 0; i < index; ++i) {
      x += pane.scale * lengths[i] * Math.sin(angles[i]);
      y += pane.scale * lengths[i] * Math.cos(angles[i]);
    }
    const angle = Math.atan2(event.clientX - box.left - x, event.clientY - box.top - y);
    return unwrapped(angle, angles[index]);
  }

  private release(event: PointerEvent): void {
    if (!this.held) return;
    const { index, path, played } = this.held;
    this.held = null;
    if (path.length === 0) return;
    const last = path[path.length - 1];
    const held = event.timeStamp - last.at > HELD;
    const first = path.find((each) => last.at - each.at < THROWN && each !== last) ?? path.at(-2);
    const moved = first !== undefined && !held && last.at > first.at;
    const rate = moved ? (1000 * (last.angle - first.angle)) / (last.at - first.at) : 0;
    const thrown = Math.abs(rate) > REST;
    if (thrown) this.set(index, last.angle, Number(rate.toPrecision(3)));
    if (thrown || played) this.lab.clock.play();
    this.lab.tell("time");
  }
}
