"""What every motion in closed form obeys, and that batches are what their parts are."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from motions import Start, starts, times
from pendula import LinearPendulum, SimplePendulum, _engine, exact
from stored import BOUNDS, EPS

SYSTEM = SimplePendulum(0.5, 9.81)
MANY_TIMES = np.concatenate([np.linspace(-30, 30, 41), 10.0 ** np.arange(-9, 8)])


def energy_bound(start: Start, states: Any) -> Any:
    """What errors of θ and ω within their bounds may do to the energy, and its own roundings."""
    system, (theta, omega) = start.system, states.T
    energy = system.energy(np.array(start.state))
    amplitude, fastest = np.abs(theta).max(), np.abs(omega).max()
    slope = system.mass * system.gravity * system.length * np.abs(np.sin(theta))
    inertia = system.mass * system.length**2 * np.abs(omega)
    unit = np.maximum(np.abs(theta), min(1.0, 1.01 * amplitude))
    return EPS * (BOUNDS.motion * (slope * unit + 1.01 * inertia * fastest) + 8 * energy)


@settings(max_examples=60)
@given(starts("libration", "rest", "rotation", "top", "separatrix", turns=False))
def test_energy_is_constant(start: Start) -> None:
    states = exact(start.system, start.state, MANY_TIMES).states
    states = states[np.abs(states[:, 0]) < _engine.LARGEST_ANGLE]
    change = np.abs(start.system.energy(states) - start.system.energy(np.array(start.state)))
    assert (change <= energy_bound(start, states)).all()


@given(starts(), times())
def test_back_in_time_is_the_motion_with_the_velocity_turned(start: Start, t: float) -> None:
    theta, omega = exact(start.system, start.state, -t).states[0]
    back = exact(start.system, (start.theta, -start.omega), t).states[0]
    assert (theta, omega) == (back[0], -back[1])


@given(starts(), times())
def test_the_mirror_image_moves_as_a_mirror_image(start: Start, t: float) -> None:
    states = exact(start.system, start.state, t).states
    mirrored = exact(start.system, (-start.theta, -start.omega), t).states
    assert (mirrored == -states).all()


def turns_over(start: Start) -> bool:
    with mp.workdps(50):
        most = 4 * mp.cos(mpf(start.theta) / 2) ** 2 * mpf(start.system.gravity)
        return bool(mpf(start.omega) ** 2 * mpf(start.system.length) > most)


@settings(max_examples=100)
@given(starts("libration", "rest", "rotation", "top", "separatrix", turns=False))
def test_a_period_brings_the_state_back(start: Start) -> None:
    """Up to the rounding of the times, through which the state moves on."""
    period, t = start.system.period(state=start.state), np.linspace(-3, 3, 20)
    assume(math.isfinite(period))
    turn = 2 * math.pi * math.copysign(1.0, start.omega) if turns_over(start) else 0.0
    now, later = (exact(start.system, start.state, each).states for each in (t, t + period))
    fastest = np.hypot(start.omega, 2 * start.system.natural_frequency)
    late = EPS * (2 * period + np.abs(t))
    scale = np.maximum(1.0, np.abs(now[:, 0]) + abs(turn))
    assert (np.abs(later[:, 0] - now[:, 0] - turn) <= 10 * EPS * scale + late * fastest).all()
    force = start.system.gravity / start.system.length
    assert (np.abs(later[:, 1] - now[:, 1]) <= 10 * EPS * fastest + late * force).all()


@settings(max_examples=100)
@given(starts("libration", "rotation", turns=False), st.floats(-5, 5), st.floats(-5, 5))
def test_in_two_pieces_as_in_one(start: Start, first: float, second: float) -> None:
    """The state between is rounded; away from the top that grows with the phases passed."""
    system = start.system
    middle = exact(system, start.state, first).states[0]
    carried = exact(system, middle, first + second, t0=first).states[0]
    whole = exact(system, start.state, first + second).states[0]
    fastest = np.hypot(start.omega, 2 * system.natural_frequency)
    grown = GROWTH * EPS * (1 + np.abs(middle[0]) + fastest * (abs(first) + abs(second)))
    assert (np.abs(carried - whole) <= grown * np.array([1.0, fastest])).all()


GROWTH = 60.0  # times the roundings; 37 is reached, where a swing ends 1% below the top


def test_small_angles_are_linear() -> None:
    """The linear model's error falls with the cube of the amplitude over one swing."""
    linear, simple = LinearPendulum(), SimplePendulum()
    t = np.linspace(0, linear.period(), 50)
    errors = [
        np.abs(exact(linear, (a, 0.3 * a), t).theta - exact(simple, (a, 0.3 * a), t).theta).max()
        for a in (0.02, 0.04)
    ]
    assert math.log2(errors[1] / errors[0]) == pytest.approx(3, abs=0.01)


