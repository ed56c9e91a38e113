"""Maps over the two angles a double pendulum is released from: flip times, divergence."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._checks import number_pair, one_of
from pendula._messages import ArgumentError
from pendula.plot.grid import Grid, angle_axes, check_dataset, picked
from pendula.plot.labels import Labels, labels
from pendula.plot.map_scale import growth_time, number_ticks, time_scale
from pendula.plot.style import panels, styled

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from pendula._types import Array

    Limits = tuple[float, float] | None

_NEVER = "#8fb8d8"
_FORBIDDEN, _HATCH = "#f7f8f9", "#c6ccd3"
_EDGE = "#6b737c"
_PALE = 0.55  # of the way to white: what is not certain
_FEW = 0.03  # of the times are so short that they are one colour, to leave more to the others
_FEWER = 0.01  # the same of rates
_LONGEST = 5.0  # sides of a map that is drawn with equal units
_HEIGHT, _LOWEST, _HIGHEST = 4.6, 2.6, 6.4  # inches


@styled
def flip_map(
    dataset: xr.Dataset,
    *,
    time_unit: str = "s",
    ticks: str = "degrees",
    unresolved: str = "pale",
    limits: Limits = None,
    language: str = "en",
) -> Figure:
    """Time until the first flip, for each pair of angles of a release.

    The colours are logarithmic in time. Cells without a flip have a colour of their own, and where
    the energy forbids one the map is hatched. Of a map with more cells than a picture can show,
    every k-th row and column is drawn, so that each colour is that of a cell; of one opened from
    a file, no more than a band is in memory at a time.

    Args:
        dataset: what `pendula.flip_map` returned, or its file opened again.
        time_unit: "s", or "natural" for units of √(l₁/g).
        ticks: of the angles: "degrees", or "pi" for parts of π.
        unresolved: "pale": cells that the dataset marks as unresolved are paler;
            "shown": they are not.
        limits: times at the ends of the colour scale [s], to compare maps; None: the longest, and
            the one that 3 % are shorter than.
        language: "en" or "es".

    Returns:
        A figure for a notebook to show, or for `.savefig(path)`.

    Raises:
        ValueError: for a dataset that is no flip map, or an unknown option.
    """
    check_dataset(dataset, "flip_map")
    words = labels(language)
    one_of("ticks", ticks, ("degrees", "pi"))
    one_of("unresolved", unresolved, ("pale", "shown"))
    paled = unresolved == "pale" and "resolved" in dataset
    names = ("flip_time", "forbidden", *(("resolved",) if paled else ()))
    grid, cells = picked(dataset, names, "flip_map")
    scale = time_scale(dataset.attrs, time_unit)
    times, forbidden = cells["flip_time"] / scale.unit, cells["forbidden"].astype(bool)
    never = np.isnan(times) & ~forbidden
    ends = _ends(limits, "two times, 0 < low <= high [s]", "s")
    colours, norm = _logarithmic(times, ends and (ends[0] / scale.unit, ends[1] / scale.unit))
    colours[never] = _rgb(_NEVER)
    pale = ~forbidden & ~cells["resolved"].astype(bool) if paled else np.zeros_like(forbidden)
    colours[pale] += _PALE * (1.0 - colours[pale])
    colours[forbidden] = _rgb(_FORBIDDEN)
    figure, ax = _drawn(grid, colours, ticks, words)
    _hatched(ax, grid, forbidden)
    shown = {"forbidden": forbidden.any(), "never": never.any(), "unresolved": pale.any()}
    _key(figure, [name for name, there in shown.items() if there], scale.end(words), words)
    if norm is not None:
        number_ticks(_colour_bar(figure, ax, norm, times, scale.label(words)), words)
    return figure


@styled
def divergence_map(
    dataset: xr.Dataset,
    *,
    ticks: str = "degrees",
    limits: Limits = None,
    language: str = "en",
) -> Figure:
    """How fast neighbours part within a given time, for each pair of angles of a release.

    The colours are ln(growth) / t_max, the mean rate at which the logarithm of their distance grew.

    Args:
        dataset: what `pendula.divergence_map` returned, or its file opened again.
        ticks: of the angles: "degrees", or "pi" for parts of π.
        limits: rates at the ends of the colour scale [1/s]; None: the largest, and the one that
            1 % are lower than.
        language: "en" or "es".

    Returns:
        A figure for a notebook to show, or for `.savefig(path)`.

    Raises:
        ValueError: for a dataset that is no such map, or an unknown option.
    """
    from matplotlib.colors import Normalize

    check_dataset(dataset, "divergence_map")
    words = labels(language)
    one_of("ticks", ticks, ("degrees", "pi"))
    grid, cells = picked(dataset, ("growth",), "divergence_map")
    with np.errstate(divide="ignore"):
        rates = np.log(cells["growth"]) / growth_time(dataset.attrs)
    known = np.isfinite(rates)
    colours, norm = np.ones((*rates.shape, 3)), None
    if known.any():
        ends = _ends(limits, "two rates [1/s]", "1/s")
        low, high = ends or (_above(rates[known], _FEWER), float(rates[known].max()))
        norm = Normalize(low, high if high > low else low + 1.0)
        colours[known] = _palette()(norm(rates[known]))[:, :3]
    colours[~known] = _rgb(_FORBIDDEN)
    figure, ax = _drawn(grid, colours, ticks, words)
    if not known.all():
        _hatched(ax, grid, ~known)
        _key(figure, ["unknown"], "", words)
    if norm is not None:
        label = words.axis["divergence"]
        number_ticks(_colour_bar(figure, ax, norm, rates[known], label), words)
    return figure


def _ends(limits: Limits, what: str, unit: str) -> Limits:
    """The ends of the colour scale, as numbers in that unit; None: the map's own."""
    return None if limits is None else number_pair("limits", limits, f"must be {what}", unit)


