"""Periodic orbits, normal modes and families, against orbits with 40 digits."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import refusals
from pendula import DoublePendulum, DrivenPendulum, LinearPendulum, SimplePendulum
from pendula.chaos import family, normal_mode, periodic_orbit

# Form, mode, θ1, θ2, period, energy, μ: Taylor series of motion and variations in 40 digits; masses
# and lengths 1, gravity 9.81
ORBITS: list[tuple[str, int, float, float, float, float, complex]] = [
    (
        *("rods", 1, 0.25, 0.344150785706474172450596, 2.355406928916542223329586),
        *(0.7450715609780462419070869, -0.282871873687742977 + 0.95915770500808968j),
    ),
    (
        *("rods", 1, 1.05, 0.8819782131002250936882259, 2.455024275479659543242232),
        *(9.180500361705460295436955, -0.916906126575998471 + 0.399102937908754401j),
    ),
    (
        *("rods", 1, 2.05, 1.268074463200213836823529, 2.891300858971363952308444),
        *(24.94240897514964221511598, 18.281832130001085 + 0j),
    ),
    (
        *("rods", 2, 0.45, -0.939856744345229905752027, 1.343357688889866902854841),
        *(3.476443209757109221177107, -0.818910782189875777 + 0.5739208401976407j),
    ),
    (
        *("rods", 2, 1.05, -1.420229527744348276173548, 1.953048833350975037584612),
        *(11.56249917711603614446962, 9.75976197267597258 + 0j),
    ),
    (
        *("bobs", 1, 0.5, 0.659830067045454957683843, 2.671583117606352622420349),
        *(4.460984364905969777102784, -0.992473959550003714 + 0.122455868030640292j),
    ),
    (
        *("bobs", 2, 0.5, -0.6776379047465930797020838, 1.460022709673253061719145),
        *(4.569292569400547171301261, -0.89975733498310368 + 0.436390579806786104j),
    ),
]
NAMES = [f"{form}-{mode}-{theta1}" for form, mode, theta1, *_ in ORBITS]
RODS = DoublePendulum.rods(gravity=9.81)


def double_of(form: str) -> DoublePendulum:
    made: DoublePendulum = getattr(DoublePendulum, form)(gravity=9.81)
    return made


def driven(a: float, q: float = 2.0) -> DrivenPendulum:
    return DrivenPendulum.scaled(q, a, 2.0 / 3.0)


@pytest.mark.parametrize("case", ORBITS, ids=NAMES)
def test_an_orbit_from_four_digits(case: Any) -> None:
    form, _, theta1, theta2, period, energy, multiplier = case
    for about in (round(period, 4), None):
        found = periodic_orbit(double_of(form), (theta1, round(theta2, 4), 0.0, 0.0), about)
        assert abs(found.state - [theta1, theta2, 0.0, 0.0]).max() < 2e-15
        assert abs(found.period - period) < 3e-15
        assert abs(found.energy - energy) < 2e-14
        assert abs(found.multipliers - [1.0, 1.0, multiplier, 1.0 / multiplier]).max() < 1e-12
        assert found.kind == ("elliptic" if multiplier.imag else "hyperbolic")
        assert found.stable == bool(multiplier.imag)
        assert found.closure < 1e-13
        assert found.symmetry == "brake, odd"
        if multiplier.imag:
            assert found.rotation_angle == pytest.approx(
                math.atan2(multiplier.imag, multiplier.real)
            )
        else:
            assert found.rotation_angle is None


@pytest.mark.parametrize("case", ORBITS, ids=NAMES)
def test_a_normal_mode(case: Any) -> None:
    form, mode, theta1, theta2, period, energy, _ = case
    system = double_of(form)
    for asked in ({"amplitude": theta1}, {"energy": energy}):
        found = normal_mode(system, mode, **asked)
        assert abs(found.state - [theta1, theta2, 0.0, 0.0]).max() < 2e-15
        assert abs(found.period - period) < 3e-15


@pytest.mark.parametrize("case", ORBITS[:3], ids=NAMES[:3])
def test_an_orbit_from_a_moving_start(case: Any) -> None:
    """From anywhere on it, and of an energy that is asked for."""
    form, _, theta1, theta2, period, energy, multiplier = case
    system = double_of(form)
    orbit = periodic_orbit(system, (theta1, theta2, 0.0, 0.0), period)
    passing = orbit.trajectory(101).states[37]
    found = periodic_orbit(system, np.round(passing, 4), round(period, 4), energy=energy)
    assert abs(found.period - period) < 1e-13
    assert abs(found.energy - energy) < 1e-13
    assert abs(found.multipliers[2] - multiplier) < 1e-11
    again = periodic_orbit(system, (theta1 + 1e-4, theta2, 0.0, 0.0), energy=energy)
    assert abs(again.state - orbit.state).max() < 1e-14


def test_orbits_that_turn_over() -> None:
    """Both rods turn together; turns are counted out."""
    found = periodic_orbit(RODS, (0.0, 0.0, 8.0, 8.0))
    assert found.turns == (1, 1)
    assert found.closure < 1e-12
    again = periodic_orbit(
        RODS, np.round(found.state, 4), round(found.period, 4), energy=found.energy
    )
    assert abs(again.state - found.state).max() < 1e-12
    assert abs(again.multipliers - found.multipliers).max() < 1e-11


def test_small_modes_are_the_linear_ones() -> None:
    system = DoublePendulum.bobs(1.3, 0.7, 0.8, 1.1)
    modes = system.normal_modes()
    for mode in (1, 2):
        found = normal_mode(system, mode, amplitude=1e-5)
        frequency, shape = modes.frequencies[mode - 1], modes.shapes[mode - 1]
        assert found.period * frequency == pytest.approx(math.tau, rel=1e-9)
        assert found.state[1] / found.state[0] == pytest.approx(shape[1] / shape[0], rel=1e-9)


def test_a_mode_through_a_resonance() -> None:
    """Where the family comes back with θ1 on the other side, its mirror image is given."""
    found = normal_mode(DoublePendulum.rods(1.17, 1.92, 0.55, 1.91, gravity=9.81), 1, energy=15.0)
    assert found.state[0] > 0.0
    assert found.energy == pytest.approx(15.0, rel=1e-14)
    assert found.closure < 1e-13


def test_the_simple_pendulum_has_its_own_period() -> None:
    system = SimplePendulum()
    swing, turn = periodic_orbit(system, (1.0, 0.0)), periodic_orbit(system, (0.3, 8.0))
    assert swing.period == pytest.approx(system.period(1.0), rel=1e-15)
    assert turn.period == pytest.approx(system.period(state=(0.3, 8.0)), rel=1e-14)
    assert (swing.turns, turn.turns) == ((0,), (1,))
    assert np.array_equal(swing.multipliers, [1.0, 1.0])
    assert swing.kind == "parabolic"


# Stroboscopic states of the driven pendulum, q = 2, ωD = 2/3: another Taylor integrator's doubles
DRIVEN = [
    (1, 1.066372862455208, (-0.22147489981695484, 1.9596599332195093), (0,)),
    (4, 1.0820843842942263, (-0.33400569566406035, 2.000560369914727), (0,)),
    (1, 1.424873247206088, (-0.07169137021496587, 0.9786304907094396), (-1,)),
    (8, 1.4774969558022466, (0.17845683118044434, 0.41673215699057187), (-8,)),
]


@pytest.mark.parametrize(("periods", "a", "state", "turns"), DRIVEN)
def test_orbits_of_the_driven_pendulum(
    periods: int, a: float, state: tuple[float, float], turns: tuple[int]
) -> None:
    """They double there: a multiplier is −1, and both together exp(−T/q)."""
    about = round(periods * 3.0 * math.pi, 4)
    found = periodic_orbit(driven(a), np.round(state, 4), about)
    assert abs(found.state - state).max() < 1e-12
    assert abs(found.multipliers[0] + 1.0) < 1e-10
    product = found.multipliers[0] * found.multipliers[1]
    assert abs(product - math.exp(-periods * 3.0 * math.pi / 2.0)) < 1e-13
    assert found.period == pytest.approx(periods * 3.0 * math.pi, rel=1e-15)
    assert (found.turns, found.drive_periods) == (turns, periods)


def test_a_symmetric_orbit_where_the_symmetry_breaks() -> None:
    """There Newton's method with the whole period alone has a singular matrix."""
    found = periodic_orbit(driven(1.0043194774264663), (-1.072, 1.8972))
    assert found.symmetry == "odd"
    assert abs(found.state - [-1.071954314878029, 1.8972317332805793]).max() < 1e-14
    assert abs(found.multipliers[0] - 1.0) < 1e-13


