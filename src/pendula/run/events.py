"""Events that `solve` looks for inside its steps."""

from __future__ import annotations

import math
import operator
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula import _engine
from pendula._angles import warn_of_degrees
from pendula._checks import LARGEST_COUNT, extra, finite_number, flag, one_of, whole_number
from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    import pandas as pd
    from numpy.typing import NDArray

    from pendula._types import Array


_REST_OF_PI = math.sin(math.pi)  # π less the double nearest to it, to its last bit
MOST_RODS = max(each.can.degrees_of_freedom for each in _engine.system_entries().values())


class Crossings(NamedTuple):
    """Where an event took place.

    Attributes:
        times: in the order of the run, (k,) [s].
        states: at those times, (k, d) [rad, rad/s].
    """

    times: Array
    states: Array

    def to_pandas(self) -> pd.DataFrame:
        """A table with a row for each crossing; columns such as "theta [rad]" (extra: io)."""
        return crossings_table(self.states, {"t [s]": self.times})


def crossings_table(states: Array, first: Mapping[str, NDArray[Any]]) -> pd.DataFrame:
    """A table of crossings: other columns, then the components of the states (k, d)."""
    pandas = extra("pandas", "io")
    entries = _engine.system_entries().values()  # those of one dimension name their states alike
    components = next(e.components for e in entries if len(e.components) == states.shape[1])
    labels = [f"{each.name} [{each.unit}]" for each in components]
    table: pd.DataFrame = pandas.DataFrame({**first, **dict(zip(labels, states.T, strict=True))})
    return table


@dataclass(frozen=True)
class Event:
    """What to look for; made by `angle`, `flip`, `velocity_zero` and `tip_height`.

    Attributes:
        kind: "angle", "velocity_zero" or "tip_height".
        index: of the rod, from 1; 0 for the tip.
        value: that is passed, [rad] or [m].
        every_turn: whether an angle also passes it whole turns away.
        direction: 1: growing with time, −1: falling, 0: both.
        terminal: so many of them end the run; 0: none does.
    """

    kind: str
    index: int = 0
    value: float = 0.0
    every_turn: bool = False
    direction: int = 0
    terminal: int = 0

    def for_core(self) -> _engine.Event:
        """The event as the core takes it."""
        tail = _REST_OF_PI if self.every_turn and self.value == math.pi else 0.0
        kind, index = _engine.EVENT_KINDS.index(self.kind), max(self.index - 1, 0)
        return _engine.Event(
            kind, index, self.value, tail, self.every_turn, self.direction, self.terminal
        )


def angle(
    i: int,
    value: float,
    direction: int = 0,
    terminal: bool | int = False,
    *,
    every_turn: bool = False,
) -> Event:
    """The angle of rod i passes a value.

    Args:
        i: the rod, from 1 (the simple pendulum has one).
        value: of the angle, which is never wrapped [rad].
        direction: 1: growing with time, −1: falling, 0: both.
        terminal: True ends the run at the first, a number n at the nth.
        every_turn: also count the value and any number of whole turns.

    Raises:
        ValueError: for an argument out of range.
    """
    passed = finite_number("value", value, "rad")
    warn_of_degrees("value", value, passed)
    return _event("angle", i, passed, direction, terminal, every_turn)


def flip(i: int, direction: int = 0, terminal: bool | int = False) -> Event:
    """Rod i passes the top: its angle π and any number of whole turns, π itself, not its double.

    The first is the one next to the start, ±π beyond the lowest point of the rod's own turn.
    Arguments and errors are those of `angle`.
    """
    return _event("angle", i, math.pi, direction, terminal, True)


def velocity_zero(i: int, direction: int = 0, terminal: bool | int = False) -> Event:
    """The angular velocity of rod i passes zero; a start at rest is none.

    Arguments and errors are those of `angle`.
    """
    return _event("velocity_zero", i, 0.0, direction, terminal, False)


def tip_height(y: float, direction: int = 0, terminal: bool | int = False) -> Event:
    """The bob, or the end of the last rod, passes the height y above the pivot [m].

    The other arguments and errors are those of `angle`.
    """
    height = finite_number("y", y, "m")
    return Event("tip_height", 0, height, False, _direction(direction), _terminal(terminal))


def checked_events(events: object, name: str = "events") -> tuple[Event, ...]:
    """The events, if they are any; the core looks at whether a system can have them.

    Raises:
        ValueError: for anything else.
    """
    if isinstance(events, Event | str):
        events = (events,)
    try:
        found: tuple[Any, ...] = tuple(events)  # type: ignore[arg-type]
    except TypeError:
        found = (events,)
    for each in found:
        if not isinstance(each, Event):
            rule = (
                "must be made by pendula.events: angle, flip, velocity_zero or tip_height; "
                "got {value}"
            )
            raise ArgumentError(name, rule, value=each)
    return found


def described(event: Event) -> dict[str, Any]:
    """The event as data, which `event_from` takes back."""
    return asdict(event)


def event_from(data: dict[str, Any]) -> Event:
    """The event of its attributes, as files carry them.

    Raises:
        TypeError, ValueError: for attributes that no event has.
    """
    made = Event(**data)
    return Event(
        one_of("kind", made.kind, _engine.EVENT_KINDS),
        whole_number("index", made.index, MOST_RODS) if made.index != 0 else 0,
        finite_number("value", made.value),
        flag("every_turn", made.every_turn),
        _direction(made.direction),
        _terminal(made.terminal),
    )


def crossings_of(found: Iterable[_engine.Crossings], dimension: int) -> tuple[Crossings, ...]:
    """What the core found of each event."""
    return tuple(Crossings(each.times, each.states(dimension)) for each in found)


def _event(
    kind: str, i: int, value: float, direction: int, terminal: bool | int, every_turn: bool
) -> Event:
    index = _rod(i)
    return Event(kind, index, value, bool(every_turn), _direction(direction), _terminal(terminal))


def _rod(i: object) -> int:
    """The number of a rod, from 1."""
    numbers = range(1, MOST_RODS + 1)
    try:
        rod = 0 if isinstance(i, bool) else operator.index(i)  # type: ignore[arg-type]
    except TypeError:
        rod = 0
    if rod not in numbers:
        rule = "must be {any_of}, counted from the pivot (a simple pendulum has rod 1); got {value}"
        raise ArgumentError("i", rule, any_of=list(numbers), value=i)
    return rod


def _direction(direction: object) -> int:
    if direction not in (-1, 0, 1) or isinstance(direction, bool):
        rule = "must be 1 (growing with time), -1 (falling) or 0 (both), got {value}"
        raise ArgumentError("direction", rule, value=direction)
    return int(direction)


def _terminal(terminal: bool | int) -> int:
    if isinstance(terminal, bool):
        return int(terminal)
    return 0 if terminal == 0 else whole_number("terminal", terminal, LARGEST_COUNT)
