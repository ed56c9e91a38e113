"""`pendula period`: the period against the amplitude."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from pendula.cli.groups import one_each
from pendula.cli.options import start_of, start_options, system_of, system_options, value
from pendula.cli.tables import table
from pendula.systems import systems_that

if TYPE_CHECKING:
    from fractions import Fraction

    from pendula._engine import SystemEntry


def _options(entry: SystemEntry) -> list[click.Parameter]:
    return [
        *system_options(entry),
        value("amplitude", "amplitude(s), e.g. 30deg,60deg"),
        *start_options(entry),
    ]


def _period(entry: SystemEntry, **given: Any) -> None:
    from pendula.units import half_turns

    system: Any = system_of(entry, given)
    names = [row.name for row in entry.components]
    small = 2.0 * math.pi / system.natural_frequency
    if (given["amplitude"] is None) == all(given[name] is None for name in names):
        raise ValueError(
            "give amplitudes with --amplitude 30deg,60deg, or a state with --theta and --omega"
        )
    if given["amplitude"] is None:
        state = start_of(entry, given)
        standing = state[1] == 0.0 and given["theta"] is not None
        period = (
            math.inf
            if standing and _is_top(system, half_turns(given["theta"], "theta")[0])
            else float(system.period(state=state))
        )
        row = (*map(repr, state), repr(period), repr(period / small))
        click.echo(table(("theta [rad]", "omega [rad/s]", "period [s]", "T/T0"), [row]))
        return
    click.echo(
        table(
            ("amplitude", "amplitude [rad]", "period [s]", "T/T0"),
            _of_swings(system, given["amplitude"], small),
        )
    )


def _of_swings(system: Any, texts: str, small: float) -> list[tuple[str, ...]]:
    from pendula.units import half_turns, quantities

    amplitudes = quantities(texts, "rad", "amplitude")
    periods = [
        math.inf if _is_top(system, turns) else float(period)
        for turns, period in zip(
            half_turns(texts, "amplitude"), system.period(amplitudes), strict=True
        )
    ]
    return [
        ("".join(text.split()), repr(amplitude), repr(period), repr(period / small))
        for text, amplitude, period in zip(texts.split(","), amplitudes, periods, strict=True)
    ]


def _is_top(system: Any, half_turns: Fraction) -> bool:
    """Whether an angle is π itself, or turns more: the double nearest to it lies beside the top."""
    return system.can.periodic and half_turns.denominator == 1 and half_turns % 2 == 1


command = one_each(
    "period",
    "Period for an amplitude or a state, and its ratio to the small-angle period T0.",
    systems_that(lambda can: can.period),
    _options,
    _period,
    without="the {system} pendulum has no period as a function of amplitude; pendula solve "
    "{system} gives its motion",
)
