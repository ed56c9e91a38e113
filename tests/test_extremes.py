"""The ends of the range: the largest angles, and amplitudes down to the smallest numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from mpmath import cos, mp, mpf, pi, sqrt

from pendula import DoublePendulum, LinearPendulum, SimplePendulum, ensemble, exact, solve

if TYPE_CHECKING:
    from pendula._types import MethodName

RODS = DoublePendulum.rods(m1=1.3, m2=0.7, l1=0.9, l2=1.1)
DOUBLES = [
    RODS,
    DoublePendulum.bobs(m1=1.3, m2=0.7, l1=0.9, l2=1.1),
    DoublePendulum.bodies(m1=1.0, m2=2.0, l1=1.0, c1=0.4, c2=0.6, I1=0.1, I2=0.2),
]
FAR = [(3.4e7, -3.4e7), (-6.7e7, 6.7e7), (6.7e7, 6.6e7), (1e5, -1e5), (2.0, -1.0)]


@pytest.mark.parametrize("system", DOUBLES)
@pytest.mark.parametrize("angles", FAR)
def test_energies_of_large_angles(system: DoublePendulum, angles: tuple[float, float]) -> None:
    """Each angle within 2^26, though their difference is not."""
    state, constants = (*angles, 0.1, 0.2), {k: mpf(v) for k, v in system.constants.items()}
    with mp.workdps(40):
        a, b, w1, w2 = (mpf(x) for x in state)
        kinetic = (constants["A"] * w1**2 + constants["B"] * w2**2) / 2
        kinetic += constants["C"] * w1 * w2 * cos(a - b)
        potential = constants["D"] * (1 - cos(a)) + constants["E"] * (1 - cos(b))
    assert float(system.energy(state)) == pytest.approx(float(kinetic + potential), rel=1e-14)
    run = solve(system, state, [0.1])
    # the angles of its states are rounded to 1.5e-8 rad there
    assert run.energy[-1] == pytest.approx(float(kinetic + potential), rel=1e-7)
    energies = ensemble(system, [state], [0.1]).energy
    assert energies.ravel()[-1] == run.energy[-1]


SPINS = [(1e160, -1e160), (-1e308, 1e308), (1e154, -2e154), (1e154, -1.9e154), (1e154, 3e-160)]


@pytest.mark.parametrize("system", DOUBLES)
@pytest.mark.parametrize("spin", [*SPINS, *((-b, -a) for a, b in SPINS)])
@pytest.mark.parametrize("angles", [(1.0, 1.0), (0.0, 3.14), (2.0, -1.0)])
def test_energies_of_velocities_whose_squares_overflow(
    system: DoublePendulum, angles: tuple[float, float], spin: tuple[float, float]
) -> None:
    """Infinite where they are beyond all doubles, never nan; else right."""
    constants = {k: mpf(v) for k, v in system.constants.items()}
    with mp.workdps(40):
        (a, b), (w1, w2) = (map(mpf, pair) for pair in (angles, spin))
        kinetic = (constants["A"] * w1**2 + constants["B"] * w2**2) / 2
        kinetic += constants["C"] * w1 * w2 * cos(a - b)
    truth = float(kinetic) if kinetic < np.finfo(float).max else np.inf
    state, calm = (*angles, *spin), (*angles, 0.1, 0.2)
    assert system.kinetic_energy(state) == pytest.approx(truth, rel=1e-14)
    both = system.energy([[state, calm], [calm, state]])
    assert both[0, 0] == both[1, 1] == system.energy(state) == pytest.approx(truth, rel=1e-14)
    assert both[0, 1] == both[1, 0] == system.energy(calm)


@pytest.mark.parametrize("system", [SimplePendulum(0.5), LinearPendulum(0.5)])
def test_energies_of_one_bob_whose_square_overflows(system: SimplePendulum) -> None:
    assert system.energy((1.0, -1e160)) == system.kinetic_energy((1.0, 1e160)) == np.inf
    assert system.kinetic_energy((1.0, 2e154)) == pytest.approx(5e307, rel=1e-15)
    assert np.isnan(system.energy((1e160, 1.0))) == system.can.periodic  # beyond the sine's range


@pytest.mark.parametrize("method", ["taylor", "dop853"])
@pytest.mark.parametrize("amplitude", [1e-77, 1e-150, 1e-155, 1e-163, 1e-200, 1e-250, 1e-300])
@pytest.mark.parametrize("system", [SimplePendulum(0.5), LinearPendulum(0.5)])
def test_the_smallest_swings(system: Any, amplitude: float, method: MethodName) -> None:
    """Whose energy is below the smallest number; alone and through the lanes."""
    for state in ((amplitude, 0.0), (0.0, -3.0 * amplitude), (-amplitude, amplitude)):
        right = exact(system, state, [1.0, -3.0]).states / amplitude
        for n, t in enumerate((1.0, -3.0)):
            run = solve(system, state, [t], method)
            np.testing.assert_allclose(run.states[-1] / amplitude, right[n], rtol=1e-12)
            lanes = ensemble(system, [state, (1.0, 0.0)], [t], method)
            assert lanes.states[0, -1].tobytes() == run.states[-1].tobytes()


@pytest.mark.parametrize("method", ["taylor", "dop853"])
@pytest.mark.parametrize("amplitude", [1e-150, 1e-155, 1e-163, 1e-200, 1e-300])
@pytest.mark.parametrize("system", DOUBLES)
def test_the_smallest_swings_of_two(
    system: DoublePendulum, amplitude: float, method: MethodName
) -> None:
    """They are those of 1e-20 rad, smaller."""
    small = np.array([1.0, -0.5, 0.3, 2.0])
    right = solve(system, 1e-20 * small, [2.0], "taylor").states[-1] * 1e20
    run = solve(system, amplitude * small, [2.0], method)
    np.testing.assert_allclose(run.states[-1] / amplitude, right, rtol=1e-11)
    assert run.n_steps < 600


@pytest.mark.parametrize("method", ["taylor", "dop853"])
@pytest.mark.parametrize(("amplitude", "digits"), [(1e-310, 1e-11), (1e-313, 1e-8), (1e-315, 1e-6)])
def test_below_the_normal_numbers(amplitude: float, digits: float, method: MethodName) -> None:
    """As far as the digits go that are left there."""
    for system in (SimplePendulum(0.5), LinearPendulum(0.5)):
        right = exact(system, (1e-9, 2e-9), [2.0]).states[0] * 1e9
        run = solve(system, (amplitude, 2 * amplitude), [2.0], method)
        np.testing.assert_allclose(run.states[-1] / amplitude, right, rtol=0, atol=30 * digits)


@pytest.mark.parametrize("method", ["taylor", "dop853"])
@pytest.mark.parametrize("gravity", [1e-100, 1e-40, 1e-20, 1e-12, 1e12, 1e20, 1e40, 1e100])
def test_motions_of_any_frequency_are_alike(gravity: float, method: MethodName) -> None:
    """With a time that is counted in periods; alone and through the lanes."""
    unit = float(sqrt(mpf(9.8) / mpf(gravity)))
    for make, state in (
        (lambda g: SimplePendulum(1.0, g), (1.0, 0.0)),
        (lambda g: LinearPendulum(1.0, g), (1.0, 0.0)),
        (lambda g: DoublePendulum.rods(gravity=g), (1.0, 0.5, 0.0, 0.0)),
    ):
        half = len(state) // 2
        usual = solve(make(9.8), state, [2.0], method)
        run = solve(make(gravity), state, [2.0 * unit], method, max_steps=10_000)
        assert run.outcome == "reached_end"
        assert abs(run.n_steps - usual.n_steps) <= 3
        np.testing.assert_allclose(run.states[0, :half], usual.states[0, :half], atol=1e-13)
        np.testing.assert_allclose(run.states[0, half:] * unit, usual.states[0, half:], atol=1e-12)
        lanes = ensemble([make(gravity), make(2 * gravity)], state, [2.0 * unit], method)
        assert lanes.states[0].tobytes() == run.states.tobytes()


def test_the_period_of_the_smallest_swings_is_the_linear_one() -> None:
    rng = np.random.default_rng(8)
    for length, gravity in np.exp(rng.uniform(-12.0, 12.0, (500, 2))):
        linear = LinearPendulum(length, gravity).period(1.0)
        assert SimplePendulum(length, gravity).period(0.0) == linear
        with mp.workdps(40):
            right = 2 * pi * sqrt(mpf(length) / mpf(gravity))
            assert abs(mpf(linear) - right) <= 0.5001 * mpf(np.spacing(linear))
