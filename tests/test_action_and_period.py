"""Action and period, against quadrature and the complete integrals with many digits."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

import truth
from motions import Start, starts
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, action
from stored import in_ulps

HEAVY = SimplePendulum(0.7, 9.81, 2.5)
UNIT = SimplePendulum(1.0, 1.0)


def action_by_quadrature(system: SimplePendulum, theta: float, omega: float) -> float:
    """∮ p dθ / 2π. A swing, from −A to A and back, by cos θ/2 = …, which takes the root away."""
    with mp.workdps(40):
        wn2, inertia = (
            mpf(system.gravity) / system.length,
            mpf(system.mass) * mpf(system.length) ** 2,
        )
        k2 = mp.sin(mpf(theta) / 2) ** 2 + mpf(omega) ** 2 / (4 * wn2)
        if k2 > 1:
            speed = mp.quad(
                lambda x: 2 * mp.sqrt(wn2 * (k2 - mp.sin(x / 2) ** 2)), [-mp.pi, 0, mp.pi]
            )
            return float(inertia * speed / (2 * mp.pi))
        most = 2 * mp.asin(mp.sqrt(k2))
        speed = mp.quad(lambda x: 2 * mp.sqrt(wn2 * abs(k2 - mp.sin(x / 2) ** 2)), [0, most])
        return float(4 * inertia * speed / (2 * mp.pi))


@pytest.mark.filterwarnings("ignore::pendula.DegreesWarning")
@pytest.mark.parametrize(
    "state",
    [
        *((0.01, 0.0), (1.0, 0.0), (-3.1, 0.0), (0.3, 2.0), (7.0, -1.0), (math.pi, 0.0)),
        *((0.0, 8.0), (0.0, -30.0), (3.0, 1.2), (1e-8, 1e-9), (-2.0, 1e4), (40 * math.pi, 7.4)),
    ],
)
def test_the_action_is_the_area_in_phase_space(state: tuple[float, float]) -> None:
    assert action(HEAVY, state) == pytest.approx(action_by_quadrature(HEAVY, *state), rel=4e-16)


def test_the_action_of_the_separatrix_and_of_rest() -> None:
    """8/π m √(g L³), which is what a libration comes to; a rotation comes to half of it."""
    assert action(UNIT, (0.0, 2.0)) == pytest.approx(8 / math.pi, rel=2e-16)
    assert action(UNIT, (0.0, 2.0 * (1 - 1e-12))) == pytest.approx(8 / math.pi, rel=1e-10)
    assert action(UNIT, (0.0, -2.0 * (1 + 1e-12))) == pytest.approx(4 / math.pi, rel=1e-10)
    assert action(UNIT, (0.0, 0.0)) == 0.0


@pytest.mark.parametrize("state", [(0.3, 0.0), (1.0, 0.4), (-2.5, 1.0), (0.0, 9.0), (1.0, -20.0)])
def test_the_action_changes_with_the_energy_as_the_period_says(state: tuple[float, float]) -> None:
    """dJ/dE = T/2π: for ω, dE = m L² ω dω. By differences of fourth order."""
    theta, omega = state
    bottom = math.copysign(math.sqrt(2 * float(HEAVY.energy(np.array(state))) / 2.5) / 0.7, omega)
    h = 1e-4 * bottom
    up, down, up2, down2 = (action(HEAVY, (0.0, bottom + n * h)) for n in (1, -1, 2, -2))
    slope = (8 * (up - down) - (up2 - down2)) / (12 * h) / (2.5 * 0.7**2 * bottom)
    assert slope == pytest.approx(HEAVY.period(state=(theta, omega)) / (2 * math.pi), rel=1e-11)


def test_the_linear_pendulum() -> None:
    """J = E/ωn, an ellipse; the simple pendulum's where the swings are small."""
    linear = LinearPendulum(0.7, 9.81, 2.5)
    wn, state = math.sqrt(9.81 / 0.7), (0.3, -0.5)
    ellipse = 2.5 * 0.7**2 * wn * (0.3**2 + (0.5 / wn) ** 2) / 2
    assert action(linear, state) == pytest.approx(ellipse, rel=1e-15)
    tiny = (3e-9, 4e-9)
    assert action(HEAVY, tiny) == pytest.approx(action(linear, tiny), rel=1e-15)


def test_the_shapes_of_actions_and_what_is_refused() -> None:
    states = np.array([[(1.0, 0.0), (0.0, 9.0)], [(-1.0, 2.0), (3.0, 0.0)]])
    for system in (HEAVY, LinearPendulum(0.7, 9.81, 2.5)):
        rows = states.reshape(-1, 2)
        actions, periods = action(system, states), system.period(state=states)
        assert actions.shape == periods.shape == (2, 2)
        assert actions.ravel().tolist() == [action(system, y) for y in rows]
        assert periods.ravel().tolist() == [system.period(state=y) for y in rows]
        assert isinstance(action(system, (1.0, 0.0)), float)
        assert action(system, np.zeros((0, 2))).shape == (0,)
    with pytest.raises(ValueError, match=r"^system must be a LinearPendulum or SimplePendulum"):
        action(DoublePendulum.rods(), (1, 1, 0, 0))
    with pytest.raises(ValueError, match="^state must hold finite numbers"):
        action(UNIT, (1.0, math.nan))


# ---- periods ----


@settings(max_examples=200)
@given(starts())
def test_the_period_through_any_state(start: Start) -> None:
    want = truth.settled(lambda: [truth.period(*start.numbers)], 80, 26)[0]
    got = start.system.period(state=start.state)
    assert in_ulps(got, want) <= 1


