"""The two rods as heyoka is told of them: the equations in several forms, to find its best."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import heyoka
import numpy as np

A, B, C, D, E = 4.0 / 3.0, 1.0 / 3.0, 0.5, 1.5 * 9.81, 0.5 * 9.81
BASE = ("t1", "t2", "p1", "p2")  # p: the velocities or the momenta
SINES, DIFFERENCE = ("s1", "c1", "s2", "c2"), ("s", "c")
Equations = list[tuple[Any, Any]]


@dataclass(frozen=True)
class Form:
    """Equations, their state for given angles at rest, and the velocities in a state."""

    equations: Callable[[], Equations]
    start: Callable[[Any], Any]
    usual: Callable[[Any], Any]


def velocities(p1: Any, p2: Any, cosine: Any) -> tuple[Any, Any]:
    """The angular velocities of momenta, of numbers or of heyoka's expressions."""
    determinant = A * B - C * C * cosine**2
    return (
        (B * p1 - C * (cosine * p2)) / determinant,
        (A * p2 - C * (cosine * p1)) / determinant,
    )


def from_momenta(state: Any) -> Any:
    """(θ1, θ2, ω1, ω2) of a state that begins with (θ1, θ2, p1, p2)."""
    t1, t2, p1, p2 = state[:4]
    return np.stack([t1, t2, *velocities(p1, p2, np.cos(t1 - t2))])


def at_rest(angles: Any) -> Any:
    """Angles and zeros."""
    return np.concatenate([angles, np.zeros_like(angles)])


def with_difference(angles: Any) -> Any:
    """… and the sine and cosine of the angles' difference."""
    difference = angles[:1] - angles[1:]
    return np.concatenate([at_rest(angles), np.sin(difference), np.cos(difference)])


def with_all_sines(angles: Any) -> Any:
    """… and those of the angles."""
    each = [np.sin(angles[:1]), np.cos(angles[:1]), np.sin(angles[1:]), np.cos(angles[1:])]
    return np.concatenate([at_rest(angles), *each, with_difference(angles)[4:]])


def lagrangian() -> Equations:
    """In angles and velocities; heyoka itself finds what occurs twice."""
    t1, t2, w1, w2 = heyoka.make_vars(*BASE)
    sine, coupling = heyoka.sin(t1 - t2), C * heyoka.cos(t1 - t2)
    r1 = -C * sine * w2**2 - D * heyoka.sin(t1)
    r2 = C * sine * w1**2 - E * heyoka.sin(t2)
    determinant = A * B - coupling**2
    acceleration1 = (B * r1 - coupling * r2) / determinant
    acceleration2 = (A * r2 - coupling * r1) / determinant
    return [(t1, w1), (t2, w2), (w1, acceleration1), (w2, acceleration2)]


def canonical() -> Equations:
    """In angles and momenta."""
    t1, t2, p1, p2 = heyoka.make_vars(*BASE)
    w1, w2 = velocities(p1, p2, heyoka.cos(t1 - t2))
    force = C * (heyoka.sin(t1 - t2) * (w1 * w2))
    push1, push2 = -force - D * heyoka.sin(t1), force - E * heyoka.sin(t2)
    return [(t1, w1), (t2, w2), (p1, push1), (p2, push2)]


def difference_as_states() -> Equations:
    """In angles, momenta, and the sine and cosine of the difference as unknowns of their own.

    The product cos δ · ω then needs no multiplication: p1 = A ω1 + C cos δ · ω2 holds it.
    """
    t1, t2, p1, p2, sine, cosine = heyoka.make_vars(*BASE, *DIFFERENCE)
    s1, s2 = heyoka.sin(t1), heyoka.sin(t2)
    return _with_known_difference(t1, t2, p1, p2, sine, cosine, s1, s2)


def sines_as_states() -> Equations:
    """The same with the sines and cosines of both angles as unknowns too."""
    t1, t2, p1, p2, s1, c1, s2, c2, sine, cosine = heyoka.make_vars(*BASE, *SINES, *DIFFERENCE)
    w1, w2 = velocities(p1, p2, cosine)
    turning = [(s1, c1 * w1), (c1, -(s1 * w1)), (s2, c2 * w2), (c2, -(s2 * w2))]
    main = _with_known_difference(t1, t2, p1, p2, sine, cosine, s1, s2)
    return [*main[:4], *turning, *main[4:]]


def _with_known_difference(
    t1: Any, t2: Any, p1: Any, p2: Any, sine: Any, cosine: Any, s1: Any, s2: Any
) -> Equations:
    w1, w2 = velocities(p1, p2, cosine)
    x = sine * w1
    force = C * (x * w2)
    sine_slope = ((p2 - B * w2) - (p1 - A * w1)) * (1 / C)
    return [
        (t1, w1),
        (t2, w2),
        (p1, -force - D * s1),
        (p2, force - E * s2),
        (sine, sine_slope),
        (cosine, sine * w2 - x),
    ]


FORMS = {
    "θ, ω": Form(lagrangian, at_rest, lambda state: np.array(state[:4])),
    "θ, p": Form(canonical, at_rest, from_momenta),
    "θ, p, sin δ, cos δ": Form(difference_as_states, with_difference, from_momenta),
    "θ, p, all sines": Form(sines_as_states, with_all_sines, from_momenta),
}
