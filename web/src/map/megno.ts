// MEGNO of the cells of a map: about 2 where the motion from there is regular, growing with time where
// it is chaotic (Cincotta & Simó, Astron. Astrophys. Suppl. 147 (2000) 205, eqs. 19 and 21). The
// numbers are those of `indicator_map` in `pendula.many.maps`.

import type { CellRange, Core, FlipMapRequest } from "../core/api";
import type { Range } from "./level";

/** Angles at the centres of some cells, as `Cells.centres` in Python has them. */
export function centres([low, high]: Range, count: number, from: number, to: number): Float64Array {
  return Float64Array.from({ length: to - from }, (_, i) => {
    const place = (2 * (from + i) + 1 - count) / (2 * count);
    return 0.5 * (low + high) + (high - low) * place;
  });
}

/** Starts from rest at cells, theta1 outermost; of a start and its mirror image the same is run. */
function starts(
  { theta1, theta2, shape }: FlipMapRequest,
  { first, stop }: CellRange,
): Float64Array {
  const [rows, columns] = [theta1, theta2].map((range, axis) =>
    centres(range, shape[axis], first[axis], stop[axis]),
  );
  const states = new Float64Array(4 * rows.length * columns.length);
  rows.forEach((a, i) => {
    columns.forEach((b, j) => {
      const sign = a < 0 || (a === 0 && b < 0) ? -1 : 1;
      states.set([sign * a, sign * b], 4 * (i * columns.length + j));
    });
  });
  return states;
}

/** The mean MEGNO of cells at the request's end; NaN where a run did not come so far. */
export async function megnoCells(
  core: Core,
  request: FlipMapRequest,
  cells: CellRange,
  signal: AbortSignal,
): Promise<Float64Array> {
  const { system, tMax, tolerance } = request;
  const states = starts(request, cells);
  const found = await core.call(
    "varied",
    [
      {
        system,
        method: "taylor",
        state: [...states.subarray(0, 4)],
        options: { tolerance },
        states,
        times: Float64Array.of(tMax),
        use: "megno",
        variations: Float64Array.of(0.5, 0.5, 0.5, 0.5),
      },
    ],
    { signal },
  );
  const { size } = found;
  return Float64Array.from(
    { length: states.length / 4 },
    (_, i) => found.states[(i + 1) * size - 1] / tMax,
  );
}
