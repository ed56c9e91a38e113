"""The closed form against solutions with many digits: within its bounds, at any time."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

import truth
from motions import REGIMES, Start, starts, times
from pendula import LinearPendulum, SimplePendulum, exact
from stored import BOUNDS, cases, of_motion

STORED = cases("exact.json")
KINDS = sorted({case["kind"] for case in STORED})


def solved(case: dict[str, Any]) -> Any:
    number = {
        name: float.fromhex(case[name]) for name in ("theta0", "omega0", "gravity", "length", "t")
    }
    system = SimplePendulum(number["length"], number["gravity"])
    return exact(system, (number["theta0"], number["omega0"]), number["t"]).states[0]


def test_the_stored_solutions_by_another_program() -> None:
    """Their scales are what the formula in `truth` says, their angles and speeds are not."""
    stored = cases("simple.json")
    assert len(stored) == 107
    for case in stored:
        with mp.workdps(60):
            start = [float.fromhex(case[name]) for name in ("theta0", "omega0")]
            where = [float.fromhex(case[name]) for name in ("gravity", "length")]
            scales = truth.simple(start[0], start[1], where[0], where[1], 0)[2:]
        assert of_motion(solved(case), (case["theta"], case["omega"], *scales)) <= BOUNDS.motion


@pytest.mark.parametrize("kind", KINDS)
def test_the_stored_solutions_of_every_kind(kind: str) -> None:
    names = ("theta", "omega", "omega_max", "amplitude")
    for case in STORED:
        if case["kind"] == kind:
            assert of_motion(solved(case), [case[name] for name in names]) <= BOUNDS.motion, case


def wanted(start: Start, t: Any) -> truth.Motion:
    """With digits enough for 1e-26, also next to the separatrix and after 1e9 periods."""
    return truth.Motion(*truth.settled(lambda: truth.simple(*start.numbers, t), 60, 26))


@pytest.mark.parametrize("regime", REGIMES)
@settings(max_examples=60)
@given(data=st.data())
def test_any_state_at_any_time(regime: str, data: st.DataObject) -> None:
    start, t = data.draw(starts(regime)), data.draw(times())
    got = exact(start.system, start.state, t).states[0]
    assert of_motion(got, wanted(start, mpf(t))) <= BOUNDS.motion


@settings(max_examples=100)
@given(starts(), times(), times())
def test_the_difference_of_times_is_not_rounded(start: Start, t: float, t0: float) -> None:
    with mp.workdps(700):
        elapsed = mpf(t) - mpf(t0)
    got = exact(start.system, start.state, t, t0=t0).states[0]
    assert of_motion(got, wanted(start, elapsed)) <= BOUNDS.motion


@pytest.mark.parametrize("count", [1, 3, 8, 11])
@pytest.mark.parametrize("state", [(1.0, 0.3), (-2.0, 9.0), (3.0, 0.0), (0.3, 6.1)])
def test_a_time_far_from_zero_and_a_tenth(state: tuple[float, float], count: int) -> None:
    """1e9 − 0.1 is no double: rounded, it would be off by 2e-8 s."""
    system, t = SimplePendulum(0.7, 9.81), [1e9 + i for i in range(count)]
    got = exact(system, state, t, t0=0.1).states
    with mp.workdps(60):
        elapsed = [mpf(each) - mpf(0.1) for each in t]
    for states, each in zip(got, elapsed, strict=True):
        assert of_motion(states, wanted(Start(system, *state), each)) <= BOUNDS.motion


@settings(max_examples=200)
@given(
    st.floats(-50, 50), st.floats(-50, 50), st.floats(0.05, 20), st.floats(0.5, 30), times(-6, 9)
)
def test_the_linear_pendulum(
    theta: float, omega: float, length: float, gravity: float, t: float
) -> None:
    """Of any amplitude, also where nearly all of a large one cancels."""
    assume(max(abs(theta), abs(omega)) > 1e-250)
    system = LinearPendulum(length, gravity)
    with mp.workdps(60):
        elapsed = mpf(t) - mpf(0.1)
        want = truth.linear(theta, omega, gravity, length, elapsed)
    got = exact(system, (theta, omega), t, t0=0.1).states[0]
    assert of_motion(got, want) <= BOUNDS.motion


@pytest.mark.parametrize("scale", [1e-300, 1e-150, 1e-20, 1e20, 1e150])
def test_the_size_of_the_units_does_not_matter(scale: float) -> None:
    """Lengths and times of any size: ωn from 1e-150 to 1e150."""
    length, gravity = (1.0, scale) if scale < 1 else (1 / scale, 1.0)
    system = SimplePendulum(length, gravity)
    wn = system.natural_frequency
    for theta, speed, time in ((1.0, 0.3, 7.0), (-3.0, 5.0, 1e6), (math.pi, 0.0, 30.0)):
        start = Start(system, theta, speed * wn)
        got = exact(system, start.state, time / wn).states[0]
        assert of_motion(got, wanted(start, mpf(time / wn))) <= BOUNDS.motion


def test_subnormal_states_stay_as_small() -> None:
    smallest = 5e-324
    for system in (SimplePendulum(), LinearPendulum()):
        states = exact(system, (smallest, -smallest), np.linspace(-9, 9, 50)).states
        assert (np.abs(states) <= 8 * smallest).all()
        assert np.isfinite(states).all()
