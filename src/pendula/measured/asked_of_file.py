"""What a person names of a file, and what was taken on the way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

from pendula._checks import (
    counted,
    finite_array,
    finite_number,
    flag,
    number_pair,
    one_of,
    positive_number,
)
from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from collections.abc import Sequence

    Name = int | str
    Names = int | str | Sequence[int | str]

_MOST_SWINGS = 10_000


@dataclass(frozen=True)
class Asked:
    """The arguments of `read`, checked; None: left to the file. See there."""

    time: Name | None = None
    angle: tuple[Name, ...] = ()
    rate: tuple[Name, ...] = ()
    x: tuple[Name, ...] = ()
    y: tuple[Name, ...] = ()
    radial: tuple[Name, ...] = ()
    length: Name | None = None
    amplitude: Name | None = None
    period: tuple[Name, ...] = ()
    unit: str | None = None
    time_unit: str | None = None
    frame_rate: float | None = None
    scale: float | None = None
    y_axis: str | None = None
    zero: str | None = None
    mass: float | None = None
    linear: bool | None = None
    swings: int | None = None
    run: str | None = None
    sheet: str | None = None
    t: tuple[float, float] | None = None
    outliers: str = "keep"
    leave_out: tuple[float, ...] = ()
    as_angle: bool = False

    @property
    def quantity(self) -> str:
        """What was named to be measured; empty: nothing."""
        named = [name for name in ("angle", "rate", "x", "radial", "period") if getattr(self, name)]
        if self.y and not self.x:
            named.append("y")
        if len(named) > 1:
            rule = f"cannot be named together with {named[1]}"
            way_out = "a measurement holds one quantity: name one of them"
            raise ArgumentError(named[0], rule, way_out)
        if named and named[0] in ("x", "y") and len(self.x) != len(self.y):
            rule = "must name as many columns as {other}, got {value}"
            raise ArgumentError("x", rule, other="y", value=len(self.x))
        return named[0] if named else ""


@dataclass
class Log:
    """What was taken, by the arguments' names, and a sentence for each thing understood."""

    took: dict[str, Any] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)

    def note(self, sentence: str) -> None:
        """Add a sentence, once."""
        if sentence not in self.notes:
            self.notes.append(sentence)


def checked(**given: Any) -> Asked:
    """The arguments of `read`, each of them of its kind.

    Raises:
        ArgumentError: for a value of another kind.
    """
    kept = {name: value for name, value in given.items() if value is not None}
    return Asked(**{name: _CHECKS[name](name, value) for name, value in kept.items()})


def window_of(value: Any) -> tuple[float, float]:
    """A start and an end, in that order [s].

    Raises:
        ArgumentError: for anything else.
    """
    start, end = number_pair("t", value, "must be a start and an end [s]", "s")
    if not start < end:
        rule = "must start before it ends, got {value}"
        raise ArgumentError("t", rule, value=(start, end))
    return finite_number("t", start), finite_number("t", end)


def _names(name: str, value: Any) -> tuple[Name, ...]:
    """One column, or several."""
    if isinstance(value, str | int):
        return (_name(name, value),)
    try:
        return tuple(_name(name, each) for each in value)
    except TypeError:
        raise _no_name(name, value) from None


def _name(name: str, value: Any) -> Name:
    if isinstance(value, bool) or not isinstance(value, str | int):
        raise _no_name(name, value)
    return value


def _no_name(name: str, value: Any) -> ArgumentError:
    rule = "must be a column's label, or its number from 1, got {value}"
    return ArgumentError(name, rule, value=value)


def _numbers(name: str, value: Any) -> tuple[float, ...]:
    """Times, however they are given."""
    return tuple(finite_array(name, value, "s").ravel().tolist())


_CHECKS: dict[str, Callable[[str, Any], Any]] = {
    **dict.fromkeys(("angle", "rate", "x", "y", "radial", "period"), _names),
    **dict.fromkeys(("time", "length", "amplitude"), _name),
    **dict.fromkeys(("unit", "time_unit", "run", "sheet"), lambda _, value: str(value)),
    **dict.fromkeys(("linear", "as_angle"), flag),
    "frame_rate": partial(positive_number, unit="1/s"),
    "scale": partial(positive_number, unit="m"),
    "mass": partial(positive_number, unit="kg"),
    "swings": partial(counted, most=_MOST_SWINGS),
    "y_axis": partial(one_of, choices=("up", "down")),
    "zero": partial(one_of, choices=("down", "up")),
    "outliers": partial(one_of, choices=("keep", "leave out")),
    "t": lambda _, value: window_of(value),
    "leave_out": _numbers,
}
