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
    from pendula._engine import SystemEntry


def _options(entry: SystemEntry) -> list[click.Parameter]:
    return [
        *system_options(entry),
        value("amplitude", "amplitude(s), e.g. 30deg,60deg"),
        *start_options(entry),
    ]


def _period(entry: SystemEntry, **given: Any) -> None:
    system: Any = system_of(entry, given)
    names = [row.name for row in entry.components]
    small = 2.0 * math.pi / system.natural_frequency
    if (given["amplitude"] is None) == all(given[name] is None for name in names):
        raise ValueError(
            "give amplitudes with --amplitude 30deg,60deg, or a state with --theta and --omega"
        )
    if given["amplitude"] is None:
        state = start_of(entry, given)
        period = float(system.period(state=state))
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
    from pendula.units import quantities

    amplitudes = quantities(texts, "rad", "amplitude")
    periods = [float(each) for each in system.period(amplitudes)]
    return [
        ("".join(text.split()), repr(amplitude), repr(period), repr(period / small))
        for text, amplitude, period in zip(texts.split(","), amplitudes, periods, strict=True)
    ]


command = one_each(
    "period",
    "Period for an amplitude or a state, and its ratio to the small-angle period T0.",
    systems_that(lambda can: can.period),
    _options,
    _period,
)
