"""Normally distributed values, made of random bits in the same way on every machine.

A C library's logarithm differs from another's in the last bit, so it is summed here, with
operations that IEEE 754 rounds in one way.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pendula._types import Array


FARTHEST = 8.2924  # standard deviations; the farthest of `normals`, of p = 2^-54, is 8.29236…
_LN2 = 0.6931471805599453
_LOG_TERMS = 12  # |s| ≤ 0.1716: the next is below 2^-60
_NEAR = (
    (
        3.3871328727963666080e0,
        1.3314166789178437745e2,
        1.9715909503065514427e3,
        1.3731693765509461125e4,
        4.5921953931549871457e4,
        6.7265770927008700853e4,
        3.3430575583588128105e4,
        2.5090809287301226727e3,
    ),
    (
        1.0,
        4.2313330701600911252e1,
        6.8718700749205790830e2,
        5.3941960214247511077e3,
        2.1213794301586595867e4,
        3.9307895800092710610e4,
        2.8729085735721942674e4,
        5.2264952788528545610e3,
    ),
)
_MIDDLE = (
    (
        1.42343711074968357734e0,
        4.63033784615654529590e0,
        5.76949722146069140550e0,
        3.64784832476320460504e0,
        1.27045825245236838258e0,
        2.41780725177450611770e-1,
        2.27238449892691845833e-2,
        7.74545014278341407640e-4,
    ),
    (
        1.0,
        2.05319162663775882187e0,
        1.67638483018380384940e0,
        6.89767334985100004550e-1,
        1.48103976427480074590e-1,
        1.51986665636164571966e-2,
        5.47593808499534494600e-4,
        1.05075007164441684324e-9,
    ),
)
_FAR = (
    (
        6.65790464350110377720e0,
        5.46378491116411436990e0,
        1.78482653991729133580e0,
        2.96560571828504891230e-1,
        2.65321895265761230930e-2,
        1.24266094738807843860e-3,
        2.71155556874348757815e-5,
        2.01033439929228813265e-7,
    ),
    (
        1.0,
        5.99832206555887937690e-1,
        1.36929880922735805310e-1,
        1.48753612908506148525e-2,
        7.86869131145613259100e-4,
        1.84631831751005468180e-5,
        1.42151175831644588870e-7,
        2.04426310338993978564e-15,
    ),
)


def normals(words: NDArray[np.uint64]) -> Array:
    """Normally distributed, mean 0 and deviation 1, symmetric to the last bit.

    The normal quantile at p = (k + 1/2) 2^-53, k < 2^52, with the sign of one more bit (AS241,
    PPND16: Wichura, Applied Statistics 37 (1988) 477; its relative error is about 1e-16).
    """
    p = ((words >> np.uint64(12)).astype(np.float64) + 0.5) * 2.0**-53
    sign = np.where(words & np.uint64(1), 1.0, -1.0)
    q = 0.5 - p
    r = np.sqrt(-_log(p))
    near, middle = q <= 0.425, r <= 5.0
    value = np.where(near, q * _ratio(_NEAR, 0.180625 - q * q), 0.0)
    value = np.where(~near & middle, _ratio(_MIDDLE, r - 1.6), value)
    value = np.where(~near & ~middle, _ratio(_FAR, r - 5.0), value)
    return np.asarray(sign * value)


def _log(x: Array) -> Array:
    """The logarithm by ln(m) = 2 artanh((m − 1)/(m + 1)), of x = m 2^n: no two machines differ."""
    m, n = np.frexp(x)
    low = m < math.sqrt(0.5)
    m, n = np.where(low, 2.0 * m, m), np.where(low, n - 1, n)
    s = (m - 1.0) / (m + 1.0)
    square, sum_ = s * s, np.zeros_like(s)
    for k in range(_LOG_TERMS - 1, -1, -1):
        sum_ = sum_ * square + 1.0 / (2 * k + 1)
    return np.asarray(2.0 * s * sum_ + n * _LN2)


def _ratio(coefficients: tuple[tuple[float, ...], ...], x: Array) -> Array:
    """A rational function: numerator and denominator, lowest power first."""
    over, under = (np.zeros_like(x) for _ in coefficients)
    for a in reversed(coefficients[0]):
        over = over * x + a
    for b in reversed(coefficients[1]):
        under = under * x + b
    return np.asarray(over / under)
