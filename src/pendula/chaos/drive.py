"""The period of what drives a pendulum."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from pendula.systems import System

_DRIVES = (  # amplitude and angular frequency, by the parameters' names
    ("a", "drive_frequency"),
    ("torque", "drive_frequency"),
    ("pivot_amplitude", "pivot_frequency"),
)
_MOST_PERIODS = 1000  # of either drive, after which both are where they were


def is_driven(system: System) -> bool:
    """Whether a drive acts on the system."""
    return bool(_frequencies(system))


def drive_period(system: System) -> float:
    """The time after which a system's drives are where they were [s].

    Raises:
        ValueError: where nothing drives it, or two drives are never where they were.
    """
    frequencies = _frequencies(system)
    if not frequencies:
        raise ArgumentError(
            "system",
            "must have a drive that repeats itself, got {value}",
            "give it a torque or a moving pivot, with a frequency",
            value=system,
        )
    first, *others = frequencies
    period = math.tau / first
    for other in others:
        ratio = Fraction(other / first).limit_denominator(_MOST_PERIODS)
        if not ratio or abs(float(ratio) * first / other - 1.0) > 1e-12:
            rule = "must have drives that come back together, got frequencies {value}"
            raise ArgumentError("system", rule, "make one a fraction of the other", value=other)
        period *= ratio.denominator
    return period


def drive_periods(system: System, period: float | None) -> tuple[int, float]:
    """How many periods of the drive an orbit's period is, and that period [s].

    Args:
        system: driven.
        period: about that many of the drive's [s]; None: one.

    Raises:
        ValueError: for a period that is not near a multiple of the drive's.
    """
    one = drive_period(system)
    count = 1 if period is None else round(period / one)
    if period is not None and (count < 1 or abs(period / one - count) > 0.01):
        raise ArgumentError(
            "period",
            "must be a multiple of the drive's, {other} s; got {value}",
            f"give <period={max(count, 1) * one:.12g}>",
            other=f"{one:.12g}",
            value=period,
        )
    return count, count * one


def _frequencies(system: System) -> list[float]:
    """Angular frequencies of what drives the system, each once [rad/s]."""
    values = system.parameters
    acting = [abs(values[f]) for a, f in _DRIVES if values.get(a) and values.get(f)]
    return list(dict.fromkeys(acting))
