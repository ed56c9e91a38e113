// Where the energy of a run with friction or a drive went: work done on it and heat given off since
// its start, at places of its grid.

import { EXACT, gridOf, systemOf } from "../recipe/recipe";
import type { Lab } from "./lab";
import type { Motion } from "./motion";

const MOST = 4000; // places that are asked for

/** At every `stride`-th place of a motion, the start included; all [J]. */
export interface EnergyBalance {
  readonly motion: Motion;
  readonly stride: number;
  readonly work: Float64Array;
  readonly heat: Float64Array;
  /** Change of the energy. */
  readonly change: Float64Array;
  /** Of the change, work and heat apart: what the method got wrong. */
  readonly error: Float64Array;
}

/** The balance of a motion that is at its end, by a run to the same places. */
export async function balanceOf(lab: Lab, signal: AbortSignal): Promise<EnergyBalance> {
  const { recipe, motion } = lab;
  const method = recipe.method === EXACT ? "taylor" : recipe.method;
  const { spacing: _, ...request } = gridOf(recipe, method);
  const stride = Math.max(1, Math.ceil(motion.count / MOST));
  const count = Math.floor((motion.count - 1) / stride);
  const times = Float64Array.from({ length: count }, (_, i) => motion.times[(i + 1) * stride]);
  const found = await lab.core.call("balance", [{ ...request, times }], { signal });
  const works = found.works.length;
  const width = works + found.heats.length;
  const reached = found.net.length;
  const sum = (from: number, to: number) =>
    Float64Array.from({ length: reached + 1 }, (_, i) =>
      i === 0 ? 0 : total(found.parts.subarray((i - 1) * width + from, (i - 1) * width + to)),
    );
  const energy = (place: number) => motion.kinetic[place] + motion.potential[place];
  const change = Float64Array.from(
    { length: reached + 1 },
    (_, i) => energy(i * stride) - energy(0),
  );
  const error = change.map((value, i) =>
    i === 0 ? 0 : value - found.net[i - 1] - found.netTails[i - 1],
  );
  return { motion, stride, work: sum(0, works), heat: sum(works, width), change, error };
}

/** Whether work and heat change the energy of what is on the stage. */
export const exchanges = (lab: Lab): boolean => !systemOf(lab.recipe).capabilities.conservative;

/** The entry of a balance at the clock's place, or the last before it; null: none yet. */
export function entryNow({ balance, motion, clock }: Lab): number | null {
  if (!balance || balance.motion !== motion) return null;
  return Math.min(Math.floor(clock.place / balance.stride), balance.work.length - 1);
}

function total(values: Float64Array): number {
  return values.reduce((all, value) => all + value, 0);
}