@pytest.mark.parametrize(("mode", "energy"), [(1, 22.3189795012), (2, 8.01573901902)])
@pytest.mark.parametrize("n", [6, 40])
def test_where_a_mode_loses_its_stability(mode: int, energy: float, n: int) -> None:
    found = family(normal_mode(RODS, mode, energy=5.0), n, energy=(1.0, 30.0))
    assert found.outcome == "reached_end"
    assert [each.energy for each in found.orbits] == pytest.approx(np.linspace(1.0, 30.0, n))
    (change,) = found.changes
    assert abs(change.value - energy) < 5e-11
    assert (change.below, change.above, change.multiplier) == ("elliptic", "hyperbolic", 1)
    assert abs(change.orbit.multiplier_sum - 2.0) < 1e-12


RESONANT = DoublePendulum.rods(1.17, 1.92, 0.55, 1.91, gravity=9.81)


def test_a_family_goes_round_its_folds() -> None:
    """Where it turns, its energy is a maximum or minimum also by orbits of kept θ1."""
    found = family(normal_mode(RESONANT, 1, energy=2.0), 15, energy=(0.5, 15.0))
    assert found.outcome == "reached_end"
    assert [each.energy for each in found.orbits] == pytest.approx(found.values)
    upper, lower = found.changes
    assert upper.fold
    assert lower.fold
    rises = np.diff(found.values) > 0.0
    assert rises[: upper.place - 1].all()
    assert not rises[upper.place : lower.place - 1].any()
    assert rises[lower.place :].all()
    assert [each.stable for each in found.orbits] == [
        not upper.place <= i < lower.place for i in range(len(found.orbits))
    ]
    for fold, sign in ((upper, 1.0), (lower, -1.0)):
        beside = [fold.orbit.state + np.array([h, 0.0, 0.0, 0.0]) for h in (-3e-4, 0.0, 3e-4)]
        left, there, right = (
            periodic_orbit(RESONANT, each, fold.orbit.period).energy for each in beside
        )
        assert sign * (there - max(left, right, key=lambda e: sign * e)) > 0.0
        top = there - (right - left) ** 2 / (8.0 * (right - 2.0 * there + left))
        assert abs(fold.value - top) < 1e-9


