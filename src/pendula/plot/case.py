"""The case that a picture shows, in one line: the system, its parameters, energy, time."""

from __future__ import annotations

import json
import math
from itertools import groupby
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY
from pendula.systems import system_from

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array
    from pendula.plot.labels import Labels
    from pendula.systems import System

_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_SYMBOLS = {
    "gravity": "g",
    "length": "l",
    "mass": "m",
    "centre": "c",
    "inertia": "I",
    "viscous": "b",
    "viscous1": "b₁",
    "viscous2": "b₂",
    "coulomb": "τc",
    "coulomb1": "τc₁",
    "coulomb2": "τc₂",
    "quadratic": "d",
    "cubic": "r",
    "torque": "τ",
    "drive_frequency": "Ω",
    "drive_phase": "φ",
    "pivot_amplitude": "a",
    "pivot_frequency": "Ωp",
    "pivot_phase": "φp",
    "pivot_direction": "α",
}
_UNITS = {"m/s^2": "m/s²", "kg m^2": "kg m²", "N m s^2": "N m s²", "N m s^3": "N m s³"}


def case_of(
    system: System,
    words: Labels,
    values: Mapping[str, tuple[float, str]] | None = None,
    *,
    without: tuple[str, ...] = (),
) -> str:
    """The form, its parameters that are not 0, equal ones together; then symbols and values.

    Args:
        system: the pendulum.
        words: of the language.
        values: further ones with their units, by symbol.
        without: names of parameters that the picture shows along an axis.
    """
    given = system.parameters
    still = () if given.get("pivot_amplitude") else ("pivot_direction", "pivot_phase")
    rows = [
        (symbol_of(row.name), given[row.name], row.unit)
        for row in system._rows()
        if given[row.name] and row.name not in (*without, *still)
    ]
    rows += [(symbol, *each) for symbol, each in (values or {}).items()]
    parts = [
        " = ".join([*(each[0] for each in same), _with_unit(value, unit, words)])
        for (value, unit), same in groupby(rows, key=lambda row: (row[1], row[2]))
    ]
    return f"{_form(system, words)}: {'; '.join(parts)}"


def start_of(system: System, state: Array, words: Labels) -> str:
    """The state at the start, (d,), angles in degrees."""
    half = system.can.degrees_of_freedom
    numbers = ("",) if half == 1 else ("₁", "₂")
    parts = [
        f"θ{i} = {words.local(f'{math.degrees(each):.6g}')}°"
        for i, each in zip(numbers, state[:half].tolist(), strict=True)
    ]
    unit = "" if system.form == "scaled" else " rad/s"
    parts += [
        f"ω{i} = {words.local(f'{each:.6g}')}{unit}"
        for i, each in zip(numbers, state[half:].tolist(), strict=True)
    ]
    return "; ".join(parts)


def symbol_of(parameter: str) -> str:
    """How a parameter is written on a picture."""
    return _SYMBOLS.get(parameter, parameter.translate(_SUBSCRIPTS))


def axis_of(system: System, parameter: str) -> str:
    """How a parameter is written at an axis, with its unit."""
    unit = next((row.unit for row in system._rows() if row.name == parameter), "")
    written = _UNITS.get(unit, unit)
    return f"{symbol_of(parameter)} [{written}]" if written else symbol_of(parameter)


def stored_case(
    attributes: Mapping[Any, Any], words: Labels, values: Mapping[str, tuple[float, str]]
) -> str | None:
    """The case of a map with these attributes; None: they lack the system."""
    try:
        described = json.loads(attributes[KEY])["system"]
    except (KeyError, TypeError, ValueError):
        return None
    return case_of(system_from(described), words, values)


def _form(system: System, words: Labels) -> str:
    name = words.case[system.form or system.name]
    damped = system.name.startswith("damped")
    return words.case["joints"].format(form=name) if damped else name


def _with_unit(value: float, unit: str, words: Labels) -> str:
    text = words.local(f"{value:.6g}")
    return f"{text} {_UNITS.get(unit, unit)}".rstrip()
