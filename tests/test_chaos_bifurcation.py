"""Bifurcations of the driven pendulum, against another integrator's roots and exponents."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import refusals
from pendula import DoublePendulum, DrivenPendulum
from pendula.chaos import bifurcation, period_doublings, periodic_orbit

# θ̈ + θ̇/2 + sin θ = a cos(2t/3): where multipliers pass ∓1, by another Taylor integrator
BREAKING = 1.0043194774264663
DOUBLINGS = (
    1.066372862455208,
    1.0793139059037182,
    1.0820843842942263,
    1.0826783527040238,
    1.082805591155011,
    1.082832843256021,
)
ROTATING = (1.424873247206088, 1.4598246038432494, 1.476348757081878, 1.4774969558022466)
# Largest exponents and their standard errors, of 400 to 20000 periods
EXPONENTS = [
    (0.9, -0.25001, 0.0015),
    (1.05, -0.09149, 0.00029),
    (1.07, -0.039771, 0.00016),
    (1.15, 0.099589, 0.00096),
    (1.2, 0.132219, 0.00086),
    (1.45, -0.042006, 5.4e-05),
]


def driven(a: float = 1.0) -> DrivenPendulum:
    return DrivenPendulum.scaled(2.0, a, 2.0 / 3.0)


def test_a_cascade_of_doublings() -> None:
    orbit = periodic_orbit(driven(1.05), (-0.2, 2.0))
    found = period_doublings(orbit, "a", 1.083, periods=32)
    assert [each.multiplier for each in found] == [-1] * 6
    assert [each.orbit.drive_periods for each in found] == [1, 2, 4, 8, 16, 32]
    assert abs(np.array([each.value for each in found]) - DOUBLINGS).max() < 1e-12
    assert found[0].below == "stable node"
    assert found[0].above == "inverse hyperbolic"


def test_a_cascade_of_turning_orbits() -> None:
    orbit = periodic_orbit(driven(1.42), (-0.07, 0.98))
    found = period_doublings(orbit, "a", 1.4777, periods=8)
    assert abs(np.array([each.value for each in found]) - ROTATING).max() < 1e-13
    assert [each.orbit.turns for each in found] == [(-1,), (-2,), (-4,), (-8,)]


@pytest.mark.parametrize("values", [(1.0, 1.05, 1.07, 1.0825), (1.0825, 1.07, 1.05, 1.0)])
def test_changes_between_values(values: tuple[float, ...]) -> None:
    """Up and down; between the last two values several doublings follow one another."""
    start = (0.0, 0.0) if values[0] == 1.0 else (-0.334, 2.0)
    found = bifurcation(driven(), "a", values, state=start, points=64, transient=400)
    want = (BREAKING, *DOUBLINGS[:3])
    assert [each.value for each in found.changes] == pytest.approx(want, rel=1e-13)
    assert [each.value for each in found.doublings] == pytest.approx(want[1:], rel=1e-13)
    periods = dict(zip(found.values.tolist(), found.periods.tolist(), strict=True))
    assert periods == {1.0: 1, 1.05: 1, 1.07: 2, 1.0825: 8}


def test_exponents_and_their_sum() -> None:
    values = [a for a, *_ in EXPONENTS]
    found = bifurcation(
        driven(), "a", values, state=(0.2, 0.0), points=320, follow=False, changes=False
    )
    # In chaos a period stretches up to 560 times, and rounding takes half a unit of |Φ|² from the
    # determinant e^(−T/q): 3.0e-12 and 6.0e-12 in the mean, at most; 1.1e-12 and 3.8e-13 measured.
    defects = abs(found.exponents.sum(axis=1) + 0.5)
    chaotic = np.array([exponent > 0 for _, exponent, _ in EXPONENTS])
    assert defects[chaotic].max() < 3e-12
    assert defects[~chaotic].max() < 1e-13
    for (_, exponent, error), largest, own in zip(
        EXPONENTS, found.exponents[:, 0], found.standard_errors, strict=True
    ):
        assert abs(largest - exponent) < 3.0 * math.hypot(error, own)
        assert own < 0.02
    assert found.changes == ()
    assert (found.periods > 0).tolist() == [exponent < 0 for _, exponent, _ in EXPONENTS]


def test_points_are_the_attractor() -> None:
    found = bifurcation(driven(), "a", [1.07], points=40)
    first, second = found.points[0, -2:]
    orbit = periodic_orbit(driven(1.07), second, 6.0 * math.pi)
    assert abs(orbit.state - second).max() < 1e-6
    assert abs(found.points[0, -4] - first).max() < 1e-6
    assert abs(first - second).max() > 0.01


def test_double_pendulums_by_energy() -> None:
    """Regular at 2 J, chaotic at 20 J: 1.1972 ± 0.0024 1/s, of twelve runs of 10 000 s or more."""
    system = DoublePendulum.rods(gravity=9.81)
    found = bifurcation(system, "energy", [2.0, 20.0], points=300, section=(0.3, 0.1))
    regular, chaotic = found.exponents[:, 0]
    assert regular < 0.05
    assert abs(chaotic - 1.1972) < 3.0 * math.hypot(found.standard_errors[1], 0.0024)
    assert found.standard_errors[1] < 0.1
    assert abs(found.exponents[:, ::-1] + found.exponents).max() < 0.02  # in pairs
    assert found.to_xarray().sizes == {"energy": 2, "point": 300, "order": 4, "change": 0}


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: bifurcation(driven(), "b", [1.0]), "parameter must be one of q, a"),
        (lambda: bifurcation(driven(), "a", [0.0]), "system must be a driven or a double"),
        (lambda: bifurcation(driven(), "a", [1.0], points=3), "points must be at least 32"),
        (lambda: bifurcation(driven(), "a", [[1.0]]), "values must hold from 1"),
        (lambda: bifurcation(DoublePendulum.rods(), "m2", [1.0]), "energy must be given, unless"),
        (lambda: period_doublings(None, "a", 1.0), "orbit must be a periodic orbit of a driven"),  # type: ignore[arg-type]
    ],
)
def test_what_has_no_bifurcations(call: Any, says: str) -> None:
    assert says in refusals.told(call)
