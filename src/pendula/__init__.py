"""A laboratory for the simple and the double pendulum.

Exact solutions, integrators and their comparison; SI units and radians, angles from the downward
vertical, counter-clockwise. See `SimplePendulum`, `DoublePendulum`, `exact`, `solve` and `methods`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

# Where each public name lives. It is imported when it is first used: help has to be there at once.
_HOMES = {
    "systems": ("DoublePendulum", "LinearPendulum", "SimplePendulum"),
    "closed_form": ("action", "exact", "time_at"),
    "solving": ("methods", "solve"),
    "trajectory": ("Trajectory",),
    "io": ("load", "rerun"),
}
_MODULES = ("analysis", "elliptic", "io", "plot", "study", "units")

if TYPE_CHECKING:
    from pendula import elliptic
    from pendula.closed_form import action, exact, time_at
    from pendula.io import load, rerun
    from pendula.solving import methods, solve
    from pendula.systems import DoublePendulum, LinearPendulum, SimplePendulum
    from pendula.trajectory import Trajectory

__all__ = [
    "DoublePendulum",
    "LinearPendulum",
    "SimplePendulum",
    "Trajectory",
    "action",
    "elliptic",
    "exact",
    "load",
    "methods",
    "rerun",
    "solve",
    "time_at",
]


def __getattr__(name: str) -> Any:
    import importlib

    if name in _MODULES:
        return importlib.import_module(f"pendula.{name}")
    for home, names in _HOMES.items():
        if name in names:
            return getattr(importlib.import_module(f"pendula.{home}"), name)
    raise AttributeError(f"module 'pendula' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*__all__, *_MODULES})
