"""Derivatives of the closed forms, against differences of mpmath's solutions with many digits."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

import refusals
import truth
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, exact, solve

SIZES = (1.3, 9.7)  # length and gravity
STARTS = {
    "swing": (0.4, -0.3),
    "small": (1e-9, 0.0),
    "from the top": (3.1415926, 1e-4),
    "turning": (0.2, 8.0),
    "turning backwards": (-2.0, -9.5),
    "at rest": (0.0, 0.0),
}
TIMES = [-3.0, 0.0, 0.7, 25.0]


def differences(of: Any, given: list[float], place: int) -> list[float]:
    """Derivatives of all that a function of many numbers gives by the one at a place."""
    with mp.workdps(120):
        h = mpf(10) ** -40
        sides = [
            [mpf(x) + (sign * h if i == place else 0) for i, x in enumerate(given)]
            for sign in (1, -1)
        ]
        plus, minus = (of(*side) for side in sides)
        return [float((a - b) / (2 * h)) for a, b in zip(plus, minus, strict=True)]


def assert_near(found: Any, want: Any, epsilons: float = 8.0) -> None:
    size = np.abs(want).max()
    assert np.abs(found - want).max() <= epsilons * 2.0**-52 * size


@pytest.mark.parametrize("start", STARTS.values(), ids=STARTS.keys())
def test_those_of_the_simple_pendulum(start: tuple[float, float]) -> None:
    run = exact(SimplePendulum(*SIZES), start, TIMES, derivatives="all")
    assert run.derivative_names == ("theta", "omega", "length", "gravity", "mass")
    assert run.derivatives is not None
    assert np.array_equal(run.states, exact(SimplePendulum(*SIZES), start, TIMES).states)
    for t, found in zip(TIMES, run.derivatives, strict=True):

        def of(theta: Any, omega: Any, length: Any, gravity: Any, t: float = t) -> Any:
            return truth.simple(theta, omega, gravity, length, t)[:2]

        want = np.transpose([differences(of, [*start, *SIZES], place) for place in range(4)])
        assert_near(found[:, :4], want)
        assert np.all(found[:, 4] == 0.0)


def test_on_the_separatrix() -> None:
    """With g = L the start 2 rad/s at the bottom is on it: sin(θ/2) = tanh τ, ω = 2 sech τ.

    Its variations are sech τ and sinh τ + τ sech τ (by quadrature from the first).
    """
    t = [0.5, 3.0, 12.0]
    run = exact(SimplePendulum(2.0, 2.0), (0.0, 2.0), t, derivatives="state")
    assert run.derivatives is not None
    for tau, found in zip(t, run.derivatives, strict=True):
        sech, tanh = 1 / np.cosh(tau), np.tanh(tau)
        grown = np.sinh(tau) + tau * sech
        rate = np.cosh(tau) + sech - tau * sech * tanh
        assert_near(found, np.array([[sech, grown / 2], [-sech * tanh, rate / 2]]))


FREQUENCY = float(np.sqrt(SIZES[1] / SIZES[0]))
CRITICAL = 2 * FREQUENCY * 0.7 * SIZES[0] ** 2
REGIMES = {
    "ideal": {},
    "weak": {"viscous": 0.05, "torque": 0.3, "drive_frequency": 2.0, "drive_phase": 0.4},
    "critical": {"viscous": CRITICAL, "torque": 0.3, "drive_frequency": 2.0},
    "strong": {"viscous": 40.0, "torque": 0.3, "drive_frequency": 2.0},
    "resonance": {"torque": 0.3, "drive_frequency": FREQUENCY},
    "exact resonance": {"torque": 0.3, "drive_frequency": 2.0, "length": 2.0, "gravity": 8.0},
    "exactly critical": {"viscous": 4.0, "length": 1.0, "gravity": 4.0, "mass": 1.0},
}


@pytest.mark.parametrize("real", REGIMES.values(), ids=REGIMES.keys())
def test_those_of_the_linear_pendulum(real: dict[str, float]) -> None:
    """Against the Taylor method, whose derivatives come another way."""
    system = LinearPendulum(**{"length": SIZES[0], "gravity": SIZES[1], "mass": 0.7, **real})
    t = [0.3, 5.0, 40.0]
    closed = exact(system, (0.4, -0.3), t, derivatives="all")
    stepped = solve(system, (0.4, -0.3), t, derivatives="all")
    assert closed.derivatives is not None
    assert stepped.derivatives is not None
    for found, want in zip(closed.derivatives, stepped.derivatives, strict=True):
        assert_near(found, want, 200.0)


def test_of_many_states() -> None:
    system = SimplePendulum(*SIZES)
    many = exact(system, [[[0.1, 0.0], [2.0, 1.0]]], [1.0, 2.0], derivatives=("gravity", "theta"))
    assert many.derivatives is not None
    assert many.derivatives.shape == (1, 2, 2, 2, 2)
    one = exact(system, (2.0, 1.0), [1.0, 2.0], derivatives=("gravity", "theta"))
    assert one.derivatives is not None
    assert np.array_equal(many.derivatives[0, 1], one.derivatives)


def test_a_name_that_there_is_none_of() -> None:
    said = refusals.told(lambda: exact(SimplePendulum(), (1.0, 0.0), 1.0, derivatives="lenght"))
    assert said.endswith("got 'lenght'; did you mean 'length'?")
    said = refusals.told(lambda: exact(DoublePendulum.rods(), (1, 1, 0, 0), 1.0, derivatives="all"))
    assert "closed form" in said
