"""`pendula period`: the period against the amplitude."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from pendula.cli.groups import one_angle, one_each
from pendula.cli.options import system_of, system_options, value
from pendula.cli.tables import table

if TYPE_CHECKING:
    from pendula._engine import SystemEntry


def _options(entry: SystemEntry) -> list[click.Parameter]:
    return [
        *system_options(entry),
        value("amplitude", "one or a list, such as 30deg,60deg", required=True),
    ]


def _period(entry: SystemEntry, **given: Any) -> None:
    from pendula.units import quantities

    system: Any = system_of(entry, given)
    amplitudes = quantities(given["amplitude"], "rad", "--amplitude")
    periods = [float(each) for each in system.period(amplitudes)]
    small = 2.0 * math.pi / system.natural_frequency
    rows = [
        ("".join(text.split()), repr(amplitude), repr(period), repr(period / small))
        for text, amplitude, period in zip(
            given["amplitude"].split(","), amplitudes, periods, strict=True
        )
    ]
    click.echo(table(("amplitude", "amplitude [rad]", "period [s]", "T/T0"), rows))


command = one_each(
    "period",
    "Period for each amplitude, and its ratio to the small-angle period T0.",
    one_angle(),
    _options,
    _period,
)
