"""Order and chaos: exponents and indicators with their errors, sections, orbits, bifurcations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula.chaos.alignment import Alignment, gali, sali
from pendula.chaos.bifurcation import Bifurcation, bifurcation
from pendula.chaos.changes import Change
from pendula.chaos.doublings import period_doublings
from pendula.chaos.energy_surface import energy_surface
from pendula.chaos.families import Family, family
from pendula.chaos.frequencies import Frequencies, frequencies
from pendula.chaos.lyapunov import Lyapunov, lyapunov
from pendula.chaos.megno import Megno, megno
from pendula.chaos.modes import normal_mode
from pendula.chaos.orbit import PeriodicOrbit
from pendula.chaos.orbits import periodic_orbit
from pendula.chaos.section_plane import section_starts
from pendula.chaos.sections import Section, section
from pendula.chaos.tangent_map import TangentMap, tangent_map
from pendula.chaos.zero_one import ZeroOne, zero_one

if TYPE_CHECKING:
    from pendula.many.maps import indicator_map, section_map
    from pendula.many.shares import chaotic_share

# Of a room above this one, by where they stand there.
_ABOVE = {
    "chaotic_share": "many.shares",
    "indicator_map": "many.maps",
    "section_map": "many.maps",
}

__all__ = [
    "Alignment",
    "Bifurcation",
    "Change",
    "Family",
    "Frequencies",
    "Lyapunov",
    "Megno",
    "PeriodicOrbit",
    "Section",
    "TangentMap",
    "ZeroOne",
    "bifurcation",
    "chaotic_share",
    "energy_surface",
    "family",
    "frequencies",
    "gali",
    "indicator_map",
    "lyapunov",
    "megno",
    "normal_mode",
    "period_doublings",
    "periodic_orbit",
    "sali",
    "section",
    "section_map",
    "section_starts",
    "tangent_map",
    "zero_one",
]


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name in _ABOVE:
        found = globals()[name] = getattr(import_module(f"pendula.{_ABOVE[name]}"), name)
        return found
    raise AttributeError(f"module 'pendula.chaos' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
