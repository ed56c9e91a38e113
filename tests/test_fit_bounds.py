"""Errors of values that cannot be beyond a bound: frictions near zero."""

from __future__ import annotations

import numpy as np
import pytest

from pendula.measured import fit
from pendula.measured.bounded import _drawn
from simulated import clean, swing


def moments(
    centre: list[float], covariance: list[list[float]], lower: list[float]
) -> tuple[np.ndarray, np.ndarray]:
    """Mean (m,) and second moments (m, m) of a normal distribution above bounds."""
    upper = np.full(len(centre), np.inf)
    points, weights = _drawn(np.array(centre), np.array(covariance), np.array(lower), upper)
    return weights @ points, np.einsum("n,ni,nj->ij", weights, points, points)


def test_one_value_near_its_bound_is_spread_as_a_truncated_normal() -> None:
    # mean and mean square of N(μ, 1) above 0, by its hazard λ = φ(μ)/Φ(μ): μ + λ, 1 + μ² + μ λ
    hazards = {0.0: 0.79788456, 1.0: 0.28759997, -1.0: 1.52513528, -6.0: 6.15844827}
    for mu, hazard in hazards.items():
        mean, square = moments([mu], [[1.0]], [0.0])
        assert mean[0] == pytest.approx(mu + hazard, abs=1e-3)
        assert square[0, 0] == pytest.approx(1.0 + mu * mu + mu * hazard, abs=5e-3)


def test_two_values_that_are_alike_share_what_the_bounds_leave() -> None:
    covariance = [[1.0, -0.95], [-0.95, 1.0]]
    random = np.random.default_rng(0).multivariate_normal([0.4, 0.3], covariance, 400_000)
    kept = random[(random > 0.0).all(axis=1)]
    mean, square = moments([0.4, 0.3], covariance, [0.0, 0.0])
    np.testing.assert_allclose(mean, kept.mean(axis=0), atol=6e-3)
    np.testing.assert_allclose(square, kept.T @ kept / len(kept), atol=6e-3)


def test_an_error_says_no_more_than_the_bounds_leave() -> None:
    narrower = 0
    for seed in range(8):
        made, _ = swing(seed, 0.9, ("viscous", "coulomb"))
        found = fit(made, "viscous + coulomb")
        free = found.error_kinds["autocorrelation"]
        i = found.names.index("viscous")
        narrower += bool(found.standard_errors[i] < 0.8 * free[i])
        assert (np.linalg.eigvalsh(found.correlation) > -1e-9).all()
    assert narrower >= 2
    far = fit(clean(viscous=0.1), "viscous")
    np.testing.assert_array_equal(far.standard_errors, far.error_kinds["autocorrelation"])
