"""The cells of a map: starts from rest at the two angles, and their symmetry."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._checks import number_pair, whole_number
from pendula._messages import ArgumentError
from pendula.many.chunks import Axis

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pendula._types import Array
    from pendula.many.chunks import Chunk


NAMES = ("theta1", "theta2")
MOST_CELLS, MOST_OF_ALL = 10**6, 10**10  # along an angle, and in all: days of work
LARGEST_CHUNK = 256  # cells along an angle: 65536 trajectories, about a second of one processor


@dataclass(frozen=True)
class Cells:
    """A rectangle of starts from rest.

    Attributes:
        ranges: of the two angles, ((lo, hi), (lo, hi)) [rad].
        shape: cells along each.
    """

    ranges: tuple[tuple[float, float], tuple[float, float]]
    shape: tuple[int, int]

    def description(self) -> dict[str, Any]:
        """The rectangle as data that JSON can hold."""
        ranges = {name: list(each) for name, each in zip(NAMES, self.ranges, strict=True)}
        return {**ranges, "shape": list(self.shape)}

    @property
    def symmetric(self) -> bool:
        """Whether each cell's mirror image, both angles negated, is a cell, too."""
        return all(lo == -hi for lo, hi in self.ranges)

    def centres(self, axis: int, start: int, stop: int) -> Array:
        """Angles at the centres of some cells, exactly antisymmetric where the range is."""
        import numpy as np

        (lo, hi), count = self.ranges[axis], self.shape[axis]
        places = (2.0 * np.arange(start, stop, dtype=np.float64) + 1.0 - count) / (2.0 * count)
        return np.add(0.5 * (lo + hi), (hi - lo) * places)

    def axes(self) -> tuple[Axis, Axis]:
        """The axes of the map, cut into chunks of about a second's work."""
        first, second = (
            Axis(
                name,
                count,
                chunk=_chunk(count, whole=self.symmetric),
                values=self.centres(i, 0, count),
                attrs={"units": "rad", "long_name": f"angle of rod {i + 1} at the start"},
            )
            for i, (name, count) in enumerate(zip(NAMES, self.shape, strict=True))
        )
        return first, second

    @property
    def mirrored(self) -> bool:
        """Whether whole chunks are mirror images of one another."""
        return self.symmetric and all(
            count % _chunk(count, whole=True) == 0 for count in self.shape
        )

    def starts(self, chunk: Chunk) -> Array:
        """States (n, 4) of the cells of a chunk, row by row, and only those that are not mirrored.

        Of a cell and its mirror image one is run, the same one in any map; both have its numbers.
        """
        import numpy as np

        angles = [self.centres(i, *chunk.spans[name]) for i, name in enumerate(NAMES)]
        first, second = (each.ravel() for each in np.meshgrid(*angles, indexing="ij"))
        count = (first.size + 1) // 2 if self._is_its_own_image(chunk) else first.size
        states = np.zeros((count, 4))
        image = ((first < 0.0) | ((first == 0.0) & (second < 0.0)))[:count]
        states[:, 0] = np.where(image, -first[:count], first[:count])
        states[:, 1] = np.where(image, -second[:count], second[:count])
        return states

    def whole(self, chunk: Chunk, values: NDArray[np.generic]) -> NDArray[np.generic]:
        """The values of all cells of a chunk, from those of `starts`."""
        import numpy as np

        rows, columns = (stop - start for start, stop in (chunk.spans[name] for name in NAMES))
        if self._is_its_own_image(chunk):
            values = np.concatenate([values, values[: rows * columns - len(values)][::-1]])
        return values.reshape(rows, columns)

    def _is_its_own_image(self, chunk: Chunk) -> bool:
        return self.symmetric and all(
            sum(chunk.spans[name]) == count for name, count in zip(NAMES, self.shape, strict=True)
        )


def checked_cells(
    first: object,
    second: object,
    shape: object,
    names: tuple[str, str] = NAMES,
    units: tuple[str, str] = ("rad", "rad"),
) -> Cells:
    """The rectangle that the arguments of a map, by their names, ask for.

    Raises:
        ValueError: naming the argument.
    """
    try:
        counts: tuple[Any, ...] = tuple(shape)  # type: ignore[arg-type]
    except TypeError:
        counts = (shape,)
    if len(counts) != 2:
        rule = "must be two numbers of cells, such as (500, 500), got {value}"
        raise ArgumentError("shape", rule, value=shape)
    n1, n2 = (whole_number("shape", count, MOST_CELLS) for count in counts)
    if n1 * n2 > MOST_OF_ALL:
        raise ArgumentError(
            "shape",
            "must be at most 10^10 cells in all, got {text}",
            "take a smaller rectangle",
            text=f"{n1} x {n2}",
        )
    ranges = (
        _checked_range(names[0], first, n1, units[0]),
        _checked_range(names[1], second, n2, units[1]),
    )
    return Cells(ranges, (n1, n2))


def _checked_range(name: str, given: object, count: int, unit: str) -> tuple[float, float]:
    """A range within that of the sine, whose cells' centres are different doubles."""
    lo, hi = number_pair(name, given, f"must be a range (lo, hi) [{unit}]", unit)
    if not lo < hi:
        rule = f"must be a range (lo, hi) with lo < hi [{unit}], got {{value}}"
        raise ArgumentError(name, rule, value=(lo, hi))
    largest = max(abs(lo), abs(hi))
    if unit == "rad" and largest > _engine.LARGEST_ANGLE:
        rule = "must lie within ±2^26 rad, got {value}"
        raise ArgumentError(name, rule, "take whole turns off", value=(lo, hi))
    if hi - lo < 2 * count * math.ulp(largest):
        rule = "must be a range whose {count} cells are different doubles, got {value}"
        way_out = "take a wider one, or fewer cells"
        raise ArgumentError(name, rule, way_out, count=count, value=(lo, hi))
    return lo, hi


def _chunk(count: int, *, whole: bool) -> int:
    """Cells of a chunk along an angle: all of the same size where images are to fit."""
    pieces = -(-count // LARGEST_CHUNK)
    if whole:
        fitting = (n for n in range(pieces, min(4 * pieces, count) + 1) if count % n == 0)
        pieces = next(fitting, pieces)
    return -(-count // pieces)
