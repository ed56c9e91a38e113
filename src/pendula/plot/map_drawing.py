"""The parts of a map's picture: cells, hatching, key and colour bar."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._messages import ArgumentError
from pendula.plot.grid import Grid, angle_axes
from pendula.plot.style import given_or_new

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap, Normalize
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from pendula._types import Array
    from pendula.plot.labels import Labels


NEVER = "#8fb8d8"
FORBIDDEN, _HATCH = "#f7f8f9", "#c6ccd3"
_EDGE = "#6b737c"
_LONGEST = 5.0  # sides of a map that is drawn with equal units
_HEIGHT, _LOWEST, _HIGHEST = 4.6, 2.6, 6.4  # inches
_AT_ONCE = 2**20  # cells whose colours are computed at once


def palette(name: str) -> Colormap:
    """A colormap of matplotlib without the ends, which may look like ink and like paper.

    Raises:
        ValueError: for an unknown name.
    """
    from matplotlib import colormaps
    from matplotlib.colors import ListedColormap

    if name not in colormaps:
        near = difflib.get_close_matches(str(name).lower(), list(colormaps), n=1)
        rule = "must be the name of a colormap of matplotlib, got {value}"
        way_out = f"take {near[0]}, say" if near else "take inferno, viridis, cividis or gray, say"
        raise ArgumentError("colormap", rule, way_out, value=name)
    return ListedColormap(colormaps[name](np.linspace(0.06, 0.97, 512)))


def painted(shape: tuple[int, int], paint: Callable[[slice], Array]) -> NDArray[np.uint8]:
    """Pixels (rows, columns, 3) of colours (…, 3) in parts of 1, which `paint` gives for rows."""
    pixels = np.empty((*shape, 3), np.uint8)
    step = max(1, _AT_ONCE // shape[1])
    for start in range(0, shape[0], step):
        rows = slice(start, start + step)
        pixels[rows] = np.rint(255 * paint(rows))
    return pixels


def rgb(colour: str) -> tuple[float, float, float]:
    """Parts of red, green and blue."""
    from matplotlib.colors import to_rgb

    return to_rgb(colour)


def drawn(
    grid: Grid,
    pixels: NDArray[np.uint8],
    ax: Axes | None,
    ticks: str,
    title: str | None,
    words: Labels,
) -> tuple[Figure, Axes]:
    """The cells as one image, in a figure of its own or in given axes."""
    ratio = grid.height / grid.width
    equal = grid.alike and 1 / _LONGEST <= ratio <= _LONGEST
    height = min(max(_HEIGHT * ratio + 0.7, _LOWEST), _HIGHEST) if equal else _HEIGHT
    figure, place = given_or_new(ax, height, words)
    place.grid(visible=False)
    place.imshow(
        pixels,
        origin="lower",
        extent=grid.extent,
        aspect="equal" if equal else "auto",
        interpolation="none",
    )
    if ax is None:
        figure.cells = place, (pixels.shape[1], pixels.shape[0])
    angle_axes(place, grid, ticks, words)
    for side in ("top", "right"):
        place.spines[side].set_visible(True)
    if title is not None:
        place.set_title(title)
    return figure, place


def hatched(ax: Axes, grid: Grid, mask: NDArray[np.bool_]) -> None:
    """Hatch the cells of a mask up to the map's edges, with a thin line around them."""
    if not mask.any():
        return
    x, y = grid.padded()
    level = np.pad(mask, 1, mode="edge").astype(np.float64)
    region = ax.contourf(x, y, level, levels=[0.5, 1.5], colors="none", hatches=["////"])
    region.set_edgecolor(_HATCH)
    region.set_linewidth(0.0)
    ax.contour(x, y, level, levels=[0.5], colors=_EDGE, linewidths=0.6)


def key(figure: Figure, ax: Axes, names: list[str], end: str, words: Labels) -> None:
    """What the colours besides the scale mean, above the map."""
    from matplotlib.patches import Patch

    looks: dict[str, dict[str, Any]] = {
        "forbidden": {"facecolor": FORBIDDEN, "edgecolor": _HATCH, "hatch": "////"},
        "unknown": {"facecolor": FORBIDDEN, "edgecolor": _HATCH, "hatch": "////"},
        "unreachable": {"facecolor": FORBIDDEN, "edgecolor": _HATCH, "hatch": "////"},
        "never": {"facecolor": NEVER},
        "unresolved": {"facecolor": "#e3c8c0"},
    }
    handles = [Patch(label=words.curve[name].format(end=end), **looks[name]) for name in names]
    if not handles:
        return
    if getattr(figure, "cells", None) is None:  # the axes of somebody else's figure
        ax.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.08), frameon=False)
    else:
        figure.legend(handles=handles, loc="outside upper left", ncols=3, handlelength=1.6)


def colour_bar(
    figure: Figure, ax: Axes, norm: Normalize, colours: Colormap, values: Array, label: str
) -> Any:
    """The scale beside the map, as high as it; with arrows where values lie beyond its ends."""
    from matplotlib.cm import ScalarMappable

    left, right, low, high = ax.get_images()[-1].get_extent()
    tall = max(1.0, (high - low) / (right - left)) if ax.get_aspect() != "auto" else 1.0
    place = ax.inset_axes((1.0 + 0.025 * tall, 0.0, 0.03 * tall, 1.0))
    place.grid(visible=False)
    ends = bool(norm(values.min()) < 0), bool(norm(values.max()) > 1)
    extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[ends]
    scale = ScalarMappable(norm, colours)
    bar = figure.colorbar(scale, cax=place, extend=extend)
    bar.set_label(label)
    bar.outline.set_linewidth(0.6)
    return bar
