"""The measurement that a table of one run holds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pendula._messages import ArgumentError
from pendula.measured import sensors, times
from pendula.measured.angles import angles_of
from pendula.measured.columns import name_in
from pendula.measured.header_units import header_unit
from pendula.measured.measurement import Measurement
from pendula.measured.motion import SINCE_1970, Picked, pick, time_column
from pendula.measured.positions import positions_of
from pendula.units import scaled

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.measured.asked_of_file import Asked, Log
    from pendula.measured.tables import Column, Table

_COARSE = 2.0  # s; no pendulum is sampled so seldom: such steps are of other units
_NAMES = {
    ("angle", 1): ("theta",),
    ("angle", 2): ("theta1", "theta2"),
    ("rate", 1): ("omega",),
    ("rate", 2): ("omega1", "omega2"),
    ("position", 2): ("x", "y"),
    ("position", 4): ("x1", "y1", "x2", "y2"),
    ("acceleration", 1): ("radial",),
}


def measurement_of(whole: Table, table: Table, asked: Asked, log: Log) -> Measurement:
    """The samples of a run.

    Args:
        whole: the table that the run stands in: columns of the same kind tell units.
        table: the run.
        asked: what is named.
        log: takes what was understood.

    Raises:
        ArgumentError: for what is missing, or could be one thing or another.
    """
    import numpy as np

    time = time_column(table, asked)
    if time is not None:
        table, log_rows = _with_times(table, time)
        time = next(each for each in table.columns if each.number == time.number)
        if log_rows:
            log.note(log_rows)
    t = seconds_of(table, time, asked, log)
    if asked.frame_rate is None:
        times.check_rising(t, table, str(time))
    picked = pick(table, time, t, asked, log)
    values, unit, geometry = _values(picked, whole, table, t, asked, log)
    again = asked.frame_rate is None or _is_frames(time)
    if again:
        t, kept = times.standing(t, values, log, table)
    else:
        t, kept = made_again(t, asked.frame_rate or 1.0, log), np.ones(t.size, dtype=bool)
    there = np.flatnonzero(np.isfinite(values).any(axis=1) & kept)
    if there.size < 2:
        raise ArgumentError("path", "holds fewer than two samples", "name other columns")
    ends = slice(int(there[0]), int(there[-1]) + 1)
    t, values = t[ends][kept[ends]], values[ends][kept[ends]]
    times.told(t, values, log)
    quantity = "acceleration" if picked.quantity == "force" else picked.quantity
    names = _NAMES[quantity, values.shape[1]]
    bodies = 2 if names[0].endswith("1") else 1
    return Measurement(
        t, np.ascontiguousarray(values), quantity, names, unit, bodies, geometry=geometry
    )


def _is_frames(time: Column | None) -> bool:
    return time is None or time.heading.kind == "frame"


def _with_times(table: Table, time: Column) -> tuple[Table, str]:
    """The rows that have a time, and what is to be told of those between that have none."""
    import numpy as np

    there = np.isfinite(time.values)
    kept = np.flatnonzero(there)
    if not kept.size:
        raise ArgumentError("time", "must name a column of numbers, got {text}", text=str(time))
    lost = int((~there[kept[0] : kept[-1]]).sum())
    note = f"{lost} rows without a time are left out." if lost else ""
    return (table if there.all() else table.rows(there)), note


def seconds_of(table: Table, time: Column | None, asked: Asked, log: Log) -> Array:
    """Times [s] of a table's rows, (n,): of its column of times, or counted frames.

    Raises:
        ArgumentError: without times and frame rate, or without a unit where seconds are unlikely.
    """
    import numpy as np

    if time is None or time.heading.kind == "frame" or _counts(time):
        return _of_frames(table, time, asked, log)
    log.took["time"] = name_in(table, time)
    written = asked.time_unit or (time.heading.written if time.heading.unit == "s" else "")
    known = header_unit(written) if written else None
    if asked.time_unit and (known is None or known[0] != "s"):
        rule = "must be a unit of time, got {value}"
        raise ArgumentError("time_unit", rule, "write <time_unit=ms>", value=asked.time_unit)
    if known is not None:
        log.took["time_unit"] = written
        log.note(f"Times from {time} [{written}].")
        return scaled(time.values, known[1])
    if np.nanmin(time.values) > SINCE_1970:
        log.note(f"Times from {time}, counted from 1970: from the first sample on.")
        return _from_first(time.values)
    steps = np.diff(time.values)
    usual = float(np.median(steps)) if steps.size else 0.0
    if usual > _COARSE and asked.frame_rate is None:
        rule = f"of the times in {time} is not told, and they go in steps of {usual:g}"
        raise ArgumentError("time_unit", rule, "say it with <time_unit=ms>, or <time_unit=s>")
    log.note(f"Times from {time}: no unit is told, seconds.")
    return time.values.copy()


def _from_first(stamps: Array) -> Array:
    """Seconds from the first of times that are counted from 1970 in s, ms, µs or ns."""
    import numpy as np

    size = float(np.log10(stamps[0]))
    thousands = max(0, round((size - 9.2) / 3))  # of today's 1.8e9 s
    return np.asarray((stamps - stamps[0]) / 1000.0**thousands)


def _counts(time: Column) -> bool:
    """Whether a column without a name counts rows one by one."""
    import numpy as np

    steps = np.diff(time.values)
    return not time.heading.kind and bool((steps == 1).all()) and steps.size > 3


def _of_frames(table: Table, time: Column | None, asked: Asked, log: Log) -> Array:
    """Times of counted frames.

    Raises:
        ArgumentError: without a frame rate.
    """
    import numpy as np

    if asked.frame_rate is None:
        if time is None:
            rule = "has no column of times"
            way_out = "name one with <time=1>, or give the frames per second with <frame_rate=30>"
        else:
            rule = f"has no times, but counts frames in {time}"
            way_out = "give the frames per second with <frame_rate=30>"
        raise ArgumentError("path", rule, way_out)
    log.took["frame_rate"] = asked.frame_rate
    if time is None:
        frames = np.arange(table.lines.size, dtype=np.float64)
        log.note(f"Times from rows, {asked.frame_rate:g} a second.")
    else:
        frames = time.values - time.values[0]
        log.took["time"] = name_in(table, time)
        log.note(f"Times from frames in {time}, {asked.frame_rate:g} a second.")
    return frames / asked.frame_rate


def made_again(t: Array, rate: float, log: Log) -> Array:
    """Times of even frames in place of those in the file.

    Where the file's times are of that rate a gap in them stays one.
    """
    import numpy as np

    log.took["frame_rate"] = rate
    frames = np.arange(t.size, dtype=np.float64)
    usual = float(np.median(np.diff(t)))
    if abs(usual * rate - 1) < 0.02:
        counted = np.round((t - t[0]) * rate)
        if (np.diff(counted) > 0).all():
            frames = counted
    log.note(f"Times are made again from {rate:g} frames a second, as asked.")
    return np.asarray(t[0] + frames / rate)


def _values(
    picked: Picked, whole: Table, table: Table, t: Array, asked: Asked, log: Log
) -> tuple[Array, str, dict[str, float]]:
    """The values in SI units (n, m), their unit, and what the file says of the pendulum."""
    from dataclasses import replace

    if picked.quantity == "angle":
        kind = picked.columns[0].heading.kind
        alike = [each for each in whole.columns if kind and each.heading.kind == kind]
        alike = [each for each in alike if not each.heading.computed]
        values = angles_of(picked.columns, alike or picked.columns, asked, log)
        return values, "rad", {}
    if picked.quantity == "rate":
        return sensors.rates_of(picked.columns, t, asked, log), "rad/s", {}
    if picked.quantity == "force":
        log.took["radial"] = name_in(table, picked.columns[0])
        return sensors.of_force(picked.columns[0], asked, log), "m/s²", {}
    if picked.quantity == "acceleration":
        values, column = sensors.radial_of(picked.columns, table, t, asked, log)
        log.took["radial"] = name_in(table, column)
        return values, "m/s²", {}
    columns = [*picked.columns, *(picked.pivot or ())]
    way = asked.y_axis or picked.y_axis or None
    values, unit = positions_of(columns, replace(asked, y_axis=way), log)
    if picked.pivot is None:
        return values, unit, {}
    return values[:, :-2], unit, _pivot(values[:, -2:], picked, table, log)


def _pivot(at: Array, picked: Picked, table: Table, log: Log) -> dict[str, float]:
    """Where the point is that stands still; it is named with the others in what was taken."""
    import numpy as np

    assert picked.pivot is not None
    x, y = picked.pivot
    for name, column in (("x", x), ("y", y)):
        taken = log.took[name]
        taken = taken if isinstance(taken, tuple) else (taken,)
        log.took[name] = (*taken, name_in(table, column))
    log.note(f"The point ({x}, {y}) stands still: it is the pivot.")
    middle = np.nanmedian(at, axis=0)
    return {"pivot_x": float(middle[0]), "pivot_y": float(middle[1])}
