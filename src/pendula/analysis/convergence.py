"""The order of a method as measured: how fast its error falls with the step."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pendula._checks import numbers_array
from pendula._messages import ArgumentError
from pendula._rules import broken

if TYPE_CHECKING:
    from pendula._types import Array


@dataclass(frozen=True)
class ConvergenceOrder:
    """A straight line through the errors in logarithms: error ≈ constant · stepᵒʳᵈᵉʳ."""

    order: float
    """Slope of the line; nan if fewer than two points could be used."""
    constant: float
    """Error [rad] the line gives for a step of 1 s; nan likewise."""
    used: NDArray[np.bool_]
    """Which points the line was drawn through, shape (n,)."""


def convergence_order(
    steps: ArrayLike,
    errors: ArrayLike,
    *,
    floor: float = 3e-12,
    ceiling: float = 0.05,
    points: int = 3,
) -> ConvergenceOrder:
    """The order of convergence that errors at several steps show.

    The theory, error = C hᵖ + O(hᵖ⁺¹), holds for small steps only, and rounding hides the error
    of very small ones. So the line is fitted by least squares to the finest steps whose errors
    are neither too small nor too large (Hairer, Nørsett & Wanner 1993, II.3).

    Args:
        steps: step sizes [s], shape (n,), in any order.
        errors: largest error at each step [rad], shape (n,); nan where a run broke down.
        floor: errors up to here may be rounding [rad].
        ceiling: errors from here on are no longer small [rad].
        points: at most so many of the finest steps are taken.

    Returns:
        The line, with a slope of nan where fewer than two points are left.

    Raises:
        ValueError: for lists of different lengths, or a step that is not positive.
    """
    h = numbers_array("steps", steps, "s")
    e = numbers_array("errors", errors, "rad")
    if h.ndim != 1 or h.shape != e.shape:
        raise ArgumentError(
            "",
            "<steps> and <errors> must be lists of one length, got {text}",
            text=f"{h.shape}, {e.shape}",
        )
    if not np.all(h > 0):
        raise broken("steps", "positive", value=float(h.min()))
    usable = np.flatnonzero((e > floor) & (e < ceiling))
    finest = usable[np.argsort(h[usable])][:points]
    used = np.zeros(h.shape, dtype=np.bool_)
    used[finest] = True
    if len(np.unique(h[finest])) < 2:
        return ConvergenceOrder(np.nan, np.nan, used)
    order, constant = _line(np.log(h[finest]), np.log(e[finest]))
    return ConvergenceOrder(order, math.exp(constant), used)


def _line(x: Array, y: Array) -> tuple[float, float]:
    """Slope and height at 0 of the straight line through points, by least squares."""
    slope = float(np.sum((x - x.mean()) * (y - y.mean())) / np.sum((x - x.mean()) ** 2))
    return slope, float(y.mean() - slope * x.mean())
