"""Output times at equal distances."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from pendula._checks import LARGEST_COUNT, positive_number
from pendula._engine import MOST_OUTPUTS, ON_GRID
from pendula._messages import ArgumentError
from pendula._rules import broken

if TYPE_CHECKING:
    from pendula._types import Array

EXACT_INTERVALS = 500  # of a closed form's outputs, where no spacing is named


def span_of(t0: float, t_max: float) -> float:
    """The time between start and end, which must not be zero [s]."""
    if t_max == t0:
        raise broken("t_max", "differs_from_start", t0=t0, value=t_max)
    return abs(t_max - t0)


def times_apart(t0: float, t_max: float, every: float) -> Array:
    """Output times so far apart, (n,) [s].

    Raises:
        ValueError: where that is not positive, longer than the run, or too many of them.
    """
    span = span_of(t0, t_max)
    if positive_number("every", every, "s") > span:
        raise broken("every", "step_within_span", span=span, value=every)
    if span / every > MOST_OUTPUTS:
        rule = "must give at most {most} outputs, got {value} s for {count}"
        details = {"most": MOST_OUTPUTS, "value": every, "count": span / every}
        raise ArgumentError("every", rule, "take a longer time between them", **details)
    return spaced(t0, t_max, every)


def spaced(t0: float, t_max: float, every: float) -> Array:
    """Times (n,) from t0 to t_max, `every` apart; the last gap is shorter where need be [s]."""
    import numpy as np

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
