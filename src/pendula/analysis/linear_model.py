"""Where small angles stop being small: the linear model against the exact pendulum.

Nothing here depends on length or gravity: both models keep time by the one natural frequency.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pendula._messages import ArgumentError
from pendula._rules import broken
from pendula.run.exact import exact
from pendula.systems import LinearPendulum, SimplePendulum

if TYPE_CHECKING:
    from pendula._types import Array

_SAMPLES_A_PERIOD = 200  # the largest error is found to (π/200)²/2 of itself, 1 in 8000


def linear_model_error(amplitude: ArrayLike, swings: float = 1.0) -> Array:
    """How far the linear solution departs from the exact one after a release from rest.

    It grows with the phase that the linear model gains, at small angles 2π θ0²/16 a period, since
    T ≈ T0 (1 + θ0²/16).

    Args:
        amplitude: θ0, between 0 and π [rad]; any shape.
        swings: how long it is watched, in periods of the linear model.

    Returns:
        The largest |θ_linear(t) − θ(t)| / θ0, in the shape of `amplitude`.

    Raises:
        ValueError: for an amplitude outside its range, or swings that are not positive.
    """
    theta0 = np.asarray(amplitude, dtype=np.float64)
    if not np.all((theta0 > 0) & (theta0 < math.pi)):
        raise ArgumentError("amplitude", "must lie between 0 and π rad: it is a release from rest")
    if not swings > 0:
        raise broken("swings", "positive", value=swings)
    linear, simple = LinearPendulum(), SimplePendulum()
    t_max = swings * math.tau / simple.natural_frequency
    t = np.linspace(0.0, t_max, math.ceil(_SAMPLES_A_PERIOD * swings) + 1)
    states = np.stack([theta0.ravel(), np.zeros(theta0.size)], axis=-1)
    apart = exact(linear, states, t).states[..., 0] - exact(simple, states, t).states[..., 0]
    largest: Array = np.abs(apart).max(axis=-1).reshape(theta0.shape) / theta0
    return largest


def small_angle_limit(tolerance: float, swings: float = 1.0) -> float:
    """The amplitude [rad] at which `linear_model_error` reaches a tolerance.

    Args:
        tolerance: the error, as a part of the amplitude, between 0 and 1.
        swings: how long it is watched, in periods of the linear model.

    Raises:
        ValueError: for a tolerance outside its range.
    """
    _check_tolerance(tolerance)
    # Half as much again as the small-angle law gives is past the limit and before the two are in
    # opposite phase, so the error rises all the way up to there.
    high = min(1.5 * math.sqrt(8 * tolerance / (math.pi * swings)), 0.999 * math.pi)
    return _crossing(lambda a: float(linear_model_error(a, swings)), tolerance, high)


def period_limit(tolerance: float) -> float:
    """The amplitude [rad] at which the period is longer than the linear one by a tolerance.

    Args:
        tolerance: T/T0 − 1, between 0 and 1.

    Raises:
        ValueError: for a tolerance outside its range.
    """
    _check_tolerance(tolerance)
    simple = SimplePendulum()
    small = math.tau / simple.natural_frequency
    return _crossing(lambda a: float(simple.period([a])[0]) / small - 1, tolerance, 0.999 * math.pi)


def _check_tolerance(tolerance: float) -> None:
    if not 0 < tolerance < 1:
        rule = "must lie between 0 and 1, got {value}"
        raise ArgumentError("tolerance", rule, value=tolerance)


def _crossing(rising: Callable[[float], float], value: float, high: float) -> float:
    """The argument at which a rising function passes a value, by halving (to 1 in 2⁴⁰)."""
    low = 0.0
    for _ in range(40):
        middle = (low + high) / 2
        if rising(middle) < value:
            low = middle
        else:
            high = middle
    return (low + high) / 2
