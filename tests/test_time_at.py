"""When an angle is passed: the first time, and never."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

import truth
from motions import Start, starts
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, exact, time_at
from stored import EPS, in_ulps
from truth import complement, complete_K, incomplete_F

UNIT = SimplePendulum(1.0, 1.0)  # ωn = 1, and ω0 = 2 at the bottom is the separatrix
OWN = ("libration", "rest", "rotation", "top", "separatrix")


@settings(max_examples=150)
@given(starts(*OWN), st.floats(0.001, 20.0))
def test_it_inverts_the_motion_and_is_the_first_passage(start: Start, later: float) -> None:
    """The angle reached at a random time is passed then, or before where the motion came back."""
    system = start.system
    target, speed = map(float, exact(system, start.state, later).states[0])
    rounded = 4 * EPS * max(1.0, abs(target)) / max(abs(speed), 1e-300)
    when = time_at(system, start.state, target)
    if when == math.inf:  # rounded to an angle beyond the turning point
        with mp.workdps(60):
            reach = truth.simple(*start.numbers, 0).amplitude
            turns = 2 * mp.pi * mp.nint(mpf(start.theta) / (2 * mp.pi))
            assert abs(mpf(target) - turns) > reach
        return
    assert 0.0 <= when <= later * (1 + 4 * EPS) + rounded
    theta = exact(system, start.state, when).theta[0]
    fastest = np.hypot(start.omega, 2 * system.natural_frequency)
    assert abs(theta - target) <= EPS * (6 * max(1.0, abs(target)) + 2 * fastest * when)
    before = exact(system, start.state, np.linspace(0, when * (1 - 1e-5), 300)).theta
    side = np.sign(start.theta - target)
    assert side == 0 or (np.sign(before - target) * side >= 0).all()


@settings(max_examples=100)
@given(starts("rest", "top", turns=False))
def test_a_release_passes_the_bottom_and_turns_where_it_has_to(start: Start) -> None:
    """A quarter and half a period; −θ0 is reached from rest, and what is beyond is not."""
    assume(start.omega == 0.0 and start.theta != 0.0)
    system, theta = start.system, start.theta
    with mp.workdps(80):
        quarter = complete_K(mp.cos(mpf(theta) / 2)) * mp.sqrt(mpf(system.length) / system.gravity)
        assert in_ulps(time_at(system, start.state, 0.0), quarter) <= 1
        assert in_ulps(time_at(system, start.state, -theta), 2 * quarter) <= 1
    beyond = math.nextafter(abs(theta), 4)
    assert time_at(system, start.state, [beyond, -beyond, theta]).tolist() == [
        math.inf,
        math.inf,
        0,
    ]
    assert time_at(LinearPendulum(1.0, 1.0), start.state, -theta) == pytest.approx(math.pi)


@pytest.mark.filterwarnings("ignore::pendula.DegreesWarning")
@pytest.mark.parametrize("kc", [0.9, 0.1, 1e-7])
@pytest.mark.parametrize("forwards", [1, -1])
def test_a_rotation_by_the_incomplete_integral(kc: float, forwards: int) -> None:
    """(F(θ/2, 1/k) − F(θ0/2, 1/k)) / k ωn, from any turn to any other."""
    omega = forwards * 2 / math.sqrt((1 - kc) * (1 + kc))
    for theta, target in ((0.0, 3.0), (-1.0, 1.0), (0.5, 700.0), (-300.0, -299.5)):
        with mp.workdps(60):
            stretch = mp.hypot(mp.sin(mpf(theta) / 2), mpf(omega) / 2)
            q = complement(1 / stretch)
            ends = [incomplete_F(mpf(each) * forwards / 2, q) for each in (theta, target)]
            want = (ends[1] - ends[0]) / stretch
        got = time_at(UNIT, (theta, omega), target)
        assert got == math.inf if want < 0 else in_ulps(got, want) <= 1


NEVER: list[tuple[tuple[float, float], float]] = [
    ((0.0, 0.0), 1.0),  # at rest below
    ((0.0, 0.0), 5e-324),
    ((1.0, 0.0), 1.5),  # above the swing
    ((1.0, 0.0), 1.0 - 2 * math.pi),  # another turn
    ((1.0 + 2 * math.pi, 0.0), 0.0),
    ((1.0, 5.0), 0.999),  # turning forwards
    ((1.0, -5.0), 1.001),  # and backwards
    ((0.0, 2.0), 3.1416),  # the separatrix ends at the top
    ((0.0, 2.0), -1e-9),
    ((0.0, -2.0), 1e-9),
    ((math.pi, 0.0), math.nextafter(math.pi, 4)),
]


@pytest.mark.parametrize(("state", "target"), NEVER)
def test_never(state: tuple[float, float], target: float) -> None:
    assert time_at(UNIT, state, target) == math.inf


NOW = [(1.0, 0.0), (0.0, 0.0), (-3.0, 40.0), (math.pi, 0.0), (0.0, 2.0), (5e-324, 0.0), (1e12, -1)]


@pytest.mark.parametrize("state", NOW)
@pytest.mark.parametrize("system", [UNIT, LinearPendulum()])
def test_the_angle_of_the_state_is_there_already(system: Any, state: tuple[float, float]) -> None:
    assert time_at(system, state, state[0]) == 0.0


def test_the_separatrix_by_the_gudermannian() -> None:
    """gd⁻¹(θ) = artanh sin θ, DLMF 4.23.42; numpy.pi lies below π and is passed."""
    with mp.workdps(60):
        for target in (1e-9, 1.0, 3.0, math.pi):
            want = mp.atanh(mp.sin(mpf(target) / 2))
            assert in_ulps(time_at(UNIT, (0.0, 2.0), target), want) <= 1
            assert in_ulps(time_at(UNIT, (0.0, -2.0), -target), want) <= 1


@pytest.mark.filterwarnings("ignore::pendula.DegreesWarning")
@settings(max_examples=100)
@given(st.floats(-9, 9), st.floats(-9, 9), st.floats(-12, 12))
@example(1e-290, -1.0, 0.0)
def test_the_linear_pendulum(theta: float, omega: float, target: float) -> None:
    """From R sin φ on to R sin φ = target, by the larger of the two angles that has it."""
    assume(theta != target)
    system = LinearPendulum(0.5, 9.81)
    with mp.workdps(350):
        wn = mp.sqrt(mpf(9.81) / mpf(0.5))
        speed = mpf(omega) / wn
        radius, phase = mp.hypot(mpf(theta), speed), mp.atan2(mpf(theta), speed)
        if radius < abs(mpf(target)):
            want = mp.inf
        else:
            angle = mp.asin(mpf(target) / radius)
            waits = [(each - phase) % (2 * mp.pi) for each in (angle, mp.pi - angle)]
            want = min(waits) / wn
        assert in_ulps(time_at(system, (theta, omega), target), want) <= 1


@pytest.mark.parametrize("system", [UNIT, LinearPendulum(1.0, 1.0)])
@pytest.mark.parametrize("small", [1e-30, 1e-100, 1e-290])
def test_small_angles_one_after_the_other(system: Any, small: float) -> None:
    """Next to the bottom θ = ω t to all digits, downwards as upwards."""
    for speed in (1.0, -1.0):
        states = [(-small * speed, speed), (0.0, speed), (0.0, speed)]
        waits = time_at(system, states, [0.0, small * speed, 2 * small * speed])
        assert waits.tolist() == [small, small, 2 * small]


def test_states_and_angles_broadcast() -> None:
    states = np.array([(1.0, 0.0), (0.0, 5.0), (2.0, -1.0)])
    angles = np.array([[0.5], [-0.5]])
    got = time_at(UNIT, states, angles)
    assert got.shape == (2, 3)
    for i, j in np.ndindex(2, 3):
        assert got[i, j] == time_at(UNIT, states[j], float(angles[i, 0]))
    assert isinstance(time_at(UNIT, (1.0, 0.0), 0.5), float)
    assert time_at(UNIT, np.zeros((0, 2)), 1.0).shape == (0,)
    assert time_at(UNIT, (1.0, 0.0), []).shape == (0,)


def test_what_is_refused() -> None:
    with pytest.raises(
        ValueError, match=r"^system must be a LinearPendulum or SimplePendulum.*use"
    ):
        time_at(DoublePendulum.rods(), (1, 1, 0, 0), 1.0)
    with pytest.raises(ValueError, match="^theta must hold finite numbers"):
        time_at(UNIT, (1.0, 0.0), math.nan)
    with pytest.raises(ValueError, match="^state must hold finite numbers"):
        time_at(UNIT, (1.0, math.inf), 1.0)
    with pytest.raises(ValueError, match=r"^state must have a shape that goes with that of theta"):
        time_at(UNIT, np.zeros((2, 2)), [1.0, 2.0, 3.0])
