"""Pendulums, states and times of every regime, for the property tests."""

from __future__ import annotations

import math
from typing import NamedTuple

from hypothesis import strategies as st

from pendula import SimplePendulum


class Start(NamedTuple):
    """A pendulum and a state of it."""

    system: SimplePendulum
    theta: float
    omega: float

    @property
    def state(self) -> tuple[float, float]:
        return self.theta, self.omega

    @property
    def numbers(self) -> tuple[float, float, float, float]:
        """As the functions of tests/truth.py take them."""
        return self.theta, self.omega, self.system.gravity, self.system.length


def powers(low: float, high: float) -> st.SearchStrategy[float]:
    """10 to a power within the two."""
    return st.floats(low, high).map(lambda x: 10.0**x)


def signed(strategy: st.SearchStrategy[float]) -> st.SearchStrategy[float]:
    return st.tuples(st.sampled_from([-1.0, 1.0]), strategy).map(math.prod)


REGIMES = ("libration", "rest", "rotation", "top", "separatrix", "small")


@st.composite
def starts(draw: st.DrawFn, *regimes: str, turns: bool = True) -> Start:
    """In one of these regimes, or of all, with whole turns added or not."""
    regime = draw(st.sampled_from(regimes or REGIMES))
    system = SimplePendulum(draw(st.floats(0.05, 20.0)), draw(st.floats(0.5, 30.0)))
    wn = system.natural_frequency
    theta, omega = draw(st.floats(-3.1, 3.1)), 0.0
    fastest = 2.0 * wn * math.cos(theta / 2.0)  # of a libration
    if regime == "libration":
        omega = fastest * draw(st.floats(-0.99, 0.99))
    elif regime == "rotation":
        omega = wn * draw(signed(powers(0.33, 6.0)))
    elif regime == "top":
        theta = draw(st.sampled_from([-1.0, 1.0])) * (math.pi - draw(powers(-16.0, -1.0)))
        omega = wn * draw(st.one_of(st.just(0.0), signed(powers(-14.0, -1.0))))
    elif regime == "separatrix":
        omega = draw(st.sampled_from([-1.0, 1.0])) * fastest * (1.0 + draw(signed(powers(-16, -1))))
    elif regime == "small":
        theta, omega = draw(signed(powers(-300, -1))), draw(signed(powers(-300, -1))) * wn
    if turns and regime != "small":
        theta += 2.0 * math.pi * draw(st.one_of(st.just(0), st.integers(-1000, 1000)))
    return Start(system, theta, omega)


def times(low: float = -6.0, high: float = 9.0) -> st.SearchStrategy[float]:
    """Before and after, short and long [s]."""
    return signed(powers(low, high))
