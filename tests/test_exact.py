import math
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

import pendula
import truth
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, _engine, exact
from stored import BOUNDS, of_motion


@pytest.mark.parametrize(("theta0", "omega0"), [(0.3, 0.0), (-2.0, 1.5), (0.0, -4.0), (0.0, 0.0)])
def test_the_linear_pendulum_is_harmonic(theta0: float, omega0: float) -> None:
    system = LinearPendulum(0.7, 9.81)
    t = np.linspace(-7, 20, 101)
    with mp.workdps(30):
        wn = mp.sqrt(mpf(9.81) / mpf(0.7))
        want = [
            [
                float(theta0 * mp.cos(wn * x) + omega0 / wn * mp.sin(wn * x)),
                float(omega0 * mp.cos(wn * x) - theta0 * wn * mp.sin(wn * x)),
            ]
            for x in map(mpf, t)
        ]
    np.testing.assert_allclose(exact(system, (theta0, omega0), t).states, want, atol=1e-13)


def release_by_mpmath(
    length: float, gravity: float, theta0: float, t: float
) -> tuple[float, float]:
    """Theta and omega of a release from rest: DLMF 22.19(i), 40 digits."""
    with mp.workdps(40):
        k, wn = mp.sin(mpf(theta0) / 2), mp.sqrt(mpf(gravity) / mpf(length))
        u = mp.ellipk(k * k) - wn * mpf(t)
        sn, cn = mp.ellipfun("sn", u, k=k), mp.ellipfun("cn", u, k=k)
        return float(2 * mp.asin(k * sn)), float(-2 * wn * k * cn)


@pytest.mark.parametrize("theta0", [1e-9, 0.1, -0.1, 1.0, math.radians(150), -3.0, 3.1, 3.1415])
def test_a_release_from_rest_agrees_with_mpmath(theta0: float) -> None:
    system = SimplePendulum(0.5, 9.81)
    t = np.array([-3.3, 0.0, 0.01, 0.4, 1.0, 2.5, 9.9])
    want = [release_by_mpmath(0.5, 9.81, theta0, float(x)) for x in t]
    got = exact(system, (theta0, 0.0), t).states
    scale = min(1.0, abs(theta0))
    np.testing.assert_allclose(got, want, rtol=0, atol=2e-13 * scale)


def test_whole_turns_stay_on() -> None:
    system, t = SimplePendulum(), np.linspace(0, 5, 21)
    plain = exact(system, (1.0, 0.0), t).states
    turned = exact(system, (1.0 + 4 * math.pi, 0.0), t).states
    np.testing.assert_allclose(turned - [4 * math.pi, 0], plain, atol=1e-13)


def test_a_release_next_to_the_top_falls() -> None:
    """numpy.pi is not π."""
    system = SimplePendulum()
    quarter = system.period(math.pi) / 4
    theta, omega = exact(system, (math.pi, 0.0), quarter).states[0]
    assert abs(theta) < 1e-9
    assert omega == pytest.approx(-2 * system.natural_frequency, rel=1e-12)


def test_energy_is_constant_and_a_period_brings_the_state_back() -> None:
    system = SimplePendulum(0.5, 9.81)
    for amplitude in (0.01, 1.0, 2.6, 3.14):
        period = system.period(amplitude)
        run = exact(system, (amplitude, 0.0), np.linspace(0, 3 * period, 200))
        assert np.abs(run.energy_error).max() < 1e-13
        np.testing.assert_allclose(run.at(run.t + period), run.states, atol=2e-11)
        np.testing.assert_allclose(run.at(-run.t)[:, 0], run.theta, atol=1e-14)


def test_many_states_at_once_and_any_order_of_times() -> None:
    system, starts = SimplePendulum(), [(0.5, 0.0), (2.0, 0.0), (-1.0, 0.0)]
    t = [3.0, -1.0, 0.0, 7.5]
    many = exact(system, starts, t, t0=0.5)
    assert many.states.shape == (3, 4, 2)
    assert many.theta.shape == many.energy.shape == many.energy_error.shape == (3, 4)
    for start, states in zip(starts, many.states, strict=True):
        assert (exact(system, start, t, t0=0.5).states == states).all()
    assert exact(system, starts[0], 0.5, t0=0.5).states.tolist() == [[0.5, 0.0]]
    assert many.at([1.0]).shape == (3, 1, 2)


