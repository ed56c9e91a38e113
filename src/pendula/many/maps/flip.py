"""The flip map: how long it takes until a rod first passes the top (Heyl 2008)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._angles import warn_of_degrees
from pendula._checks import checked_threads, flag, whole_number
from pendula._messages import ArgumentError
from pendula._progress import with_bar
from pendula._rules import refuse
from pendula.many.chunks import Variable
from pendula.many.maps.base import Map, checked_map, checked_tolerance
from pendula.many.maps.cells import NAMES
from pendula.run.options import BEST_TOLERANCE

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    from pendula._progress import AskedProgress, Progress
    from pendula.many.chunks import Chunk
    from pendula.systems import DoublePendulum


TIGHTER = _engine.SECOND_RUN_TOLERANCE  # in parts of the first run's
AGREEMENT = _engine.FLIP_AGREEMENT  # of two times, in parts of them; of two angles [rad]


@with_bar("flip map")
def flip_map(
    system: DoublePendulum,
    theta1: tuple[float, float],
    theta2: tuple[float, float],
    shape: tuple[int, int],
    t_max: float,
    which: int | None = None,
    *,
    tolerance: float = 1e-8,
    resolve: bool = True,
    store: str | Path | None = None,
    client: Any = None,
    threads: int | None = None,
    progress: AskedProgress = None,
    resume: bool = True,
    overwrite: bool = False,
) -> xr.Dataset:
    """The time until a rod first flips, from rest at each pair of angles of a rectangle.

    A rod flips when it first passes the top next to its start, ±π beyond the lowest point of its
    own turn. Where the energy is less than a flip needs the cell is forbidden, and nothing is run;
    where the rectangle is symmetric about rest, half the cells are run. A cell has the same bits
    whatever the threads, chunks or workers.

    Args:
        system: a double pendulum.
        theta1: range of the first angle, (lo, hi) [rad]; the cells' centres are run.
        theta2: of the second.
        shape: cells along each.
        t_max: how long to wait for a flip [s].
        which: rod 1 or 2; None: the one that is first.
        tolerance: of the Taylor method.
        resolve: run each cell again at a thousandth of the tolerance, and say where both agree:
            twice the work.
        store: a folder, or a URL, for a Zarr store that is written chunk by chunk: the same call
            resumes it, and the map may be larger than memory. None: in memory.
        client: of a Dask cluster that computes the chunks.
        threads: None: one for each processor.
        progress: called with the part that is done, 0 to 1; True: a bar, in a notebook or a
            terminal.
        resume: resume an existing store; else it is refused.
        overwrite: overwrite it.

    Returns:
        Dims (theta1, theta2), coordinates the centres of the cells. `flip_time` [s], NaN where none
        flips until t_max; `flipped_rod` 0 (none), 1, 2; `forbidden`; and, with `resolve`,
        `resolved`: flip times agree to 10^-4 of them and in the rod, or, where there is no flip,
        both runs are together to 10^-4 rad at t_max.

    Raises:
        ValueError: for an argument out of range, or a store of another map.
    """
    asked = FlipMap.checked(
        system, theta1, theta2, shape, t_max, which, tolerance=tolerance, resolve=resolve
    )
    for name, given, ends in zip(NAMES, (theta1, theta2), asked.cells.ranges, strict=True):
        warn_of_degrees(name, given, ends)
    how: dict[str, Any] = {"client": client, "progress": progress, "threads": threads}
    return asked.dataset(store, **how, resume=resume, overwrite=overwrite)


@dataclass(frozen=True)
class FlipMap(Map):
    """What computes flip times, from checked arguments."""

    kind = "flip"
    title = "Flip map of the double pendulum, from rest"

    which: int | None
    tolerance: float
    resolve: bool

    @classmethod
    def checked(
        cls,
        system: object,
        theta1: object,
        theta2: object,
        shape: object,
        t_max: object,
        which: object = None,
        *,
        tolerance: object = 1e-8,
        resolve: object = True,
    ) -> FlipMap:
        """The map that the arguments of `flip_map` ask for.

        Raises:
            ValueError: naming the argument.
        """
        where = checked_map(system, theta1, theta2, shape, t_max)
        again = flag("resolve", resolve)
        within = checked_tolerance(where[0], where[-1], tolerance)
        asked = cls(*where, _checked_rod(which), within, again)
        if again and within * TIGHTER < BEST_TOLERANCE:
            raise ArgumentError(
                "tolerance",
                f"must be at least {BEST_TOLERANCE / TIGHTER:.3g} for another run with a "
                "thousandth of it, got {value}",
                "take a larger one, or <resolve=False>",
                value=within,
            )
        return asked

    @property
    def variables(self) -> tuple[Variable, ...]:
        """Flip times, rods, and whether they were verified."""
        rods = "either rod" if self.which is None else f"rod {self.which}"
        variables = [
            Variable(
                "flip_time",
                NAMES,
                "float64",
                math.nan,
                {"units": "s", "long_name": f"time until {rods} first flips"},
            ),
            Variable("flipped_rod", NAMES, "uint8", 0, {"long_name": "rod that flipped, 0: none"}),
            Variable(
                "forbidden", NAMES, "bool", False, {"long_name": "energy too small for a flip"}
            ),
        ]
        if self.resolve:
            meaning = (
                f"a run at tolerance {TIGHTER * self.tolerance:.3g} agrees: flip times to "
                f"{AGREEMENT:g} of them, or angles at t_max to {AGREEMENT:g} rad"
            )
            variables.append(Variable("resolved", NAMES, "bool", False, {"long_name": meaning}))
        return tuple(variables)

    def __call__(
        self, chunk: Chunk, threads: int | None, progress: Progress
    ) -> dict[str, NDArray[np.generic]]:
        """The variables of the map at the cells of a chunk."""
        found = _engine.flips(
            self.system._description(),
            self.t_max,
            self.tolerance,
            self.which or 0,
            self.resolve,
            self.cells.starts(chunk),
            checked_threads(threads),
            progress,
        )
        refuse(found.refused)
        values: dict[str, NDArray[np.generic]] = {
            "flip_time": found.time,
            "flipped_rod": found.rod,
            "forbidden": found.forbidden.astype(bool),
            "resolved": found.resolved.astype(bool),
        }
        if progress is not None:
            progress(1.0)
        return {each.name: self.cells.whole(chunk, values[each.name]) for each in self.variables}


def _checked_rod(which: object) -> int | None:
    if which is None:
        return None
    try:
        return whole_number("which", which, 2)
    except ValueError:
        rule = "must be rod 1 or 2, or left out for the first that flips, got {value}"
        raise ArgumentError("which", rule, value=which) from None
