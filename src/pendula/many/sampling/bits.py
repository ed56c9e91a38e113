"""Random bits, and what is made of them in the same way on every machine.

The bits are those of Philox4x64-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3",
SC 2011): a stream for each column, whose word i belongs to draw i. After them come only operations
that IEEE 754 rounds in one way.
"""

from __future__ import annotations

import hashlib
import math
from decimal import Context, Decimal
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pendula._types import Array


_TERMS = 15  # of the power series of 2^x for |x| ≤ ½: the next one is below 2^-55
_DIGITS = Context(prec=60)


def words(seed: int, name: str, start: int, stop: int) -> NDArray[np.uint64]:
    """Words start to stop of a column's stream: four to each count of Philox."""
    first = start // 4
    stream = int.from_bytes(hashlib.blake2b(name.encode(), digest_size=8).digest(), "little")
    key = np.array([seed, stream], dtype=np.uint64)
    generator = np.random.Philox(key=key, counter=first)
    return np.asarray(generator.random_raw(stop - 4 * first))[start - 4 * first :]


def units(words: NDArray[np.uint64]) -> Array:
    """Uniform in [0, 1), multiples of 2^-53."""
    return (words >> np.uint64(11)).astype(np.float64) * 2.0**-53


@cache
def log2_ratio(low: float, high: float) -> float:
    """log₂(high / low), rounded once."""
    c = _DIGITS
    ratio = c.divide(Decimal(high), Decimal(low))
    return float(c.divide(c.ln(ratio), c.ln(Decimal(2))))


@cache
def _series() -> tuple[float, ...]:
    """Coefficients (ln 2)^k / k! of 2^x, each rounded once."""
    logarithm = Fraction(_DIGITS.ln(Decimal(2)))
    return tuple(float(logarithm**k / math.factorial(k)) for k in range(_TERMS))


def exp2(x: Array) -> Array:
    """2^x by its power series about the next whole number: no two machines differ."""
    whole = np.rint(x)
    rest, value = x - whole, np.zeros_like(x)
    for coefficient in reversed(_series()):
        value = value * rest + coefficient
    return np.ldexp(value, whole.astype(np.int32))
