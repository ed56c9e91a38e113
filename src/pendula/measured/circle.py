"""The circle on which a bob moves: its centre is the pivot, its radius the length."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pendula._types import Array

_STEPS = 50
_STRAIGHT = 1e4  # times the points' mean distance from their middle: no arc, but a line


@dataclass(frozen=True)
class Circle:
    """A circle through points.

    Attributes:
        x: of its centre.
        y: of its centre.
        radius: of it.
        rms: of the points' distances from it.
        radius_error: standard error of the radius, for independent errors of the points.
    """

    x: float
    y: float
    radius: float
    rms: float
    radius_error: float


def circle_of(x: Array, y: Array) -> Circle | None:
    """The circle nearest to points; None: they lie on no arc, or there are fewer than four.

    Starts from Taubin's algebraic fit (IEEE Trans. PAMI 13 (1991) 1115), whose bias on short arcs
    is small, then least squares of the distances (Gander, Golub and Strebel, BIT 34 (1994) 558).

    Args:
        x: abscissae, (n,); NaN: missing.
        y: ordinates, (n,).
    """
    import numpy as np

    there = np.isfinite(x) & np.isfinite(y)
    if there.sum() < 4:
        return None
    u, v = x[there], y[there]
    middle_u, middle_v = float(u.mean()), float(v.mean())
    size = float(np.hypot(u - middle_u, v - middle_v).mean())
    if size == 0.0:
        return None
    u, v = (u - middle_u) / size, (v - middle_v) / size
    start = _taubin(u, v)
    if start is None:
        return None
    found = _geometric(u, v, start)
    if found is None:
        return None
    (a, b, r), rms, error = found
    here = (middle_u + float(a) * size, middle_v + float(b) * size)
    return Circle(*here, float(r) * size, rms * size, error * size)


def _taubin(u: Array, v: Array) -> Array | None:
    """Centre and radius of the algebraic fit of centred points; None: a straight line."""
    import numpy as np

    z = u * u + v * v
    mean = float(z.mean())
    rows = np.column_stack([(z - mean) / (2 * math.sqrt(mean)), u, v])
    a = np.linalg.svd(rows, full_matrices=False)[2][-1]
    if abs(a[0]) < 1e-9:
        return None
    head = a[0] / (2 * math.sqrt(mean))
    centre = -a[1:] / (2 * head)
    radius = math.sqrt(float(centre @ centre) + mean)
    return np.array([*centre, radius])


def _geometric(u: Array, v: Array, start: Array) -> tuple[Array, float, float] | None:
    """Least squares of the distances, by Gauss and Newton with Levenberg's damping."""
    import numpy as np

    at, damping = start, 1e-3
    off = np.hypot(u - at[0], v - at[1]) - at[2]
    cost = float(off @ off)
    for _ in range(_STEPS):
        far = np.hypot(u - at[0], v - at[1])
        slopes = np.column_stack([(at[0] - u) / far, (at[1] - v) / far, -np.ones(u.size)])
        normal = slopes.T @ slopes
        step = np.linalg.solve(normal + damping * np.diag(np.diag(normal)), -slopes.T @ off)
        tried = at + step
        tried_off = np.hypot(u - tried[0], v - tried[1]) - tried[2]
        tried_cost = float(tried_off @ tried_off)
        if tried_cost > cost:
            damping *= 10
            if damping > 1e10:
                break
            continue
        done = cost - tried_cost <= 1e-14 * cost
        at, off, cost, damping = tried, tried_off, tried_cost, damping / 10
        if done:
            break
    covariance = np.linalg.pinv(normal) * cost / max(u.size - 3, 1)
    if not np.isfinite(at).all() or not 0 < at[2] < _STRAIGHT:
        return None
    return at, math.sqrt(cost / u.size), math.sqrt(float(covariance[2, 2]))
