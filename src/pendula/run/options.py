"""The options of a run, each stated once; the core's rows say units, ranges and meanings."""

from __future__ import annotations

import inspect
import textwrap
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Final, TypedDict, cast

from pendula import _engine
from pendula._checks import number, whole_number
from pendula._messages import meant
from pendula.run.events import Event, checked_events, described, event_from

if TYPE_CHECKING:
    from typing import TypeVar

    Function = TypeVar("Function", bound=Callable[..., Any])


class RunOptions(TypedDict, total=False):
    """The keyword options of `solve`, `ensemble` and others, for type checkers."""

    step: float | None
    tolerance: float | None
    max_steps: int | None
    certify: float | None
    digits: int | None
    events: Event | Iterable[Event]


@dataclass(frozen=True, kw_only=True)
class Options:
    """The options of one run, or of all runs of an ensemble.

    Attributes:
        step: of a fixed-step method [s].
        tolerance: of an adaptive method; None: machine precision.
        max_steps: most steps allowed; None: no limit.
        certify: angle by which the run may be off up to its trust horizon [rad].
        digits: that are right at every output time.
        events: looked for inside the steps.
    """

    step: float | None = None
    tolerance: float | None = None
    max_steps: int | None = None
    certify: float | None = None
    digits: int | None = None
    events: tuple[Event, ...] = ()

    @property
    def options(self) -> RunOptions:
        """These options as the arguments of `solve`."""
        return cast("RunOptions", {name: getattr(self, name) for name in NAMES})

    def numbers(self) -> dict[str, Any]:
        """All but the events, by name."""
        return {name: getattr(self, name) for name in NAMES if name != "events"}

    def described(self) -> dict[str, Any]:
        """The options as data that JSON can hold; `options_from` takes it back."""
        return {**self.numbers(), "events": [described(each) for each in self.events]}


ROWS = {row.name: row for row in _engine.option_rows()}
STANDARD_METHOD: Final = "taylor"  # of runs for which none is named
BEST_TOLERANCE = ROWS["tolerance"].least
NAMES = tuple(each.name for each in fields(Options))


def options_from(data: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of `Options` of their description; what earlier versions left out is not set.

    Raises:
        TypeError, ValueError: for what is no number, no whole number, or no event.
    """
    known = {name: data.get(name) for name in NAMES}
    events = tuple(map(event_from, data.get("events") or ()))
    return checked_types({**known, "events": events}, "options_from")


def checked_types(
    given: Mapping[str, Any], function: str, taken: Iterable[str] = NAMES
) -> dict[str, Any]:
    """The fields of `Options` from the arguments of a function, as numbers and events.

    Raises:
        TypeError: for an option that the function does not take.
        ValueError: for what is no number, no whole number, or no event.
    """
    for name in given:
        if name not in taken:
            hint = meant(name, taken)
            told = f"{function}() got an unexpected keyword argument {name!r}"
            raise TypeError(f"{told}; {hint}" if hint else told)
    return {
        **{
            row.name: _number_of(row, given[row.name])
            for row in ROWS.values()
            if given.get(row.name) is not None
        },
        "events": checked_events(given.get("events", ())),
    }


def _number_of(row: _engine.OptionRow, value: object) -> float | int:
    """A value as the core's number; whole ones have to be in range to be one."""
    if row.whole:
        return whole_number(row.name, value, int(row.most))
    return number(row.name, value, row.unit)


def takes_options(*names: str, **otherwise: str) -> Callable[[Function], Function]:
    """Give a function that takes **options these options in its signature and its help.

    Args:
        *names: the options that it takes; none: all.
        **otherwise: what the function does without an option, where that is not what runs do.
    """
    taken = names or NAMES

    def with_options(function: Function) -> Function:
        signature = inspect.signature(function)
        kept = [each for each in signature.parameters.values() if each.kind is not each.VAR_KEYWORD]
        options = [
            inspect.Parameter(
                each.name,
                inspect.Parameter.KEYWORD_ONLY,
                default=each.default,
                annotation=RunOptions.__annotations__[each.name].__forward_arg__,
            )
            for each in fields(Options)
            if each.name in taken
        ]
        function.__signature__ = signature.replace(parameters=[*kept, *options])  # type: ignore[attr-defined]
        lines = "\n".join(_lines(name, otherwise.get(name)) for name in taken)
        function.__doc__ = (function.__doc__ or "").replace(_MARKER, lines)
        return function

    return with_options


def _lines(name: str, otherwise: str | None) -> str:
    """The option's entry in a docstring, wrapped."""
    if name == "events":
        sentence = _EVENTS
    else:
        row = ROWS[name]
        unit = f" [{row.unit}]" if row.unit else ""
        default = otherwise or row.otherwise
        when = "" if default.startswith("required") else "None: "
        sentence = f"{name}: {row.meaning}{unit}; {when}{default}."
    indent = " " * 8
    return textwrap.fill(
        sentence, _WIDTH, initial_indent=indent, subsequent_indent=indent + " " * 4
    )


_MARKER = "        **options: see `RunOptions`."
_EVENTS = "events: what to look for inside the steps of an adaptive method: see `pendula.events`."
_WIDTH = 100
