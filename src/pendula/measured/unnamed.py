"""Columns without a name: what they are by what they do."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pendula.measured.circle import circle_of
from pendula.measured.positions import downward

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._types import Array
    from pendula.measured.tables import Column

_DERIVED = 0.9  # correlation of a column with another's slope
_RATIO = (0.85, 1.18)  # of a rate to that slope
_ROUND = 0.02  # of the radius: points are on a circle


def is_time(column: Column) -> bool:
    """Whether numbers rise from row to row, as times do."""
    import numpy as np

    values = column.values[np.isfinite(column.values)]
    steps = np.diff(values)
    if values.size < 3 or (steps < 0).any() or not (steps > 0).any():
        return False
    usual = float(np.median(steps[steps > 0]))
    return float(steps.max()) < 0.2 * float(values[-1] - values[0]) or steps.max() < 3 * usual


def rates_among(columns: Sequence[Column], t: Array) -> dict[int, int]:
    """Which columns are the rates of which: places of rates by those of angles."""
    found = dict[int, int]()
    for i, angle in enumerate(columns):
        for j, rate in enumerate(columns):
            taken = j in found.values() or i in found.values()
            if i != j and not taken and _is_rate(rate.values, angle.values, t):
                found[i] = j
                break
    return found


def _is_rate(rate: Array, angle: Array, t: Array) -> bool:
    import numpy as np

    there = np.isfinite(rate) & np.isfinite(angle) & np.isfinite(t)
    if there.sum() < 10:
        return False
    at, v, w = t[there], angle[there], rate[there]
    if (np.diff(at) <= 0).any() or v.std() == 0 or w.std() == 0:
        return False
    slope = np.gradient(v, at)
    if slope.std() == 0:
        return False
    ratio = float(np.dot(slope, w) / np.dot(slope, slope))
    return bool(np.corrcoef(slope, w)[0, 1] > _DERIVED and _RATIO[0] < ratio < _RATIO[1])


def points_among(columns: Sequence[Column]) -> list[tuple[Column, Column]]:
    """Pairs of columns as x and y of points, one of which moves on a circle; none: they are not.

    Columns that follow one another are a pair; a pair that stands still is the pivot.
    """
    import numpy as np

    if len(columns) % 2 or not columns:
        return []
    pairs = list(zip(columns[::2], columns[1::2], strict=True))
    motions = [max(float(np.nanstd(one.values)) for one in pair) for pair in pairs]
    moving = [i for i, motion in enumerate(motions) if motion > 0.02 * max(motions)]
    still = [pairs[i] for i in range(len(pairs)) if i not in moving]
    centre = still[0] if len(still) == 1 else None
    return pairs if any(_is_round(pairs[i], centre) for i in moving) else []


def _is_round(pair: tuple[Column, Column], centre: tuple[Column, Column] | None) -> bool:
    """Whether a point keeps its distance from a pivot, or from any point."""
    import numpy as np

    x, y = (each.values for each in pair)
    if centre is None:
        circle = circle_of(x, y)
        return circle is not None and circle.rms < _ROUND * min(circle.radius, float(np.nanstd(x)))
    far = np.hypot(x - centre[0].values, y - centre[1].values)
    if not np.isfinite(far).any():
        return False
    return bool(np.nanstd(far) < _ROUND * np.nanmean(far))


def in_order(
    pairs: list[tuple[Column, Column]],
) -> tuple[list[tuple[Column, Column]], str]:
    """Pairs as x and y, and which way y grows by how the points move; empty: it does not tell.

    Of the four ways in which down may point along two columns, it is the one in which the motion
    shows gravity most clearly.
    """
    import numpy as np

    swapped = [(y, x) for x, y in pairs]
    shown = [
        downward(np.column_stack([each.values for pair in way for each in pair]))
        for way in (pairs, swapped)
    ]
    if shown[1] and not shown[0]:
        return swapped, "down" if shown[1] > 0 else "up"
    return pairs, {1: "down", -1: "up"}.get(shown[0], "")
