"""Where the fit of a driven pendulum starts: at what the spectrum and the accelerations say."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula.measured.double_start import smoothed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array
    from pendula.measured.problem import Sampled

_LINES = 3  # of a spectrum that may be the drive's
_TRIED = 41  # frequencies about each


def driven_values(recording: Sampled, constants: Mapping[str, float]) -> dict[str, float]:
    """State, ω0², viscous friction, offset, drive and late amplitude of a record of angles.

    θ̈ = −ω0² sin(θ − o) − b ω + p cos Ωt + q sin Ωt is linear in all but the frequency of the drive:
    the lines of the spectrum of the late motion, and of all of it, are tried.

    Args:
        recording: of angles.
        constants: parameters that are known.
    """
    import numpy as np

    (theta,), (omega,), (alpha,) = smoothed(recording)
    t = np.linspace(recording.t[0], recording.t[-1], len(theta))
    inner = slice(len(t) // 50, len(t) - len(t) // 50)  # smoothed worse at the ends
    motion = (t[inner], theta[inner], omega[inner], alpha[inner])
    late = len(t) // 2
    lines = [*_lines(t[late:], theta[late:]), *_lines(t, theta)]
    if "drive_frequency" in constants:
        tried = [constants["drive_frequency"]]
    else:
        width = 4.0 * math.pi / (t[-1] - t[0])
        tried = [
            line + shift for line in lines for shift in np.linspace(-width, width, _TRIED).tolist()
        ]
    frequency = min((each for each in tried if each > 0.0), key=lambda f: _regressed(f, *motion)[1])
    (sine, cosine, viscous, p, q), _ = _regressed(frequency, *motion)
    offset = constants.get("angle_offset", math.atan2(-cosine, sine))
    return {
        "theta": float(theta[0]) - offset,
        "omega": float(omega[0]),
        "omega0_squared": max(math.hypot(sine, cosine), 1e-6),
        "viscous": max(viscous, 0.0),
        "angle_offset": offset,
        "torque": math.hypot(p, q),
        "drive_frequency": frequency,
        "drive_phase": math.atan2(-q, p),
        "amplitude": 0.5 * float(np.ptp(theta[late:])),
    }


def _lines(t: Array, theta: Array) -> list[float]:
    """Angular frequencies of the largest lines of a spectrum [rad/s]."""
    import numpy as np

    n = len(theta)
    padded = 1 << (4 * n - 1).bit_length()
    power = np.abs(np.fft.rfft((theta - theta.mean()) * np.hanning(n + 2)[1:-1], padded)) ** 2
    peaks = np.flatnonzero((power[1:-1] > power[:-2]) & (power[1:-1] >= power[2:])) + 1
    largest = peaks[np.argsort(power[peaks])[::-1][:_LINES]]
    return [2.0 * math.pi * each / (padded * float(t[1] - t[0])) for each in largest.tolist()]


def _regressed(
    frequency: float, t: Array, theta: Array, omega: Array, alpha: Array
) -> tuple[list[float], float]:
    """Factors of sin θ, cos θ, ω, cos Ωt and sin Ωt, and what they leave of θ̈."""
    import numpy as np

    turned = frequency * t
    rows = np.stack([-np.sin(theta), -np.cos(theta), -omega, np.cos(turned), np.sin(turned)])
    found, *_ = np.linalg.lstsq(rows.T, alpha, rcond=None)
    return found.tolist(), float(np.sum((alpha - found @ rows) ** 2))
