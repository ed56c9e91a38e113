// What is on the stage: the recipe, its motion, what is compared with it, and who has to be told.

import type { Core, RunOptions } from "../core/api";
import { RefusedError, TrappedError } from "../core/api";
import { catalogue } from "../core/catalogue";
import { sentence } from "../core/fault";
import type { Series } from "../measured/series";
import { checked } from "../recipe/address";
import {
  described,
  EXACT,
  gridOf,
  isDouble,
  methodsFor,
  optionsOf,
  type Page,
  placesOf,
  type Recipe,
  spacingOf,
  systemOf,
} from "../recipe/recipe";
import { current } from "../words/language";
import type { EnergyBalance } from "./balance";
import { Clock } from "./clock";
import { Ghosts } from "./ghosts";
import {
  compute,
  emptyMotion,
  exactSource,
  gridSource,
  type Motion,
  type Source,
  solveSource,
} from "./motion";

/** What may change: the recipe; the motion or what is beside it; the place of the clock; the page. */
export type Change = "recipe" | "motion" | "time" | "page" | "refused";

/** The state of the page, and the only place that changes it. */
export class Lab {
  readonly clock = new Clock();
  motion: Motion;
  twin: Motion | null = null; // the linear pendulum beside the simple one
  twinShown = true;
  horizon: number | null = null; // s; null: not known (yet)
  refusal = ""; // of the core, in one line
  cloudWanted = false; // neighbours around the start
  balance: EnergyBalance | null = null; // of this motion or one before, where a graph wanted it
  measured: Series | null = null; // a recording beside the run
  hidden = false; // gravity is a riddle: neither shown nor in the address
  readonly ghosts: Ghosts;
  private readonly listeners = new Map<Change, Set<() => void>>();
  private work = new AbortController();
  private trustWork = new AbortController();

  constructor(
    readonly core: Core,
    public recipe: Recipe,
    public page: Page,
  ) {
    this.ghosts = new Ghosts(this);
    this.clock.speed = page.speed;
    this.motion = this.fresh(recipe.method);
  }

  /** Calls back at a change; gives what ends that. */
  on(change: Change, listener: () => void): () => void {
    const listeners = this.listeners.get(change) ?? new Set();
    this.listeners.set(change, listeners.add(listener));
    return () => listeners.delete(listener);
  }

  tell(change: Change): void {
    for (const listener of this.listeners.get(change) ?? []) listener();
  }

  /** Runs another recipe; throws `Refused` where it cannot be. */
  change(next: Partial<Recipe>): void {
    const recipe = { ...this.recipe, ...next };
    checked(recipe);
    this.recipe = recipe;
    this.tell("recipe");
    this.run();
  }

  changePage(next: Partial<Page>): void {
    Object.assign(this.page, next);
    if (next.speed !== undefined) this.clock.setSpeed(next.speed);
    if (next.compare !== undefined) this.ghosts.run();
    this.tell("page");
  }

  /** Computes the recipe's motion from its start. */
  run(): void {
    this.work.abort();
    this.work = new AbortController();
    const { signal } = this.work;
    const { recipe } = this;
    this.motion = this.fresh(recipe.method);
    this.horizon = null;
    this.refusal = "";
    this.ghosts.clear();
    this.trustWork.abort();
    const sign = recipe.t_max < recipe.t0 ? -1 : 1;
    this.clock.restart(sign * this.motion.spacing, this.motion.places - 1);
    const main = this.fill(this.motion, this.source(recipe.method), signal);
    const twin = this.runTwin(signal);
    Promise.all([main, twin])
      .then(() => Promise.all([this.ghosts.run(), this.trust()]))
      .catch((error) => this.caught(error));
  }

  /** The source of a method's states on the recipe's grid. */
  source(method: string): Source {
    const request = gridOf(this.recipe, method);
    if (method === EXACT) return exactSource(this.core, request);
    const { step } = request.options ?? {};
    const whole = step === undefined || Math.abs(remainder(request.spacing, step)) < 1e-9 * step;
    return whole
      ? gridSource(this.core, request)
      : solveSource(this.core, request, placesOf(this.recipe));
  }

  fresh(method: string): Motion {
    const { recipe } = this;
    const sign = recipe.t_max < recipe.t0 ? -1 : 1;
    return emptyMotion(
      method,
      recipe.state.length,
      placesOf(recipe),
      sign * spacingOf(recipe),
      recipe.t0,
    );
  }

  /** Computes a motion of the recipe's system; the stage is told of each piece. */
  fill(motion: Motion, source: Source, signal: AbortSignal): Promise<void> {
    const system = described(this.recipe);
    return compute(this.core, motion, source, system, signal, () => this.tell("motion"));
  }

  /** Says what went wrong, unless a run was left on purpose. */
  caught(error: unknown): void {
    if (error instanceof DOMException && error.name === "AbortError") return;
    if (error instanceof TrappedError) return; // told by the core itself
    this.refusal =
      error instanceof RefusedError
        ? sentence(error.fault, current())
        : String((error as Error).message);
    this.tell("refused");
  }

  private async runTwin(signal: AbortSignal): Promise<void> {
    this.twin = null;
    if (this.recipe.system !== "simple" || !this.twinShown) return;
    const system = { ...described(this.recipe), name: "linear", form: "" };
    const twin = this.fresh("linear");
    const source = exactSource(this.core, { ...gridOf(this.recipe), system });
    await compute(this.core, twin, source, system, signal, () => {
      this.twin = twin;
      this.tell("motion");
    });
  }

  /** Until when the run is right, beside one with twice the digits. */
  private async trust(): Promise<void> {
    this.trustWork.abort();
    this.trustWork = new AbortController();
    const { method, t0, t_max } = this.recipe;
    if (method === EXACT || t_max < t0) return;
    const options = optionsOf(this.recipe, method);
    this.horizon = await this.horizonOf(method, options, this.trustWork.signal);
    this.tell("motion");
  }

  /** The time until which a method's run is right to `trusted` [s]; Infinity: to its end. */
  async horizonOf(
    method: string,
    options: RunOptions,
    signal: AbortSignal,
  ): Promise<number | null> {
    const { spacing: _, ...request } = gridOf(this.recipe, method);
    const times = Float64Array.of(this.recipe.t_max);
    const asked = { ...request, times, options: { ...options, certify: this.trusted } };
    return (await this.core.call("solve", [asked], { signal })).trustHorizon;
  }

  /** Angle that a run may be off by and still be called right [rad]. */
  get trusted(): number {
    return this.recipe.options.certify ?? TRUSTED;
  }

  /** Methods that take the system. */
  methods(): string[] {
    return methodsFor(this.recipe, catalogue.methods);
  }
}

/** Angle that a run may be off by and still be called right, where the recipe names none [rad]: a degree. */
const TRUSTED = Math.PI / 180;

/** What is left of a division to the nearest whole number. */
function remainder(value: number, by: number): number {
  return value - Math.round(value / by) * by;
}

/** Whether the system swings in two angles. */
export const twoAngles = (lab: Lab): boolean => isDouble(lab.recipe);

/** Whether energy is kept. */
export const conservative = (lab: Lab): boolean => systemOf(lab.recipe).capabilities.conservative;
