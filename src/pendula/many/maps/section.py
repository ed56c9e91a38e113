"""Maps of an indicator of chaos over an energy's Poincaré section: θ1 = 0, ω1 > 0."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from pendula._checks import one_of, positive_number
from pendula._progress import with_bar
from pendula.chaos.indicators import INDICATORS
from pendula.chaos.section_plane import lifted, reach
from pendula.many.chunks import Axis, Variable
from pendula.many.maps.base import Map, checked_map, checked_tolerance
from pendula.many.maps.cells import Cells, checked_cells
from pendula.many.maps.indicator import indicator_variable, values_of

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    from pendula._progress import AskedProgress, Progress
    from pendula._types import Array
    from pendula.many.chunks import Chunk
    from pendula.systems import DoublePendulum

NAMES = ("theta2", "p2")


@with_bar("section map")
def section_map(
    system: DoublePendulum,
    energy: float,
    shape: tuple[int, int],
    t_max: float,
    indicator: str = "megno",
    *,
    theta2: tuple[float, float] | None = None,
    p2: tuple[float, float] | None = None,
    tolerance: float | None = None,
    store: str | Path | None = None,
    client: Any = None,
    threads: int | None = None,
    progress: AskedProgress = None,
    resume: bool = True,
    overwrite: bool = False,
) -> xr.Dataset:
    """An indicator of chaos from each point of an energy's section θ1 = 0, ω1 > 0.

    p2 = C cos θ2 ω1 + B ω2 is the momentum of θ2. Where the energy is too small for a point
    nothing is run, and the indicator is NaN.

    Args:
        system: a double pendulum.
        energy: of all starts [J].
        shape: cells along θ2 and p2.
        t_max: the length of the runs [s].
        indicator: as for `indicator_map`.
        theta2: range of θ2, (lo, hi); None: all that the energy allows [rad].
        p2: range of p2, (lo, hi); None: all that the energy allows [J s].
        tolerance: of the Taylor method; None: machine precision.
        store: as for `flip_map`.
        client: as for `flip_map`.
        threads: as for `flip_map`.
        progress: as for `flip_map`.
        resume: as for `flip_map`.
        overwrite: as for `flip_map`.

    Returns:
        Dims (theta2, p2), coordinates the centres of the cells; a variable by the indicator's name,
        and `forbidden`, where the energy allows no start.

    Raises:
        ValueError: for an argument out of range, or a store of another map.
    """
    asked = SectionMap.checked(
        system, energy, shape, t_max, indicator, theta2=theta2, p2=p2, tolerance=tolerance
    )
    how: dict[str, Any] = {"client": client, "progress": progress, "threads": threads}
    return asked.dataset(store, **how, resume=resume, overwrite=overwrite)


class SectionCells(Cells):
    """A rectangle of the section."""

    def description(self) -> dict[str, Any]:
        """The rectangle as data that JSON can hold."""
        ranges = {name: list(each) for name, each in zip(NAMES, self.ranges, strict=True)}
        return {**ranges, "shape": list(self.shape)}

    @property
    def symmetric(self) -> bool:
        """No: (−θ2, −p2) belongs to ω1 < 0."""
        return False

    def axes(self) -> tuple[Axis, Axis]:
        """The axes of the map."""
        attributes = (
            {"units": "rad", "long_name": "angle of rod 2 on the section"},
            {"units": "J s", "long_name": "momentum of that angle on the section"},
        )
        first, second = (
            replace(each, name=name, attrs=attrs)
            for name, each, attrs in zip(NAMES, super().axes(), attributes, strict=True)
        )
        return first, second

    def points(self, chunk: Chunk) -> Array:
        """(θ2, p2) of the cells of a chunk, row by row, (n, 2)."""
        import numpy as np

        lines = [self.centres(i, *chunk.spans[name]) for i, name in enumerate(NAMES)]
        return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 2)


@dataclass(frozen=True)
class SectionMap(Map):
    """What computes an indicator on a section, from checked arguments."""

    kind = "section"
    title = "Indicator of chaos of the double pendulum on a Poincaré section"

    energy: float
    indicator: str
    tolerance: float

    @classmethod
    def checked(
        cls,
        system: object,
        energy: object,
        shape: object,
        t_max: object,
        indicator: object = "megno",
        *,
        theta2: object = None,
        p2: object = None,
        tolerance: object = None,
    ) -> SectionMap:
        """The map that the arguments of `section_map` ask for.

        Raises:
            ValueError: naming the argument.
        """
        one, _, end = checked_map(system, (-1.0, 1.0), (-1.0, 1.0), (1, 1), t_max)
        value = positive_number("energy", energy, "J")
        given = (theta2, p2)
        first, second = (
            whole if asked is None else asked
            for whole, asked in zip(reach(one, value), given, strict=True)
        )
        checked = checked_cells(first, second, shape, NAMES, ("rad", "J s"))
        cells = SectionCells(checked.ranges, checked.shape)
        within = checked_tolerance(one, end, tolerance)
        return cls(one, cells, end, value, one_of("indicator", indicator, INDICATORS), within)

    @property
    def variables(self) -> tuple[Variable, ...]:
        """The indicator, and where there is none."""
        meaning = {"long_name": "energy too small for a start"}
        forbidden = Variable("forbidden", NAMES, "bool", False, meaning)
        return indicator_variable(self.indicator, NAMES), forbidden

    def __call__(
        self, chunk: Chunk, threads: int | None, progress: Progress
    ) -> dict[str, NDArray[np.generic]]:
        """The variables of the map at the cells of a chunk."""
        import numpy as np

        assert isinstance(self.cells, SectionCells)
        starts = lifted(self.system, self.energy, *self.cells.points(chunk).T)
        allowed = np.isfinite(starts[:, 2])
        values = np.full(len(starts), math.nan)
        if allowed.any():
            values[allowed] = values_of(self, starts[allowed], threads, progress)
        found: dict[str, NDArray[np.generic]] = {self.indicator: values, "forbidden": ~allowed}
        shape = [chunk.spans[name][1] - chunk.spans[name][0] for name in NAMES]
        return {name: each.reshape(shape) for name, each in found.items()}
