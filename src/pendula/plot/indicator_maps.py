"""Maps of an indicator of chaos: over two angles of a release, or over an energy's section."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Unpack, overload

import numpy as np

from pendula._checks import number_pair, one_of
from pendula._messages import ArgumentError
from pendula.plot.case import stored_case
from pendula.plot.grid import ANGLES, SECTION, check_dataset, picked
from pendula.plot.labels import labels
from pendula.plot.map_drawing import (
    FORBIDDEN,
    colour_bar,
    drawn,
    hatched,
    key,
    painted,
    palette,
    rgb,
)
from pendula.plot.map_scale import inputs_of, number_ticks, power_ticks, seconds_of
from pendula.plot.style import styled

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

    from pendula._types import Array
    from pendula.plot.labels import Labels
    from pendula.plot.maps import Limits, MapLook

# Of each indicator: whether its colours are logarithmic, and whether small values are light.
INDICATOR_LOOKS = {"megno": (True, False), "lyapunov": (False, False), "sali": (True, True)}
INDICATORS = tuple(INDICATOR_LOOKS)
LEAST = {"megno": 1.0, "sali": 1e-16}  # below, a colour tells nothing more
_FEW = 0.01  # of the values lie beyond either end of the colour scale


@overload
def indicator_map(dataset: xr.Dataset, *, ax: None = None, **look: Unpack[MapLook]) -> Figure: ...


@overload
def indicator_map(dataset: xr.Dataset, *, ax: Axes, **look: Unpack[MapLook]) -> Axes: ...


@styled
def indicator_map(
    dataset: xr.Dataset,
    *,
    ax: Axes | None = None,
    ticks: str = "degrees",
    limits: Limits = None,
    colormap: str = "inferno",
    title: str | None = None,
    language: str = "en",
) -> Figure | Axes:
    """An indicator of chaos, light where it tells chaos.

    MEGNO and SALI have logarithmic colours, exponents linear ones. Where the energy allows no start
    the map is hatched.

    Args:
        dataset: what `pendula.chaos.indicator_map` or `section_map` returned, or its file opened
            again.
        ax: axes to draw into; None: a figure of its own.
        ticks: of the angles: "degrees", or "pi" for parts of π.
        limits: values at the ends of the colour scale; None: those that 1 % lie beyond.
        colormap: a name that matplotlib knows.
        title: above the map; None: the case that is shown.
        language: "en" or "es".

    Returns:
        A figure, which a notebook shows, for `.savefig(path)`; or the axes given.

    Raises:
        ValueError: for a dataset that is no such map, or is not finished, or an unknown option.
    """
    check_dataset(dataset, "chaos.indicator_map")
    words, colours = labels(language), palette(colormap)
    one_of("ticks", ticks, ("degrees", "pi"))
    name = _indicator(dataset)
    grid, cells = _picked(dataset, name)
    values, forbidden = cells[name], cells.get("forbidden", np.zeros(cells[name].shape, bool))
    known = np.isfinite(values) & ~forbidden
    norm = _scale(name, values[known], limits)
    if INDICATOR_LOOKS[name][1]:
        colours = colours.reversed()

    def paint(rows: slice) -> Array:
        colour = np.ones((*values[rows].shape, 3))
        if norm is not None:
            colour[known[rows]] = colours(norm(values[rows][known[rows]]))[:, :3]
        colour[~known[rows]] = rgb(FORBIDDEN)
        return colour

    shown = _case(dataset.attrs, words) if title is None else title
    figure, place = drawn(grid, painted(values.shape, paint), ax, ticks, shown, words)
    hatched(place, grid, ~known)
    there = {"unreachable": forbidden.any(), "unknown": (~known & ~forbidden).any()}
    key(figure, place, [each for each, is_there in there.items() if is_there], "", words)
    if norm is not None:
        bar = colour_bar(figure, place, norm, colours, values[known], words.axis[name])
        power_ticks(bar) if name == "sali" else number_ticks(bar, words)
    return figure if ax is None else ax


def _indicator(dataset: xr.Dataset) -> str:
    """Which one the dataset holds."""
    found = [name for name in INDICATORS if name in dataset]
    if not found:
        raise ArgumentError(
            "dataset",
            "must hold one of {text}",
            "give what pendula.chaos.indicator_map returned",
            text=", ".join(INDICATORS),
        )
    return found[0]


def _picked(dataset: xr.Dataset, name: str) -> tuple[Any, dict[str, Any]]:
    if "p2" not in dataset[name].dims:
        return picked(dataset, (name,), "chaos.indicator_map", ANGLES)
    grid, cells = picked(dataset, (name, "forbidden"), "chaos.section_map", SECTION)
    return grid, {**cells, "forbidden": cells["forbidden"].astype(bool)}


def _scale(name: str, known: Array, limits: Limits) -> Normalize | None:
    """The scale of the colours; None where nothing is known."""
    from matplotlib.colors import LogNorm, Normalize

    logarithmic = INDICATOR_LOOKS[name][0]
    if not known.size:
        return None
    if limits is not None:
        low, high = number_pair("limits", limits, "must be two values, low < high", "")
        if not low < high or (logarithmic and low <= 0.0):
            rule = "must be two values, low < high{text}, got {low} and {high}"
            more = ", above 0 for logarithmic colours" if logarithmic else ""
            raise ArgumentError("limits", rule, text=more, low=low, high=high)
    else:
        low, high = (float(each) for each in np.quantile(known, [_FEW, 1.0 - _FEW]))
        low = max(low, LEAST.get(name, low))
        high = max(high, 2.0 * low) if logarithmic else high if high > low else low + 1.0
    return LogNorm(low, high) if logarithmic else Normalize(low, high)


def _case(attributes: Mapping[Any, Any], words: Labels) -> str | None:
    """System, energy and time of the map."""
    values: dict[str, tuple[float, str]] = {}
    energy, t_max = inputs_of(attributes).get("energy"), seconds_of(attributes)
    if energy is not None:
        values["E"] = float(energy), "J"
    if t_max is not None:
        values["t"] = t_max, "s"
    return stored_case(attributes, words, values)
