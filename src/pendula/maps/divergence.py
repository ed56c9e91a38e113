"""The divergence map: how far neighbours have moved apart after a time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula import __version__
from pendula._arguments import check_rounding_of_times, checked_tolerance
from pendula._checks import positive_number
from pendula.chunks import Variable, Work, run
from pendula.ensembles import Task, checked_threads, run_task
from pendula.maps.cells import NAMES, Cells, checked_cells, checked_double

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    from pendula._progress import Progress
    from pendula.chunks import Chunk
    from pendula.systems import DoublePendulum

SMALLEST_SEPARATION, LARGEST_SEPARATION = 1e-13, 1e-2  # rad


def divergence_map(
    system: DoublePendulum,
    theta1: tuple[float, float],
    theta2: tuple[float, float],
    shape: tuple[int, int],
    t_max: float,
    *,
    separation: float = 1e-8,
    tolerance: float | None = None,
    store: str | Path | None = None,
    client: Any = None,
    threads: int | None = None,
    progress: Progress = None,
    resume: bool = True,
    overwrite: bool = False,
) -> xr.Dataset:
    """How many times farther apart than at the start two neighbours are after a time.

    Both start from rest; the neighbour's angles are both larger by the separation, or, where
    theta1 < 0, smaller, so that a map about rest is symmetric. The finite-time divergence is
    ln(growth) / t_max. Angles are never wrapped: once the two are apart by turns, growth is about
    2π / separation, and tells no more.

    Args:
        system: a double pendulum.
        theta1: range of the first angle, (lo, hi) [rad]; the cells' centres are run.
        theta2: of the second.
        shape: cells along each.
        t_max: the time after which they are compared [s].
        separation: of the neighbours at the start [rad].
        tolerance: of the Taylor method; None: its best.
        store: as for `flip_map`.
        client: as for `flip_map`.
        threads: as for `flip_map`.
        progress: as for `flip_map`.
        resume: as for `flip_map`.
        overwrite: as for `flip_map`.

    Returns:
        Dims (theta1, theta2), coordinates the centres of the cells; `growth`, the largest
        difference of an angle at t_max in parts of the separation; NaN where a run did not come
        so far.

    Raises:
        ValueError: for an argument out of range, or a store of another map.
    """
    chosen = checked_double(system)
    cells = checked_cells(theta1, theta2, shape)
    end = positive_number("t_max", t_max, "s")
    check_rounding_of_times(chosen, 0.0, end)
    apart = positive_number("separation", separation, "rad")
    if not SMALLEST_SEPARATION <= apart <= LARGEST_SEPARATION:
        raise ValueError(
            f"separation must lie between {SMALLEST_SEPARATION:g} and {LARGEST_SEPARATION:g} rad, "
            f"got {apart!r}: nearer they are one, farther apart no neighbours"
        )
    compute = DivergenceCells(chosen, cells, end, apart, checked_tolerance(tolerance))
    told = {"units": "1", "long_name": "growth of the distance of neighbours until t_max"}
    work = Work(
        recipe=compute.recipe(),
        axes=cells.axes(),
        variables=(Variable("growth", NAMES, "float64", math.nan, told),),
        compute=compute,
        attrs={"title": "Divergence of neighbours, double pendulum, from rest", "t_max": end},
        mirrored=cells.mirrored,
    )
    how: dict[str, Any] = {"client": client, "progress": progress, "threads": threads}
    return run(work, store, **how, resume=resume, overwrite=overwrite)


@dataclass(frozen=True)
class DivergenceCells:
    """What computes the cells of a chunk."""

    system: DoublePendulum
    cells: Cells
    t_max: float
    separation: float
    tolerance: float

    def recipe(self) -> dict[str, Any]:
        """All that decides the numbers."""
        return {
            "pendula": __version__,
            "map": "divergence",
            "system": self.system.description(),
            **self.cells.description(),
            "t_max": self.t_max,
            "separation": self.separation,
            "tolerance": self.tolerance,
        }

    def __call__(
        self, chunk: Chunk, threads: int | None, progress: Progress
    ) -> dict[str, NDArray[np.generic]]:
        """The growth at the cells of a chunk."""
        import numpy as np

        end = np.array([self.t_max])
        task = Task(
            self.system.name, self.system.form, "taylor", 0.0, end, tolerance=self.tolerance
        )
        parameters = np.array([list(self.system.parameters.values())])
        starts = self.cells.starts(chunk)
        neighbours = starts.copy()
        neighbours[:, :2] += self.separation
        both = np.concatenate([starts, neighbours])
        ends = run_task(task, parameters, both, checked_threads(threads), progress)[0][:, 0, :2]
        apart = abs(ends[len(starts) :] - ends[: len(starts)]).max(axis=1)
        return {"growth": self.cells.whole(chunk, apart / self.separation)}