def test_a_family_that_turns_back_is_told() -> None:
    found = family(normal_mode(RESONANT, 1, energy=9.0), 6, energy=(8.0, 10.0))
    assert found.outcome == "turned"
    assert found.values.tolist() == pytest.approx(
        [8.0, 8.4, 8.8, 9.2, 9.6, 9.6, 9.2, 8.8, 8.4, 8.0]
    )
    assert [each.fold for each in found.changes] == [True]


def test_a_family_by_a_parameter() -> None:
    orbit = periodic_orbit(driven(0.1), (0.0, 0.0))
    found = family(orbit, 20, a=(0.1, 1.05))
    assert len(found.orbits) == 20
    assert [each.value for each in found.changes] == pytest.approx([1.0043194774264663], rel=1e-14)
    made = found.to_xarray()
    assert made["period"].values == pytest.approx(3.0 * math.pi)
    assert made.sizes == {"a": 20, "multiplier": 2}


def test_a_family_that_ends_is_told() -> None:
    """The in-phase mode ends at the energy of both rods on top, 39.24 J."""
    found = family(normal_mode(RODS, 1, energy=30.0), 5, energy=(30.0, 50.0))
    assert found.outcome == "lost"
    assert 0 < len(found.orbits) < 5


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: periodic_orbit(RODS, (0.0, 0.0, 0.0, 0.0)), "state is an equilibrium"),
        (lambda: periodic_orbit(RODS, (0.0, 0.0, 12.0, -12.0), 33.36), "must be near a periodic"),
        (lambda: periodic_orbit(RODS, (0.5, 0.5, 0.0, 0.0), -1.0), "period must be positive"),
        (lambda: periodic_orbit(driven(1.0), (0.0, 0.0), 5.0), "period must be a multiple"),
        (lambda: periodic_orbit(driven(1.0), (0.0, 0.0), energy=1.0), "energy is not constant"),
        (lambda: periodic_orbit(driven(0.0), (0.1, 0.0)), "system must be without friction"),
        (lambda: periodic_orbit(LinearPendulum(viscous=0.1), (1.0, 0.0)), "no motion then repeats"),
        (lambda: normal_mode(RODS, 3, energy=1.0), "mode must be 1"),
        (lambda: normal_mode(RODS, 1), "amplitude must be given, or energy"),
        (lambda: normal_mode(RODS, 1, energy=40.0), "which comes to 39.24 J; got 40.0"),
        (lambda: normal_mode(SimplePendulum(), 1, energy=1.0), "system must be a DoublePendulum"),
        (lambda: family(RODS, energy=(1.0, 2.0)), "orbit must be a periodic orbit"),  # type: ignore[arg-type]
        (lambda: family(normal_mode(RODS, 1, energy=1.0), a=(1.0, 2.0)), "along must be one of"),
        (lambda: family(normal_mode(RODS, 1, energy=1.0), energy=(2.0, 1.0)), "a rising range"),
        (lambda: family(normal_mode(RODS, 1, energy=1.0)), "orbit must be followed along one"),
    ],
)
def test_what_has_no_orbit(call: Any, says: str) -> None:
    assert says in refusals.told(call)
