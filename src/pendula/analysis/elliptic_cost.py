"""What the complete elliptic integral K costs: terms of the paper's series, iterations of the AGM.

Both take the complementary modulus k' = √(1 − k²), here `kc`: for a release from θ0 it is
cos(θ0/2), exact to the last digit even where k itself rounds to 1.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pendula import elliptic
from pendula._checks import number, numbers_array
from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from pendula._types import Array

_LEAST_TOLERANCE = 1e-15


def series_terms(kc: ArrayLike, tolerance: float, *, largest: int = 1_000_000) -> Array:
    """How many terms the series of K needs for a given relative error.

    K = (τ/4) Σ [(2n)!/(2²ⁿ(n!)²)]² k²ⁿ (the paper's equation 26; DLMF 19.5.1).

    Args:
        kc: complementary modulus, 0 < kc ≤ 1; any shape.
        tolerance: largest relative error, between 1e-15 and 1.
        largest: where so many terms are not enough, no more are counted.

    Returns:
        Whole numbers in the shape of `kc`; inf where `largest` terms are not enough.

    Raises:
        ValueError: for a modulus or a tolerance outside its range.
    """
    modulus, part = _checked(kc, tolerance)
    counts = [_series_terms(float(c), part, largest) for c in modulus.ravel()]
    return np.array(counts, dtype=np.float64).reshape(modulus.shape)


def agm_iterations(kc: ArrayLike, tolerance: float) -> NDArray[np.int64]:
    """How many iterations of the arithmetic-geometric mean give K to a relative error.

    After n of them K ≈ τ/(4 aₙ), with a₀ = 1, g₀ = k' and aₙ₊₁ = (aₙ + gₙ)/2, gₙ₊₁ = √(aₙ gₙ)
    (DLMF 19.8.1 and 19.8.5).

    Args:
        kc: complementary modulus, 0 < kc ≤ 1; any shape.
        tolerance: largest relative error, between 1e-15 and 1.

    Returns:
        Whole numbers in the shape of `kc`.

    Raises:
        ValueError: for a modulus or a tolerance outside its range.
    """
    modulus, part = _checked(kc, tolerance)
    counts = [_agm_iterations(float(c), part) for c in modulus.ravel()]
    return np.array(counts, dtype=np.int64).reshape(modulus.shape)


def _checked(kc: ArrayLike, tolerance: float) -> tuple[Array, float]:
    modulus, part = numbers_array("kc", kc), number("tolerance", tolerance)
    if not np.all((modulus > 0) & (modulus <= 1)):
        raise ArgumentError(
            "kc", "must lie in 0 < kc ≤ 1: at kc = 0 (the separatrix) K is infinite"
        )
    if not _LEAST_TOLERANCE < part < 1:
        raise ArgumentError(
            "tolerance",
            "must lie between {least} and 1, the reach of double precision, got {value}",
            least=_LEAST_TOLERANCE,
            value=part,
        )
    return modulus, part


def _series_terms(kc: float, tolerance: float, largest: int) -> float:
    if kc == 1.0:
        return 1.0
    if kc < 1e-150:  # its square is lost, and no number of terms would do
        return math.inf
    m = (1.0 - kc) * (1.0 + kc)
    # Each term is less than k² times the one before, so what remains after n terms is below the
    # next term over k'², and after `enough` of them far below the tolerance.
    enough = math.ceil(math.log(tolerance * kc * kc) / math.log1p(-kc * kc)) + 16
    # Twice `largest` is far enough, too: if that many terms suffice, next to nothing is left there.
    n = np.arange(1, min(enough, 2 * largest) + 1, dtype=np.float64)
    terms = np.cumprod(np.concatenate(([1.0], ((2 * n - 1) / (2 * n)) ** 2 * m)))
    # Summed from the small end: the difference of K and a long sum would be mere rounding.
    remainder = np.cumsum(terms[:0:-1])[::-1] + terms[-1] * m / (kc * kc)
    total = 4 / math.tau * float(elliptic.K(kc=kc))
    within = np.flatnonzero(remainder <= tolerance * total)
    count = float(within[0]) + 1 if len(within) else math.inf
    return count if count <= largest else math.inf


def _agm_iterations(kc: float, tolerance: float) -> int:
    a, g, n = 1.0, kc, 0
    limit = math.tau / (4 * float(elliptic.K(kc=kc)))
    # K ≈ τ/(4a) is off by the factor limit/a; a falls towards the limit, quadratically in the end.
    while 1 - limit / a > tolerance:
        a, g, n = (a + g) / 2, math.sqrt(a * g), n + 1
    return n
