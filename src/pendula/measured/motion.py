"""Which columns of a table hold the motion: times, and what was measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula._messages import ArgumentError
from pendula.measured.columns import name_in, named_column, shown
from pendula.measured.positions import inner_first, without_pivot
from pendula.measured.unnamed import in_order, is_time, points_among, rates_among

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.measured.asked_of_file import Asked, Log
    from pendula.measured.tables import Column, Table

SINCE_1970 = 1e8  # seconds, three years of them; no recording is as long
_HOW = "name it with <angle=2>, <rate=2>, <x=2> and <y=3>, or <radial=2>, by label or number"


@dataclass(frozen=True)
class Picked:
    """Columns of one quantity.

    Attributes:
        quantity: "angle", "rate", "position", "acceleration" or "force".
        columns: of it, of positions x and y in turn.
        pivot: x and y of a point that stands still.
        y_axis: which way y grows, where the columns had no names to say it; empty: not told.
    """

    quantity: str
    columns: tuple[Column, ...]
    pivot: tuple[Column, Column] | None = None
    y_axis: str = ""


def time_column(table: Table, asked: Asked) -> Column | None:
    """The column of times, or of frames; None: the table has none.

    Raises:
        ArgumentError: for several.
    """
    if asked.time is not None:
        return named_column(table, "time", asked.time)
    measured = [each for each in table.columns if not each.heading.computed]
    for kind in ("time", "frame", "period"):
        found = [each for each in measured if each.heading.kind == kind]
        rising = [each for each in found if is_time(each)] if kind != "time" else found
        rising = [each for each in rising if not _is_clock(each)] or rising
        if len(rising) > 1:
            rising = [each for each in rising if each.heading.unit == "s"] or rising
        if len(rising) > 1 and not _are_alike(rising):
            rule = "could be either of two columns or more: {text}"
            way_out = f"name one with <time={name_in(table, rising[0])}>"
            raise ArgumentError("time", rule, way_out, text=shown(rising, table))
        if rising:
            return rising[0]
    unknown = [each for each in measured if not each.heading.kind and not each.heading.written]
    return next((each for each in unknown if is_time(each)), None)


def _is_clock(column: Column) -> bool:
    """Whether times are counted from 1970, in whatever unit: others beside them are meant."""
    import numpy as np

    return bool(np.nanmin(column.values) > SINCE_1970)


def pick(table: Table, time: Column | None, t: Array, asked: Asked, log: Log) -> Picked:
    """The columns of what was measured.

    Args:
        table: of one run.
        time: its column of times; None: they were counted from frames.
        t: times, (n,).
        asked: names of columns, before anything else.
        log: takes what was understood.

    Raises:
        ArgumentError: for none, or several quantities that may be meant.
    """
    if asked.quantity:
        found = _named(table, asked)
    else:
        rest = [each for each in table.columns if time is None or each.number != time.number]
        found = _known(table, rest, log) or _unknown(table, rest, t, log)
    names = [name_in(table, each) for each in found.columns]
    if found.quantity == "position":
        log.took |= {"x": _one_or_all(names[::2]), "y": _one_or_all(names[1::2])}
    elif found.quantity in ("angle", "rate"):
        log.took[found.quantity] = _one_or_all(names)
    return found


def _one_or_all(names: list[int | str]) -> int | str | tuple[int | str, ...]:
    return names[0] if len(names) == 1 else tuple(names)


def _named(table: Table, asked: Asked) -> Picked:
    """The columns that were named."""
    quantity = asked.quantity
    if quantity in ("x", "y"):
        pairs = [
            (named_column(table, "x", x), named_column(table, "y", y))
            for x, y in zip(asked.x, asked.y, strict=True)
        ]
        moving, pivot = without_pivot(pairs)
        _at_most("x", len(moving), 2)
        return Picked("position", tuple(each for pair in moving for each in pair), pivot)
    names = getattr(asked, quantity)
    _at_most(quantity, len(names), {"angle": 2, "rate": 3, "radial": 1}.get(quantity, 1))
    columns = tuple(named_column(table, quantity, name) for name in names)
    if quantity == "radial":
        kind = "force" if columns[0].heading.kind == "force" else "acceleration"
        return Picked(kind, columns)
    return Picked(quantity, columns)


def _never_turns(column: Column) -> bool:
    """Whether numbers rise all the way, or fall."""
    import numpy as np

    steps = np.diff(column.values[np.isfinite(column.values)])
    return bool((steps > 0).all() or (steps < 0).all())


def _at_most(argument: str, count: int, most: int) -> None:
    if count > most:
        rule = f"must name at most {most} columns, got {{value}}"
        raise ArgumentError(argument, rule, value=count)


def _known(table: Table, rest: Sequence[Column], log: Log) -> Picked | None:
    """The columns whose headers say what they are; None: none does."""
    left = [each for each in rest if each.heading.computed]
    if left:
        log.note(f"Left out as computed, not measured: {', '.join(map(str, left))}.")
    measured = [each for each in rest if each not in left]

    def of(kind: str) -> list[Column]:
        found = [each for each in measured if each.heading.kind == kind]
        found = [each for each in found if not each.heading.absolute]
        return [each for each in found if not each.heading.weak] or found

    angles, rates, points = of("angle"), of("rate"), _points(of("x"), of("y"))
    chosen: Picked | None = None
    if angles and len(points) <= len(angles):
        chosen = Picked("angle", _bodies(table, "angle", angles))
    elif points:
        chosen = _of_points(table, points)
    elif rates:
        axes = {each.heading.axis for each in rates}
        three = len(rates) == 3 and axes == {"x", "y", "z"}
        chosen = Picked("rate", tuple(rates) if three else _bodies(table, "rate", rates))
    elif of("acceleration"):
        chosen = Picked("acceleration", tuple(of("acceleration")))
    elif of("force"):
        chosen = Picked("force", tuple(of("force")[:1]))
    if chosen:
        others = [each for each in measured if each not in chosen.columns]
        kept = ", ".join(f"{each}" for each in chosen.columns)
        beside = f"; not used: {', '.join(map(str, others))}" if others else ""
        log.note(f"{chosen.quantity.capitalize()} from {kept}{beside}.")
    return chosen


def _bodies(table: Table, kind: str, columns: list[Column]) -> tuple[Column, ...]:
    """The column of the one body, or those of two.

    Raises:
        ArgumentError: where there are more columns than bodies.
    """
    distinct = list["Column"]()
    for each in columns:
        if not any(_are_alike([each, other]) for other in distinct):
            distinct.append(each)
    if len(distinct) == 1:
        return tuple(distinct)
    indices = [each.heading.index for each in distinct]
    if len(distinct) == 2 and sorted(indices) in (["1", "2"], ["a", "b"]):
        return tuple(sorted(distinct, key=lambda each: each.heading.index))
    names = [name_in(table, each) for each in distinct]
    rule = f"could be one of {len(distinct)} columns: {{text}}"
    both = f", or two bodies' with <{kind}={names[0]},{names[1]}>"
    raise ArgumentError(
        kind, rule, f"name one with <{kind}={names[0]}>{both}", text=shown(distinct, table)
    )


def _are_alike(columns: Sequence[Column]) -> bool:
    """Whether columns hold the same, in another unit at most."""
    import numpy as np

    first = columns[0].values
    for each in columns[1:]:
        there = np.isfinite(first) & np.isfinite(each.values)
        a, b = first[there], each.values[there]
        if a.size < 2 or not a.any() or not b.any():
            return False
        at = int(np.argmax(np.abs(a)))
        if np.abs(b / b[at] - a / a[at]).max() > 1e-3 if b[at] else True:
            return False
    return True


def _points(xs: list[Column], ys: list[Column]) -> list[tuple[Column, Column]]:
    """X and y that belong together: by what names their point, else in their order."""
    keys = [(each.group, each.heading.index, each.heading.axis) for each in xs]
    if len(set(keys)) == len(keys):
        by_key = {(each.group, each.heading.index): each for each in ys}
        pairs = [(x, by_key.get((x.group, x.heading.index))) for x in xs]
        found = [(x, y) for x, y in pairs if y is not None]
        if len(found) == len(xs):
            return sorted(found, key=lambda pair: pair[0].heading.index)
    return list(zip(xs, ys, strict=False))


def _of_points(table: Table, points: list[tuple[Column, Column]]) -> Picked:
    """One point that moves, or two; one that stands still is the pivot.

    Raises:
        ArgumentError: where more move.
    """
    moving, pivot = without_pivot(points)
    if len(moving) > 2:
        rule = f"could be of {len(moving)} points: {{text}}"
        names = [[name_in(table, pair[i]) for pair in moving] for i in (0, 1)]
        way_out = f"name one, or two, with <x={names[0][0]}> and <y={names[1][0]}>"
        text = shown([pair[0] for pair in moving], table)
        raise ArgumentError("x", rule, way_out, text=text)
    if len(moving) == 2:
        moving = inner_first(moving)
    return Picked("position", tuple(each for pair in moving for each in pair), pivot)


def _unknown(table: Table, rest: Sequence[Column], t: Array, log: Log) -> Picked:
    """What columns without a known name are, by what they do.

    Raises:
        ArgumentError: where they do not show it.
    """
    unknown = [each for each in rest if not each.heading.kind and not each.heading.written]
    if len(unknown) == 1:
        if _never_turns(unknown[0]):
            rule = f"holds no swing: {unknown[0]} rises all the way"
            way_out = "a table of periods is named with <length=1> and <period=2>"
            raise ArgumentError("path", rule, way_out)
        log.note(f"The angle is {unknown[0]}, the only column beside the times.")
        return Picked("angle", tuple(unknown))
    rates = rates_among(unknown, t)
    if rates and len(rates) * 2 == len(unknown) and len(rates) <= 2:
        angles = tuple(unknown[i] for i in sorted(rates))
        beside = ", ".join(str(unknown[j]) for j in rates.values())
        named = ", ".join(map(str, angles))
        log.note(f"Angles are {named}, as {beside} are their derivatives by time.")
        return Picked("angle", angles)
    pairs = points_among(unknown)
    if pairs:
        pairs, grows = in_order(pairs)
        moving, pivot = without_pivot(pairs)
        if len(moving) <= 2:
            points = ", ".join(f"({x}, {y})" for x, y in moving)
            beside = "" if pivot is None else f", the pivot ({pivot[0]}, {pivot[1]})"
            log.note(f"Positions (x, y) are {points}{beside}, as they lie on circles.")
            columns = tuple(each for pair in moving for each in pair)
            return Picked("position", columns, pivot, grows)
    if not rest:
        raise ArgumentError("path", "holds a single column", "a motion needs times and angles")
    candidates = unknown or rest
    rule = "has no column that is known as an angle, a rate, a position or an acceleration: {text}"
    labels = ", ".join(repr(name_in(table, each)) for each in candidates)
    raise ArgumentError("path", rule, _HOW, text=labels)
