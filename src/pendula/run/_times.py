"""Output times at equal distances."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from pendula._checks import LARGEST_COUNT
from pendula._engine import ON_GRID

if TYPE_CHECKING:
    from pendula._types import Array


def spaced(t0: float, t_max: float, every: float) -> Array:
    """Times (n,) from t0 to t_max, `every` apart; the last gap is shorter where need be [s]."""
    span = abs(t_max - t0)
    numbers = np.arange(int(span / every + ON_GRID) + 1)
    ratio = Fraction(every).limit_denominator(10**9)  # 7 × 10 ms is 0.07 s, not 0.07000000000000001
    exact = float(ratio) == every and int(numbers[-1]) * ratio.numerator < LARGEST_COUNT
    if exact:
        elapsed: Array = np.divide(numbers * ratio.numerator, ratio.denominator)
    else:
        elapsed = np.multiply(numbers, every)
    if span - elapsed[-1] > ON_GRID * every:
        elapsed = np.append(elapsed, span)
    times = t0 + elapsed if t_max > t0 else t0 - elapsed
    times[-1] = t_max
    return times
