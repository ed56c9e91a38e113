"""The section plane θ1 = 0, ω1 > 0 of the double pendulum, in (θ2, p2)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula._checks import broadcast_shape, finite_array, positive_number
from pendula._messages import ArgumentError
from pendula.chaos.energy_surface import check_double

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from pendula._types import Array
    from pendula.systems import DoublePendulum, System

# 1/g and 1/g² of g³ = g + 1: the sequence of multiples, modulo 1, that fills a square most evenly
# (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences")
_EVEN = 0.7548776662466927, 0.5698402909980532


def section_starts(
    system: DoublePendulum, energy: float, theta2: ArrayLike, p2: ArrayLike
) -> Array:
    """States of one energy on the section plane θ1 = 0, ω1 > 0.

    ω1 = √((2B(E − V) − p2²) / det) with det = AB − C² cos²θ2, ω2 = (p2 − C cos θ2 ω1) / B.

    Args:
        system: a double pendulum.
        energy: [J].
        theta2: angles of the second rod, of any shape that broadcasts against p2 [rad].
        p2: its momenta ∂T/∂ω2 = B ω2 + C cos(θ1 − θ2) ω1 [kg m²/s].

    Returns:
        States (..., 4) [rad, rad/s].

    Raises:
        ValueError: for a point that the energy does not reach.
    """
    import numpy as np

    check_double(system)
    total = positive_number("energy", energy, "J")
    angles, momenta = finite_array("theta2", theta2, "rad"), finite_array("p2", p2, "kg m^2/s")
    shape = broadcast_shape(theta2=angles.shape, p2=momenta.shape)
    angles, momenta = np.broadcast_to(angles, shape), np.broadcast_to(momenta, shape)
    states = lifted(system, total, angles.ravel(), momenta.ravel())
    lacking = ~np.isfinite(states[:, 2])
    if lacking.any():
        first = int(lacking.argmax())
        raise ArgumentError(
            "p2",
            "must be a point that {other} J reach with omega1 > 0, got {value} at theta2 = {text}",
            "take a smaller <p2>, or more <energy>",
            other=f"{total:g}",
            text=f"{float(angles.ravel()[first]):g}",
            value=float(momenta.ravel()[first]),
        )
    return states.reshape(*shape, 4)


def section_grid(system: DoublePendulum, energy: float, count: int) -> Array:
    """States (n, 4) evenly over the part of the section plane that an energy reaches.

    The invariant measure of the section is dθ2 dp2 (Poincaré), in which they are even.

    Args:
        system: a double pendulum.
        energy: above 0 [J].
        count: how many.
    """
    import numpy as np

    (_, widest), (_, most) = reach(system, energy)
    kept, first, found = [], 0, 0
    while found < count:
        places = np.arange(first, first + 4 * count) + 0.5
        unit = np.mod(np.outer(places, _EVEN), 1.0)
        states = lifted(
            system, energy, widest * (2.0 * unit[:, 0] - 1.0), most * (2.0 * unit[:, 1] - 1.0)
        )
        kept.append(states[np.isfinite(states[:, 2])])
        first, found = first + 4 * count, found + len(kept[-1])
    return np.concatenate(kept)[:count]


def momentum2(system: System, states: Array) -> Array:
    """p2 = B ω2 + C cos(θ1 − θ2) ω1 at states (..., 4): (...) [kg m²/s]."""
    import numpy as np

    constants = system.constants
    coupling = constants["C"] * np.cos(states[..., 0] - states[..., 1])
    return np.asarray(constants["B"] * states[..., 3] + coupling * states[..., 2])


def reach(system: System, energy: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """The least rectangle of (θ2, p2) that holds the section of an energy [rad, kg m²/s]."""
    constants = system.constants
    ratio = energy / (2.0 * constants["E"]) if constants["E"] else 2.0  # sin²(θ2/2) at rest
    widest = 2.0 * math.asin(math.sqrt(ratio)) if ratio < 1.0 else math.pi
    most = math.sqrt(2.0 * constants["B"] * energy)  # of p2, at θ2 = 0
    return (-widest, widest), (-most, most)


def lifted(system: System, energy: float, theta2: Array, p2: Array) -> Array:
    """States (n, 4) on the plane; NaN velocities where the energy does not reach."""
    import numpy as np

    of = system.constants
    states = np.zeros((theta2.size, 4))
    states[:, 1] = theta2
    coupling, sine = of["C"] * np.cos(theta2), of["C"] * np.sin(theta2)
    left = 2.0 * of["B"] * (energy - system.potential_energy(states)) - p2 * p2
    # A B − C² cos² θ2 without cancellation
    square = np.where(left > 0.0, left, np.nan) / (of["determinant_floor"] + sine * sine)
    states[:, 2] = np.sqrt(square)
    states[:, 3] = (p2 - coupling * states[:, 2]) / of["B"]
    return states
