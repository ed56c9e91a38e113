"""Whether a motion can reach a surface at all, as far as its energy tells."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.run.events import Event
    from pendula.systems import System

_ROUNDING = 1e-9  # of the energy: what is nearer to the limit is left to the run


def check_reachable(system: System, start: Array, event: Event, count: int) -> None:
    """Refuse a surface that the energy forbids so often, or a start that stays where it is.

    Raises:
        ValueError: naming both energies, or what the motion cannot do.
    """
    if not (system.can.conservative and system.can.autonomous):
        return
    if not system.rhs(start).any():
        rule, way_out = "is an equilibrium, {value}: nothing is ever crossed", "let it move"
        raise ArgumentError("state", rule, way_out, value=start.tolist())
    energy, scale = float(system.energy(start)), system.energy_scale
    one = system.can.periodic and system.can.degrees_of_freedom == 1
    if one and energy > _at_rest(system, 0, math.pi) + _ROUNDING * scale:
        _check_rotation(start, event, count)
    if event.kind == "velocity_zero":
        return
    needed = _angle_energy(system, event) if event.kind == "angle" else _tip_energy(system, event)
    if math.isinf(needed) or energy < needed - _ROUNDING * max(needed, scale):
        rule = (
            "cannot be reached: it needs an energy of {needed} J, and the motion has {energy} J"
            if math.isfinite(needed)
            else "cannot be reached: the end of the pendulum never is so far from the pivot"
        )
        way_out = "start with more energy, or take another event"
        raise ArgumentError("event", rule, way_out, needed=needed, energy=energy)
    if event.kind == "angle" and not event.every_turn and system.can.periodic:
        _check_own_turn(system, start, event, energy)


def _check_rotation(start: Array, event: Event, count: int) -> None:
    """Refuse what a single pendulum does not do that turns over the top, always one way."""
    way_out = "start with less energy, or take another event"
    if event.kind == "velocity_zero":
        rule = "cannot be reached: the pendulum turns over the top and never stands still"
        raise ArgumentError("event", rule, way_out)
    if event.kind != "angle":
        return
    theta, omega = start.tolist()
    if event.direction * omega < 0.0:
        rule = "cannot be reached: the pendulum turns over the top, the other way"
        raise ArgumentError("event", rule, way_out)
    if not event.every_turn and (count > 1 or (event.value - theta) * omega <= 0.0):
        rule = "cannot be reached so often: the pendulum turns over the top and does not come back"
        raise ArgumentError("event", rule, "give <every_turn=True>")


def _check_own_turn(system: System, start: Array, event: Event, energy: float) -> None:
    """Refuse an angle of another turn, where the energy does not take the rod over the top."""
    angle = float(start[event.index - 1])
    middle = math.tau * round(angle / math.tau)
    beyond = abs(event.value - middle) > math.pi
    if beyond and energy < (1.0 - _ROUNDING) * _at_rest(system, event.index - 1, math.pi):
        rule = "cannot be reached: rod {text} does not get over the top, to {value} rad"
        way_out = "give the angle of its own turn, or <every_turn=True>"
        raise ArgumentError("event", rule, way_out, text=event.index, value=event.value)


def _angle_energy(system: System, event: Event) -> float:
    """The least energy with which a rod has the angle: at rest, the others hanging down [J]."""
    return _at_rest(system, event.index - 1, event.value)


def _at_rest(system: System, rod: int, angle: float) -> float:
    """The energy at rest with one rod at an angle and the others at 0 [J]."""
    state = np.zeros(len(system.components))
    state[rod] = angle
    return float(system.energy(state))


def _tip_energy(system: System, event: Event) -> float:
    """The least energy with which the tip is so high [J]; infinite: it never is.

    Every rod is raised by L (1 − cos θ), from 0 to twice its length; for a potential that is a sum
    over the rods, those that cost least for their height go first.
    """
    rods = system.can.degrees_of_freedom
    down = system.positions(np.zeros(2 * rods))
    lengths = np.hypot(*np.diff(down, axis=0, prepend=np.zeros((1, 2))).T)
    height = event.value + float(lengths.sum())
    if not 0.0 <= height <= 2.0 * float(lengths.sum()):
        return math.inf
    if not system.can.periodic:  # a linear one: its energy is no multiple of its height
        return _at_rest(system, 0, math.acos(1.0 - height / float(lengths[0])))
    needed = 0.0
    tops = [_at_rest(system, rod, math.pi) for rod in range(rods)]
    for rod in sorted(range(rods), key=lambda i: tops[i] / lengths[i] if lengths[i] else math.inf):
        raised = min(height, 2.0 * float(lengths[rod]))
        needed += tops[rod] * raised / (2.0 * float(lengths[rod])) if raised else 0.0
        height -= raised
    return needed
