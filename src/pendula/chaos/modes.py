"""Nonlinear normal modes: the families of periodic orbits that small oscillations grow into."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from pendula._checks import positive_number
from pendula._messages import ArgumentError
from pendula.chaos.closing import Row, across, held, swinging, with_energy
from pendula.chaos.newton import Closed, OrbitError, closed_orbit
from pendula.chaos.orbit import PeriodicOrbit, orbit_of
from pendula.systems import DoublePendulum

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.systems import System

_FIRST = 0.02  # rad: how far the first orbit is from rest, where the mode is all but linear
# Steps along the family, in radians and periods over the small oscillation's
_LONGEST, _SHORTEST, _GROWTH = 0.15, 1e-5, 1.5
_MOST_STEPS = 4000
_BEND = 0.02  # by which an orbit may differ from where it was looked for


def normal_mode(
    system: System, mode: int, *, amplitude: float | None = None, energy: float | None = None
) -> PeriodicOrbit:
    """The periodic orbit that a small oscillation of the double pendulum grows into.

    Both angles are at rest together and pass zero together (Rosenberg 1962; Lyapunov's centre
    theorem 1907). The family is followed from the small oscillation by its length, so that it may
    turn back in amplitude or energy: the first orbit with the one asked for is taken. In resonance
    with the other mode the family may go over into that one's orbits (Kerschen et al. 2009).

    Args:
        system: a double pendulum.
        mode: 1: both rods on one side, the slow one; 2: on opposite sides.
        amplitude: θ1 at rest [rad].
        energy: [J]. One of the two has to be given.

    Returns:
        The orbit, from rest with θ1 positive.

    Raises:
        ValueError: for another system, an argument out of range, or an orbit that the family does
            not reach.
    """
    if not isinstance(system, DoublePendulum):
        rule = "must be a DoublePendulum, got {value}: others have no two modes"
        raise ArgumentError("system", rule, "use <call=periodic_orbit>", value=system)
    if mode not in (1, 2) or isinstance(mode, bool):
        rule = "must be 1 (the slow mode, in phase) or 2 (out of phase), got {value}"
        raise ArgumentError("mode", rule, value=mode)
    if (amplitude is None) == (energy is None):
        rule = "must be given, or <energy>: one of them, not both"
        raise ArgumentError("amplitude", rule)
    recipe = {"mode": mode, "amplitude": amplitude, "energy": energy}
    if amplitude is not None:
        wanted = positive_number("amplitude", amplitude, "rad")
        closed = _grown(system, mode, "amplitude", wanted)
    else:
        closed = _grown(system, mode, "energy", positive_number("energy", energy, "J"))
    if closed.state[0] < 0.0:  # half a period later the orbit is at the mirrored state
        closed = closed._replace(state=0.0 - closed.state)
    return orbit_of(system, swinging(closed.state[:2] * 0.0), closed, None, recipe)


def _grown(system: DoublePendulum, mode: int, asked: str, wanted: float) -> Closed:
    """The first orbit of a mode's family with an amplitude or energy."""
    import numpy as np

    shape = np.array(system.normal_modes().shapes[mode - 1])
    small = math.tau / system.normal_modes().frequencies[mode - 1]
    units = np.array([1.0, 1.0, small])
    closing, first = swinging(np.zeros(2)), _FIRST
    while _value(system, asked, _from_rest(first * shape)) > wanted and first > 1e-8:
        first /= 2.0
    here, direction = np.array([0.0, 0.0, small]), np.append(shape, 0.0)
    length, n_steps, most = first, 0, 0.0
    for _ in range(_MOST_STEPS):
        there = here + length * direction * units
        row = across(_in_seconds(direction, small), _from_rest(there[:2]), there[2])
        found = _at(system, closing, row, there, small)
        if found is None:
            length /= 2.0
            if length < _SHORTEST:
                break
            continue
        n_steps += found.n_steps
        before, here = here, np.append(found.state[:2], found.period)
        most = max(most, _value(system, asked, found.state))
        if most >= wanted:
            guess = _between(system, asked, wanted, before, here)
            row = _condition(system, asked, wanted, float(guess[0]))
            final = closed_orbit(system, closing, [row], _from_rest(guess[:2]), guess[2])
            return final._replace(n_steps=n_steps + final.n_steps)
        direction = (here - before) / units
        direction = direction / np.hypot.reduce(direction)
        length = min(_GROWTH * length, _LONGEST)
    raise _beyond(asked, wanted, most)


def _at(system: System, closing: Any, row: Row, there: Array, small: float) -> Closed | None:
    """The orbit on the plane; None: there is none near."""
    try:
        found = closed_orbit(system, closing, [row], _from_rest(there[:2]), float(there[2]))
    except OrbitError:
        return None
    off = max(abs(found.state[:2] - there[:2]).max(), abs(found.period - there[2]) / small)
    return found if off < _BEND else None


def _beyond(asked: str, wanted: float, reached: float) -> ArgumentError:
    unit = "rad" if asked == "amplitude" else "J"
    return ArgumentError(
        asked,
        "must be reached by the mode's family, which comes to {other} {text}; got {value}",
        "take less",
        other=f"{reached:.6g}",
        text=unit,
        value=wanted,
    )


def _condition(system: System, asked: str, wanted: float, theta1: float) -> Row:
    """What the orbit has to have; at that point of the family θ1 may have become negative."""
    if asked == "amplitude":
        return held(0, math.copysign(wanted, theta1))
    return with_energy(system, wanted)


def _value(system: System, asked: str, state: Array) -> float:
    """Amplitude or energy of a start from rest."""
    return abs(float(state[0])) if asked == "amplitude" else float(system.energy(state))


def _between(system: System, asked: str, wanted: float, before: Array, here: Array) -> Array:
    """Where between two orbits the value is about the one wanted: (θ1, θ2, T)."""
    low, high = (_value(system, asked, _from_rest(each[:2])) for each in (before, here))
    share = (wanted - low) / (high - low) if high > low else 1.0
    return before + share * (here - before)


def _from_rest(angles: Array) -> Array:
    """The state at rest with these angles."""
    import numpy as np

    return np.concatenate([angles, np.zeros_like(angles)])


def _in_seconds(direction: Array, small: float) -> Array:
    """A direction in (θ1, θ2, T over the small period) as one in state and period, (5,)."""
    import numpy as np

    return np.array([direction[0], direction[1], 0.0, 0.0, direction[2] / small])
