"""The analysis against mpmath and against cases whose answer is known."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from catalogue import FIXED, SYSTEMS, label, some_state
from pendula import DoublePendulum, LinearPendulum, exact, solve
from pendula._engine import Method
from pendula.analysis import (
    agm_iterations,
    angle_difference,
    convergence_order,
    linear_model_error,
    parting_time,
    period_limit,
    series_terms,
    small_angle_limit,
)
from pendula.systems import System

STEPS = np.array([0.1, 0.05, 0.025, 0.0125, 0.00625, 0.003125])


def test_order_of_a_pure_power() -> None:
    fit = convergence_order(STEPS, 3e-3 * STEPS**2)
    assert fit.order == pytest.approx(2, abs=1e-12)
    assert fit.constant == pytest.approx(3e-3, rel=1e-11)
    assert fit.used.tolist() == [False, False, False, True, True, True]


def test_order_ignores_what_is_too_coarse_rounded_or_broken() -> None:
    errors = 1e4 * STEPS**4
    errors[0] = np.nan  # broke down
    errors[1] = 0.4  # no longer small
    errors[-1] = 3e-12  # rounding
    fit = convergence_order(STEPS, errors)
    assert fit.order == pytest.approx(4, abs=1e-9)
    assert fit.used.tolist() == [False, False, True, True, True, False]


def test_order_does_not_depend_on_the_order_of_the_steps() -> None:
    errors = STEPS * (1 + STEPS)
    backwards = convergence_order(STEPS[::-1], errors[::-1])
    assert backwards.order == pytest.approx(convergence_order(STEPS, errors).order, rel=1e-12)


def test_no_order_from_one_point() -> None:
    assert math.isnan(convergence_order([0.1, 0.05], [np.nan, 1e-3]).order)


@pytest.mark.parametrize(
    ("steps", "errors", "message"),
    [([0.1, 0.2], [1e-3], "one length"), ([0.1, 0.0], [1e-3, 1e-3], "positive, got")],
)
def test_order_refuses(steps: list[float], errors: list[float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        convergence_order(steps, errors)


@pytest.mark.parametrize(
    "method", [each for each in FIXED if each.needs == "flow"], ids=lambda each: each.name
)
@pytest.mark.parametrize("system", SYSTEMS, ids=label)
def test_measured_orders_are_those_of_theory(system: System, method: Method) -> None:
    state = 2.0 * some_state(system)
    steps = 0.05 / 2.0 ** np.arange(9)
    t = np.arange(21) * 0.05
    truth = solve(system, state, t)
    errors = [
        angle_difference(solve(system, state, t, method.name, step=h), truth).max() for h in steps
    ]
    above_rounding = np.array(errors) > 1e-13
    order = convergence_order(steps[above_rounding], np.array(errors)[above_rounding]).order
    assert order == pytest.approx(method.order, abs=0.1)


def test_angle_difference_of_two_cosines() -> None:
    pendulum, t = LinearPendulum(), np.linspace(0, 3, 50)
    one, two = (exact(pendulum, (a, 0.0), t) for a in (0.1, 0.3))
    expected = 0.2 * np.abs(np.cos(pendulum.natural_frequency * t))
    np.testing.assert_allclose(angle_difference(two, one), expected, atol=1e-15)


def test_angle_difference_takes_the_larger_angle_and_counts_turns() -> None:
    rods, t = DoublePendulum.rods(), np.array([0.0, 0.1])
    still = solve(rods, (0.0, 0.0, 0.0, 0.0), t, "rk4", step=0.1)
    turned = solve(rods, (0.0, math.tau, 0.0, 0.0), t, "rk4", step=0.1)
    np.testing.assert_allclose(angle_difference(turned, still), math.tau, rtol=1e-12)


def test_angle_difference_after_a_breakdown_is_nan() -> None:
    rods, start = DoublePendulum.rods(), (2.0, -0.2, 0.0, 0.0)
    t = np.arange(1, 401) * 1.0
    broken = solve(rods, start, t, "euler", step=1.0)
    assert broken.outcome == "not_finite"
    reference = solve(rods, start, t, "rk4", step=0.01)
    difference = angle_difference(broken, reference)
    assert len(difference) == 400
    assert np.isnan(difference[-1])
    assert parting_time(t, difference, 1e300) <= broken.t[-1]


def test_angle_difference_needs_equal_times() -> None:
    pendulum = LinearPendulum()
    one, two = (exact(pendulum, (0.1, 0.0), np.arange(5) * dt) for dt in (0.1, 0.2))
    with pytest.raises(ValueError, match="same times"):
        angle_difference(one, two)


@pytest.mark.parametrize(
    ("difference", "expected"),
    [
        ([0.0, 1.0, 2.0, 3.0], 2.5),
        ([0.0, 3.0, 0.0, 0.0], 1.0 + 1.25 / 3),  # between the samples, and the first time
        ([0.0, 1.0, 1.25, 1.25], math.inf),  # reached, not passed
        ([2.0, 0.0, 0.0, 0.0], 1.0),
        ([0.0, 1.0, np.nan, np.nan], 2.0),
        ([0.0, 1.0, np.inf, np.nan], 2.0),
    ],
)
def test_parting_time(difference: list[float], expected: float) -> None:
    tolerance = 1.25 if expected != 2.5 else 1.5
    assert parting_time([1.0, 2.0, 3.0, 4.0], difference, tolerance) == pytest.approx(expected)


def test_parting_time_refuses_a_tolerance_of_zero() -> None:
    with pytest.raises(ValueError, match=r"tolerance must be positive \[rad\], got 0"):
        parting_time([0.0], [0.0], 0)


def _terms(kc: float, tolerance: float) -> int:
    """Terms of the series needed, counted one by one in 40 digits."""
    with mpmath.workdps(40):
        m = 1 - mpmath.mpf(kc) ** 2
        total = mpmath.ellipk(m) * 2 / mpmath.pi
        term = partial = mpmath.mpf(1)
        count = 1
        while (total - partial) / total > tolerance:
            term *= (mpmath.mpf(2 * count - 1) / (2 * count)) ** 2 * m
            partial += term
            count += 1
        return count


@pytest.mark.parametrize("tolerance", [1e-12, 1e-3])
@pytest.mark.parametrize("degrees", [0.001, 5, 30, 90, 150, 170])
def test_series_terms(degrees: float, tolerance: float) -> None:
    kc = math.cos(math.radians(degrees) / 2)
    assert series_terms(kc, tolerance) == _terms(kc, tolerance)


def test_series_terms_that_do_not_suffice() -> None:
    kc = math.cos(math.radians(150) / 2)
    needed = int(series_terms(kc, 1e-12))
    assert series_terms(kc, 1e-12, largest=needed) == needed
    assert series_terms(kc, 1e-12, largest=needed - 1) == math.inf
    np.testing.assert_array_equal(series_terms([1.0, kc], 1e-12), [1, needed])


@pytest.mark.parametrize("kc", [0.99, 0.5, 1e-3, 1e-12])
def test_agm_iterations(kc: float) -> None:
    tolerance = 1e-12
    n = int(agm_iterations(kc, tolerance))
    with mpmath.workdps(40):
        truth = mpmath.ellipk(1 - mpmath.mpf(kc) ** 2)
        a, g = mpmath.mpf(1), mpmath.mpf(kc)
        errors = []
        for _ in range(n + 1):
            errors.append(float(abs(mpmath.pi / (2 * a) / truth - 1)))
            a, g = (a + g) / 2, mpmath.sqrt(a * g)
    assert errors[n] <= tolerance < errors[n - 1]


@pytest.mark.parametrize("count", [series_terms, agm_iterations])
@pytest.mark.parametrize(("kc", "tolerance"), [(0.0, 1e-9), (1.5, 1e-9), (0.5, 0.0), (0.5, 1.0)])
def test_cost_refuses(count: Callable[..., Any], kc: float, tolerance: float) -> None:
    with pytest.raises(ValueError, match="must lie"):
        count(kc, tolerance)


@pytest.mark.parametrize(("degrees", "swings"), [(5, 1), (60, 1), (20, 10)])
def test_linear_model_error_against_mpmath(degrees: float, swings: int) -> None:
    amplitude = mpmath.radians(degrees)
    k = mpmath.sin(amplitude / 2)

    def apart(turns: Any) -> Any:
        u = 2 * mpmath.pi * turns
        sn = mpmath.ellipfun("sn", mpmath.ellipk(k**2) - u, k=k)
        return abs(amplitude * mpmath.cos(u) - 2 * mpmath.asin(k * sn)) / amplitude

    # The largest error comes in the last half swing; looked for three times as finely.
    places = np.linspace(swings - 0.5, swings, 300)
    expected = float(max(apart(turns) for turns in places))
    assert linear_model_error(math.radians(degrees), swings) == pytest.approx(expected, rel=2e-4)


def test_linear_model_error_has_the_shape_of_the_amplitudes() -> None:
    errors = linear_model_error([[0.1, 0.2], [0.3, 3.0]], 1)
    assert errors.shape == (2, 2)
    assert errors[0, 1] == linear_model_error(0.2, 1)


@pytest.mark.parametrize(("amplitude", "swings"), [(0.0, 1), (math.pi, 1), (0.1, 0), (np.nan, 1)])
def test_linear_model_error_refuses(amplitude: float, swings: int) -> None:
    with pytest.raises(ValueError, match=r"amplitude|swings"):
        linear_model_error(amplitude, swings)


@pytest.mark.parametrize("swings", [1, 10])
@pytest.mark.parametrize("tolerance", [0.001, 0.01, 0.5, 0.99])
def test_small_angle_limit_is_the_first_amplitude_with_that_error(
    tolerance: float, swings: int
) -> None:
    limit = small_angle_limit(tolerance, swings)
    assert linear_model_error(limit, swings) == pytest.approx(tolerance, rel=1e-6)
    assert np.all(linear_model_error(np.linspace(0.01, 0.999, 50) * limit, swings) < tolerance)


@pytest.mark.parametrize("tolerance", [0.001, 0.01, 0.9])
def test_period_limit_against_mpmath(tolerance: float) -> None:
    def excess(amplitude: Any) -> Any:
        return 2 / mpmath.pi * mpmath.ellipk(mpmath.sin(amplitude / 2) ** 2) - 1 - tolerance

    expected = mpmath.findroot(excess, (0.05, 3.1), solver="anderson")
    assert period_limit(tolerance) == pytest.approx(float(expected), rel=1e-8)


@pytest.mark.parametrize("limit", [small_angle_limit, period_limit])
@pytest.mark.parametrize("tolerance", [0.0, 1.0, np.nan])
def test_limits_refuse(limit: Callable[[float], float], tolerance: float) -> None:
    with pytest.raises(ValueError, match="tolerance must lie between 0 and 1"):
        limit(tolerance)
