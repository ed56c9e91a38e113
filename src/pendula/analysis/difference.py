"""How far two runs of one system are apart, and from when on."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pendula._messages import ArgumentError
from pendula._rules import broken

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.run.trajectory import Trajectory


def angle_difference(run: Trajectory, reference: Trajectory) -> Array:
    """The largest difference of any angle, at each time of the reference.

    Angles are never wrapped: a turn more is a difference of τ.

    Args:
        run: one run; it may have ended early (its `outcome` says why).
        reference: another of the same system, at the same times.

    Returns:
        Differences [rad], shape (n,); nan after the end of a run that ended early.

    Raises:
        ValueError: if the two were not sampled at the same times.
    """
    n = len(run.t)
    if n > len(reference.t) or not np.array_equal(run.t, reference.t[:n]):
        raise ArgumentError(
            "", "<run> and <reference> must have the same times: solve both for one list"
        )
    difference = np.full(len(reference.t), np.nan)
    # The angles of a method that blows up may overflow in the subtraction: inf is the answer.
    with np.errstate(over="ignore", invalid="ignore"):
        apart = np.abs(run.theta - reference.theta[:n])
    difference[:n] = apart if apart.ndim == 1 else apart.max(axis=-1)
    return difference


def parting_time(t: ArrayLike, difference: ArrayLike, tolerance: float) -> float:
    """The first time at which a difference passes a tolerance.

    Between two samples the difference is taken as straight. A run that ended early (nan) has
    parted, at the last time it was seen.

    Args:
        t: times [s], shape (n,).
        difference: as `angle_difference` gives it, shape (n,).
        tolerance: in the unit of the difference.

    Returns:
        The time [s]; inf if the difference never passes the tolerance.

    Raises:
        ValueError: for a tolerance that is not positive.
    """
    if not tolerance > 0:
        raise broken("tolerance", "positive", value=tolerance)
    times, apart = np.asarray(t, dtype=np.float64), np.asarray(difference, dtype=np.float64)
    passed = np.flatnonzero(~(apart <= tolerance))
    if len(passed) == 0:
        return math.inf
    i = int(passed[0])
    if i == 0 or not math.isfinite(apart[i]):
        return float(times[max(i - 1, 0)])
    share = (tolerance - apart[i - 1]) / (apart[i] - apart[i - 1])
    return float(times[i - 1] + share * (times[i] - times[i - 1]))
