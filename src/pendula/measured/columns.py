"""Which columns are meant: those that are named, and those of each run."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING

from pendula._messages import ArgumentError, meant
from pendula.measured.headings import sensor_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pendula.measured.asked_of_file import Name
    from pendula.measured.tables import Column, Table

_UNIT = re.compile(r"\s*[(\[][^)\]]*[)\]]")
MOTION = ("angle", "rate", "x", "y", "acceleration", "force", "gate")


def named_column(table: Table, argument: str, name: Name) -> Column:
    """The column of a label, or of a number from 1.

    Raises:
        ArgumentError: for none, or several.
    """
    text = str(name).strip()
    found = [each for each in table.columns if each.label and each.label == text]
    if not found and text.isdigit():
        found = [each for each in table.columns if each.number == int(text)]
    if not found:
        wanted = _bare(text)
        found = [each for each in table.columns if wanted in _called(each)]
    if len(found) == 1:
        return found[0]
    labels = [each.label or str(each.number) for each in table.columns]
    if found:
        places = tuple(each.number for each in found)
        rule = "names several columns with {value}, those of numbers {text}"
        way_out = f"name one by its number, <{argument}={places[0]}>"
        raise ArgumentError(argument, rule, way_out, value=name, text=_listed(places))
    rule = "must be one of the columns {choices}, got {value}"
    raise ArgumentError(argument, rule, meant(text, labels), choices=labels, value=name)


def name_in(table: Table, column: Column) -> Name:
    """How `read` finds the column again: its label, or its number where the label is no one's."""
    labels = Counter(each.label for each in table.columns)
    plain = column.label and labels[column.label] == 1 and not column.label.strip().isdigit()
    return column.label if plain else column.number


def shown(columns: Iterable[Column], table: Table) -> str:
    """Columns as a way out offers them: 'theta1' or 'theta2'."""
    return " or ".join(repr(name_in(table, each)) for each in columns)


def in_context(table: Table, name: str) -> Table:
    """The table, whose x, y and z are axes of the sensor that its file is named after."""
    kind = sensor_of(name)
    axes = {each.heading.axis for each in table.columns if each.heading.kind in ("x", "y", "other")}
    if not kind or not {"x", "y", "z"} <= axes:
        return table
    return table.of(
        replace(each, heading=replace(each.heading, kind=kind.kind, linear=kind.linear))
        if each.heading.axis and each.heading.kind in ("x", "y", "other")
        else each
        for each in table.columns
    )


def runs_of(table: Table) -> dict[str, Table]:
    """The runs that stand side by side, by their names; one without a name: there is one only."""
    times = [each for each in table.columns if each.heading.kind == "time"]
    moving = [each for each in table.columns if each.heading.kind in (*MOTION, "")]
    if len(times) > 1:
        runs = _by_name(table, times) or _by_place(table, times)
        runs = {name: each for name, each in runs.items() if any(c in moving for c in each.columns)}
        return runs if len(runs) > 1 else {"": table}
    return _of_one_time(table, times, moving) or {"": table}


def _by_name(table: Table, times: Sequence[Column]) -> dict[str, Table]:
    """Runs whose columns all name the run they are of; none, where not all do."""
    names = [_run_named(each) for each in times]
    if not all(names) or len(set(names)) < len(names):
        return {}
    return {
        name: table.of(each for each in table.columns if _run_named(each) == name) for name in names
    }


def _by_place(table: Table, times: Sequence[Column]) -> dict[str, Table]:
    """Runs each of which begins with its times."""
    starts = [each.number for each in times]
    ends = [*starts[1:], max(each.number for each in table.columns) + 1]
    return {
        str(i): table.of(each for each in table.columns if start <= each.number < end)
        for i, (start, end) in enumerate(zip(starts, ends, strict=True), start=1)
    }


def _of_one_time(
    table: Table, times: Sequence[Column], moving: Sequence[Column]
) -> dict[str, Table]:
    """Runs that share their times: each quantity is there for each of several runs."""
    measured = [each for each in moving if each.heading.kind and not each.heading.computed]
    name_of = _run if all(map(_run, measured)) else _index
    names = list(dict.fromkeys(map(name_of, measured)))
    turning = all(each.heading.kind in ("angle", "rate") for each in measured)
    fewest = 2 if name_of is _run else 3 if turning else len(measured) + 1  # two: of two bodies
    if len(names) < fewest or "" in names or not times:
        return {}
    kinds = Counter((each.heading.kind, each.heading.axis) for each in measured)
    if any(count % len(names) for count in kinds.values()):
        return {}
    return {
        name: table.of([*times, *(each for each in measured if name_of(each) == name)])
        for name in names
    }


def _run(column: Column) -> str:
    return column.heading.run


def _index(column: Column) -> str:
    return column.heading.index


def _run_named(column: Column) -> str:
    return column.heading.run or column.heading.index


def _called(column: Column) -> set[str]:
    """The ways in which a label can be written, without case, unit and blanks."""
    label = column.label
    bare = _UNIT.sub("", label)
    return {_bare(each) for each in (label, bare, f"{column.group} {bare}")} - {""}


def _bare(text: str) -> str:
    return " ".join(text.lower().split())


def _listed(numbers: Sequence[int]) -> str:
    return ", ".join(map(str, numbers))
