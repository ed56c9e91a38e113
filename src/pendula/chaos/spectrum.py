"""Lyapunov exponents from the matrices of successive spans of a motion."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pendula._types import Array

_BLOCKS = 16  # whose means' scatter gives the standard error
_SETTLING = 10  # the tenth part of the spans, in which tangents find their directions


def exponents_of(matrices: Array, span: float) -> tuple[Array, float]:
    """All exponents, and the standard error of the largest, by QR (Benettin et al. 1980).

    Args:
        matrices: of successive spans, (n, d, d), n at least 32.
        span: [s].

    Returns:
        The exponents, falling, (d,) [1/s]; the standard error from means over sixteen blocks,
        which holds where a block is longer than what correlates [1/s].
    """
    import numpy as np

    d = matrices.shape[1]
    frame, growth = np.eye(d), np.empty((len(matrices), d))
    for i, matrix in enumerate(matrices):
        frame, triangle = np.linalg.qr(matrix @ frame)
        growth[i] = np.log(np.maximum(abs(triangle.diagonal()), 1e-300))
    settled = growth[len(growth) // _SETTLING :] / span
    means = [part[:, 0].mean() for part in np.array_split(settled, _BLOCKS)]
    error = float(np.std(means, ddof=1)) / math.sqrt(_BLOCKS)
    return np.sort(settled.mean(axis=0))[::-1], error
