"""Options from the catalogue's rows, and the system and the start that they describe."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from pendula import _engine

if TYPE_CHECKING:
    from pendula._engine import Form, Parameter, SystemEntry
    from pendula.systems import System

    Given = dict[str, Any]


def value(name: str, help: str, *, required: bool = False) -> click.Option:
    """An option that takes a quantity."""
    return click.Option([name, _long(name)], metavar="VALUE", help=help, required=required)


def run_options(*names: str, otherwise: str = "") -> list[click.Parameter]:
    """The options of a run, from the core's rows.

    Args:
        *names: which; none: all.
        otherwise: what is done where one is not given; empty: what its row says.
    """
    return [
        click.Option(
            [row.name, _long(row.name)],
            metavar="N" if row.whole else "VALUE",
            type=int if row.whole else None,
            help=f"{row.meaning}, e.g. {row.example:.7g}{row.unit} [{otherwise or row.otherwise}]",
        )
        for row in _engine.option_rows()
        if row.name in names or not names
    ]


def run_options_of(given: Given) -> Given:
    """The options of a run that are given, as numbers in SI units."""
    from pendula.units import quantity

    return {
        row.name: given[row.name] if row.whole else quantity(given[row.name], row.unit, row.name)
        for row in _engine.option_rows()
        if given.get(row.name) is not None
    }


def range_of(text: str, name: str, unit: str, example: str) -> tuple[float, float]:
    """The ends of a range such as -180deg:180deg, in that unit.

    Raises:
        ValueError: for anything else, or an angle without a unit.
    """
    from pendula._messages import ArgumentError
    from pendula.units import quantity

    ends = text.split(":")
    if len(ends) != 2:
        raise ArgumentError(name, f"must be a range such as {example}, got {{value}}", value=text)
    low, high = (quantity(end, unit, name) for end in ends)
    return low, high


def system_options(entry: SystemEntry) -> list[click.Parameter]:
    """The form, where there are several, and the parameters of all forms."""
    flags = [
        click.Option(
            [_flag(form), f"--{form.name}"],
            is_flag=True,
            help=form.meaning + (" (default)" if form is entry.forms[0] else ""),
        )
        for form in entry.forms
        if len(entry.forms) > 1
    ]
    names = dict.fromkeys(row.name for form in entry.forms for row in form.parameters)
    return [*flags, *(value(name, _explained(entry, name)) for name in names)]


def start_options(entry: SystemEntry) -> list[click.Parameter]:
    """The components of the state at the start."""
    return [
        value(row.name, f"{row.meaning} {_standard(row.standard, row.unit)}")
        for row in entry.components
    ]


def system_of(entry: SystemEntry, given: Given) -> System:
    """The system that the options describe.

    Raises:
        ValueError: for parameters of another form, missing ones, or values out of range.
    """
    from pendula.systems import system_from
    from pendula.units import quantity

    form = _form(entry, given)
    rows = {row.name: row for row in form.parameters}
    for other in (row.name for each in entry.forms for row in each.parameters):
        if given[other] is not None and other not in rows:
            raise ValueError(_not_of_form(entry, form, other))
    missing = [f"--{row.name}" for row in form.parameters if row.needed and not given[row.name]]
    if missing:
        raise ValueError(f"--{form.name} needs {', '.join(missing)} too")
    values = {
        name: quantity(given[name], row.unit, name)
        for name, row in rows.items()
        if given[name] is not None
    }
    return system_from({"name": entry.name, "form": form.name, "parameters": values})


def start_of(entry: SystemEntry, given: Given) -> list[float]:
    """The state at the start."""
    from pendula.units import quantity

    return [
        row.standard if given[row.name] is None else quantity(given[row.name], row.unit, row.name)
        for row in entry.components
    ]


def _form(entry: SystemEntry, given: Given) -> Form:
    chosen = [form for form in entry.forms if given.get(_flag(form))]
    if len(chosen) > 1:
        names = " and ".join(f"--{form.name}" for form in chosen)
        raise ValueError(f"{names} exclude one another; name one of them")
    return chosen[0] if chosen else entry.forms[0]


def _long(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _flag(form: Form) -> str:
    return f"as_{form.name}"


def _not_of_form(entry: SystemEntry, form: Form, name: str) -> str:
    takers = [each for each in entry.forms if name in (row.name for row in each.parameters)]
    own = ", ".join(f"--{row.name}" for row in form.parameters)
    those = " or ".join(f"--{each.name}" for each in takers)
    return f"--{name} goes with {those}; --{form.name} takes {own}"


def _explained(entry: SystemEntry, name: str) -> str:
    """The meaning of a parameter, form by form where it differs."""
    forms: dict[str, list[str]] = {}  # by meaning
    for form in entry.forms:
        for row in form.parameters:
            if row.name == name:
                forms.setdefault(f"{row.meaning} {_default(row)}", []).append(form.name)
    if sum(map(len, forms.values())) == len(entry.forms) and len(forms) == 1:
        return next(iter(forms))
    return "; ".join(f"{', '.join(names)}: {meaning}" for meaning, names in forms.items())


def _default(row: Parameter) -> str:
    if row.standard is None:
        return f"[default: {row.same_as}]" if row.same_as else "[required]"
    return _standard(row.standard, row.unit)


def _standard(standard: float, unit: str) -> str:
    if unit == "rad":
        return f"[default: {math.degrees(standard):g} deg]"
    return f"[default: {standard:g} {unit}]"
