"""The only importer of the compiled core: the catalogue, and batches in, arrays out.

Numpy is imported by the callers that make arrays, so that names, ranges and help are there at once.
"""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING, cast

from pendula import _core
from pendula._entries import (
    Capabilities,
    Component,
    Form,
    Method,
    OptionRow,
    Parameter,
    RuleRow,
    SystemEntry,
)

if TYPE_CHECKING:
    from pendula._types import Array


__all__ = [  # of what is defined elsewhere
    "Capabilities",
    "Component",
    "Form",
    "Method",
    "OptionRow",
    "Parameter",
    "RuleRow",
    "SystemEntry",
]

Description = _core.Description


@cache
def system_entries() -> dict[str, SystemEntry]:
    """The catalogue's systems by name."""
    entries = (
        SystemEntry(
            row["name"],
            tuple(Component(**component) for component in row["components"]),
            tuple(
                Form(form["name"], form["meaning"], tuple(map(_parameter, form["parameters"])))
                for form in row["forms"]
            ),
            Capabilities(**row["capabilities"]),
        )
        for row in _core.systems()
    )
    return {entry.name: entry for entry in entries}


def _parameter(row: dict[str, object]) -> Parameter:
    standard = cast("float", row["standard"])
    return Parameter(**{**row, "standard": None if math.isnan(standard) else standard})  # type: ignore[arg-type]


@cache
def methods() -> tuple[Method, ...]:
    """The catalogue's methods, in its order."""
    return tuple(
        Method(**{**row, "evaluations_per_step": row["evaluations_per_step"] or None})
        for row in _core.methods()
    )


@cache
def methods_by_name() -> dict[str, Method]:
    """The same by their names."""
    return {each.name: each for each in methods()}


def method_named(name: str) -> Method:
    """The method of that name, which has to exist."""
    return methods_by_name()[name]


@cache
def option_rows() -> tuple[OptionRow, ...]:
    """The options of a run, in the core's order."""
    return tuple(OptionRow(**row) for row in _core.option_rows())


def option_unit(name: str) -> str:
    """SI unit of an option of a run; empty: it has none, or is no such option."""
    return next((row.unit for row in option_rows() if row.name == name), "")


@cache
def rule_rows() -> dict[str, RuleRow]:
    """The rules of the core by their keys."""
    return {key: RuleRow(*sentences) for key, *sentences in _core.rule_rows()}


def describe(system: str, form: str, parameters: tuple[float, ...]) -> Description:
    """The description the core takes."""
    return Description(system, system_entries()[system].form_index(form), list(parameters))


@cache
def powers(system: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Names of what does work on a system, and of what turns its energy into heat."""
    works, heats = _core.powers(system)
    return tuple(works), tuple(heats)


def rhs(description: Description, states: Array, t: float) -> Array:
    """Time derivatives (..., d) of states (..., d)."""
    return _core.rhs(description, _rows(states), t).reshape(states.shape)


def positions(description: Description, states: Array) -> Array:
    """Positions (..., d/2, 2) of states (..., d) [m]."""
    found = _core.positions(description, _rows(states))
    return found.reshape(states.shape[:-1] + found.shape[1:])


def energies(description: Description, states: Array) -> tuple[Array, Array]:
    """Kinetic and potential energy of states (..., d), each (...) [J]."""
    kinetic, potential = _core.energies(description, _rows(states))
    return kinetic.reshape(states.shape[:-1]), potential.reshape(states.shape[:-1])


def _rows(states: Array) -> Array:
    """States (n, d) one after the other."""
    import numpy as np

    return np.ascontiguousarray(states.reshape(-1, states.shape[-1]))


def within_range_of_sine(states: Array) -> Array:
    """States (..., d) whose angles are the same directions, but small enough for the sine."""
    import numpy as np

    half = states.shape[-1] // 2
    if not (abs(states[..., :half]) >= LARGEST_ANGLE).any():
        return states
    reduced = states.copy()
    angles = np.ascontiguousarray(states[..., :half])
    reduced[..., :half] = _core.within_range_of_sine(angles.ravel()).reshape(angles.shape)
    return reduced


LARGEST_ANGLE = _core.largest_angle  # the sine ends there [rad]
LARGEST_LONG_ANGLE = _core.largest_long_angle  # a run with many digits ends there [rad]
ON_GRID = _core.on_grid  # of a spacing: a time nearer to the grid lies on it
MOST_OUTPUTS = _core.most_outputs  # of one run
series_order = _core.series_order
constants = _core.constants
scales = _core.scales
Event = _core.Event
EVENT_KINDS = tuple(_core.event_kinds())  # by number
Request = _core.Request
Fault = _core.Fault
check = _core.check
check_method = _core.check_method
check_options = _core.check_options
check_system = _core.check_system
solve = _core.solve
balance = _core.balance
derivatives = _core.derivatives
RunResult = _core.RunResult
RunDerivatives = _core.RunDerivatives
Crossings = _core.Crossings
Pieces = _core.Pieces
DenseOutput = _core.DenseOutput
OUTCOMES = tuple(_core.outcomes())  # how runs end, by number
ensemble = _core.ensemble
varied = _core.varied
EnsembleResult = _core.EnsembleResult
flips = _core.flips
SECOND_RUN_TOLERANCE = _core.second_run_tolerance  # of a map's cell
FLIP_AGREEMENT = _core.flip_agreement
trust_horizon = _core.trust_horizon
long_run = _core.long_run
long_run_digits = _core.long_run_digits
exact = _core.exact
exact_derivatives = _core.exact_derivatives
periods = _core.periods
actions = _core.actions
times_at = _core.times_at
LARGEST_START_ANGLE = _core.largest_start_angle  # of a closed form [rad]
LARGEST_START_SPEED = _core.largest_start_speed  # of a closed form [natural frequencies]
COUNTED_HALF_PERIODS = _core.counted_half_periods  # the same, of the linear pendulum
MOST_HALF_PERIODS = _core.most_half_periods  # of a closed form
machines = _core.machines
elliptic_K = _core.elliptic_K
elliptic_K_series = _core.elliptic_K_series
elliptic_E = _core.elliptic_E
elliptic_F = _core.elliptic_F
jacobi = _core.jacobi
