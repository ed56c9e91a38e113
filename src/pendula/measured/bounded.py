"""Uncertainties of values that cannot be beyond a bound: friction is never negative."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from pendula._checks import extra

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.measured.errors import Errors
    from pendula.measured.problem import Problem

_NEAR = 5.0  # standard errors from a bound: beyond it does not matter
_POINTS = 4096


def within_bounds(problem: Problem, x: Array, errors: Errors) -> Errors:
    """The errors with what lies beyond bounds left out.

    Without bounds the true values are spread about the optimum that least squares would then have,
    normally with the covariance of the errors. What the bounds leave of that is no longer normal,
    nor centred on the values; the standard errors are its root mean square distances from them.
    With frictions that a short record does not tell apart the free errors reach far beyond zero.

    Args:
        problem: that was solved.
        x: its optimum within the bounds, (k,).
        errors: as if there were no bounds.
    """
    import numpy as np

    lower, upper = problem.bounds()
    active = ((x == lower) | (x == upper)).any()
    centre = x + errors.beyond if active else x
    reach = _NEAR * np.sqrt(np.diagonal(errors.covariance))
    near = np.flatnonzero(
        ((centre - lower < reach) | (upper - centre < reach)) & np.isfinite(errors.standard)
    )
    if not near.size:
        return errors
    covariance = errors.covariance
    inner = covariance[np.ix_(near, near)]
    points, weights = _drawn(centre[near], inner, lower[near], upper[near])
    along = np.linalg.lstsq(inner, covariance[near], rcond=None)[0].T
    away = centre - x + (points - centre[near]) @ along.T
    rest = covariance - along @ covariance[near]
    moments = np.einsum("n,ni,nj->ij", weights, away, away) + rest
    spread = np.sqrt(np.maximum(np.diagonal(moments), 0.0))
    standard = np.where(np.isfinite(errors.standard), spread, errors.standard)
    return replace(errors, covariance=moments, standard=standard)


def _drawn(centre: Array, covariance: Array, lower: Array, upper: Array) -> tuple[Array, Array]:
    """Points (n, m) of a normal distribution between bounds, and their weights (n,).

    One component after the other, each between its bounds given those before (Geweke, Hajivassiliou
    and Keane: Hajivassiliou & McFadden, Econometrica 66 (1998) 863), of evenly spread numbers.
    """
    import numpy as np

    special = extra("scipy.special", "fit")
    root = _root(covariance)
    m = len(centre)
    even = _even(m)
    normal, logarithm = np.zeros((_POINTS, m)), np.zeros(_POINTS)
    for j in range(m):
        known = centre[j] + normal[:, :j] @ root[j, :j]
        low, high = (lower[j] - known) / root[j, j], (upper[j] - known) / root[j, j]
        turned = low > 0.0  # the tail is told in small numbers on the other side
        low, high = np.where(turned, -high, low), np.where(turned, -low, high)
        least, most = special.ndtr(low), special.ndtr(high)
        drawn = special.ndtri(np.maximum(least + even[:, j] * (most - least), 1e-300))
        normal[:, j] = np.where(turned, -drawn, drawn)
        logarithm += np.log(np.maximum(most - least, 1e-300))
    weights = np.exp(logarithm - logarithm.max())
    return centre + normal @ root.T, weights / weights.sum()


def _root(covariance: Array) -> Array:
    """Cholesky's root (m, m), also where rounding leaves a covariance without one.

    Values that the record does not tell apart have correlations of 1; their differences are then
    known to no better than 10^-6 of the standard errors.
    """
    import numpy as np

    scale = np.sqrt(np.diagonal(covariance))
    sizes, axes = np.linalg.eigh(covariance / np.outer(scale, scale))
    root = np.linalg.qr(np.sqrt(np.maximum(sizes, 1e-12))[:, np.newaxis] * axes.T)[1].T
    found: Array = scale[:, np.newaxis] * root * np.sign(np.diagonal(root))
    return found


def _even(m: int) -> Array:
    """Numbers between 0 and 1, evenly spread in m dimensions, (n, m): multiples of powers of 1/x.

    x is the root of x^(m + 1) = x + 1, the golden ratio for one of them.
    """
    import numpy as np

    root = 2.0
    for _ in range(60):
        root = (1.0 + root) ** (1.0 / (m + 1.0))
    return np.asarray(np.outer(np.arange(1, _POINTS + 1), root ** -np.arange(1.0, m + 1.0)) % 1.0)
