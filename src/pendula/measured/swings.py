"""Tables of periods: of a stopwatch, or of a light barrier."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

from pendula._messages import ArgumentError
from pendula._unit_names import PI
from pendula.measured.columns import name_in, named_column, shown
from pendula.measured.header_units import header_unit
from pendula.measured.measurement import PeriodTable
from pendula.units import scaled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._types import Array
    from pendula.measured.asked_of_file import Asked, Log
    from pendula.measured.tables import Column, Table

_G = 9.81  # m/s², for a guess at the number of swings that is only offered
_SINGLE = (0.7, 1.4)  # times the period of a small swing: what is one swing
_MOTION = ("angle", "rate", "x", "acceleration", "force")
_SAME = 1.5  # times the least median: columns that differ by more are not one time, repeated
_LONGEST = 20.0  # of a pendulum's string, in metres: a larger number is in cm or mm


def is_period_table(table: Table, asked: Asked) -> bool:
    """Whether a table holds periods against a length or an amplitude."""
    if asked.period or asked.swings is not None or asked.length is not None:
        return True
    kinds = [each.heading.kind for each in table.columns]
    varied = "length" in kinds or "amplitude" in kinds
    timed = any(kind in ("period", "trial") for kind in kinds)
    if not varied and timed and "angle" in kinds:  # T against the angle of release
        return "time" not in kinds and "period" in kinds and not _rises(table, "period")
    return (varied and (timed or ("time" in kinds and not set(kinds) & {*_MOTION}))) or (
        "period" in kinds and not set(kinds) & {*_MOTION, "time", ""} and len(table.lines) < 1000
    )


def _rises(table: Table, kind: str) -> bool:
    import numpy as np

    values = next(each.values for each in table.columns if each.heading.kind == kind)
    return bool((np.diff(values[np.isfinite(values)]) > 0).all()) and values.size > 30


def period_table(table: Table, asked: Asked, log: Log) -> PeriodTable:
    """The periods of a table, of one swing each.

    Raises:
        ArgumentError: where the number of swings, or a unit, is not told.
    """
    import numpy as np

    length, amplitude = _varied(table, asked, log)
    timed = _timed(table, asked, (length, amplitude))
    log.took["period"] = tuple(name_in(table, each) for each in timed)
    times = np.column_stack([_seconds(each, asked, log) for each in timed])
    lengths = None if length is None else _lengths(length, asked, log)
    amplitudes = None if amplitude is None else _amplitudes(amplitude, log)
    there = np.isfinite(times).any(axis=1)
    for values in (lengths, amplitudes):
        there &= True if values is None else np.isfinite(values)
    if not there.any():
        raise ArgumentError("path", "holds no period beside a length or an amplitude")
    lengths = None if lengths is None else lengths[there]
    swings = _swings(timed, times[there], lengths, asked)
    log.took["swings"] = swings
    periods = times[there] / swings
    per = "one swing" if swings == 1 else f"{swings} swings: divided by that"
    log.note(f"Periods from {', '.join(map(str, timed))}, times of {per}.")
    return PeriodTable(
        period=np.nanmean(periods, axis=1),
        length=lengths,
        amplitude=None if amplitudes is None else amplitudes[there],
        repeats=periods if periods.shape[1] > 1 else None,
    )


def _varied(table: Table, asked: Asked, log: Log) -> tuple[Column | None, Column | None]:
    """The columns of length and amplitude."""
    found: list[Column | None] = []
    for argument, kinds in (("length", ("length",)), ("amplitude", ("amplitude", "angle"))):
        name = getattr(asked, argument)
        named = [] if name is None else [named_column(table, argument, name)]
        known = [each for each in table.columns if each.heading.kind in kinds]
        column = next(iter([*named, *known]), None)
        if column is not None:
            log.took[argument] = name_in(table, column)
            log.note(f"{argument.capitalize()} from {column}.")
        found.append(column)
    return found[0], found[1]


def _timed(table: Table, asked: Asked, varied: Sequence[Column | None]) -> tuple[Column, ...]:
    """The columns of times: named ones, else periods, else what was measured several times.

    Raises:
        ArgumentError: for none, or times of different numbers of swings.
    """
    if asked.period:
        return tuple(named_column(table, "period", name) for name in asked.period)
    taken = {each.number for each in varied if each is not None}
    free = [each for each in table.columns if each.number not in taken]
    free = [each for each in free if not each.heading.computed]
    for kinds in (("trial",), ("period",), ("time",), ("",)):
        found = [each for each in free if each.heading.kind in kinds]
        found = [each for each in found if each.heading.unit in ("", "s")]
        counts = {each.heading.swings for each in found}
        if len(counts) > 1:  # T beside the time of ten swings: what was read off the watch
            most = max(counts, key=lambda each: each or 0)
            found = [each for each in found if each.heading.swings == most]
        found = [each for each in found if not _counts(each)]
        if found:
            return _alike(table, found)
    rule = "is not told by any header: {text}"
    text = shown(free or table.columns, table)
    raise ArgumentError("period", rule, "name its columns with <period=2>", text=text)


def _counts(column: Column) -> bool:
    """Whether a column without a unit numbers the trials, instead of holding their times."""
    import numpy as np

    values = column.values[np.isfinite(column.values)]
    whole = (values == np.round(values)).all() and values.min() in (0, 1)
    return bool(whole) and not column.heading.unit


def _alike(table: Table, columns: list[Column]) -> tuple[Column, ...]:
    """Columns that can be the same time, measured several times.

    Raises:
        ArgumentError: for columns that differ by more.
    """
    import numpy as np

    usual = [float(np.nanmedian(each.values)) for each in columns]
    if max(usual) > _SAME * min(usual):
        rule = "could be one of several columns that differ: {text}"
        way_out = f"name it with <period={name_in(table, columns[0])}>"
        raise ArgumentError("period", rule, way_out, text=shown(columns, table))
    return tuple(columns)


def _seconds(column: Column, asked: Asked, log: Log) -> Array:
    """Times in seconds."""
    written = asked.time_unit or column.heading.written
    known = header_unit(written) if written else None
    if asked.time_unit and (known is None or known[0] != "s"):
        rule = "must be a unit of time, got {value}"
        raise ArgumentError("time_unit", rule, "write <time_unit=ms>", value=asked.time_unit)
    if known is None:
        log.note("No unit of time is told: seconds.")
        return column.values
    log.took["time_unit"] = written
    return scaled(column.values, known[1])


def _lengths(column: Column, asked: Asked, log: Log) -> Array:
    """Lengths in metres.

    Raises:
        ArgumentError: where no unit is told, and they are no likely metres.
    """
    import numpy as np

    written = asked.unit or column.heading.written
    known = header_unit(written) if written else None
    if asked.unit and (known is None or known[0] != "m"):
        rule = "must be a unit of length, got {value}"
        raise ArgumentError("unit", rule, "write <unit=cm>, say", value=asked.unit)
    if known is not None:
        log.took["unit"] = written
        return scaled(column.values, known[1])
    most = float(np.nanmax(column.values))
    if most > _LONGEST / 4:
        rule = "of the lengths is not told, and they go up to {text}"
        way_out = "say it with <unit=cm>, <unit=mm> or <unit=m>"
        raise ArgumentError("unit", rule, way_out, text=f"{most:g}")
    log.took["unit"] = "m"
    log.note("No unit of length is told: metres.")
    return column.values


def _amplitudes(column: Column, log: Log) -> Array:
    """Amplitudes in radians; without a unit, degrees if any is beyond a straight angle."""
    import numpy as np

    if column.heading.unit == "rad":
        return scaled(column.values, column.heading.factor)
    degrees = float(np.nanmax(np.abs(column.values))) > math.pi
    log.note(f"No unit of amplitude is told: {'degrees' if degrees else 'radians'}, by their size.")
    return scaled(column.values, PI / 180 if degrees else Fraction(1))


def _swings(timed: Sequence[Column], times: Array, lengths: Array | None, asked: Asked) -> int:
    """How many swings each time is of.

    Raises:
        ArgumentError: where it is not told, and the times are no periods of such lengths.
    """
    import numpy as np

    told = {each.heading.swings for each in timed} - {None}
    if asked.swings is not None:
        return asked.swings
    if told:
        return int(told.pop() or 1)
    named = all(each.heading.kind == "period" for each in timed)
    if lengths is None:
        if named:
            return 1
        raise ArgumentError("swings", "is not told by any header", "give it with <swings=10>")
    ratio = float(np.nanmedian(np.nanmean(times, axis=1) / (2 * math.pi * np.sqrt(lengths / _G))))
    if _SINGLE[0] < ratio < _SINGLE[1]:
        return 1
    likely = max(round(ratio / 5) * 5 or round(ratio), 1)
    rule = "is not told by any header: the times are {text} times the period of such a length"
    way_out = f"give the number of swings that were timed at once with <swings={likely}>"
    raise ArgumentError("swings", rule, way_out, text=f"{ratio:.3g}")


def gate_periods(t: Array, state: Array, log: Log) -> PeriodTable:
    """Periods of a pendulum that interrupts a light barrier twice a swing.

    Args:
        t: times of changes, (n,) [s].
        state: 1 where the barrier is interrupted, (n,).
        log: takes what was understood.

    Raises:
        ArgumentError: for fewer than three interruptions.
    """
    import numpy as np

    blocked = t[1:][(state[1:] > 0.5) & ~(state[:-1] > 0.5)]
    if state.size and state[0] > 0.5:
        blocked = np.concatenate([t[:1], blocked])
    if blocked.size < 3:
        raise ArgumentError("path", "holds fewer than three passes through a light barrier")
    log.note(
        f"{blocked.size} passes through a light barrier: a period from each to the second next."
    )
    return PeriodTable(period=blocked[2:] - blocked[:-2])
