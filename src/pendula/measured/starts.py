"""Start values from the recording itself: frequency, state and decay."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula.measured.least_squares import ROUGH
from pendula.measured.problem import Optimum, Problem, Sampled, minimise

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array
    from pendula.measured.model import SingleModel

FIRST = 2.5  # periods of the first window
MOST = 500  # samples of an early fit
_POOR = 0.3  # of the signal's spread: residuals of a first window that has not been understood
_FACTORS = (1.0, 0.7, 1.4, 0.5, 2.0)  # of the frequency that are tried there
_LARGEST = 3.0  # amplitude that a first guess has [rad]


def first_window(
    sampled: Sampled, model: SingleModel, constants: Mapping[str, float]
) -> tuple[dict[str, float], float]:
    """What describes the first swings of a recording, found unaided.

    Args:
        sampled: a recording.
        model: of it.
        constants: parameters that are known.

    Returns:
        Start state, ω0², viscous friction and offset by name, and how long the window is [s].
    """
    import numpy as np

    names: tuple[str, ...] = ("theta", "omega", "omega0_squared", "viscous", model.offset)
    if model.quantity == "acceleration" and "sensor_radius" not in constants:
        names = (*names[:-1], "sensor_radius")
    if model.quantity == "acceleration" and not constants["gravity_seen"]:
        names = (*names, "tilt")
    free = tuple(name for name in names if name not in constants)
    problem = Problem(model, (sampled,), free, (), constants)
    frequency = main_frequency(sampled)
    if model.quantity == "acceleration":  # which is the same on both sides
        frequency *= 0.5
    span = float(sampled.t[-1] - sampled.t[0])
    length = min(FIRST * 2.0 * math.pi / frequency, span)
    first = problem.within(length).thinned(MOST)
    spread = float(np.nanstd(first.recordings[0].values))
    best: Optimum | None = None
    guesses = [_harmonic(first.recordings[0], model, frequency * f, constants) for f in _FACTORS]
    if model.quantity == "angle":
        turns = np.ptp(sampled.values[sampled.there[:, 0]]) > 2.0 * math.pi
        guesses.insert(0 if turns else len(guesses), _by_energy(sampled, constants))
    for guess in guesses:
        found = minimise(first, np.array([guess[name] for name in first.names]), search=ROUGH)
        if best is None or found.rms < best.rms:
            best = found
        if best.rms < _POOR * spread:
            break
    assert best is not None
    values = dict(zip(best.names, best.x.tolist(), strict=True))
    if "theta" in values and "angle_offset" in values and "scale" not in constants:
        turns = 2.0 * math.pi * round(values["angle_offset"] / (2.0 * math.pi))
        values["theta"] += turns  # whole turns are the pendulum's, not the offset's
        values["angle_offset"] -= turns
    return values, length


def main_frequency(sampled: Sampled) -> float:
    """Angular frequency of the largest line of a recording's spectrum [rad/s]."""
    import numpy as np

    there = sampled.there[:, 0]
    t, y = sampled.t[there], sampled.values[there, 0]
    step = float(np.median(np.diff(t)))
    n = min(round(float(t[-1] - t[0]) / step) + 1, 1 << 18)
    grid = np.linspace(t[0], t[-1], n)
    even = np.interp(grid, t, y)
    even = even - np.polynomial.Polynomial.fit(grid, even, 1)(grid)
    padded = 1 << (4 * n - 1).bit_length()
    power = np.abs(np.fft.rfft(even * np.hanning(n + 2)[1:-1], padded)) ** 2
    power[: padded // n] = 0.0  # slower than the record is long
    peak = int(power.argmax())
    return float(2.0 * math.pi * peak / (padded * (grid[1] - grid[0])))


def _harmonic(
    sampled: Sampled, model: SingleModel, frequency: float, constants: Mapping[str, float]
) -> dict[str, float]:
    """Parameters of the harmonic motion of that frequency that is nearest to the samples."""
    import numpy as np

    there = sampled.there[:, 0]
    t, y = sampled.t[there] - sampled.t[0], sampled.values[there, 0]
    if model.quantity == "acceleration":
        return _by_acceleration(t, y, frequency, constants)
    basis = np.stack([np.cos(frequency * t), np.sin(frequency * t), np.ones_like(t)], axis=1)
    (cosine, sine, offset), *_ = np.linalg.lstsq(basis, y, rcond=None)
    scale = constants.get("scale", 1.0)
    if model.quantity == "angle":
        theta, omega = cosine / scale, sine * frequency / scale
    else:
        theta, omega = -sine / frequency / scale, cosine / scale
    amplitude = min(math.hypot(theta, omega / frequency), _LARGEST)
    natural = frequency if model.linear else frequency / _slowing(amplitude)
    return {
        "theta": theta,
        "omega": omega,
        "omega0_squared": natural**2,
        "viscous": 0.01 * frequency,
        model.offset: offset,
    }


def _by_acceleration(
    t: Array, y: Array, frequency: float, constants: Mapping[str, float]
) -> dict[str, float]:
    """The same from R (ω² + s ω0² cos θ) of θ = A cos(Ωt + φ), −(2 + s)/4 R Ω² A² cos 2(Ωt + φ)."""
    import numpy as np

    both = 2.0 * frequency * t
    basis = np.stack([np.cos(both), np.sin(both), np.ones_like(t)], axis=1)
    (cosine, sine, mean), *_ = np.linalg.lstsq(basis, y, rcond=None)
    radius = constants.get("sensor_radius", abs(mean) / frequency**2)
    seen = constants.get("gravity_seen", 0.0)
    size = 4.0 * math.hypot(cosine, sine) / ((2.0 + seen) * radius * frequency**2)
    amplitude, phase = min(math.sqrt(size), _LARGEST), 0.5 * math.atan2(sine, -cosine)
    return {
        "theta": amplitude * math.cos(phase),
        "omega": -amplitude * frequency * math.sin(phase),
        "omega0_squared": (frequency / _slowing(amplitude)) ** 2,
        "viscous": 0.01 * frequency,
        "sensor_radius": radius,
        "acceleration_offset": 0.0,
        "tilt": 0.0,
    }


def _by_energy(sampled: Sampled, constants: Mapping[str, float]) -> dict[str, float]:
    """Parameters by the law of energy, ω² = 2 ω0² cos θ + a − b t, whether it swings or turns."""
    import numpy as np

    there = sampled.there[:, 0]
    t, y = sampled.t[there] - sampled.t[0], sampled.values[there, 0] / constants.get("scale", 1.0)
    rates = np.gradient(y, t)
    basis = np.stack([2.0 * np.cos(y), np.ones_like(t), -t], axis=1)
    square = float(np.linalg.lstsq(basis, rates**2, rcond=None)[0][0])
    return {
        "theta": float(y[0]),
        "omega": float(rates[:3].mean()),
        "omega0_squared": max(square, 1e-6),
        "viscous": 0.0,
        "angle_offset": 0.0,
    }


def _slowing(amplitude: float) -> float:
    """Frequency at an amplitude over that of small swings, π / 2 K(sin(A/2))."""
    from pendula import elliptic

    return float(math.pi / (2.0 * elliptic.K(math.sin(amplitude / 2.0))))


def equivalents(viscous: float, amplitude: float, frequency: float) -> dict[str, float]:
    """Coefficients of each friction that takes as much energy in a swing as a viscous one.

    ∮ of b ω, c sgn ω, q |ω| ω and r ω³ along A cos Ωt: π b A² Ω, 4 c A, (8/3) q A³ Ω², (3/4) π r A⁴
    Ω³.
    """
    speed = amplitude * frequency
    return {
        "viscous": viscous,
        "coulomb": math.pi / 4.0 * viscous * speed,
        "quadratic": 3.0 * math.pi / 8.0 * viscous / speed,
        "cubic": 4.0 / 3.0 * viscous / speed**2,
    }
