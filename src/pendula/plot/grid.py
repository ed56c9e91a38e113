"""Cells of a map: what a picture can show of them, and the axes, in degrees or parts of π."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._attributes import UNFINISHED
from pendula._messages import ArgumentError
from pendula.plot.style import degree_ticks

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from pendula._types import Array
    from pendula.plot.labels import Labels


MOST = 4096  # cells along an axis of a picture: 16 million take 2 GB while they are drawn
_AT_ONCE = 2**23  # cells read at once: 64 MB of times
ANGLES = ("theta1", "theta2")
SECTION = ("theta2", "p2")  # the momentum has no degrees
_PARTS = tuple(Fraction(n, d) for n, d in ((1, 12), (1, 6), (1, 4), (1, 2), (1, 1), (2, 1)))


@dataclass(frozen=True)
class Grid:
    """The cells drawn: centres and outer edges, angles in degrees, by the names of the axes."""

    x: Array
    y: Array
    extent: tuple[float, float, float, float]
    dims: tuple[str, str] = ANGLES

    @property
    def width(self) -> float:
        """In the unit of the axis."""
        return self.extent[1] - self.extent[0]

    @property
    def height(self) -> float:
        """In the unit of the axis."""
        return self.extent[3] - self.extent[2]

    @property
    def alike(self) -> bool:
        """Whether both axes have one unit."""
        return self.dims == ANGLES

    def padded(self) -> tuple[Array, Array]:
        """Centres with the outer edges at both ends."""
        left, right, low, high = self.extent
        return np.r_[left, self.x, right], np.r_[low, self.y, high]


def check_dataset(given: object, caller: str) -> None:
    """Refuse what is no dataset at all.

    Raises:
        ValueError: with what there is for it.
    """
    if isinstance(given, Mapping) and hasattr(given, "attrs"):
        return
    way_out = "draw a run with its own plot()"
    if isinstance(given, str | PathLike):
        way_out = "open the file first, with xarray.open_dataset or xarray.open_zarr"
    elif not hasattr(given, "plot"):
        way_out = f"give what pendula.{caller} returned"
    rule = f"must be a dataset of pendula.{caller}, got {{value}}"
    raise ArgumentError("dataset", rule, way_out, value=given)


def picked(
    dataset: xr.Dataset, names: Sequence[str], caller: str, dims: tuple[str, str] = ANGLES
) -> tuple[Grid, dict[str, NDArray[Any]]]:
    """The cells to draw, (n2, n1) of each variable: every k-th, where there are too many.

    Raises:
        ValueError: for a dataset without these variables over both dims, or one whose cells are not
            all computed.
    """
    if UNFINISHED in dataset.attrs:
        rule = "must be finished, but some of its chunks are not computed yet"
        raise ArgumentError("dataset", rule, "run <call=the call that made the store again>")
    for name in names:
        found = dataset[name].dims if name in dataset else None
        if found is None or set(found) != set(dims):
            has = "has none" if found is None else f"has ({', '.join(map(str, found))})"
            raise ArgumentError(
                "dataset",
                f"must hold {{text}} over {' and '.join(dims)}, but {{place}}",
                f"give what pendula.{caller} returned",
                text=name,
                place=has,
            )
    centres = [np.asarray(dataset[dim].values, dtype=np.float64) for dim in dims]
    for dim, values in zip(dims, centres, strict=True):
        if values.size == 0 or not (np.diff(values) > 0).all():
            rule = "must have rising cell centres, got {text}"
            raise ArgumentError("dataset", rule, text=f"{dim} = {values[:4]}")
    strides = [-(-values.size // MOST) for values in centres]
    places = {dim: slice(k // 2, None, k) for dim, k in zip(dims, strides, strict=True)}
    shown = [_shown(dim, v) for dim, v in zip(dims, centres, strict=True)]
    x, y = (v[places[dim]] for dim, v in zip(dims, shown, strict=True))
    grid = Grid(x, y, (*_edges(shown[0]), *_edges(shown[1])), dims)
    return grid, {name: _thinned(dataset[name], places) for name in names}


def _shown(dim: str, values: Array) -> Array:
    """Values in the unit of their axis: angles in degrees."""
    return np.degrees(values) if dim.startswith("theta") else values


def _thinned(array: xr.DataArray, places: dict[str, slice]) -> NDArray[Any]:
    """The cells (n2, n1) at these places, band by band: a file may hold more than the memory."""
    first, second = places
    rows = np.arange(array.sizes[first])[places[first]]
    chunk = array.encoding.get("preferred_chunks", {}).get(first, 0)
    band = chunk if 0 < chunk * array.sizes[second] <= _AT_ONCE else 0
    band = band or max(1, _AT_ONCE // array.sizes[second])
    parts = []
    for start in range(0, array.sizes[first], band):
        inside = rows[(rows >= start) & (rows < start + band)]
        if inside.size:
            part = slice(int(inside[0]), int(inside[-1]) + 1, places[first].step)
            picked = array.isel({first: part, second: places[second]})
            parts.append(picked.transpose(second, first).values)
    return np.concatenate(parts, axis=1)


def _edges(centres: Array) -> tuple[float, float]:
    """Outer edges of the first and the last cell, in the unit of the axis."""
    half = float(centres[-1] - centres[0]) / (2 * (centres.size - 1)) if centres.size > 1 else 0.5
    return float(centres[0] - half), float(centres[-1] + half)


def angle_axes(ax: Axes, grid: Grid, ticks: str, words: Labels) -> None:
    """Label both axes, angles with ticks in degrees or in parts of π."""
    left, right, low, high = grid.extent
    for name, dim, ends in zip("xy", grid.dims, ((left, right), (low, high)), strict=True):
        if not dim.startswith("theta"):
            getattr(ax, f"set_{name}label")(words.axis[f"momentum_{dim[-1]}"])
            continue
        kind = "angle" if ticks == "degrees" else "angle_rad"
        getattr(ax, f"set_{name}label")(words.axis[f"{kind}_{dim[-1]}"])
        if ticks == "degrees":
            degree_ticks(ax, name, *ends)
            _few_if_long(getattr(ax, f"{name}axis"), *ends)
        else:
            _pi_ticks(getattr(ax, f"{name}axis"), *ends, words=words)


def _few_if_long(axis: Any, low: float, high: float) -> None:
    """Long numbers of a map far zoomed in need room."""
    from matplotlib.ticker import MaxNLocator

    if high - low < 1e-2 * max(abs(low), abs(high)):
        axis.set_major_locator(MaxNLocator(3))


def _pi_ticks(axis: Any, low: float, high: float, *, words: Labels) -> None:
    """Ticks at parts of π, or at decimals of it where the range is small."""
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    span = Fraction(high - low) / 180
    step = next((part for part in _PARTS if span / part <= 8), None)
    if step is None or span / step < 2:
        first, last = low / 180, high / 180
        few = last - first < 1e-2 * max(abs(first), abs(last))
        decimals = MaxNLocator(3 if few else 6).tick_values(first, last)
        inside = [each for each in decimals if first <= each <= last]
        axis.set_ticks([180 * each for each in inside])
        names = {180 * each: words.local(f"{each:.12g}π") for each in inside}
        axis.set_major_formatter(FuncFormatter(lambda x, _: names.get(x, "")))
        return
    near = 1e-9 * span
    numbers = range(
        math.ceil(Fraction(low) / 180 / step - near / step),
        math.floor(Fraction(high) / 180 / step + near / step) + 1,
    )
    axis.set_ticks([float(180 * step * n) for n in numbers], [_part(step * n) for n in numbers])


def _part(part: Fraction) -> str:
    """A multiple of π."""
    if part == 0:
        return "0"
    sign, top = "−" if part < 0 else "", abs(part.numerator)
    return (
        f"{sign}{'' if top == 1 else top}π{'' if part.denominator == 1 else f'/{part.denominator}'}"
    )
