"""`pendula exact`: a motion in closed form."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula.cli.groups import one_each
from pendula.cli.naming import renaming
from pendula.cli.options import start_of, start_options, system_of, system_options, value
from pendula.cli.run import deliver, file_options, seconds, start_time, target
from pendula.run._times import EXACT_INTERVALS, span_of, times_apart
from pendula.systems import systems_that

if TYPE_CHECKING:
    import click

    from pendula._engine import SystemEntry
    from pendula._types import Array


def _options(entry: SystemEntry) -> list[click.Parameter]:
    return [
        *system_options(entry),
        *start_options(entry),
        start_time(),
        value("at", "output times, e.g. 1s,2s, in any order"),
        value("t_max", "end time (instead of --at)"),
        value(
            "every",
            f"with --t-max: time between outputs [default: 1/{EXACT_INTERVALS} of the span]",
        ),
        *file_options(),
    ]


def _exact(entry: SystemEntry, **given: Any) -> None:
    from pendula.run.exact import exact

    system, start = system_of(entry, given), start_of(entry, given)
    t0 = seconds(given, "t0")
    out = target(given["out"], force=given["force"])
    with renaming(t="t_max" if given["at"] is None else "at"):
        run = exact(system, start, _times(t0, given), t0=t0)
    deliver(run, out, force=given["force"], every_row=given["at"] is not None)


def _times(t0: float, given: dict[str, Any]) -> list[float] | Array:
    from pendula.units import quantities

    at, every = given["at"], given["every"]
    if (at is None) == (given["t_max"] is None) or (at is not None and every is not None):
        raise ValueError("name the times with --at 1s,2s or with --t-max 10s [--every 10ms]")
    if at is not None:
        return quantities(at, "s", "at")
    t_max = seconds(given, "t_max")
    return times_apart(t0, t_max, seconds(given, "every", span_of(t0, t_max) / EXACT_INTERVALS))


command = one_each(
    "exact",
    "Evaluate a motion in closed form.",
    systems_that(lambda can: can.closed_form),
    _options,
    _exact,
    without="the {system} pendulum has no closed form; use pendula solve {system}, "
    "with --digits 12 for guaranteed digits",
)
