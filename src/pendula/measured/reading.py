"""Recordings from files, of whatever program wrote them."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pendula._messages import ArgumentError
from pendula.measured import times
from pendula.measured.asked_of_file import Asked, Log, checked
from pendula.measured.columns import MOTION, in_context, named_column, runs_of
from pendula.measured.files import tables_of
from pendula.measured.measurement import Measurement, PeriodTable
from pendula.measured.motion import time_column
from pendula.measured.samples import measurement_of, seconds_of
from pendula.measured.swings import gate_periods, is_period_table, period_table

if TYPE_CHECKING:
    from collections.abc import Sequence
    from os import PathLike

    from pendula.measured.asked_of_file import Name, Names
    from pendula.measured.tables import Table

_THRESHOLD = 6.0  # robust standard deviations, as `Measurement.outliers` has it


def read(
    path: str | PathLike[str],
    *,
    time: Name | None = None,
    angle: Names | None = None,
    rate: Names | None = None,
    x: Names | None = None,
    y: Names | None = None,
    radial: Name | None = None,
    length: Name | None = None,
    amplitude: Name | None = None,
    period: Names | None = None,
    unit: str | None = None,
    time_unit: str | None = None,
    frame_rate: float | None = None,
    scale: float | None = None,
    y_axis: str | None = None,
    zero: str | None = None,
    mass: float | None = None,
    linear: bool | None = None,
    swings: int | None = None,
    run: Name | None = None,
    sheet: str | None = None,
    t: tuple[float, float] | None = None,
    outliers: str | None = None,
    leave_out: Sequence[float] | None = None,
    as_angle: bool | None = None,
) -> Measurement | PeriodTable:
    """A recording of a pendulum, from a file of whatever program wrote it.

    Text tables of any usual dialect, exports of phyphox (CSV, also in a zip, .xls, .xlsx, saved
    states), Tracker (text, .trk, .trz), Vernier and PASCO, spreadsheets (.xls, .xlsx, .ods), MATLAB
    .mat files, Parquet and NetCDF; by what is in the file, whatever its name ends in. What each
    column was taken for is in the result's notes. Columns are named by their label, with or without
    its unit, or by their number from 1; two bodies by a pair of them.

    Args:
        path: of the file.
        time: column of times, or of frames.
        angle: column of angles.
        rate: column of angular rates; of a gyroscope's three axes the rate about the direction in
            which they vary most is taken.
        x: column of positions to the right; of a double pendulum those of both bobs, and of the
            pivot, if it was marked.
        y: column of positions along the vertical, as many as of x.
        radial: column of the acceleration, or force, along the string.
        length: column of lengths, in a table of periods.
        amplitude: column of amplitudes, in a table of periods.
        period: columns of periods, or of times of several swings.
        unit: of what was measured, such as "deg", "rad/s", "mm" or "px"; of lengths in a table of
            periods.
        time_unit: of the times, such as "ms".
        frame_rate: frames per second; times are made of it [1/s].
        scale: of a pixel [m].
        y_axis: "up" or "down": which way y grows in the file.
        zero: "down" or "up": where the angle is counted from; not told: it is taken as it is.
        mass: of the bob, for a force along its string [kg].
        linear: whether gravity is taken off the acceleration.
        swings: how many were timed at once.
        run: which of several.
        sheet: which of several, or which file in an archive.
        t: first and last time that are kept [s].
        outliers: "keep", or "leave out" those that `Measurement.outliers` shows.
        leave_out: times of samples that are left out [s].
        as_angle: whether positions are turned into angles, as `Measurement.as_angle` does.

    Returns:
        A motion, or a table of periods.

    Raises:
        ValueError: in one line what is missing or could be one thing or another, and how to say it.
        MissingExtraError: for a file that needs a package of the extra "fit" which is not there.
        OSError: for a file that cannot be read.
    """
    given = {name: each for name, each in locals().items() if name != "path"}
    asked = checked(**given)
    return _read(Path(path), asked)


def read_all(path: str | PathLike[str], **given: Any) -> dict[str, Measurement | PeriodTable]:
    """All runs of a file, by their names; of a file with one, that one, named "1".

    Args:
        path: of the file.
        **given: arguments of `read` but run.

    Raises:
        ValueError, MissingExtraError, OSError: as `read`.
    """
    asked = checked(**given)
    data = Path(path).read_bytes()
    tables = [in_context(table, table.name or Path(path).stem) for table in tables_of(data)]
    table = _table(tables, asked, Log())
    names = [] if is_period_table(table, asked) else list(_runs(table, asked, Log()))
    if len(names) < 2:
        return {"1": _read(Path(path), asked)}
    return {name: _read(Path(path), replace(asked, run=name)) for name in names}


def _read(path: Path, asked: Asked) -> Measurement | PeriodTable:
    """What the file holds, with all that is told of how it was read."""
    data = path.read_bytes()
    try:
        return _of_bytes(path, data, asked)
    except ArgumentError as error:
        if error.argument != "path":
            raise
        said = error.message
        details = {**said.details, "path": str(path)}
        raise ArgumentError("", f"{{path}} {said.rule}", said.way_out, **details) from None


def _of_bytes(path: Path, data: bytes, asked: Asked) -> Measurement | PeriodTable:
    log = Log()
    tables = [in_context(table, table.name or path.stem) for table in tables_of(data)]
    table = _table(tables, asked, log)
    log.notes += table.notes
    found: Measurement | PeriodTable
    if is_period_table(table, asked):
        found = period_table(table, asked, log)
    else:
        run = _run(table, asked, log)
        found = _gate(run, asked, log) or measurement_of(table, run, asked, log)
    found = replace(
        found,
        source=str(path),
        checksum=hashlib.sha256(data).hexdigest(),
        reading=log.took,
        notes=tuple(log.notes),
    )
    return found if isinstance(found, PeriodTable) else _narrowed(found, asked)


def _narrowed(found: Measurement, asked: Asked) -> Measurement:
    """The samples that are asked for."""
    import numpy as np

    if asked.t is not None:
        found = found.window(*asked.t)
    if asked.leave_out:
        found = found.without(np.isin(found.t, asked.leave_out))
    if asked.outliers == "leave out":
        found = found.without(found.outliers(_THRESHOLD))
    return found.as_angle() if asked.as_angle else found


def _gate(table: Table, asked: Asked, log: Log) -> PeriodTable | None:
    """Periods by a light barrier; None: the table holds something else."""
    gates = [each for each in table.columns if each.heading.kind == "gate"]
    if (
        not gates
        or asked.quantity
        or any(
            each.heading.kind in MOTION and each.heading.kind != "gate" for each in table.columns
        )
    ):
        return None
    time = time_column(table, asked)
    return gate_periods(seconds_of(table, time, asked, log), gates[0].values, log)


def _table(tables: list[Table], asked: Asked, log: Log) -> Table:
    """The table that is named, or the only one that holds a motion or periods.

    Raises:
        ArgumentError: for several, or a name that none has.
    """
    names = [table.name for table in tables]
    if asked.sheet is not None:
        for table in tables:
            if table.name == asked.sheet:
                log.took["sheet"] = asked.sheet
                return table
        if len(tables) == 1:
            rule = "cannot be {value}: the file has one table only"
            raise ArgumentError("sheet", rule, "leave it out", value=asked.sheet)
        rule = "must be one of {choices}, got {value}"
        raise ArgumentError("sheet", rule, choices=names, value=asked.sheet)
    useful = [table for table in tables if _is_useful(table, asked)] or tables
    if len(useful) > 1:
        rule = "holds {text}"
        each = f"{len(useful)} tables: {', '.join(repr(table.name) for table in useful)}"
        way_out = f"name one with <sheet={useful[0].name}>"
        raise ArgumentError("path", rule, way_out, text=each)
    if len(tables) > 1:
        log.took["sheet"] = useful[0].name
        log.note(f"Table {useful[0].name!r}, of {', '.join(map(repr, names))}.")
    return useful[0]


def _is_useful(table: Table, asked: Asked) -> bool:
    """Whether the headers say that it holds a motion or periods."""
    kinds = {each.heading.kind for each in table.columns}
    moves = bool(kinds & {*MOTION}) and bool(kinds & {"time", "frame"})
    return moves or is_period_table(table, asked)


def _run(table: Table, asked: Asked, log: Log) -> Table:
    """The run that is named, or the only one.

    Raises:
        ArgumentError: for several, or a name that none has.
    """
    runs = _runs(table, asked, log)
    if len(runs) == 1 and asked.run is None:
        return next(iter(runs.values()))
    if asked.run in runs:
        log.took["run"] = int(asked.run) if asked.run.isdigit() else asked.run
        log.note(f"Run {asked.run}, of {len(runs)}.")
        return runs[asked.run]
    names = list(runs)
    if asked.run is None:
        rule = f"holds {len(runs)} runs: {{text}}"
        way_out = f"name one with <run={names[0]}>"
        raise ArgumentError("path", rule, way_out, text=", ".join(names))
    raise ArgumentError("run", "must be one of {choices}, got {value}", choices=names,
                        value=asked.run)  # fmt: skip


def _runs(table: Table, asked: Asked, log: Log) -> dict[str, Table]:
    """Runs side by side, or one below the other, by their names."""
    import numpy as np

    beside = runs_of(table)
    if len(beside) > 1:
        if asked.time is not None and asked.run is None:
            time = named_column(table, "time", asked.time)
            return {
                name: each
                for name, each in beside.items()
                if any(one.number == time.number for one in each.columns)
            }
        return beside
    found = time_column(table, asked)
    if found is None or found.heading.kind == "frame":
        return {"1": table}
    rows = table.rows(np.isfinite(found.values))
    t = found.values[np.isfinite(found.values)]
    below = times.stacked(t)
    return {str(i): rows.rows(each) for i, each in enumerate(below, start=1)}
