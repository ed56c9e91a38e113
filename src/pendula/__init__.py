"""A laboratory for the simple and the double pendulum.

Exact solutions, integrators and their comparison; SI units and radians, angles from the downward
vertical, counter-clockwise. See `SimplePendulum`, `DoublePendulum`, `exact`, `solve` and `events`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula._late_methods import promise
from pendula._version import __version__ as __version__

# Where each public name lives. The first use of any of them imports all that a run needs: no run
# waits. The command line imports the modules by themselves, as its help has to be there at once.
_HOMES = {
    "_angles": ("DegreesWarning", "degrees"),
    "systems": (
        "DampedDoublePendulum",
        "DoublePendulum",
        "DrivenPendulum",
        "LinearPendulum",
        "SimplePendulum",
    ),
    "run.exact": ("action", "exact", "time_at"),
    "run.sections": ("poincare_section",),
    "run.solve": ("methods", "solve"),
    "run.stiffness": ("StiffWarning",),
    "run.trajectory": ("Trajectory",),
    "many.ensembles": ("Ensemble", "ensemble"),
    "many.maps": ("divergence_map", "flip_map"),
    "many.sweep": ("sweep",),
    "io": ("load", "rerun"),
}
_MODULES = (
    "analysis",
    "chaos",
    "chunks",
    "elliptic",
    "events",
    "io",
    "lab",
    "maps",
    "measured",
    "plot",
    "sampling",
    "study",
    "sweeping",
    "systems",
    "units",
)
_OF_A_RUN = ("exact", "events", "sections", "solve", "trajectory", "trust")

# Methods that stand above their class; each room attaches its own.
promise("Trajectory", "pendula.io", "save", "to_pandas", "to_xarray")
promise("Ensemble", "pendula.many.tables", "save", "to_pandas", "to_xarray")
promise("Trajectory", "pendula.plot", "animate", "plot")
promise("Storable", "pendula.io.measured", "save", "to_pandas", "to_xarray")
promise("Measurement", "pendula.plot.recorded", "plot")
promise("Fit", "pendula.study.measured.report", "report")
promise("Comparison", "pendula.study.measured.report", "report")
promise("PeriodFit", "pendula.study.measured.report", "report")
_DRAWN = ("Alignment", "Bifurcation", "Family", "Frequencies", "Lyapunov", "Megno", "PeriodicOrbit")
for _owner in (*_DRAWN, "Section", "ZeroOne"):
    promise(_owner, "pendula.plot", "plot")

if TYPE_CHECKING:
    from pendula import elliptic, events
    from pendula._angles import DegreesWarning, degrees
    from pendula.io import load, rerun
    from pendula.many.ensembles import Ensemble, ensemble
    from pendula.many.maps import divergence_map, flip_map
    from pendula.many.sweep import sweep
    from pendula.run.exact import action, exact, time_at
    from pendula.run.sections import poincare_section
    from pendula.run.solve import methods, solve
    from pendula.run.stiffness import StiffWarning
    from pendula.run.trajectory import Trajectory
    from pendula.systems import (
        DampedDoublePendulum,
        DoublePendulum,
        DrivenPendulum,
        LinearPendulum,
        SimplePendulum,
    )

__all__ = [
    "DampedDoublePendulum",
    "DegreesWarning",
    "DoublePendulum",
    "DrivenPendulum",
    "Ensemble",
    "LinearPendulum",
    "SimplePendulum",
    "StiffWarning",
    "Trajectory",
    "action",
    "degrees",
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
            for module in ("numpy", *(f"pendula.run.{each}" for each in _OF_A_RUN)):
                importlib.import_module(module)
            found = globals()[name] = getattr(importlib.import_module(f"pendula.{home}"), name)
            return found
    raise AttributeError(f"module 'pendula' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*__all__, *_MODULES})
