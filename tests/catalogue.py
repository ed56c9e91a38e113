"""The systems and methods there are, for tests that every one of them has to pass.

A new system or method is in these lists by being in the core's catalogue.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._engine import Method, Parameter, methods, system_entries
from pendula.systems import System, system_from

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

GOLDEN = 0.6180339887498949


def made(name: str, form: str = "", **named: float) -> System:
    """The system with these parameters, as far as it has them, and any others.

    Friction is weak, as it grows backward in time; dry friction and drag, which change from piece
    to piece of a motion, have to be named.
    """
    entry = system_entries()[name]
    rows = entry.forms[entry.form_index(form)].parameters
    values = {
        row.name: 9.81 if row.unit == "m/s^2" else _size(row) * (0.4 + GOLDEN * (i + 1) % 1.0)
        for i, row in enumerate(rows)
    }
    values.update((key, value) for key, value in named.items() if key in values)
    return system_from({"name": name, "form": form, "parameters": values})


def _size(row: Parameter) -> float:
    if row.name.startswith("coulomb") or row.name == "quadratic":
        return 0.0
    return 0.02 if row.unit.startswith("N m s") else 1.0


ENTRIES = tuple(system_entries().values())
SYSTEMS = tuple(made(entry.name, form.name) for entry in ENTRIES for form in entry.forms)
METHODS = methods()
FIXED = tuple(each for each in METHODS if not each.adaptive)
ADAPTIVE = tuple(each for each in METHODS if each.adaptive)
TAKEN = tuple((m, s) for m in METHODS for s in SYSTEMS if s.name in m.systems)
REFUSED = tuple((m, s) for m in METHODS for s in SYSTEMS if s.name not in m.systems)


def label(x: object) -> str:
    """How a test is called that takes a method or a system."""
    if isinstance(x, System):
        return f"{x.name}-{x.form}".strip("-")
    return x.name if isinstance(x, Method) else str(x)


def taking(name: str) -> tuple[Method, ...]:
    """The methods that take the system of that name."""
    return tuple(each for each in METHODS if name in each.systems)


def control(method: Method, step: float = 0.01) -> dict[str, Any]:
    """The step, where the method needs one."""
    return {} if method.adaptive else {"step": step}


def at_rest(system: System) -> Array:
    """The lowest point."""
    return np.zeros(len(system.components))


def some_state(system: System) -> Array:
    """A swing of moderate angles and speeds, the same for all systems as far as they go."""
    d = system.can.degrees_of_freedom
    angles, speeds = (np.resize(each, d) for each in ((0.7, -0.4), (0.3, 1.0)))
    return np.concatenate([angles, speeds])


def any_states(system: System, count: int, seed: int = 1) -> Array:
    """From small swings to wild ones."""
    numbers = np.random.default_rng(seed)
    size = numbers.uniform(0.1, 1.0, (count, 1))
    return numbers.uniform(-3.0, 3.0, (count, len(system.components))) * size
