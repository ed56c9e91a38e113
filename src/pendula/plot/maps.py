"""Maps over the two angles a double pendulum is released from: flip times, divergence."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Unpack, overload

import numpy as np

from pendula._checks import number_pair, one_of
from pendula._messages import ArgumentError
from pendula.plot.grid import check_dataset, picked
from pendula.plot.indicator_maps import INDICATORS, indicator_map
from pendula.plot.labels import labels
from pendula.plot.map_drawing import (
    FORBIDDEN,
    NEVER,
    colour_bar,
    drawn,
    hatched,
    key,
    painted,
    palette,
    rgb,
)
from pendula.plot.map_scale import growth_time, number_ticks, time_scale
from pendula.plot.style import styled

if TYPE_CHECKING:
    from typing import TypedDict

    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

    from pendula._types import Array

    Limits = tuple[float, float] | None

    class MapLook(TypedDict, total=False):
        """How any map is drawn; see `flip_map`."""

        ticks: str
        limits: Limits
        colormap: str
        title: str | None
        language: str

    class FlipLook(MapLook, total=False):
        """How a flip map is drawn; see `flip_map`."""

        time_unit: str
        unresolved: str


_PALE = 0.55  # of the way to white: what is not certain
_FEW = 0.03  # of the times are so short that they are one colour, to leave more to the others
_FEWER = 0.01  # the same of rates


@overload
def flip_map(dataset: xr.Dataset, *, ax: None = None, **look: Unpack[FlipLook]) -> Figure: ...


@overload
def flip_map(dataset: xr.Dataset, *, ax: Axes, **look: Unpack[FlipLook]) -> Axes: ...


@styled
def flip_map(
    dataset: xr.Dataset,
    *,
    ax: Axes | None = None,
    time_unit: str = "s",
    ticks: str = "degrees",
    unresolved: str = "pale",
    limits: Limits = None,
    colormap: str = "inferno",
    title: str | None = None,
    language: str = "en",
) -> Figure | Axes:
    """Time until the first flip, for each pair of angles of a release.

    The colours are logarithmic in time. Cells without a flip have a colour of their own, and where
    the energy forbids one the map is hatched. Each cell is drawn: a picture has at least a pixel
    for it. Of more than 4096 cells along an angle every k-th is drawn, so that each colour is that
    of a cell; of a map opened from a file, no more than a band is in memory at a time.

    Args:
        dataset: what `pendula.flip_map` returned, or its file opened again.
        ax: axes to draw into; None: a figure of its own.
        time_unit: "s", or "natural" for units of √(l₁/g).
        ticks: of the angles: "degrees", or "pi" for parts of π.
        unresolved: "pale": cells that the dataset marks as unresolved are paler;
            "shown": they are not.
        limits: times at the ends of the colour scale [s], to compare maps; None: the longest, and
            the one that 3 % are shorter than.
        colormap: a name that matplotlib knows.
        title: above the map; None: none.
        language: "en" or "es".

    Returns:
        A figure, which a notebook shows, for `.savefig(path)`; or the axes given.

    Raises:
        ValueError: for a dataset that is no flip map, or is not finished, or an unknown option.
    """
    check_dataset(dataset, "flip_map")
    words, colours = labels(language), palette(colormap)
    one_of("ticks", ticks, ("degrees", "pi"))
    paled = one_of("unresolved", unresolved, ("pale", "shown")) == "pale" and "resolved" in dataset
    names = ("flip_time", "forbidden", *(("resolved",) if paled else ()))
    grid, cells = picked(dataset, names, "flip_map")
    scale = time_scale(dataset.attrs, time_unit)
    times, forbidden = cells["flip_time"] / scale.unit, cells["forbidden"].astype(bool)
    norm = _logarithmic(times, limits, scale.unit)
    never = np.isnan(times) & ~forbidden
    pale = ~forbidden & ~cells["resolved"].astype(bool) if paled else np.zeros_like(forbidden)

    def paint(rows: slice) -> Array:
        colour = _coloured(times[rows], times[rows] > 0, norm, colours)
        colour[never[rows]] = rgb(NEVER)
        colour[pale[rows]] += _PALE * (1.0 - colour[pale[rows]])
        colour[forbidden[rows]] = rgb(FORBIDDEN)
        return colour

    figure, place = drawn(grid, painted(times.shape, paint), ax, ticks, title, words)
    hatched(place, grid, forbidden)
    shown = {"forbidden": forbidden.any(), "never": never.any(), "unresolved": pale.any()}
    key(figure, place, [name for name, there in shown.items() if there], scale.end(words), words)
    if norm is not None:
        bar = colour_bar(figure, place, norm, colours, times[times > 0], scale.label(words))
        number_ticks(bar, words)
    return figure if ax is None else ax


@overload
def divergence_map(dataset: xr.Dataset, *, ax: None = None, **look: Unpack[MapLook]) -> Figure: ...


@overload
def divergence_map(dataset: xr.Dataset, *, ax: Axes, **look: Unpack[MapLook]) -> Axes: ...


@styled
def divergence_map(
    dataset: xr.Dataset,
    *,
    ax: Axes | None = None,
    ticks: str = "degrees",
    limits: Limits = None,
    colormap: str = "inferno",
    title: str | None = None,
    language: str = "en",
) -> Figure | Axes:
    """How fast neighbours part within a given time, for each pair of angles of a release.

    The colours are ln(growth) / t_max, the mean rate at which the logarithm of their distance grew.

    Args:
        dataset: what `pendula.divergence_map` returned, or its file opened again.
        ax: axes to draw into; None: a figure of its own.
        ticks: of the angles: "degrees", or "pi" for parts of π.
        limits: rates at the ends of the colour scale [1/s]; None: the largest, and the one that
            1 % are lower than.
        colormap: a name that matplotlib knows.
        title: above the map; None: none.
        language: "en" or "es".

    Returns:
        A figure, which a notebook shows, for `.savefig(path)`; or the axes given.

    Raises:
        ValueError: for a dataset that is no such map, or is not finished, or an unknown option.
    """
    from matplotlib.colors import Normalize

    check_dataset(dataset, "divergence_map")
    words, colours = labels(language), palette(colormap)
    one_of("ticks", ticks, ("degrees", "pi"))
    grid, cells = picked(dataset, ("growth",), "divergence_map")
    with np.errstate(divide="ignore"):
        rates = np.log(cells["growth"]) / growth_time(dataset.attrs)
    known, norm = np.isfinite(rates), None
    if known.any():
        ends = _ends(limits, "two rates [1/s]", "1/s")
        low, high = ends or (_above(rates[known], _FEWER), float(rates[known].max()))
        norm = Normalize(low, high if high > low else low + 1.0)

    def paint(rows: slice) -> Array:
        colour = _coloured(rates[rows], known[rows], norm, colours)
        colour[~known[rows]] = rgb(FORBIDDEN)
        return colour

    figure, place = drawn(grid, painted(rates.shape, paint), ax, ticks, title, words)
    if not known.all():
        hatched(place, grid, ~known)
        key(figure, place, ["unknown"], "", words)
    if norm is not None:
        bar = colour_bar(figure, place, norm, colours, rates[known], words.axis["divergence"])
        number_ticks(bar, words)
    return figure if ax is None else ax


_DRAWERS: dict[str, Any] = {
    "flip_time": flip_map,
    "growth": divergence_map,
    **dict.fromkeys(INDICATORS, indicator_map),
}


def stored_map(dataset: xr.Dataset, **look: Any) -> Any:
    """The picture of a map of any kind; `look`: what its own function takes, as `flip_map` does.

    Raises:
        ValueError: for a dataset that is no map, or is not finished, or an unknown option.
    """
    for variable, draw in _DRAWERS.items():
        if variable in dataset:
            return draw(dataset, **look)
    raise ArgumentError(
        "dataset",
        f"must hold {', '.join(list(_DRAWERS)[:-1])} or {list(_DRAWERS)[-1]}, got {{text}}",
        "give what pendula.flip_map or another map returned",
        text=", ".join(map(str, dataset.data_vars)) or "no variables",
    )


def _ends(limits: Limits, what: str, unit: str) -> Limits:
    """The ends of the colour scale, as numbers in that unit; None: the map's own."""
    return None if limits is None else number_pair("limits", limits, f"must be {what}", unit)


def _logarithmic(times: Array, limits: Limits, unit: float) -> Normalize | None:
    """The scale of times in units of `unit` seconds; None where there is no flip."""
    from matplotlib.colors import LogNorm

    ends, flips = _ends(limits, "two times, 0 < low <= high [s]", "s"), times[times > 0]
    if not flips.size:
        return None
    if ends:
        low, high = ends[0] / unit, ends[1] / unit
    else:
        low, high = _above(flips, _FEW), float(flips.max())
    if not 0 < low <= high:
        rule = "must be two times, 0 < low <= high, got {low} and {high}"
        raise ArgumentError("limits", rule, low=low, high=high)
    return LogNorm(low, high if high > low else 1.01 * low)


def _coloured(values: Array, known: Any, norm: Normalize | None, colours: Any) -> Array:
    """Colours (…, 3) of the values that are known, white elsewhere."""
    colour = np.ones((*values.shape, 3))
    if norm is not None:
        colour[known] = colours(norm(values[known]))[:, :3]
    return colour


def _above(values: Array, few: float) -> float:
    """The value that this part of them lies below."""
    place = int(few * values.size)
    return float(np.partition(values, place)[place])
