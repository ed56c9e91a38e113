"""When an orbit is closed: linear conditions on its start and on a state some way along it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula._messages import ArgumentError
from pendula.run.solve import solve

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.systems import System

# One more condition on start and period: its value, zero where it holds, and its derivatives (d+1,)
Row = Callable[["Array", float], tuple[float, "Array"]]

_NEAR = 0.2  # rad: a start that misses a symmetry by more does not have it
_DIFFERENCE = 1e-6  # of an angle, for the energy's derivatives


@dataclass(frozen=True, eq=False)
class Closing:
    """L x(part · T) + R x(0) = offset, for the start x(0) and the period T.

    An orbit that passes through rest runs back on itself: at rest again after half a period
    (Birkhoff 1915). One that is its own mirror image is at the mirrored state after half a period,
    and with both symmetries at an equilibrium's angles after a quarter. The shorter the part, the
    better the digits; and at a bifurcation that breaks a symmetry the conditions with it stay
    regular.

    Attributes:
        symmetry: "none", "odd", "brake" or "brake, odd".
        part: of the period that is run.
        L: of the state at its end, (m, d).
        R: of the start, (m, d).
        offset: (m,).
        free: components of the start that may change, (k,); the others are 0.
    """

    symmetry: str
    part: float
    L: Array
    R: Array
    offset: Array
    free: tuple[int, ...]


def closings(system: System, start: Array, period: float) -> list[Closing]:
    """The conditions that an orbit near the start may have, those of most symmetry first.

    Args:
        system: of the orbit.
        start: near it, (d,); at rest: the orbit is one through rest.
        period: about the orbit's [s].
    """
    import numpy as np

    dof = start.size // 2
    one, none = np.eye(2 * dof), np.zeros((2 * dof, 2 * dof))
    angles, velocities = tuple(range(dof)), tuple(range(dof, 2 * dof))
    every = angles + velocities
    quarter, half, whole = (_end(system, start, each * period) for each in (0.25, 0.5, 1.0))
    tau, zero = math.tau, np.zeros(2 * dof)
    if system.can.conservative and not start[dof:].any():
        middle = np.pi * np.round(quarter[:dof] / np.pi)
        odd = swinging(middle)
        plain = Closing("brake", 0.5, one[dof:], none[dof:], zero[dof:], angles)
        missed = abs(quarter[:dof] - middle).max()
    else:
        turned = _turns(half + start, dof)
        odd = Closing("odd", 0.5, one, one, tau * turned, every)
        plain = Closing("none", 1.0, one, -one, tau * _turns(whole - start, dof), every)
        missed = abs(half + start - tau * turned)[:dof].max()
    mirrored = missed < _NEAR and system.can.periodic and is_odd(system, period)
    return [odd, plain] if mirrored else [plain]


def swinging(middle: Array) -> Closing:
    """The conditions of an orbit from rest that is its own mirror image about `middle`, (d/2,)."""
    import numpy as np

    dof = middle.size
    ends = np.eye(dof, 2 * dof)
    return Closing("brake, odd", 0.25, ends, np.zeros_like(ends), middle, tuple(range(dof)))


def is_odd(system: System, period: float) -> bool:
    """Whether the mirror image of a motion, half a period later, is another motion.

    Args:
        system: whose equations are compared at two states and times.
        period: of the orbit in question [s].
    """
    import numpy as np

    dof = system.can.degrees_of_freedom
    for shift in (0.1, 0.37):
        state, t = np.linspace(0.3, 1.1, 2 * dof), shift * period
        here = system.rhs(state, t)
        there = system.rhs(-state, t + 0.5 * period)
        if abs(here + there).max() > 1e-9 * abs(here).max():
            return False
    return True


def held(component: int, value: float) -> Row:
    """A component of the start keeps its value."""

    def row(x: Array, _: float) -> tuple[float, Array]:
        import numpy as np

        return float(x[component]) - value, np.eye(x.size + 1)[component]

    return row


def with_energy(system: System, energy: float) -> Row:
    """The start has an energy [J].

    The derivatives are differences: they bear on how fast Newton's method converges, to nine
    digits in each step, not on where.
    """

    def row(x: Array, _: float) -> tuple[float, Array]:
        import numpy as np

        beside = _DIFFERENCE * np.maximum(1.0, abs(x)) * np.eye(x.size)
        change = system.energy(x + beside) - system.energy(x - beside)
        slope = change / (2.0 * beside.diagonal())
        size = system.energy_scale
        value = (float(system.energy(x)) - energy) / size
        return value, np.append(slope / size, 0.0)

    return row


def across(direction: Array, x0: Array, period0: float) -> Row:
    """Start and period stay in the plane through a point across a direction (d+1,)."""

    def row(x: Array, period: float) -> tuple[float, Array]:
        value = float(direction[:-1] @ (x - x0) + direction[-1] * (period - period0))
        return value, direction

    return row


def phase_of(system: System, start: Array) -> int:
    """The angle that is held to say where on its orbit the start is: the first that moves."""
    speeds = abs(start[start.size // 2 :])
    moving = speeds > 1e-3 * speeds.max()
    if not moving.any():
        rule, way_out = "is at rest, {value}", "start with some velocity"
        raise ArgumentError("state", rule, way_out, value=start.tolist())
    return int(moving.argmax())


def _end(system: System, start: Array, span: float) -> Array:
    """The state after a time."""
    end: Array = solve(system, start, [span]).states[-1]
    return end


def _turns(difference: Array, dof: int) -> Array:
    """Whole turns in the angles of a difference, (d,); none in velocities."""
    import numpy as np

    turns = np.zeros(difference.size)
    turns[:dof] = np.round(difference[:dof] / math.tau)
    return turns
