"""`pendula solve`: a motion step by step."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from pendula import _engine
from pendula.cli.events import EXAMPLES, event_of
from pendula.cli.groups import all_systems, one_each
from pendula.cli.options import start_of, start_options, system_of, system_options, value
from pendula.cli.progress import late_bar
from pendula.cli.run import (
    check_count,
    check_outcome,
    deliver,
    file_options,
    seconds,
    spacing,
    span_of,
    start_time,
    target,
)

if TYPE_CHECKING:
    from pendula._engine import SystemEntry
    from pendula._types import Array

_SHOWN = 20_000  # most outputs of a run that is only printed
_STANDARD = "taylor"


def _options(entry: SystemEntry) -> list[click.Parameter]:
    names = [each.name for each in _engine.methods()]  # one that does not take it says why
    return [
        *system_options(entry),
        *start_options(entry),
        start_time(),
        value("until", "end time", required=True),
        click.Option(
            ["--method"],
            type=click.Choice(names),
            default=_STANDARD,
            show_default=True,
            help="see `pendula methods`",
        ),
        value("step", "step size, e.g. 1ms (required by fixed-step methods)"),
        value("tolerance", "of adaptive methods, 1e-3 or less [default: machine precision]"),
        value("every", "time between outputs [default: every step]"),
        *_trust_options(),
        click.Option(
            ["events", "--event"],
            multiple=True,
            metavar="WORDS",
            help=f"event to find: {EXAMPLES}; may be repeated",
        ),
        *file_options(),
    ]


def _trust_options() -> list[click.Parameter]:
    return [
        value("certify", "also find until when every angle is accurate to this value, e.g. 1e-9"),
        click.Option(
            ["--digits"],
            type=int,
            metavar="N",
            help="guaranteed digits of every output, 1 to 15, however chaotic the motion",
        ),
    ]


def _solve(entry: SystemEntry, **given: Any) -> None:
    from pendula._checks import positive_number
    from pendula.run.solve import solve

    system, start = system_of(entry, given), start_of(entry, given)
    t0, until = seconds(given["t0"], "--t0"), seconds(given["until"], "--until")
    method, step = given["method"], None
    if given["step"] is not None:
        step = positive_number("--step", seconds(given["step"], "--step"), "s")
    asked: dict[str, Any] = {
        "tolerance": _number(given["tolerance"], "", "--tolerance"),
        "certify": _number(given["certify"], "rad", "--certify"),
        "digits": given["digits"],
        "events": [event_of(words) for words in given["events"]],
    }
    out = target(given["out"], force=given["force"])
    times = _times(t0, until, step, given["every"], thin=out is None)
    with late_bar(method) as progress:
        run = solve(system, start, times, method, t0=t0, step=step, progress=progress, **asked)
    check_outcome(run, until)
    deliver(run, out, force=given["force"])


def _number(text: str | None, unit: str, name: str) -> float | None:
    from pendula.units import quantity

    return None if text is None else quantity(text, unit, name)


def _times(
    t0: float, until: float, step: float | None, every: str | None, *, thin: bool
) -> float | Array:
    """The outputs asked for; without --every each step, or of a printed run every so many steps."""
    from pendula._checks import LARGEST_COUNT
    from pendula.run._times import spaced

    span = span_of(t0, until)
    if step is not None and span / step > LARGEST_COUNT:
        raise ValueError(f"--step must be larger for a span of {span!r} s, got {step!r} s")
    if every is not None:
        apart = spacing(every, span)
        check_count(span, apart, "--every")
        return spaced(t0, until, apart)
    if step is None:
        return until
    if thin and span / step > _SHOWN:
        return spaced(t0, until, step * math.ceil(span / step / _SHOWN))
    check_count(span, step, "--step")
    return until


command = one_each("solve", "Integrate a motion step by step.", all_systems(), _options, _solve)
