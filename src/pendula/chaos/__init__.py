"""Order and chaos: periodic orbits, sections, bifurcations, frequencies and tests of series."""

from __future__ import annotations

from pendula.chaos.bifurcation import Bifurcation, bifurcation
from pendula.chaos.doublings import period_doublings
from pendula.chaos.energy_surface import energy_surface
from pendula.chaos.families import Change, Family, family
from pendula.chaos.frequencies import Frequencies, frequencies
from pendula.chaos.modes import normal_mode
from pendula.chaos.orbit import PeriodicOrbit
from pendula.chaos.orbits import periodic_orbit
from pendula.chaos.section_plane import section_starts
from pendula.chaos.sections import Section, section
from pendula.chaos.zero_one import ZeroOne, zero_one

__all__ = [
    "Bifurcation",
    "Change",
    "Family",
    "Frequencies",
    "PeriodicOrbit",
    "Section",
    "ZeroOne",
    "bifurcation",
    "energy_surface",
    "family",
    "frequencies",
    "normal_mode",
    "period_doublings",
    "periodic_orbit",
    "section",
    "section_starts",
    "zero_one",
]
