"""Plots in a terminal: a curve of braille characters, two by four dots each; a map in shades."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pendula._types import Array


_DOTS = np.array([[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]])
_EMPTY = 0x2800  # the braille character without a dot
_NUMBERS = 9  # characters for those at the side
MARGIN = _NUMBERS + 2
_SHADES = "█▓▒░"


def curve(t: Array, y: Array, *, width: int = 68, height: int = 8) -> str:
    """Draw y over t, in `height` lines of `width` characters and one with the times.

    Args:
        t: times (n,), rising or falling, at least two.
        y: values (n,), finite.
        width: of the field for the curve, in characters.
        height: of the field, in lines.
    """
    low, high = float(y.min()), float(y.max())
    dots = _drawn(t, y, 2 * width, 4 * height)
    cells = (dots.reshape(height, 4, width, 2) * _DOTS[:, np.newaxis, :]).sum(axis=(1, 3))
    lines = ["".join(chr(_EMPTY + int(cell)) for cell in row) for row in cells]
    labels = [f"{high:.4g}", *[""] * (height - 2), f"{low:.4g}"]
    body = [f"{label:>{_NUMBERS}} │{line}" for label, line in zip(labels, lines, strict=True)]
    first, last = f"{t[0]:g}", f"{t[-1]:g} s"
    return "\n".join([*body, f"{'':{_NUMBERS}}  {first}{last:>{width - len(first)}}"])


def _drawn(t: Array, y: Array, columns: int, rows: int) -> NDArray[np.bool_]:
    """Which dots are set: in each column all between the lowest and the highest value in it."""
    t = (t - t[0]) / (t[-1] - t[0])
    fine = np.union1d(t, np.linspace(0.0, 1.0, 4 * columns))
    values = np.interp(fine, t, y)
    low, high = values.min(), values.max()
    scale = (rows - 1) / (high - low) if high > low else 0.0
    heights = np.rint((high - values) * scale).astype(int)
    places = np.rint(fine * (columns - 1)).astype(int)
    top, bottom = np.full(columns, rows), np.full(columns, -1)
    for place, height in ((places, heights), (places[1:], heights[:-1])):  # and where it came from
        np.minimum.at(top, place, height)
        np.maximum.at(bottom, place, height)
    row = np.arange(rows)[:, np.newaxis]
    return (row >= top) & (row <= bottom)


def shades(values: Array, *, width: int = 68) -> str:
    """A picture of values (n1, n2) over two angles, the second one upward: dark where they are low.

    Args:
        values: finite, or nan where there is none: blank.
        width: in characters, each twice as high as wide.
    """
    columns = np.linspace(0, values.shape[0] - 1, width).round().astype(int)
    height = max(1, round(width * values.shape[1] / values.shape[0] / 2))
    rows = np.linspace(values.shape[1] - 1, 0, height).round().astype(int)
    picked = values[np.ix_(columns, rows)].T
    known = picked[np.isfinite(picked)]
    if not known.size:
        return "\n".join([" " * width] * height)
    ends = np.quantile(known, np.arange(1, len(_SHADES)) / len(_SHADES))
    return "\n".join(
        "".join(
            _SHADES[int(np.searchsorted(ends, each))] if np.isfinite(each) else " " for each in row
        )
        for row in picked
    )
