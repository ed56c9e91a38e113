"""What makes the period of a real pendulum differ from 2π √(L/g), effect by effect.

Each correction is the factor by which its effect multiplies the square of the period. The list is
that of Nelson and Olsson, Am. J. Phys. 54 (1986) 112; they give the first order of each, here are
closed forms where there are any.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula import elliptic
from pendula._checks import positive_number
from pendula._messages import ArgumentError
from pendula.systems.base import STANDARD_GRAVITY

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from pendula._types import Array

    Known = Mapping[str, Any]

_UNITS = {
    "amplitude": "rad",
    "bob_radius": "m",
    "bob_mass": "kg",
    "string_density": "kg/m",
    "string_stiffness": "N",
    "decay_rate": "1/s",
    "air_density": "kg/m^3",
    "air_viscosity": "m^2/s",
}


@dataclass(frozen=True, kw_only=True)
class Apparatus:
    """A ball on a string in air, as far as it is known; None: not known.

    Args:
        amplitude: of every swing [rad]; a table that tells its amplitudes goes before.
        bob_radius: of the ball [m].
        bob_mass: of the ball [kg].
        string_density: mass of the string over its length [kg/m].
        string_stiffness: force over relative stretch, E A [N]; give it only where the length was
            measured without the ball's weight on the string.
        decay_rate: γ of an amplitude that falls as exp(−γ t) [1/s].
        air_density: of the air [kg/m³]; 1.2 at 20 °C and 101 kPa.
        air_viscosity: kinematic viscosity of the air [m²/s]; 1.5e−5 at 20 °C.

    Raises:
        ValueError: for a number that is not positive and finite, or an amplitude of π or more.
    """

    amplitude: float | None = None
    bob_radius: float | None = None
    bob_mass: float | None = None
    string_density: float | None = None
    string_stiffness: float | None = None
    decay_rate: float | None = None
    air_density: float = 1.2
    air_viscosity: float = 1.5e-5

    def __post_init__(self) -> None:
        for field in fields(self):
            given = getattr(self, field.name)
            if given is not None:
                found = positive_number(field.name, given, _UNITS[field.name])
                object.__setattr__(self, field.name, found)
        if self.amplitude is not None and self.amplitude >= math.pi:
            rule = "must be below pi [rad], got {value}"
            raise ArgumentError("amplitude", rule, value=self.amplitude)
        known = self.known
        if {"bob_mass", "bob_radius"} <= set(known) and _bob_density(known) <= self.air_density:
            rule = "must be that of a ball heavier than the air in its place, got {value} kg"
            way_out = "check <bob_radius> and <bob_mass>: metres and kilograms"
            raise ArgumentError("bob_mass", rule, way_out, value=self.bob_mass)

    @property
    def known(self) -> dict[str, float]:
        """What is known, by name."""
        return {name: value for name, value in vars(self).items() if value is not None}


class Correction(NamedTuple):
    """One effect.

    Attributes:
        needs: names of what has to be known: of the `Apparatus`, length [m] and amplitude [rad].
        factor: of T², from what is known by name, each of shape (n,) or a number; the period [s],
            which always is, among them.
    """

    needs: tuple[str, ...]
    factor: Callable[[Known], Any]


def amplitude_excess(amplitude: Array) -> Array:
    """T/T0 − 1 of a swing of that amplitude [rad], θ0²/16 for a small one."""
    import numpy as np

    # T = 4 K(k)/ω0 with k = sin(θ0/2): Nelson & Olsson (1986); DLMF 22.19(i)
    found: Array = np.asarray(2.0 / math.pi * elliptic.K(np.sin(amplitude / 2.0)) - 1.0)
    return found


def _of_amplitude(known: Known) -> Any:
    return (1.0 + amplitude_excess(known["amplitude"])) ** 2


def _of_bob(known: Known) -> Any:
    # I = m L² + ⅖ m r² (Huygens 1673, Horologium Oscillatorium IV, prop. 22)
    return 1.0 + 0.4 * (known["bob_radius"] / known["length"]) ** 2


def _of_string(known: Known) -> Any:
    # a uniform string from the pivot to the ball's surface: I = μ s³/3, torque μ g s²/2; the first
    # order, −μ s/6m of T², is that of Nelson & Olsson (1986)
    length, radius = known["length"], known.get("bob_radius", 0.0)
    string, density = length - radius, known["string_density"] / known["bob_mass"]
    inertia = 1.0 + density * string**3 / (3.0 * (length**2 + 0.4 * radius**2))
    return inertia / (1.0 + density * string**2 / (2.0 * length))


def _of_buoyancy(known: Known) -> Any:
    # the weight less that of the air in the ball's place (Nelson & Olsson 1986, buoyancy)
    return 1.0 / (1.0 - known["air_density"] / _bob_density(known))


def _of_added_mass(known: Known) -> Any:
    import numpy as np

    # half the air in the ball's place swings with it, and a layer of the thickness δ = √(2ν/ω)
    # besides: Stokes (1851); Landau & Lifshitz, Fluid Mechanics, § 24, problem 5
    layer = np.sqrt(known["air_viscosity"] * known["period"] / math.pi)
    coefficient = 0.5 + 2.25 * layer / known["bob_radius"]
    return 1.0 + coefficient * known["air_density"] / _bob_density(known)


def _of_damping(known: Known) -> Any:
    # ω² = ω0² − γ² of a damped oscillation (Nelson & Olsson 1986, damping)
    return 1.0 + (known["decay_rate"] * known["period"] / (2.0 * math.pi)) ** 2


def _of_stretching(known: Known) -> Any:
    # Hooke's law at rest; what the swing adds is smaller by the square of the amplitude
    return 1.0 + known["bob_mass"] * STANDARD_GRAVITY / known["string_stiffness"]


def _bob_density(known: Known) -> float:
    """Of a ball, from its mass and radius [kg/m³]."""
    return float(known["bob_mass"] / (4.0 / 3.0 * math.pi * known["bob_radius"] ** 3))


CORRECTIONS = {
    "amplitude": Correction(("amplitude",), _of_amplitude),
    "bob": Correction(("length", "bob_radius"), _of_bob),
    "string": Correction(("length", "bob_mass", "string_density"), _of_string),
    "buoyancy": Correction(("bob_mass", "bob_radius"), _of_buoyancy),
    "added_mass": Correction(("bob_mass", "bob_radius"), _of_added_mass),
    "damping": Correction(("decay_rate",), _of_damping),
    "stretching": Correction(("bob_mass", "string_stiffness"), _of_stretching),
}
