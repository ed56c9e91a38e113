"""Poincaré sections of many motions, in the colours of an indicator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, overload

import numpy as np

from pendula._checks import number_pair
from pendula._late_methods import method_of
from pendula._messages import ArgumentError
from pendula.chaos.sections import Section
from pendula.plot.case import case_of
from pendula.plot.given import curve
from pendula.plot.labels import labels
from pendula.plot.map_drawing import palette
from pendula.plot.map_scale import number_ticks
from pendula.plot.style import INK, degree_ticks, given_or_new, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from pendula._types import Array
    from pendula.plot.labels import Labels
    from pendula.plot.maps import Limits

_MANY = 40_000  # points: beyond, they get smaller, down to a pixel
_DARK = 0.88  # of a colormap: its light end is not seen on paper
_SIZES = 0.25, 2.2  # points² of a mark


@method_of(Section)
def plot(found: Section, *, ax: Any = None, language: str = "en") -> Any:
    """The crossings of all motions (extra: report); see `pendula.plot.section`."""
    return section(found, ax=ax, language=language)


@overload
def section(
    found: Section,
    indicator: ArrayLike | None = None,
    *,
    ax: None = None,
    limits: Limits = None,
    colormap: str = "viridis",
    title: str | None = None,
    language: str = "en",
) -> Figure: ...


@overload
def section(
    found: Section,
    indicator: ArrayLike | None = None,
    *,
    ax: Axes,
    limits: Limits = None,
    colormap: str = "viridis",
    title: str | None = None,
    language: str = "en",
) -> Axes: ...


@styled
def section(
    found: Section,
    indicator: ArrayLike | None = None,
    *,
    ax: Axes | None = None,
    limits: Limits = None,
    colormap: str = "viridis",
    title: str | None = None,
    language: str = "en",
) -> Figure | Axes:
    """Where motions cross a surface: (θ2, p2) of a double pendulum, (θ, ω) of a driven one.

    Args:
        found: what `pendula.chaos.section` returned.
        indicator: a mean MEGNO of each motion, such as `megno(system, found.starts,
            [400.0]).mean[:, -1]`, (n,): its points have its colour, on a logarithmic scale. None:
            all are black.
        ax: axes to draw into; None: a figure of its own.
        limits: of the indicator, at the ends of the scale; None: 2, which is regular, and the
            largest, or at least 20.
        colormap: a name that matplotlib knows.
        title: above it; None: the case that is shown.
        language: "en" or "es".

    Returns:
        A figure, which a notebook shows, for `.savefig(path)`; or the axes given.

    Raises:
        ValueError: for another result, or an indicator of another shape.
    """
    words = labels(language)
    if not isinstance(found, Section):
        rule = "must be what pendula.chaos.section returned, got {value}"
        raise ArgumentError("found", rule, value=found)
    figure, place = given_or_new(ax, 5.3, words)
    points = found.points
    x, y = np.degrees(points[..., 0]), points[..., 1]
    low, high = _SIZES
    size = max(low, high * min(1.0, _MANY / max(1, x.size)))
    how: dict[str, Any] = {"s": size, "linewidths": 0, "rasterized": True}
    if indicator is None:
        place.scatter(x.ravel(), y.ravel(), color=INK, **how)
    else:
        values = curve("indicator", indicator, "", points[:, 0, 0])
        _coloured(figure, place, (x, y), values, _ends(limits, values), colormap, how, words)
    _axes(place, found, x, words)
    place.set_title(_case(found, words) if title is None else title)
    return figure if ax is None else ax


def _ends(limits: Limits, values: Array) -> tuple[float, float]:
    if limits is None:
        return 2.0, max(20.0, float(np.nanmax(values)))
    low, high = number_pair("limits", limits, "must be two values, 0 < low < high", "")
    if not 0.0 < low < high:
        rule = "must be two values, 0 < low < high, got {low} and {high}"
        raise ArgumentError("limits", rule, low=low, high=high)
    return low, high


def _coloured(
    figure: Any,
    ax: Axes,
    points: tuple[Array, Array],
    values: Array,
    ends: tuple[float, float],
    colormap: str,
    how: dict[str, Any],
    words: Labels,
) -> None:
    """The points, chaotic motions below the regular ones, with the scale beside them."""
    from matplotlib.colors import ListedColormap, LogNorm

    order = np.argsort(-values, kind="stable")
    x, y = (each[order].ravel() for each in points)
    every = np.repeat(values[order], points[0].shape[1])
    inks = ListedColormap(palette(colormap)(np.linspace(0.0, _DARK, 256)))
    drawn = ax.scatter(x, y, c=every, cmap=inks, norm=LogNorm(*ends), **how)
    extend = "min" if (values < ends[0]).any() else "neither"
    bar = figure.colorbar(drawn, ax=ax, extend=extend, pad=0.02, fraction=0.05)
    bar.set_label(words.axis["megno"])
    bar.outline.set_linewidth(0.6)
    number_ticks(bar, words)


def _axes(ax: Axes, found: Section, x: Array, words: Labels) -> None:
    double = found.states.shape[-1] == 4
    scaled = found.system.form == "scaled"
    ax.set_xlabel(words.axis["angle_2" if double else "angle"])
    ax.set_ylabel(words.axis["momentum_2" if double else "rate_scaled" if scaled else "rate"])
    degree_ticks(ax, "x", float(np.nanmin(x)), float(np.nanmax(x)))


def _case(found: Section, words: Labels) -> str:
    energy = found.recipe.get("energy")
    values = {} if energy is None else {"E": (float(energy), "J")}
    return case_of(found.system, words, values)
