"""`pendula solve`: a motion step by step."""

from __future__ import annotations

import math
import sys
from contextlib import nullcontext
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from pendula import _engine
from pendula.cli.groups import all_systems, one_each
from pendula.cli.options import start_of, start_options, system_of, system_options, value
from pendula.cli.progress import progress_bar
from pendula.cli.run import (
    check_count,
    check_outcome,
    deliver,
    file_options,
    seconds,
    spaced,
    spacing,
    span_of,
    start_time,
    target,
)

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pendula._engine import SystemEntry

_SHOWN = 20_000  # most outputs of a run that is only printed
_LONG = 10**7  # steps: a second or so


def _options(entry: SystemEntry) -> list[click.Parameter]:
    names = [each.name for each in _engine.methods() if entry.name in each.systems]
    return [
        *system_options(entry),
        *start_options(entry),
        start_time(),
        value("until", "time of the end", required=True),
        click.Option(
            ["--method"], type=click.Choice(names), required=True, help="see `pendula methods`"
        ),
        value("step", "of the method, such as 1ms", required=True),
        value("every", "time between outputs [each step]"),
        *file_options(),
    ]


def _solve(entry: SystemEntry, **given: Any) -> None:
    from pendula._checks import positive_number
    from pendula.solving import solve

    system, start = system_of(entry, given), start_of(entry, given)
    t0, until = seconds(given["t0"], "--t0"), seconds(given["until"], "--until")
    step = positive_number("--step", seconds(given["step"], "--step"), "s")
    out = target(given["out"], force=given["force"])
    times = _times(t0, until, step, given["every"], thin=out is None)
    with progress_bar() if _is_long(abs(until - t0) / step) else nullcontext() as told:
        progress = None if told is None else partial(told, given["method"])
        run = solve(system, start, times, given["method"], t0=t0, step=step, progress=progress)
    check_outcome(run, until)
    deliver(run, out, force=given["force"])


def _is_long(steps: float) -> bool:
    return steps >= _LONG and sys.stderr.isatty()


def _times(
    t0: float, until: float, step: float, every: str | None, *, thin: bool
) -> float | NDArray[np.float64]:
    """The outputs asked for; without --every each step, or of a printed run every so many steps."""
    from pendula.solving import MOST_STEPS

    span = span_of(t0, until)
    if span / step > MOST_STEPS:
        raise ValueError(f"--step must be larger for a span of {span!r} s, got {step!r} s")
    if every is not None:
        apart = spacing(every, span)
        check_count(span, apart, "--every")
        return spaced(t0, until, apart)
    if thin and span / step > _SHOWN:
        return spaced(t0, until, step * math.ceil(span / step / _SHOWN))
    check_count(span, step, "--step")
    return until


command = one_each("solve", "Solve a motion step by step.", all_systems(), _options, _solve)
