"""Angles as they are recorded: in degrees or radians, wrapped, counted from the top."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula._messages import ArgumentError
from pendula._unit_names import PI
from pendula.measured.header_units import header_unit, is_degrees
from pendula.units import scaled

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from pendula._types import Array
    from pendula.measured.asked_of_file import Asked, Log
    from pendula.measured.tables import Column

_TURN = math.tau
_FAR = 4 * math.pi  # no rest position is counted two turns away, in radians
_WIDE = 1.75  # rad; swings in radians are seldom wider, and narrow ones in degrees are not narrower
_MEETINGS = 4  # with its middle: of a motion to and fro, which no turning over is


def unit_factor(
    columns: Sequence[Column], asked: Asked, log: Log, kind: str, example: str
) -> Fraction | None:
    """What the numbers of columns are multiplied by for SI units; None: no unit is told.

    The argument goes before the header.

    Args:
        columns: of one quantity.
        asked: for its unit.
        log: takes the unit.
        kind: the SI unit of the quantity.
        example: a unit of that kind, for the way out.

    Raises:
        ArgumentError: for a unit of another kind.
    """
    if asked.unit is not None:
        known = header_unit(asked.unit)
        if known is None or known[0] != kind:
            rule = f"must be a unit of the same kind as {kind}, got {{value}}"
            raise ArgumentError("unit", rule, f"write <unit={example}>, say", value=asked.unit)
        log.took["unit"] = asked.unit
        return known[1]
    for each in columns:
        if each.heading.unit == kind:
            log.took["unit"] = each.heading.written
            return each.heading.factor
    return None


def angles_of(columns: Sequence[Column], alike: Sequence[Column], asked: Asked, log: Log) -> Array:
    """Angles [rad], unwrapped, from below where it is told that they are from the top, (n, m).

    Args:
        columns: the angles.
        alike: all columns of angles of the file: their size tells degrees from radians.
        asked: for unit and zero.
        log: takes what was understood.

    Raises:
        ArgumentError: where the unit is not told, and the numbers do not show it.
    """
    import numpy as np

    factor = unit_factor(columns, asked, log, "rad", "deg")
    if factor is None:
        in_degrees = _are_degrees([each.values for each in alike], len(columns))
        log.took["unit"] = "deg" if in_degrees else "rad"
        factor = PI / 180 if in_degrees else PI / PI
        sizes = "their size shows it" if in_degrees else "none is larger than angles in radians are"
        log.note(f"No unit is told: {'degrees' if in_degrees else 'radians'}, as {sizes}.")
    elif is_degrees(factor):
        log.note("Angles in degrees.")
    values = np.column_stack([scaled(each.values, factor) for each in columns])
    for column in values.T:
        turned = _unwrapped(column)
        if turned:
            log.note(f"Wrapped angles were unwrapped, in {turned} places.")
    return _from_below(values, columns, asked, log)


def _from_below(values: Array, columns: Sequence[Column], asked: Asked, log: Log) -> Array:
    """Angles from the downward vertical, where it is told that they are from the upright."""
    import numpy as np

    zero = asked.zero or ("up" if any(each.heading.upright for each in columns) else None)
    if zero is None:
        return values
    log.took["zero"] = zero
    if zero == "down":
        return values
    first = np.array([column[np.isfinite(column)][0] for column in values.T])
    # whole turns are taken away so that the first sample, and not the zero, is within half of one
    turns = np.round((first - math.pi) / _TURN)
    log.note("Angles from the upright position: half a turn is taken off, and whole turns.")
    return np.asarray(values - math.pi - turns * _TURN)


def _unwrapped(column: Array) -> int:
    """Unwrap a column in place: how many jumps it had.

    Angles that span more than a turn were never wrapped.
    """
    import numpy as np

    there = np.flatnonzero(np.isfinite(column))
    kept = column[there]
    jumps = np.abs(np.diff(kept)) > math.pi
    if not jumps.any() or np.ptp(kept) > _TURN * 1.001:
        return 0
    column[there] = np.unwrap(kept)
    return int(jumps.sum())


def _are_degrees(columns: Sequence[Array], bodies: int) -> bool:
    """Whether numbers without a unit are degrees.

    Raises:
        ArgumentError: where they may be either.
    """
    import numpy as np

    spans = [float(np.nanmax(each) - np.nanmin(each)) for each in columns]
    span, most = max(spans), max(float(np.nanmax(np.abs(each))) for each in columns)
    if span <= _TURN * 1.01:
        if most > _FAR:
            return True
        if span <= 2 * _WIDE or bodies > 1 or any(map(_is_wrapped, columns)):
            return False
    elif 340 < span <= 361 or any(_meets_middle(each) >= _MEETINGS for each in columns):
        return True
    rule = "is not told, and angles from {low:.3g} to {high:.3g} may be degrees or radians"
    raise ArgumentError(
        "unit",
        rule.replace("{low:.3g}", f"{min(map(np.nanmin, columns)):.3g}").replace(
            "{high:.3g}", f"{max(map(np.nanmax, columns)):.3g}"
        ),
        "say which with <unit=deg> or <unit=rad>",
    )


def _is_wrapped(column: Array) -> bool:
    """Whether radians jump by nearly a turn."""
    import numpy as np

    kept = column[np.isfinite(column)]
    return bool((np.abs(np.diff(kept)) > 0.8 * _TURN).any())


def _meets_middle(column: Array) -> int:
    """How often a motion to and fro, of more than a turn if it were radians, passes its middle."""
    import numpy as np

    kept = column[np.isfinite(column)]
    middle = float(np.median(kept))
    far = kept[np.abs(kept - middle) > math.pi]
    return int((np.diff(np.sign(far - middle)) != 0).sum())
