"""Multipliers of periodic orbits, what kind of orbit they make, and where its stability changes."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pendula._types import Array

_AREA = 1e-9  # of the determinant from 1: the map keeps areas


def multipliers_of(monodromy: Array, *, conservative: bool) -> NDArray[Any]:
    """The eigenvalues of a monodromy matrix, (d,) complex.

    With energy and phase two of a conservative system's are 1, and the others are μ and 1/μ, from
    the trace: as plain eigenvalues the double 1 would cost half of their digits (Hénon 1965).

    Args:
        monodromy: (d, d), d 2 or 4.
        conservative: whether the system is.
    """
    import numpy as np

    if not conservative:
        determinant = float(np.linalg.det(monodromy))
        pair = _roots(float(np.trace(monodromy)), determinant)
        return np.array(pair)
    if monodromy.shape == (2, 2):
        return np.ones(2, complex)
    return np.array([1.0, 1.0, *_roots(multiplier_sum(monodromy), 1.0)])


def multiplier_sum(monodromy: Array) -> float:
    """μ + 1/μ of a conservative system with two degrees of freedom."""
    return float(monodromy.trace()) - 2.0


def _roots(total: float, product: float) -> tuple[complex, complex]:
    """The numbers with this sum and product, the larger first; of a pair that with Im > 0."""
    half, root = total / 2.0, math.sqrt(abs(product))
    # (half² - product) as a product, which keeps its digits next to zero
    inside = (half - root) * (half + root) if product >= 0.0 else half * half - product
    if inside < 0.0:
        pair = complex(half, math.sqrt(-inside))
        return pair, pair.conjugate()
    larger = half + math.copysign(math.sqrt(inside), half)
    return complex(larger), complex(product / larger if larger else 0.0)


def kind_of(multipliers: NDArray[Any], *, conservative: bool) -> str:
    """What kind of orbit the multipliers make.

    Returns:
        Of an area-preserving map: "elliptic" (on the unit circle), "hyperbolic" (μ > 1), "inverse
        hyperbolic" (μ < −1) or "parabolic" (on the border). Of a driven pendulum with friction
        also: "stable node", "stable focus", "unstable node" or "unstable focus".
    """
    first, second = (complex(each) for each in multipliers[-2:])
    area = conservative or abs(first * second - 1.0) < _AREA
    if first.imag:
        if area:
            return "elliptic"
        return "stable focus" if abs(first) < 1.0 else "unstable focus"
    if area and abs(first) == 1.0:
        return "parabolic"
    if not area and abs(first) < 1.0:
        return "stable node"
    if not area and abs(second) > 1.0:
        return "unstable node"
    return "hyperbolic" if first.real > 0.0 else "inverse hyperbolic"


def is_stable(kind: str) -> bool:
    """Whether motions beside an orbit of that kind stay beside it, as its multipliers tell."""
    return kind in ("elliptic", "stable node", "stable focus", "parabolic")


def rotation_angle(multipliers: NDArray[Any]) -> float | None:
    """By how much motions beside the orbit turn about it in a period [rad]; None: they do not."""
    last = complex(multipliers[-2])
    return cmath.phase(last) if last.imag else None


def crossings(monodromy: Array, *, conservative: bool) -> dict[str, float]:
    """Functions that change sign where a multiplier passes 1 or −1.

    Args:
        monodromy: (d, d).
        conservative: whether the system is: μ + 1/μ ∓ 2 then; else the product of (1 ∓ μ).
    """
    import numpy as np

    if conservative:
        total = multiplier_sum(monodromy)
        return {"+1": total - 2.0, "-1": total + 2.0}
    trace, determinant = float(np.trace(monodromy)), float(np.linalg.det(monodromy))
    return {"+1": 1.0 - trace + determinant, "-1": 1.0 + trace + determinant}