def _logarithmic(times: Array, limits: Limits) -> tuple[Array, Normalize | None]:
    """Colours (n2, n1, 3) of times (n2, n1), and the scale; none where there is no flip."""
    from matplotlib.colors import LogNorm

    flipped = times > 0
    colours = np.ones((*times.shape, 3))
    if not flipped.any():
        return colours, None
    low, high = limits or (_above(times[flipped], _FEW), float(times[flipped].max()))
    if not 0 < low <= high:
        rule = "must be two times, 0 < low <= high, got {low} and {high}"
        raise ArgumentError("limits", rule, low=low, high=high)
    norm = LogNorm(low, high if high > low else 1.01 * low)
    colours[flipped] = _palette()(norm(times[flipped]))[:, :3]
    return colours, norm


def _above(values: Array, few: float) -> float:
    """The value that this part of them lies below."""
    return float(np.sort(values)[int(few * values.size)])


def _palette() -> Any:
    """From dark, soon, to light, late; without the ends that look like ink and like paper."""
    from matplotlib import colormaps
    from matplotlib.colors import ListedColormap

    return ListedColormap(colormaps["inferno"](np.linspace(0.06, 0.97, 512)))


def _rgb(colour: str) -> tuple[float, float, float]:
    from matplotlib.colors import to_rgb

    return to_rgb(colour)


def _drawn(grid: Grid, colours: Array, ticks: str, words: Labels) -> tuple[Figure, Axes]:
    """The cells as one image of pixels, on axes of angles."""
    ratio = grid.height / grid.width
    equal = 1 / _LONGEST <= ratio <= _LONGEST
    height = min(max(_HEIGHT * ratio + 0.7, _LOWEST), _HIGHEST) if equal else _HEIGHT
    figure, axes = panels(1, 1, height, words)
    ax = axes[0, 0]
    ax.grid(visible=False)
    pixels = np.rint(255 * colours).astype(np.uint8)
    ax.imshow(
        pixels,
        origin="lower",
        extent=grid.extent,
        aspect="equal" if equal else "auto",
        interpolation="none",
    )
    angle_axes(ax, grid, ticks, words)
    for side in ("top", "right"):
        ax.spines[side].set_visible(True)
    return figure, ax


def _hatched(ax: Axes, grid: Grid, mask: NDArray[np.bool_]) -> None:
    """Hatch the cells of a mask up to the map's edges, with a thin line around them."""
    if not mask.any():
        return
    x, y = grid.padded()
    level = np.pad(mask, 1, mode="edge").astype(np.float64)
    hatched = ax.contourf(x, y, level, levels=[0.5, 1.5], colors="none", hatches=["////"])
    hatched.set_edgecolor(_HATCH)
    hatched.set_linewidth(0.0)
    ax.contour(x, y, level, levels=[0.5], colors=_EDGE, linewidths=0.6)


def _key(figure: Figure, names: list[str], end: str, words: Labels) -> None:
    """What the colours besides the scale mean, above the map."""
    from matplotlib.patches import Patch

    looks: dict[str, dict[str, Any]] = {
        "forbidden": {"facecolor": _FORBIDDEN, "edgecolor": _HATCH, "hatch": "////"},
        "unknown": {"facecolor": _FORBIDDEN, "edgecolor": _HATCH, "hatch": "////"},
        "never": {"facecolor": _NEVER},
        "unresolved": {"facecolor": "#e3c8c0"},
    }
    handles = [Patch(label=words.curve[name].format(end=end), **looks[name]) for name in names]
    if handles:
        figure.legend(handles=handles, loc="outside upper left", ncols=3, handlelength=1.6)


def _colour_bar(figure: Figure, ax: Axes, norm: Normalize, values: Array, label: str) -> Any:
    """The scale beside the map, as high as it; with arrows where values lie beyond its ends."""
    from matplotlib.cm import ScalarMappable

    left, right, low, high = ax.get_images()[0].get_extent()
    tall = max(1.0, (high - low) / (right - left)) if ax.get_aspect() != "auto" else 1.0
    place = ax.inset_axes((1.0 + 0.025 * tall, 0.0, 0.03 * tall, 1.0))
    place.grid(visible=False)
    inside = norm(values[np.isfinite(values)])
    ends = bool((inside < 0).any()), bool((inside > 1).any())
    extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[ends]
    bar = figure.colorbar(ScalarMappable(norm, _palette()), cax=place, extend=extend)
    bar.set_label(label)
    bar.outline.set_linewidth(0.6)
    return bar
