"""Starts of one energy, drawn by the invariant measure."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula._checks import LARGEST_COUNT, positive_number, whole_number
from pendula._messages import ArgumentError
from pendula.systems import DoublePendulum

if TYPE_CHECKING:
    import numpy as np

    from pendula._types import Array

_MOST = 10**7  # states
_DRAWN = 4096  # at a time


def energy_surface(system: DoublePendulum, energy: float, n: int, seed: int) -> Array:
    """States of one energy by the invariant (Liouville, microcanonical) measure δ(H − E) dθ dp.

    Integrated over the momenta it has a density √det M(θ) in the angles where V < E, M the mass
    matrix, and all directions of M^½ ω are alike (Landau & Lifshitz, Statistical Physics I, §4).
    Drawn by rejection with PCG64; sines and cosines are the core's and all else is exactly rounded,
    so that a seed gives the same bits on every machine.

    Args:
        system: a double pendulum.
        energy: above the lowest point [J].
        n: how many states.
        seed: of the draw, not negative.

    Returns:
        States (n, 4), angles from −π to π [rad, rad/s]; the first k are those of a smaller n.

    Raises:
        ValueError: for another system, or an argument out of range.
    """
    import numpy as np

    check_double(system)
    total = positive_number("energy", energy, "J")
    count = whole_number("n", n, _MOST)
    generator = np.random.Generator(np.random.PCG64(checked_seed(seed)))
    widths = np.array([_width(system, total, rod) for rod in (0, 1)])
    kept: list[Array] = []
    found = 0
    while found < count:
        states = _drawn(system, total, widths, generator)
        kept.append(states)
        found += len(states)
    return np.concatenate(kept)[:count]


def check_double(system: object) -> DoublePendulum:
    """The system, which has to be a double pendulum without friction.

    Raises:
        ValueError: for another.
    """
    if not isinstance(system, DoublePendulum):
        rule = "must be a DoublePendulum, got {value}: it has the energy surfaces that chaos fills"
        raise ArgumentError("system", rule, value=system)
    return system


def checked_seed(seed: object) -> int:
    """A seed, from 0."""
    if isinstance(seed, bool) or not isinstance(seed, int) or not 0 <= seed <= LARGEST_COUNT:
        rule = "must be a whole number of at least 0, got {value}"
        raise ArgumentError("seed", rule, value=seed)
    return seed


def _width(system: DoublePendulum, energy: float, rod: int) -> float:
    """Half of a range that holds all angles of a rod: π halved as long as none is left out."""
    import numpy as np

    width = math.pi
    while True:
        halved = np.zeros(4)
        halved[rod] = width / 2.0
        if float(system.potential_energy(halved)) <= energy or width < 1e-150:
            return width
        width /= 2.0


def _drawn(
    system: DoublePendulum, energy: float, widths: Array, generator: np.random.Generator
) -> Array:
    """The states that are kept of some thousand draws, (k, 4)."""
    import numpy as np

    draws = generator.random((_DRAWN, 5))
    states = np.zeros((_DRAWN, 4))
    states[:, :2] = (2.0 * draws[:, :2] - 1.0) * widths
    left = energy - system.potential_energy(states)
    A, B = system.constants["A"], system.constants["B"]
    coupling = coupling_at(system, states[:, :2])
    determinant = A * B - coupling * coupling
    # a point of the unit disc: its direction is even, and takes no sine (von Neumann 1951)
    u, v = 2.0 * draws[:, 3] - 1.0, 2.0 * draws[:, 4] - 1.0
    square = u * u + v * v
    kept = (left > 0.0) & (draws[:, 2] * draws[:, 2] * (A * B) < determinant)
    kept &= (square < 1.0) & (square > 0.0)
    size = np.sqrt(2.0 * left[kept] / square[kept])
    # M = L Lᵀ by Cholesky, and Lᵀ ω = √(2K) times the direction
    first = math.sqrt(A)
    last = np.sqrt(determinant[kept] / A)
    states = states[kept]
    states[:, 3] = size * v[kept] / last
    states[:, 2] = (size * u[kept] - coupling[kept] / first * states[:, 3]) / first
    return states


def coupling_at(system: DoublePendulum, angles: Array) -> Array:
    """C cos(θ1 − θ2), the mass matrix' element beside its diagonal, at angles (n, 2): (n,).

    From kinetic energies at unit velocities: with the core's cosine, whose bits are the same on
    all machines.
    """
    import numpy as np

    states = np.concatenate([angles, np.ones_like(angles)], axis=1)
    constants = system.constants
    return system.kinetic_energy(states) - 0.5 * (constants["A"] + constants["B"])