@settings(max_examples=100)
@given(st.one_of(st.floats(-math.pi, math.pi), st.floats(-300, 0).map(lambda x: 10.0**x)))
def test_the_period_of_any_amplitude(amplitude: float) -> None:
    with mp.workdps(60):
        want = truth.period(amplitude, 0, 9.81, 0.7)
    assert in_ulps(HEAVY.period(amplitude), want) <= 1


def test_the_period_at_the_ends() -> None:
    assert UNIT.period(0.0) == pytest.approx(2 * math.pi, rel=2e-16)
    with mp.workdps(60):  # numpy.pi is not π
        assert in_ulps(UNIT.period(math.pi), 4 * truth.complete_K(mp.cos(mpf(math.pi) / 2))) <= 1
    assert UNIT.period(state=[(0.0, 2.0), (0.0, -2.0)]).tolist() == [math.inf, math.inf]
    assert math.isfinite(UNIT.period(state=(0.0, math.nextafter(2.0, 0.0))))
    assert math.isfinite(UNIT.period(state=(0.0, math.nextafter(2.0, 3.0))))
    assert UNIT.period([0.1, 0.2]).tolist() == [UNIT.period(0.1), UNIT.period(0.2)]
    assert UNIT.period(np.empty((0, 3))).shape == (0, 3)


@pytest.mark.parametrize(
    ("given_", "message"),
    [
        ({}, "amplitude or state=.*one of the two"),
        ({"amplitude": 1.0, "state": (1.0, 0.0)}, "one of the two"),
        ({"amplitude": 3.2}, r"^amplitude must lie within \[-pi, pi\].*got 3\.2; .*state="),
        ({"amplitude": math.inf}, "^amplitude must hold finite numbers"),
        ({"state": (1.0, 0.0, 0.0)}, r"^state must be \(theta"),
    ],
)
def test_what_has_no_period_is_refused(given_: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        UNIT.period(**given_)  # type: ignore[arg-type]


# ---- periods ----

# T/T0 = (2/π) K(sin(θ0/2)) with 20 digits, by mpmath.
PERIODS = {
    1: 1.00001903892100551,
    10: 1.00190718814321661,
    30: 1.01740879759595601,
    60: 1.07318200714936438,
    90: 1.18034059901609623,
    120: 1.37288050061835016,
    150: 1.76220372950375603,
    170: 2.43936271967388406,
    179: 3.90106516038908573,
    179.99: 6.832737338014762,
}


@pytest.mark.parametrize(("degrees", "ratio"), PERIODS.items())
def test_period_to_four_ulp(degrees: float, ratio: float) -> None:
    system = SimplePendulum(length=1.0, gravity=1.0)  # ωn = 1: T = τ · ratio
    got = system.period(math.radians(degrees)) / (2.0 * math.pi)
    # the amplitude in radians is rounded: its half unit counts through dT/dθ0
    step = math.ulp(math.radians(degrees))
    slope = (
        system.period(math.radians(degrees) + 1e-6) - system.period(math.radians(degrees) - 1e-6)
    ) / 2e-6
    slack = 0.5 * step * slope / (2.0 * math.pi)
    assert abs(got - ratio) <= 4 * math.ulp(ratio) + slack


def test_period_of_amplitudes_and_states() -> None:
    system = SimplePendulum(0.7, 9.81)
    wn = system.natural_frequency
    assert system.period(0.0) == pytest.approx(2 * math.pi / wn, rel=1e-15)
    assert system.period([0.1, -0.1]).tolist() == [system.period(0.1)] * 2
    assert system.period(state=(0.3, 0.0)) == pytest.approx(system.period(0.3), rel=1e-15)
    # the same libration seen at its lowest point: ω0 = 2 ωn sin(θ0/2)
    assert system.period(state=(0.0, 2 * wn * math.sin(0.75))) == pytest.approx(
        system.period(1.5), rel=1e-14
    )
    assert system.period(state=(0.0, 2 * wn)) == math.inf or system.period(state=(0.0, 2 * wn)) > 10
    # fast rotation: a turn takes τ/ω0
    assert system.period(state=(0.0, 1e6)) == pytest.approx(2 * math.pi / 1e6, rel=1e-9)
    assert 0 < system.period(math.pi) < 100  # numpy.pi is not π
    assert LinearPendulum(0.7, 9.81).period([0.1, 3.0]).tolist() == [2 * math.pi / wn] * 2


def test_period_of_a_rotation_is_the_time_of_a_turn() -> None:
    from scipy.integrate import quad

    system, start = SimplePendulum(1.0, 9.81), (0.4, 8.0)
    energy = start[1] ** 2 / 2 - 9.81 * math.cos(start[0])
    turn, _ = quad(lambda x: 1 / math.sqrt(2 * (energy + 9.81 * math.cos(x))), 0, 2 * math.pi)
    assert system.period(state=start) == pytest.approx(turn, rel=1e-9)


@pytest.mark.parametrize("arguments", [{}, {"amplitude": 1.0, "state": (1.0, 0.0)}])
def test_period_takes_one_of_two(arguments: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="one of the two"):
        SimplePendulum().period(**arguments)


def test_period_of_more_than_a_half_turn_is_refused() -> None:
    with pytest.raises(ValueError, match=r"amplitude must lie within .*got 3\.2; .*state="):
        SimplePendulum().period(3.2)
