"""A laboratory for the simple and the double pendulum.

Exact solutions, integrators and their comparison; SI units and radians, angles from the downward
vertical, counter-clockwise. See `SimplePendulum`, `DoublePendulum`, `exact`, `solve` and `events`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

# Where each public name lives. The first use of any of them imports all that a run needs: no run
# waits. The command line imports the modules by themselves, as its help has to be there at once.
_HOMES = {
    "systems": ("DoublePendulum", "LinearPendulum", "SimplePendulum"),
    "closed_form": ("action", "exact", "time_at"),
    "sections": ("poincare_section",),
    "solving": ("methods", "solve"),
    "trajectory": ("Trajectory",),
    "io": ("load", "rerun"),
}
_MODULES = ("analysis", "elliptic", "events", "io", "plot", "study", "units")
_OF_A_RUN = ("closed_form", "events", "sections", "solving", "systems", "trajectory", "trust")

if TYPE_CHECKING:
    from pendula import elliptic, events
    from pendula.closed_form import action, exact, time_at
    from pendula.io import load, rerun
    from pendula.sections import poincare_section
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
    "events",
    "exact",
    "load",
    "methods",
    "poincare_section",
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
            for module in ("numpy", *(f"pendula.{each}" for each in _OF_A_RUN)):
                importlib.import_module(module)
            return getattr(importlib.import_module(f"pendula.{home}"), name)
    raise AttributeError(f"module 'pendula' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*__all__, *_MODULES})
