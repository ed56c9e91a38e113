"""`pendula solve`: a motion step by step."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from pendula import _engine
from pendula.cli.events import EXAMPLES, check_events_file, event_of, write_found
from pendula.cli.groups import MethodChoice, one_each
from pendula.cli.options import (
    run_options,
    run_options_of,
    start_of,
    start_options,
    system_of,
    system_options,
    value,
)
from pendula.cli.progress import late_bar
from pendula.cli.run import check_outcome, deliver, file_options, seconds, start_time, target
from pendula.run._times import span_of, times_apart
from pendula.run.options import STANDARD_METHOD
from pendula.systems import systems_that

if TYPE_CHECKING:
    from pendula._engine import SystemEntry
    from pendula._types import Array

_SHOWN = 20_000  # most outputs of a run that is only printed


def _options(entry: SystemEntry) -> list[click.Parameter]:
    names = [each.name for each in _engine.methods()]  # one that does not take it says why
    return [
        *system_options(entry),
        *start_options(entry),
        start_time(),
        value("t_max", "end time", required=True),
        click.Option(
            ["--method"],
            type=MethodChoice(),
            metavar="NAME",
            default=STANDARD_METHOD,
            show_default=True,
            help=f"one of {', '.join(names)}: see `pendula methods`",
        ),
        value("every", "time between outputs [default: every step]"),
        *run_options(),
        click.Option(
            ["events", "--event"],
            multiple=True,
            metavar="WORDS",
            help=f"event to find: {EXAMPLES}; may be repeated",
        ),
        click.Option(
            ["--events-file"],
            type=click.Path(),
            metavar="FILE",
            help="write every event found to a .csv or .json file",
        ),
        *file_options(),
    ]


def _solve(entry: SystemEntry, **given: Any) -> None:
    from pendula.run.solve import solve

    system, start = system_of(entry, given), start_of(entry, given)
    t0, t_max = seconds(given, "t0"), seconds(given, "t_max")
    span_of(t0, t_max)
    options = run_options_of(given)
    options["events"] = [event_of(words) for words in given["events"]]
    out = target(given["out"], force=given["force"])
    events_file = check_events_file(given)
    if given["every"] is not None:
        times: float | Array = times_apart(t0, t_max, seconds(given, "every"))
    else:
        times = _own_times(t0, t_max, options.get("step"), thin=out is None)
    with late_bar(given["method"]) as progress:
        run = solve(system, start, times, given["method"], t0=t0, progress=progress, **options)
    check_outcome(run, t_max)
    deliver(run, out, force=given["force"])
    if events_file is not None:
        write_found(run, events_file, force=given["force"])
        click.echo(f"{events_file}: {sum(len(each.times) for each in run.events)} events")


def _own_times(t0: float, t_max: float, step: float | None, *, thin: bool) -> float | Array:
    """The end, for an output at each step; of a run that is printed, every so many steps."""
    from pendula._checks import LARGEST_COUNT
    from pendula.run._times import spaced

    steps = abs(t_max - t0) / step if step else 0.0
    if step and thin and _SHOWN < steps <= LARGEST_COUNT:  # more are refused with the step
        return spaced(t0, t_max, step * math.ceil(steps / _SHOWN))
    return t_max


command = one_each("solve", "Integrate a motion step by step.", systems_that(), _options, _solve)
