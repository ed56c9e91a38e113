"""The swings of a recording, one by one: when, how wide, how long, all read off the samples."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from pendula import elliptic
from pendula._messages import ArgumentError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pendula._types import Array
    from pendula.measured.fitted import FittedRecording
    from pendula.run.trajectory import Trajectory

_WINDOW = 0.1  # of a period to either side, in which a curve is laid through the samples
_FEWEST = 3  # samples in it
_SAME = 1e-9  # s: two times that are one
# Of the heights of turns: two within a swing, or three of which it ends with the outer ones.
_WEIGHTS = {2: (1.0, 1.0), 3: (1.0, 2.0, 1.0)}
_OF_CROSSING, _OF_TURN = 3, 4  # degrees of the curves: what is left out is below 1e-4 of them


class Seen(NamedTuple):
    """What was measured, as the pendulum's own angle or rate, beside the fitted motion.

    Attributes:
        t: (n,) [s].
        values: the angle [rad] or the rate [rad/s], its offset taken off, (n,), of a double
            pendulum (n, 2); NaN: missing.
        is_angle: whether the values are angles.
        model: the fitted motion at those times.
    """

    t: Array
    values: Array
    is_angle: bool
    model: Trajectory


class Swings(NamedTuple):
    """Whole swings, from one zero of what was measured to the next in the same direction.

    Attributes:
        t: middle of each, (n,) [s].
        amplitude: mean of the turns within, (n,) [rad]: measured, or of the fitted motion where
            no angle was.
        period: (n,) [s].
    """

    t: Array
    amplitude: Array
    period: Array


def seen(recording: FittedRecording) -> Seen:
    """The recording as angle or rate.

    Raises:
        ValueError: for a recording of accelerations, or a fit whose values no pendulum has.
    """
    import numpy as np

    quantity = recording.measurement.quantity
    if quantity == "acceleration":
        raise ArgumentError("recording", "must be of angles or rates, got {value}", value=quantity)
    model = recording.trajectory
    is_angle = quantity != "rate"
    own = (model.theta if is_angle else model.omega).reshape(recording.fitted.shape)
    values = np.empty_like(own)
    for i, column in enumerate(own.T):
        # scale and offset of the sensor are what takes the one to the other
        scale, offset = np.polyfit(column, recording.fitted[:, i], 1)
        values[:, i] = (recording.measured[:, i] - offset) / scale
    return Seen(recording.t, values[:, 0] if len(own.T) == 1 else values, is_angle, model)


def swings(recorded: Seen) -> Swings:
    """The swings of a recording of one pendulum; none where the motion turns over or is too short.

    The fitted motion says where to look; time and height come from a curve through the samples.
    """
    import numpy as np

    theta, omega, t = recorded.model.theta, recorded.model.omega, recorded.t
    passages = _crossings(t, theta if recorded.is_angle else omega, rising=True)
    turns = _crossings(t, omega, rising=None)
    found = []
    for first, last in pairwise(passages):
        inside = turns[(turns > first - _SAME) & (turns < last + _SAME)]
        window = _WINDOW * (last - first)
        ends = [_passage(recorded, each, window) for each in (first, last)]
        heights = [_height(recorded, each, window) for each in inside]
        if len(heights) in _WEIGHTS:
            height = np.average(heights, weights=_WEIGHTS[len(heights)])
            found.append([sum(ends) / 2.0, float(height), ends[1] - ends[0]])
    rows = np.array([row for row in found if np.isfinite(row).all()]).reshape(-1, 3)
    return Swings(*rows.T)


def periods_at(omega0_squared: float, amplitude: Array) -> Array:
    """4 K(k)/ω0 of a swing of that amplitude [rad], k = sin(θ0/2) (DLMF 22.19(i)) [s]."""
    import numpy as np

    found: Array = np.asarray(
        4.0 * elliptic.K(np.sin(amplitude / 2.0)) / math.sqrt(omega0_squared), dtype=np.float64
    )
    return found


def rates(recorded: Seen) -> tuple[Array, Array]:
    """Angle [rad] and rate [rad/s] of the samples of one pendulum.

    What was not measured is the fitted motion's. A rate is the difference of angles about a
    fortieth of a period apart.
    """
    import numpy as np

    if not recorded.is_angle:
        return recorded.model.theta, recorded.values
    t, theta = recorded.t, recorded.values
    period = math.tau / recorded.model.system.slowest_frequency
    apart = max(1, round(period / 80.0 / float(np.median(np.diff(t)))))
    omega = np.full_like(theta, np.nan)
    both = slice(apart, -apart)
    omega[both] = (theta[2 * apart :] - theta[: -2 * apart]) / (t[2 * apart :] - t[: -2 * apart])
    return theta, omega


def _crossings(t: Array, values: Array, *, rising: bool | None) -> Array:
    """Times of the zeros, between two samples on a straight line; rising ones alone, or all."""
    import numpy as np

    up, down = (values[:-1] < 0) & (values[1:] >= 0), (values[:-1] >= 0) & (values[1:] < 0)
    before = np.flatnonzero(up if rising else up | down)
    low, high = values[before], values[before + 1]
    found: Array = t[before] + (t[before + 1] - t[before]) * low / (low - high)
    return found


def _passage(recorded: Seen, about: float, window: float) -> float:
    """When the samples pass zero, NaN where too few are near."""
    import numpy as np

    curve = _curve(recorded.t, recorded.values, about, window, _OF_CROSSING)
    roots = np.roots(curve)
    real = roots[np.abs(roots.imag) < 1e-12].real
    near = real[np.abs(real) < 1.0]
    return about + window * float(near[np.abs(near).argmin()]) if near.size else math.nan


def _height(recorded: Seen, about: float, window: float) -> float:
    """How far from the lowest point the samples turn."""
    import numpy as np

    values = recorded.values if recorded.is_angle else recorded.model.theta
    curve = _curve(recorded.t, values, about, window, _OF_TURN)
    if not curve.size:
        return math.nan
    fine = np.linspace(-0.5, 0.5, 101)
    return float(np.abs(np.polyval(curve, fine)).max())


def _curve(t: Array, values: Array, about: float, window: float, degree: int) -> Array:
    """A polynomial through the samples near a time, in parts of the window; empty: too few."""
    import numpy as np

    near: NDArray[np.bool_] = (np.abs(t - about) < window) & np.isfinite(values)
    if np.count_nonzero(near) < _FEWEST:
        return np.zeros(0)
    most = min(degree, int(np.count_nonzero(near)) // 2)
    found: Array = np.polyfit((t[near] - about) / window, values[near], most)
    return found