def test_turns_are_counted_in_both_directions() -> None:
    wn = SYSTEM.natural_frequency
    for forwards in (1.0, -1.0):
        state = (0.4, 3.0 * forwards * wn)
        t = np.linspace(0, 40, 2001)
        run = exact(SYSTEM, state, t)
        assert (np.diff(run.theta) * forwards > 0).all()
        turns = 40 / SYSTEM.period(state=state)
        assert (run.theta[-1] - 0.4) * forwards / (2 * math.pi) == pytest.approx(turns, abs=1)


def test_the_separatrix_ends_at_the_top_and_comes_from_there() -> None:
    system = SimplePendulum(1.0, 1.0)
    theta, omega = exact(system, (0.0, 2.0), [-40.0, -1.0, 1.0, 40.0]).states.T
    middle = 4 * math.atan(math.tanh(0.5))
    assert theta == pytest.approx([-math.pi, -middle, middle, math.pi], rel=1e-15)
    assert omega == pytest.approx([2 / math.cosh(t) for t in (40, 1, 1, 40)], rel=1e-14)
    assert (
        exact(system, (0.0, -2.0), [1.0]).states == -exact(system, (0.0, 2.0), [1.0]).states
    ).all()


# ---- batches ----


def mixed_states(count: int) -> Any:
    """All regimes side by side, so that the lanes of one step differ."""
    wn, rng = SYSTEM.natural_frequency, np.random.default_rng(5)
    kinds = [
        *((1.0, 0.3 * wn), (3.0, 0.0), (0.2, 5.0 * wn), (-1.0, -40.0 * wn), (0.0, 0.0)),
        *((math.pi, 0.0), (0.0, 2.0 * wn), (1e-200, 0.0), (-40.0, wn), (1e5, 2.1 * wn)),
    ]
    picks = rng.integers(0, len(kinds), count)
    return np.array([kinds[i] for i in picks]) * rng.uniform(0.98, 1.0, (count, 1))


@pytest.mark.parametrize("system", [SYSTEM, LinearPendulum(0.5, 9.81)])
def test_a_batch_is_bit_for_bit_its_parts(system: Any) -> None:
    """Numbers of states and times from 1 to 40: whole lanes and what is left of them."""
    states = mixed_states(40)
    t = np.concatenate([np.linspace(-3, 9, 30), [1e3, -1e6, 1e9, 3e9, 0.1, 1e-9, 7e11, 4, 5, 0]])
    single = np.array([[exact(system, y, x, t0=0.1).states[0] for x in t] for y in states])
    for count in range(1, 41):
        for few in {1, 3, 7, 8, 9, count}:
            start = 40 - count  # other states and times in the last lanes
            many = exact(system, states[start:], t[:few], t0=0.1).states
            assert many.tobytes() == single[start:, :few].tobytes(), (count, few)
            many = exact(system, states[:few], t[start:], t0=0.1).states
            assert many.tobytes() == single[:few, start:].tobytes(), (few, count)


@pytest.mark.parametrize("system", [SYSTEM, LinearPendulum(0.5, 9.81)])
@pytest.mark.parametrize("shape", [(), (0,), (1,), (5,), (2, 3), (2, 0), (1, 4, 1)])
@pytest.mark.parametrize("count", [0, 1, 3, 12])
def test_the_shapes(system: Any, shape: tuple[int, ...], count: int) -> None:
    states = mixed_states(math.prod(shape)).reshape((*shape, 2))
    t = np.linspace(-1, 7, count)
    run = exact(system, states, t)
    assert run.states.shape == (*shape, count, 2)
    assert run.theta.shape == run.omega.shape == run.energy.shape == (*shape, count)
    flat = run.states.reshape(math.prod(shape), count, 2)
    for state, got in zip(states.reshape(-1, 2), flat, strict=True):
        assert (exact(system, state, t).states == got).all()
    assert run.at(np.zeros((2, 2))).shape == (*shape, 2, 2, 2)
