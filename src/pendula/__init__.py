"""A laboratory for the simple and the double pendulum.

Exact solutions, integrators and their comparison; SI units and radians, angles from the downward
vertical, counter-clockwise. See `SimplePendulum`, `DoublePendulum`, `exact`, `solve` and `events`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula._version import __version__ as __version__

# Where each public name lives. The first use of any of them imports all that a run needs: no run
# waits. The command line imports the modules by themselves, as its help has to be there at once.
_HOMES = {
    "systems": ("DoublePendulum", "LinearPendulum", "SimplePendulum"),
    "closed_form": ("action", "exact", "time_at"),
    "ensembles": ("Ensemble", "ensemble"),
    "maps": ("divergence_map", "flip_map"),
    "sections": ("poincare_section",),
    "solving": ("methods", "solve"),
    "trajectory": ("Trajectory",),
    "io": ("load", "rerun"),
    "sweeping": ("sweep",),
}
_MODULES = ("analysis", "chunks", "elliptic", "events", "io", "plot", "sampling", "study", "units")
_OF_A_RUN = ("closed_form", "events", "sections", "solving", "systems", "trajectory", "trust")

if TYPE_CHECKING:
    from pendula import elliptic, events
    from pendula.closed_form import action, exact, time_at
    from pendula.ensembles import Ensemble, ensemble
    from pendula.io import load, rerun
    from pendula.maps import divergence_map, flip_map
    from pendula.sections import poincare_section
    from pendula.solving import methods, solve
    from pendula.sweeping import sweep
    from pendula.systems import DoublePendulum, LinearPendulum, SimplePendulum
    from pendula.trajectory import Trajectory

__all__ = [
    "DoublePendulum",
    "Ensemble",
    "LinearPendulum",
    "SimplePendulum",
    "Trajectory",
    "action",
    "divergence_map",
    "elliptic",
    "ensemble",
    "events",
    "exact",
    "flip_map",
    "load",
    "methods",
    "poincare_section",
    "rerun",
    "solve",
    "sweep",
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
