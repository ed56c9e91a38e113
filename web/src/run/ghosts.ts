// Ghosts: other methods released with the same pendulum, each with the drift of its energy and its
// distance from the reference. The reference is the closed form or, where there is none, the Taylor
// method at machine precision.

import { EXACT, optionsOf, systemOf } from "../recipe/recipe";
import type { Lab } from "./lab";
import type { Motion } from "./motion";

/** A method beside the run. */
export interface Ghost {
  readonly method: string;
  readonly motion: Motion;
  readonly drift: Float64Array; // |energy error|, relative
  readonly distance: Float64Array; // largest difference of an angle from the reference [rad]
  horizon: number | null; // s
}

/** All ghosts of one release. */
export class Ghosts {
  list: Ghost[] = [];
  reference: Motion | null = null;
  private work = new AbortController();
  private judging = new AbortController();

  constructor(private readonly lab: Lab) {}

  /** Leaves what is computed, and shows none. */
  clear(): void {
    this.work.abort();
    this.leave();
    this.list = [];
  }

  /** Computes those the page names, one after the other. */
  async run(): Promise<void> {
    this.clear();
    this.work = new AbortController();
    const { signal } = this.work;
    const { lab } = this;
    const methods = lab.page.compare.filter((name) => takes(lab, name));
    if (methods.length === 0) return;
    try {
      const reference = systemOf(lab.recipe).capabilities.closed_form ? EXACT : "taylor";
      this.reference = lab.fresh(reference);
      await lab.fill(this.reference, lab.source(reference), signal);
      for (const method of methods) await this.add(method, signal);
    } catch (error) {
      lab.caught(error);
      return;
    }
    if (lab.page.view === "compare") await this.judge();
  }

  /** Finds until when each is right; for as long as the comparison is looked at. */
  async judge(): Promise<void> {
    this.leave();
    this.judging = new AbortController();
    try {
      await this.horizons(this.judging.signal);
    } catch (error) {
      this.lab.caught(error);
    }
  }

  /** The comparison is looked at no more. */
  leave(): void {
    this.judging.abort();
  }

  private async add(method: string, signal: AbortSignal): Promise<void> {
    const { lab } = this;
    const motion = lab.fresh(method);
    await lab.fill(motion, lab.source(method), signal);
    const drift = driftOf(motion);
    const distance = distanceOf(motion, this.reference!);
    this.list.push({ method, motion, drift, distance, horizon: null });
    lab.tell("motion");
  }

  private async horizons(signal: AbortSignal): Promise<void> {
    const { lab } = this;
    for (const ghost of this.list) {
      const known = ghost.method === EXACT || ghost.horizon !== null;
      if (known || lab.recipe.t_max < lab.recipe.t0) continue;
      ghost.horizon = await lab.horizonOf(
        ghost.method,
        optionsOf(lab.recipe, ghost.method),
        signal,
      );
      lab.tell("motion");
    }
  }
}

function takes(lab: Lab, method: string): boolean {
  return lab.methods().includes(method);
}

/** Relative change of the energy since the start, as `Trajectory.energy_error` has it, unsigned. */
export function driftOf(motion: Motion): Float64Array {
  const start = motion.kinetic[0] + motion.potential[0];
  const scale = start > 0 ? start : 1;
  return Float64Array.from(
    { length: motion.count },
    (_, i) => Math.abs(motion.kinetic[i] + motion.potential[i] - start) / scale,
  );
}

/** Largest difference of an angle between two motions of one grid. */
export function distanceOf(motion: Motion, reference: Motion): Float64Array {
  const { size } = motion;
  const count = Math.min(motion.count, reference.count);
  const distance = new Float64Array(count);
  for (let i = 0; i < count; ++i) {
    for (let j = 0; j < size / 2; ++j) {
      const difference = Math.abs(motion.states[i * size + j] - reference.states[i * size + j]);
      if (!(difference <= distance[i])) distance[i] = difference;
    }
  }
  return distance;
}
