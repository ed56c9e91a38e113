"""The divergence map: how far neighbours have moved apart after a time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula._angles import warn_of_degrees
from pendula._checks import positive_number
from pendula._messages import ArgumentError
from pendula._progress import with_bar
from pendula.many.chunks import Variable
from pendula.many.maps.base import Map, checked_map, checked_tolerance
from pendula.many.maps.cells import NAMES

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    from pendula._progress import AskedProgress, Progress
    from pendula.many.chunks import Chunk
    from pendula.systems import DoublePendulum

SMALLEST_SEPARATION, LARGEST_SEPARATION = 1e-13, 1e-2  # rad


@with_bar("divergence map")
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
    progress: AskedProgress = None,
    resume: bool = True,
    overwrite: bool = False,
) -> xr.Dataset:
    """How many times farther apart than at the start two neighbours are after a time.

    Both start from rest; the neighbour's angles are both larger by the separation, or, where
    theta1 < 0, smaller, so that a map about rest is symmetric. The finite-time divergence is
    ln(growth) / t_max. Angles are never wrapped: once the two are apart by turns, growth is about
    2π / separation, and has no further meaning.

    Args:
        system: a double pendulum.
        theta1: range of the first angle, (lo, hi) [rad]; the cells' centres are run.
        theta2: of the second.
        shape: cells along each.
        t_max: the time after which they are compared [s].
        separation: of the neighbours at the start [rad].
        tolerance: of the Taylor method; None: machine precision.
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
    asked = DivergenceMap.checked(
        system, theta1, theta2, shape, t_max, separation=separation, tolerance=tolerance
    )
    for name, given, ends in zip(NAMES, (theta1, theta2), asked.cells.ranges, strict=True):
        warn_of_degrees(name, given, ends)
    how: dict[str, Any] = {"client": client, "progress": progress, "threads": threads}
    return asked.dataset(store, **how, resume=resume, overwrite=overwrite)


@dataclass(frozen=True)
class DivergenceMap(Map):
    """What computes the divergence of neighbours, from checked arguments."""

    kind = "divergence"
    title = "Divergence of neighbours, double pendulum, from rest"

    separation: float
    tolerance: float

    @classmethod
    def checked(
        cls,
        system: object,
        theta1: object,
        theta2: object,
        shape: object,
        t_max: object,
        *,
        separation: object = 1e-8,
        tolerance: object = None,
    ) -> DivergenceMap:
        """The map that the arguments of `divergence_map` ask for.

        Raises:
            ValueError: naming the argument.
        """
        where = checked_map(system, theta1, theta2, shape, t_max)
        apart = positive_number("separation", separation, "rad")
        if not SMALLEST_SEPARATION <= apart <= LARGEST_SEPARATION:
            rule = (
                "must lie between {least} and {most} rad, got {value}: nearer they are one, "
                "farther apart no neighbours"
            )
            least, most = SMALLEST_SEPARATION, LARGEST_SEPARATION
            raise ArgumentError("separation", rule, value=apart, least=least, most=most)
        return cls(*where, apart, checked_tolerance(where[0], where[-1], tolerance))

    @property
    def variables(self) -> tuple[Variable, ...]:
        """How far they have moved apart."""
        attributes = {"units": "1", "long_name": "growth of the distance of neighbours until t_max"}
        return (Variable("growth", NAMES, "float64", math.nan, attributes),)

    def __call__(
        self, chunk: Chunk, threads: int | None, progress: Progress
    ) -> dict[str, NDArray[np.generic]]:
        """The growth at the cells of a chunk."""
        import numpy as np

        starts = self.cells.starts(chunk)
        neighbours = starts.copy()
        neighbours[:, :2] += self.separation
        pairs = np.concatenate([starts, neighbours])
        found = self.runs(pairs, threads, progress, tolerance=self.tolerance)
        ends = found.states[:, 0, :2]
        apart = abs(ends[len(starts) :] - ends[: len(starts)]).max(axis=1)
        return {"growth": self.cells.whole(chunk, apart / self.separation)}
