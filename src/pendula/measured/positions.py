"""Positions of marked points: their unit, which way y grows, and the angles they stand for."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from pendula._messages import ArgumentError
from pendula.measured.circle import Circle, circle_of
from pendula.measured.header_units import header_unit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._types import Array
    from pendula.measured.asked_of_file import Asked, Log
    from pendula.measured.tables import Column

_CLEAR = 0.3  # of the correlation between height and squared speed: which way is down
_STILL = 0.02  # of the largest motion: a point that moves by less is a pivot


def positions_of(columns: Sequence[Column], asked: Asked, log: Log) -> tuple[Array, str]:
    """X and y of each point, y up, (n, m), and their unit, "m" or "px".

    Args:
        columns: x and y of each point in turn.
        asked: for unit, scale and direction of y.
        log: takes what was understood.

    Raises:
        ArgumentError: where no unit is told, and the numbers are no pixels either.
    """
    import numpy as np

    unit, factor = _unit(columns, asked, log)
    values = np.column_stack([each.values for each in columns]) * float(factor)
    if unit == "px" and asked.scale is not None:
        log.took["scale"] = asked.scale
        values, unit = values * asked.scale, "m"
        log.note(f"Pixels are taken as {asked.scale:g} m.")
    grows = asked.y_axis or _way_of_y(values, unit, log)
    log.took["y_axis"] = grows
    if grows == "down":
        values[:, 1::2] *= -1.0
    return values, unit


def _unit(columns: Sequence[Column], asked: Asked, log: Log) -> tuple[str, Fraction]:
    """The unit, "m" or "px", and its factor."""
    import numpy as np

    if asked.unit is not None:
        known = header_unit(asked.unit)
        if known is None or known[0] not in ("m", "px"):
            rule = "must be a length or px, got {value}"
            way_out = "write <unit=mm>, say, or <unit=px>"
            raise ArgumentError("unit", rule, way_out, value=asked.unit)
        log.took["unit"] = asked.unit
        return known
    told = [each.heading for each in columns if each.heading.unit in ("m", "px")]
    if told:
        log.took["unit"] = told[0].written
        return told[0].unit, told[0].factor
    values = np.concatenate([each.values for each in columns])
    values = values[np.isfinite(values)]
    whole = bool((values == np.round(values)).all() and np.abs(values).max() > 50)
    if asked.scale is not None or whole:
        log.took["unit"] = "px"
        if whole:
            log.note("No unit is told: pixels, as the numbers are whole.")
        return "px", Fraction(1)
    rule = "is not told: positions from {text}"
    raise ArgumentError(
        "unit",
        rule,
        "say it with <unit=m>, <unit=mm> or <unit=px>",
        text=f"{values.min():.4g} to {values.max():.4g}",
    )


def _way_of_y(values: Array, unit: str, log: Log) -> str:
    """Which way y grows: the way a bob's arc is open to, else as usual for the unit."""
    shown = downward(values)
    if shown:
        log.note(
            "y grows downward in the file, as the motion shows: it was turned up."
            if shown > 0
            else "y grows upward, as the motion shows."
        )
        return "down" if shown > 0 else "up"
    grows = "down" if unit == "px" else "up"
    log.note(f"y is taken to grow {grows}ward, as usual in {unit}; the motion does not show it.")
    return grows


def downward(values: Array) -> int:
    """1 where y grows downward, -1 where it grows upward, 0 where the motion does not tell.

    A single bob that swings hangs below the centre of its circle. Otherwise bobs are faster the
    lower they are, as long as little energy is lost.

    Args:
        values: x and y of each point in turn, (n, 2 m); NaN: missing.
    """
    import numpy as np

    x, y = values[:, 0], values[:, 1]
    circle = circle_of(x, y) if values.shape[1] == 2 else None
    if circle is not None and circle.rms < 0.1 * circle.radius:
        heights = (y - circle.y) / circle.radius
        heights = heights[np.isfinite(heights)]
        if (heights < 0.5).all() or (heights > -0.5).all():
            return 1 if heights.mean() > 0 else -1
    speeds, heights = np.zeros(len(values) - 2), np.zeros(len(values) - 2)
    for i in range(0, values.shape[1], 2):
        steps = (values[2:, i : i + 2] - values[:-2, i : i + 2]) / 2
        speeds += (steps**2).sum(axis=1)
        heights += values[1:-1, i + 1]
    there = np.isfinite(speeds) & np.isfinite(heights)
    if there.sum() < 10 or np.ptp(heights[there]) == 0:
        return 0
    correlation = float(np.corrcoef(speeds[there], heights[there])[0, 1])
    return int(np.sign(correlation)) if abs(correlation) > _CLEAR else 0


def without_pivot(
    pairs: list[tuple[Column, Column]],
) -> tuple[list[tuple[Column, Column]], tuple[Column, Column] | None]:
    """The points that move, and the one that stands still, if there is one."""
    import numpy as np

    motions = [max(float(np.nanstd(each.values)) for each in pair) for pair in pairs]
    still = [i for i, motion in enumerate(motions) if motion < _STILL * max(motions)]
    if len(pairs) < 2 or len(still) != 1:
        return pairs, None
    moving = [pair for i, pair in enumerate(pairs) if i != still[0]]
    return moving, pairs[still[0]]


def inner_first(pairs: list[tuple[Column, Column]]) -> list[tuple[Column, Column]]:
    """Two points in the order of the joints: the first moves on a circle, the second does not."""
    first, second = (_roundness(*pair) for pair in pairs)
    return pairs[::-1] if second < 0.1 and second < first / 4 else pairs


def _roundness(x: Column, y: Column) -> float:
    """How far points are from a circle, of its radius."""
    circle = circle_of(x.values, y.values)
    return float("inf") if circle is None else circle.rms / circle.radius


def pivot_circle(values: Array, pivot: tuple[float, float] | None) -> Circle | None:
    """The circle of the first point: the fitted one, or the one about a known pivot."""
    import numpy as np

    x, y = values[:, 0], values[:, 1]
    if pivot is None:
        return circle_of(x, y)
    far = np.hypot(x - pivot[0], y - pivot[1])
    far = far[np.isfinite(far)]
    error = float(far.std() / np.sqrt(far.size))
    return Circle(*pivot, float(far.mean()), float(far.std()), error)


def angles_about(values: Array, circle: Circle) -> Array:
    """Angles from the downward vertical, unwrapped, about the pivot and then about the joint.

    Args:
        values: x and y of one point or two, y up, (n, 2) or (n, 4); NaN: missing.
        circle: of the first point.

    Returns:
        (n, 1) or (n, 2) [rad].
    """
    import numpy as np

    from_x: Any = circle.x
    from_y: Any = circle.y
    columns = []
    for i in range(0, values.shape[1], 2):
        x, y = values[:, i], values[:, i + 1]
        angle = np.arctan2(x - from_x, from_y - y)
        there = np.isfinite(angle)
        angle[there] = np.unwrap(angle[there])
        columns.append(angle)
        from_x, from_y = x, y
    return np.column_stack(columns)
