// A cloud of neighbours: 64 × 64 starts around the one on the stage, run together through lanes.

import { described, isDouble } from "../recipe/recipe";
import type { Lab } from "./lab";

const SIDE = 64;
const HALF = 1e-4; // rad: half the side of the square of starts
const FRAME = 1 / 30; // s between pictures of the cloud
const MOST_FRAMES = 1800;
const PIECE = 10; // pictures computed at once
const STEP = 0.005; // s, of RK4

export class Cloud {
  /** Side of the square of starts [rad]. */
  readonly start = 2 * HALF;
  private readonly work = new AbortController();
  private readonly pictures: Float32Array[] = [];
  private readonly spreads: number[] = [];
  private readonly stride: number; // places of the clock between pictures

  constructor(private readonly lab: Lab) {
    const { spacing } = lab.motion;
    this.stride = Math.max(1, Math.round(FRAME / Math.abs(spacing)));
    this.compute().catch((error) => lab.caught(error));
  }

  stop(): void {
    this.work.abort();
  }

  /** Tips of all neighbours at a place, (n, 2) [m]; null: not there (yet). */
  tips(place: number): Float32Array | null {
    return this.pictures[Math.floor(place / this.stride)] ?? null;
  }

  /** The largest difference of an angle among them at a place [rad]. */
  spread(place: number): number | null {
    return this.spreads[Math.floor(place / this.stride)] ?? null;
  }

  private starts(): Float64Array {
    const { state } = this.lab.recipe;
    const size = state.length;
    const states = new Float64Array(SIDE * SIDE * size);
    const second = 1; // the second angle, or the angular velocity
    for (let i = 0; i < SIDE * SIDE; ++i) {
      states.set(state, i * size);
      states[i * size] += (((i % SIDE) + 0.5) / SIDE - 0.5) * 2 * HALF;
      states[i * size + second] += ((Math.floor(i / SIDE) + 0.5) / SIDE - 0.5) * 2 * HALF;
    }
    return states;
  }

  private async compute(): Promise<void> {
    const { lab } = this;
    const { recipe, motion } = lab;
    const { signal } = this.work;
    const system = described(recipe);
    const apart = this.stride * motion.spacing;
    const step = Math.abs(apart) / Math.max(1, Math.round(Math.abs(apart) / STEP));
    const size = recipe.state.length;
    let states = this.starts();
    await this.keep(states, 1);
    const frames = Math.min(MOST_FRAMES, Math.floor((motion.places - 1) / this.stride));
    for (let done = 0; done < frames; done += PIECE) {
      const count = Math.min(PIECE, frames - done);
      const t0 = recipe.t0 + done * apart;
      const times = Float64Array.from(
        { length: count },
        (_, i) => recipe.t0 + (done + i + 1) * apart,
      );
      const request = {
        system,
        method: "rk4",
        state: recipe.state,
        t0,
        options: { step },
        states,
        times,
      };
      const found = await lab.core.call("ensemble", [request], { signal });
      await this.keep(found.states, count);
      const last = new Float64Array(SIDE * SIDE * size);
      for (let i = 0; i < SIDE * SIDE; ++i) {
        const at = (i * count + count - 1) * size;
        last.set(found.states.subarray(at, at + size), i * size);
      }
      states = last;
      lab.tell("time");
    }
  }

  /** Keeps pictures of states (n, count, d). */
  private async keep(states: Float64Array, count: number): Promise<void> {
    const { lab } = this;
    const size = lab.recipe.state.length;
    const half = size / 2;
    const system = described(lab.recipe);
    const positions = await lab.core.call("positions", [system, states], {
      signal: this.work.signal,
    });
    for (let k = 0; k < count; ++k) {
      const tips = new Float32Array(2 * SIDE * SIDE);
      const low = new Float64Array(half).fill(Number.POSITIVE_INFINITY);
      const high = new Float64Array(half).fill(Number.NEGATIVE_INFINITY);
      for (let i = 0; i < SIDE * SIDE; ++i) {
        const at = (i * count + k) * size;
        tips[2 * i] = positions[at + size - 2];
        tips[2 * i + 1] = positions[at + size - 1];
        for (let j = 0; j < (isDouble(lab.recipe) ? 2 : 1); ++j) {
          low[j] = Math.min(low[j], states[at + j]);
          high[j] = Math.max(high[j], states[at + j]);
        }
      }
      this.pictures.push(tips);
      this.spreads.push(Math.max(...high.map((value, j) => value - low[j])));
    }
  }
}
