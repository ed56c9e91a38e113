"""Maps of indicators of chaos: MEGNO, largest exponent, SALI."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula._angles import warn_of_degrees
from pendula._checks import checked_threads, one_of
from pendula._progress import with_bar
from pendula.chaos.indicators import INDICATORS, indicator_of
from pendula.many.chunks import Variable
from pendula.many.maps.base import Map, checked_map, checked_tolerance
from pendula.many.maps.cells import NAMES

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    from pendula._progress import AskedProgress, Progress
    from pendula._types import Array
    from pendula.many.chunks import Chunk
    from pendula.systems import DoublePendulum


@with_bar("indicator map")
def indicator_map(
    system: DoublePendulum,
    theta1: tuple[float, float],
    theta2: tuple[float, float],
    shape: tuple[int, int],
    t_max: float,
    indicator: str = "megno",
    *,
    tolerance: float | None = None,
    store: str | Path | None = None,
    client: Any = None,
    threads: int | None = None,
    progress: AskedProgress = None,
    resume: bool = True,
    overwrite: bool = False,
) -> xr.Dataset:
    """An indicator of chaos from rest at each pair of angles of a rectangle.

    A cell has the bits of `megno`, `lyapunov` or `sali`, whatever the threads, chunks or workers.

    Args:
        system: a double pendulum.
        theta1: range of the first angle, (lo, hi) [rad]; the cells' centres are run.
        theta2: of the second.
        shape: cells along each.
        t_max: the length of the runs [s].
        indicator: "megno": the mean MEGNO; "lyapunov": the finite-time exponent; "sali".
        tolerance: of the Taylor method; None: machine precision.
        store: as for `flip_map`.
        client: as for `flip_map`.
        threads: as for `flip_map`.
        progress: as for `flip_map`.
        resume: as for `flip_map`.
        overwrite: as for `flip_map`.

    Returns:
        Dims (theta1, theta2), coordinates the centres of the cells; a variable by the indicator's
        name; NaN where a run did not come so far.

    Raises:
        ValueError: for an argument out of range, or a store of another map.
    """
    asked = IndicatorMap.checked(
        system, theta1, theta2, shape, t_max, indicator, tolerance=tolerance
    )
    for name, given, ends in zip(NAMES, (theta1, theta2), asked.cells.ranges, strict=True):
        warn_of_degrees(name, given, ends)
    how: dict[str, Any] = {"client": client, "progress": progress, "threads": threads}
    return asked.dataset(store, **how, resume=resume, overwrite=overwrite)


@dataclass(frozen=True)
class IndicatorMap(Map):
    """What computes an indicator, from checked arguments."""

    kind = "indicator"
    title = "Indicator of chaos of the double pendulum, from rest"

    indicator: str
    tolerance: float

    @classmethod
    def checked(
        cls,
        system: object,
        theta1: object,
        theta2: object,
        shape: object,
        t_max: object,
        indicator: object = "megno",
        *,
        tolerance: object = None,
    ) -> IndicatorMap:
        """The map that the arguments of `indicator_map` ask for.

        Raises:
            ValueError: naming the argument.
        """
        where = checked_map(system, theta1, theta2, shape, t_max)
        within = checked_tolerance(where[0], where[-1], tolerance)
        return cls(*where, one_of("indicator", indicator, INDICATORS), within)

    @property
    def variables(self) -> tuple[Variable, ...]:
        """The indicator."""
        return (indicator_variable(self.indicator, NAMES),)

    def __call__(
        self, chunk: Chunk, threads: int | None, progress: Progress
    ) -> dict[str, NDArray[np.generic]]:
        """The indicator at the cells of a chunk."""
        values = values_of(self, self.cells.starts(chunk), threads, progress)
        return {self.indicator: self.cells.whole(chunk, values)}


def indicator_variable(indicator: str, axes: tuple[str, ...]) -> Variable:
    """The array of a map."""
    units, meaning = INDICATORS[indicator]
    return Variable(indicator, axes, "float64", math.nan, {"units": units, "long_name": meaning})


def values_of(of: Any, starts: Array, threads: int | None, progress: Progress) -> Array:
    """The indicator (n,) of starts (n, 4); `of`: what a map asks for."""
    options, count = {"tolerance": of.tolerance}, checked_threads(threads)
    return indicator_of(of.system, starts, of.indicator, of.t_max, options, count, progress)
