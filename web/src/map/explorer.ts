// The flip map of a rectangle of starts: a coarse picture at once, then finer ones, from the middle
// outward, by all workers. The numbers of each level are those of `pendula.flip_map` of that shape.

import type { CellRange, Core, FlipCells, FlipMapRequest } from "../core/api";
import { paint } from "./colours";
import { type Asked, FLIPS, FORBIDDEN, Level, NEVER, type Rectangle, UNRESOLVED } from "./level";
import { megnoCells } from "./megno";

const SIDES = [32, 64, 128, 256, 512];
const RESOLVED_FROM = 128; // the finer levels are run a second time, at a thousandth of the tolerance
const CHUNK = 16; // cells along each angle: what a worker computes in some 30 ms
const TOLERANCE = 1e-8; // that of pendula.flip_map

/** Computes levels; tells when there is something new. */
export class Explorer {
  levels: Level[] = []; // those to be drawn, one over the other
  deep = false; // the finest level has cells that are no longer different doubles
  private work = new AbortController();

  constructor(
    private readonly core: Core,
    private readonly told: () => void,
  ) {}

  get last(): Level | undefined {
    return this.levels[this.levels.length - 1];
  }

  leave(): void {
    this.work.abort();
  }

  /** Begins anew with another rectangle or another system; the old picture may stay below. */
  async show(asked: Asked, keep: boolean): Promise<void> {
    this.work.abort();
    this.work = new AbortController();
    const { signal } = this.work;
    this.levels = keep ? this.levels.filter((level) => level.done > 0).slice(-3) : [];
    this.deep = false;
    for (const side of SIDES) {
      if (!distinct(asked.rectangle, side)) {
        this.deep = true;
        break;
      }
      const level = new Level(asked, side);
      this.levels.push(level);
      await this.fill(level, signal);
      if (side >= 64) this.levels = this.levels.slice(-1);
      this.told();
    }
    this.told();
  }

  private async fill(level: Level, signal: AbortSignal): Promise<void> {
    const { side, asked } = level;
    const request: FlipMapRequest = {
      system: asked.system,
      theta1: asked.rectangle.theta1,
      theta2: asked.rectangle.theta2,
      shape: [side, side],
      tMax: asked.tMax,
      which: null,
      tolerance: TOLERANCE,
      resolve: side >= RESOLVED_FROM,
    };
    const chunks = chunksOf(side);
    const next = async (): Promise<void> => {
      for (let chunk = chunks.shift(); chunk; chunk = chunks.shift()) {
        if (asked.quantity === "megno") {
          takeMegno(level, chunk, await megnoCells(this.core, request, chunk, signal));
        } else {
          const cells = await this.core.call("flipCells", [request, chunk], { signal });
          take(level, chunk, cells, request);
        }
        paint(level, chunk);
        this.told();
      }
    };
    // One asks while the other is computed, so that no worker waits for the page.
    await Promise.all(Array.from({ length: 2 * Math.max(1, this.core.workers - 1) }, next));
  }
}

/** Whether neighbouring cells are different doubles, as `pendula.flip_map` asks. */
export function distinct({ theta1, theta2 }: Rectangle, side: number): boolean {
  return [theta1, theta2].every(([low, high]) => {
    const largest = Math.max(Math.abs(low), Math.abs(high));
    return high - low >= 2 * side * ulp(largest);
  });
}

/** The distance to the next larger double. */
function ulp(value: number): number {
  return 2 ** (Math.floor(Math.log2(Math.max(value, 2 ** -1022))) - 52);
}

/** Squares of cells, those in the middle first. */
function chunksOf(side: number): CellRange[] {
  const parts = Math.ceil(side / CHUNK);
  const chunks = [...Array(parts * parts).keys()].map((k): CellRange => {
    const first = [Math.floor(k / parts) * CHUNK, (k % parts) * CHUNK] as const;
    const stop = [Math.min(side, first[0] + CHUNK), Math.min(side, first[1] + CHUNK)] as const;
    return { first, stop };
  });
  const far = ({ first }: CellRange) =>
    Math.hypot(first[0] + CHUNK / 2 - side / 2, first[1] + CHUNK / 2 - side / 2);
  return chunks.sort((a, b) => far(a) - far(b));
}

/** Places of a level that a chunk's cells have, theta1 outermost. */
function placesOf(side: number, { first, stop }: CellRange): number[] {
  const across = stop[1] - first[1];
  const count = (stop[0] - first[0]) * across;
  return Array.from(
    { length: count },
    (_, k) => (first[0] + Math.floor(k / across)) * side + first[1] + (k % across),
  );
}

function take(level: Level, chunk: CellRange, cells: FlipCells, request: FlipMapRequest): void {
  for (const [k, at] of placesOf(level.side, chunk).entries()) {
    level.values[at] = cells.flipTime[k];
    level.rods[at] = cells.flippedRod[k];
    level.kinds[at] = kindOf(cells, k, request.resolve);
  }
  level.done += cells.flipTime.length;
}

function takeMegno(level: Level, chunk: CellRange, values: Float64Array): void {
  for (const [k, at] of placesOf(level.side, chunk).entries()) {
    level.values[at] = values[k];
    level.kinds[at] = Number.isNaN(values[k]) ? UNRESOLVED : FLIPS;
  }
  level.done += values.length;
}

function kindOf(cells: FlipCells, k: number, resolve: boolean): number {
  if (cells.forbidden[k]) return FORBIDDEN;
  if (resolve && !cells.resolved[k]) return UNRESOLVED;
  return Number.isNaN(cells.flipTime[k]) ? NEVER : FLIPS;
}