def test_what_has_no_closed_form_here_is_refused() -> None:
    with pytest.raises(
        ValueError, match=r"^system must be a LinearPendulum or SimplePendulum.*use solve"
    ):
        exact(DoublePendulum.rods(), (1, 1, 0, 0), 1.0)
    with pytest.raises(ValueError, match="^t must hold finite numbers"):
        exact(SimplePendulum(), (1.0, 0.0), [1.0, math.nan])
    with pytest.raises(ValueError, match="^system must be a pendulum"):
        exact("simple", (1.0, 0.0), 1.0)  # type: ignore[arg-type]


ANGLE = (
    r"^state must have an angle below 2\^50 rad, got -?1125899906842624\.0; take whole turns off$"
)
TIME = (
    r"^t must lie within 2\^(50|200) half periods of t0.*"
    r"got t - t0 = -?1e\+(17|62) s from state \[[01]\.0, 0"
)
SLOW = SimplePendulum(1.0, 1.0)  # half a period is π or more


@pytest.mark.parametrize(
    ("system", "state", "t", "message"),
    [
        (SLOW, (2.0**50, 0.0), 1.0, ANGLE),
        (SLOW, (-(2.0**50), 3.0), 0.0, ANGLE),
        (SLOW, [(1.0, 0.0), (2.0**50, 0.0)], [0.0, 1.0], ANGLE),
        (SLOW, (1.0, 0.5), 1e62, TIME),
        (SLOW, (1.0, 0.5), [0.0, 1.0, -1e62], TIME),
        (SLOW, [(0.0, 0.0), (1.0, 0.5)], [*range(20), 1e62], TIME),
        (
            LinearPendulum(1.0, 1.0),
            (1e290, 0.5),
            1.0,
            r"^state must have an angle below 2\^900 rad",
        ),
        (SLOW, (1.0, 1e280), 1e-290, "^state must have an angular velocity below 8.45e"),
        (LinearPendulum(1.0, 1.0), (1.0, 0.5), 1e17, TIME),
        (LinearPendulum(1.0, 1.0), (1.0, 0.5), [1.0, -1e17], TIME),
    ],
)
def test_what_double_precision_cannot_tell_is_refused(
    system: LinearPendulum | SimplePendulum, state: Any, t: Any, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        exact(system, state, t)


def test_what_it_can_just_tell_is_taken() -> None:
    half_period = SLOW.period(state=(1.0, 0.5)) / 2
    exact(SLOW, (1.0, 0.5), half_period * 2.0**200 * (1 - 1e-12))
    with pytest.raises(ValueError, match="^t must lie within"):
        exact(SLOW, (1.0, 0.5), half_period * 2.0**200 * (1 + 1e-12))
    assert exact(SLOW, (math.nextafter(2.0**50, 0), 0.3), [0.0, 9.0]).states.shape == (2, 2)
    assert exact(SLOW, (0.0, 2.0), 1e10).theta[0] == math.pi  # the separatrix takes more


def test_the_public_names_are_there() -> None:
    assert all(hasattr(pendula, name) for name in pendula.__all__)


def test_energies_and_positions_of_many_turns() -> None:
    """Of angles that the sine has no digits for: the turns come off first."""
    run = exact(SimplePendulum(1.0, 9.81), (1.0, 9.0), [1e9])
    assert run.theta[0] > _engine.LARGEST_ANGLE
    with mp.workdps(40):
        turns = mp.nint(mpf(run.theta[0]) / (2 * mp.pi))
        rest = float(mpf(run.theta[0]) - 2 * mp.pi * turns)
    assert abs(run.positions[0, 0, 0] - math.sin(rest)) < 1e-15
    assert abs(run.energy_error[0]) < 1e-6  # of the angle's own rounding


@pytest.mark.parametrize("exponent", [13, 16, 20])
def test_counts_beyond_three_doubles(exponent: int) -> None:
    system, t = SimplePendulum(0.7, 9.81), 10.0**exponent
    for start in ((1.0, 0.3), (0.5, 1e4)):
        got = exact(system, start, t).states[0]
        with mp.workdps(80):
            want = truth.simple(*start, 9.81, 0.7, mpf(t))
        assert of_motion(got, want) <= BOUNDS.motion
