"""How a run changes with its start and with the parameters of its system."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from pendula import _engine
from pendula._messages import ArgumentError, meant

if TYPE_CHECKING:
    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.run.trajectory import Trajectory
    from pendula.systems import System


class CrossingDerivatives(NamedTuple):
    """How the times and states of an event change.

    Attributes:
        times: (k, columns) [s per unit of what they are derived by].
        states: at the event, whose time changes too, (k, d, columns).
    """

    times: Array
    states: Array


def names_derived_by(system: str, form: str) -> list[str]:
    """All that runs can be derived by: components of the start and parameters, as the core counts.

    Args:
        system: name in the catalogue.
        form: of its description.
    """
    entry = _engine.system_entries()[system]
    parameters = entry.forms[entry.form_index(form)].parameters
    return [*(row.name for row in entry.components), *(row.name for row in parameters)]


def checked_derivatives(asked: object, system: System) -> tuple[str, ...]:
    """The names that a run is derived by: components of the start and parameters.

    Args:
        asked: "state", "parameters", "all", a name, or several names; None: none.
        system: whose names they are.

    Raises:
        ValueError: for a name that the system does not have.
    """
    if asked is None:
        return ()
    groups = {"state": system.components, "parameters": tuple(system.parameters)}
    groups["all"] = groups["state"] + groups["parameters"]
    if isinstance(asked, str) and asked in groups:
        return groups[asked]
    names = (asked,) if isinstance(asked, str) or not isinstance(asked, Iterable) else tuple(asked)
    for name in names:
        if name not in groups["all"]:
            rule = 'must be "state", "parameters", "all" or names among {choices}; got {value}'
            way_out = meant(name, groups["all"]) if isinstance(name, str) else ""
            raise ArgumentError("derivatives", rule, way_out, choices=groups["all"], value=name)
    return tuple(dict.fromkeys(map(str, names)))


def check_method(method: str, digits: int | None) -> None:
    """Derivatives come of the Taylor method, with the digits of doubles.

    Raises:
        ValueError: for another method, or a run with `digits`.
    """
    if method != "taylor" or digits is not None:
        given = f"method={method!r}" if digits is None else f"digits={digits}"
        rule = f"come of the Taylor method with the digits of a double, got {given}"
        raise ArgumentError("derivatives", rule, 'take <method="taylor">, without digits')


def derived_run(
    system: System,
    asked: _engine.Request,
    outputs: Array,
    names: tuple[str, ...],
    progress: Progress,
) -> _engine.RunDerivatives:
    """The run and its derivatives by components of the start and parameters, at the outputs."""
    everything = names_derived_by(system.name, system.form)
    return _engine.derivatives(asked, outputs, [everything.index(name) for name in names], progress)


def with_derivatives(
    run: Trajectory, names: tuple[str, ...], found: _engine.RunDerivatives
) -> Trajectory:
    """The run, with what was found of its derivatives."""
    d, columns = run.request.state.size, len(names)
    return replace(
        run,
        derivatives=found.states(d, columns),
        derivative_names=names,
        event_derivatives=tuple(
            CrossingDerivatives(each.times(columns), each.states(d, columns))
            for each in found.events
        ),
    )


def exact_derivatives(
    system: System, state: Array, t: Array, t0: float, names: tuple[str, ...]
) -> Array:
    """Derivatives of the closed form at times (n,) from states (..., 2): (..., n, 2, k).

    Args:
        system: with a closed form.
        state: at t0.
        t: times [s].
        t0: time of the state [s].
        names: what to derive by.
    """
    import numpy as np

    everything = names_derived_by(system.name, system.form)
    columns = [everything.index(name) for name in names]
    described = system._description()
    derived = [
        _engine.exact_derivatives(described, np.ascontiguousarray(start), t, t0, columns)
        for start in state.reshape(-1, 2)
    ]
    return np.reshape(derived, (*state.shape[:-1], t.size, 2, len(names)))


def derivative_columns(
    system: System, names: tuple[str, ...], derivatives: Array
) -> dict[str, tuple[str, Array]]:
    """Name → (unit, values) of each derivative in tables and files: "dtheta_dlength" in rad/m.

    Args:
        system: whose states they are of.
        names: what the states are derived by.
        derivatives: (..., d, k).
    """
    units = dict(system.component_units) | {row.name: row.unit for row in system._rows()}
    return {
        derivative_name(component, by): (
            _quotient(units[component], units[by]),
            derivatives[..., i, k],
        )
        for i, component in enumerate(system.components)
        for k, by in enumerate(names)
    }


def derivative_name(component: str, by: str) -> str:
    """Of a component of the state by one of the start, or by a parameter."""
    return f"d{component}_d{by}"


def _quotient(unit: str, by: str) -> str:
    if by == unit:
        return "1"
    return f"{unit}/({by})" if re.search(r"[ /]", by) else f"{unit}/{by}" if by else unit
