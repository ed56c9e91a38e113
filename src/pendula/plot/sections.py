"""Poincaré sections of many motions, in the colours of an indicator."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np

from pendula._checks import number_pair
from pendula._late_methods import method_of
from pendula._messages import ArgumentError
from pendula.chaos.sections import Section
from pendula.plot.case import case_of
from pendula.plot.given import curve
from pendula.plot.indicator_maps import INDICATOR_LOOKS, LEAST
from pendula.plot.labels import labels
from pendula.plot.map_drawing import palette
from pendula.plot.map_scale import number_ticks, power_ticks
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
        found: what `pendula.chaos.section` returned, with an indicator or without.
        indicator: values of the indicator that it was asked for, or of the mean MEGNO, in place of
            its own, one of each motion, (n,): its points have its colour, light where it tells
            chaos. None: its own; where it has none, all are black.
        ax: axes to draw into; None: a figure of its own.
        limits: of the indicator, at the ends of the scale; None: of MEGNO 2, which is regular, and
            the largest, or at least 20; of an exponent 0 and the largest; of SALI the smallest, or
            1e-16, and the largest.
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
    given = found.values if indicator is None else indicator
    if given is None:
        place.scatter(x.ravel(), y.ravel(), color=INK, **how)
    else:
        name = str(found.recipe.get("indicator", "megno"))
        values = curve("indicator", given, "", points[:, 0, 0])
        look = _Look(name, _ends(name, limits, values), colormap)
        _coloured(figure, place, (x, y), values, look, how, words)
    _axes(place, found, x, words)
    place.set_title(_case(found, words) if title is None else title)
    return figure if ax is None else ax


class _Look(NamedTuple):
    """The colours of an indicator: its name, the ends of its scale, the colormap."""

    name: str
    ends: tuple[float, float]
    colormap: str

    @property
    def small_is_light(self) -> bool:
        return INDICATOR_LOOKS[self.name][1]


def _ends(name: str, limits: Limits, values: Array) -> tuple[float, float]:
    """Values at the ends of the scale."""
    most = float(np.nanmax(values))
    if limits is None:
        if name == "megno":
            return 2.0, max(20.0, most)
        low = 0.0 if name == "lyapunov" else max(LEAST["sali"], float(np.nanmin(values)))
        return low, most if most > low else 2.0 * low or 1.0
    least = ", 0 < low < high" if INDICATOR_LOOKS[name][0] else ", low < high"
    low, high = number_pair("limits", limits, f"must be two values{least}", "")
    if not low < high or (least.startswith(", 0") and low <= 0.0):
        rule = "must be two values{text}, got {low} and {high}"
        raise ArgumentError("limits", rule, text=least, low=low, high=high)
    return low, high


def _coloured(
    figure: Any,
    ax: Axes,
    points: tuple[Array, Array],
    values: Array,
    look: _Look,
    how: dict[str, Any],
    words: Labels,
) -> None:
    """The points, chaotic motions below the regular ones, with the scale beside them."""
    from matplotlib.colors import ListedColormap, LogNorm, Normalize

    order = np.argsort(values if look.small_is_light else -values, kind="stable")
    x, y = (each[order].ravel() for each in points)
    every = np.repeat(values[order], points[0].shape[1])
    shades = palette(look.colormap)(np.linspace(0.0, _DARK, 256))
    inks = ListedColormap(shades[::-1] if look.small_is_light else shades)
    low, high = look.ends
    norm = (LogNorm if INDICATOR_LOOKS[look.name][0] else Normalize)(low, high)
    drawn = ax.scatter(x, y, c=every, cmap=inks, norm=norm, **how)
    beyond = bool((values < low).any()), bool((values > high).any())
    extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[beyond]
    bar = figure.colorbar(drawn, ax=ax, extend=extend, pad=0.02, fraction=0.05)
    bar.set_label(words.axis[look.name])
    bar.outline.set_linewidth(0.6)
    power_ticks(bar) if look.name == "sali" else number_ticks(bar, words)


def _axes(ax: Axes, found: Section, x: Array, words: Labels) -> None:
    double = found.states.shape[-1] == 4
    scaled = found.system.form == "scaled"
    ax.set_xlabel(words.axis["angle_2" if double else "angle"])
    ax.set_ylabel(words.axis["momentum_2" if double else "rate_scaled" if scaled else "rate"])
    degree_ticks(ax, "x", float(np.nanmin(x)), float(np.nanmax(x)))


def _case(found: Section, words: Labels) -> str:
    energy, t_max = found.recipe.get("energy"), found.recipe.get("t_max")
    values = {} if energy is None else {"E": (float(energy), "J")}
    if t_max is not None:  # of the indicator's runs
        values["t"] = (float(t_max), "s")
    return case_of(found.system, words, values)
