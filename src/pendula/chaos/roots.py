"""Roots of functions of which each value takes runs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

_MOST = 100


def root(function: Callable[[float], float], a: float, b: float, at_a: float, at_b: float) -> float:
    """A root between two places where a function has values of opposite sign, to rounding.

    Regula falsi with the weights of Anderson & Björck (1973, BIT 13, 253), order 1.7; every third
    step that shrank the interval by less than half is followed by a bisection.

    Args:
        function: continuous.
        a: one end.
        b: the other.
        at_a: the function there.
        at_b: the function there.
    """
    width, slow = abs(b - a), 0
    weighted = at_a
    for _ in range(_MOST):
        if at_b == 0.0 or abs(b - a) <= 2.0 * math.ulp(max(abs(a), abs(b))):
            break
        middle = b - at_b * (b - a) / (at_b - weighted)
        if slow > 2 or not min(a, b) < middle < max(a, b):
            middle, slow = a + 0.5 * (b - a), 0
            if middle in (a, b):
                break
        value = function(middle)
        if value * at_b < 0.0:
            a, at_a, weighted = b, at_b, at_b
        else:
            shrunk = 1.0 - value / at_b
            weighted *= shrunk if shrunk > 0.0 else 0.5
        b, at_b = middle, value
        slow = slow + 1 if abs(b - a) > 0.5 * width else 0
        width = abs(b - a)
    return b if abs(at_b) <= abs(at_a) else a
