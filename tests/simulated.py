"""Recordings of known pendulums: simulated, with noise whose neighbours are alike."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import pendula
from pendula.measured import Measurement

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.systems.base import System

NOISE = 1e-3  # rad


def of_angle(t: Array, theta: Array, **more: Any) -> Measurement:
    """A recording of the angle of one pendulum."""
    return Measurement(t, theta.reshape(len(t), -1), "angle", ("theta",), "rad", **more)


def correlated(random: np.random.Generator, n: int, correlation: float) -> Array:
    """Noise of variance 1 with that correlation of neighbours, (n,)."""
    noise = random.normal(size=n)
    for i in range(1, n):
        noise[i] = correlation * noise[i - 1] + np.sqrt(1.0 - correlation**2) * noise[i]
    return noise


def swing(
    seed: int,
    correlation: float,
    frictions: tuple[str, ...],
    *,
    seconds: float = 10.0,
    rate: float = 50.0,
) -> tuple[Measurement, dict[str, float]]:
    """A swing with jitter, a gap or missing samples, offset and noise; and its true values."""
    random = np.random.default_rng(seed)
    square, amplitude = random.uniform(8.0, 60.0), random.uniform(0.1, 1.5)
    frequency = np.sqrt(square)
    t = np.arange(round(seconds * rate)) / rate
    t = t + random.uniform(-0.3, 0.3, len(t)) / rate * random.integers(0, 2)
    t -= t[0]
    viscous, speed = random.uniform(0.2, 2.0) / seconds, amplitude * frequency
    alike = {"viscous": viscous, "coulomb": 0.47 * viscous * speed}
    alike |= {"quadratic": 1.77 * viscous / speed, "cubic": 2.67 * viscous / speed**2}
    values = {name: alike[name] / len(frictions) for name in frictions}
    phase, offset = random.uniform(0.0, 2.0 * np.pi), random.normal(0.0, 0.1)
    start = amplitude * np.cos(phase), -speed * np.sin(phase)
    system = pendula.DrivenPendulum.body(1.0, 1.0, 1.0, square, **values)
    theta = pendula.solve(system, start, t).theta + offset
    size = amplitude * 10.0 ** random.uniform(-3.0, -1.3)
    theta = theta + size * correlated(random, len(t), correlation)
    kept = np.ones(len(t), bool)
    if random.integers(0, 2):
        begin = random.integers(len(t) // 5, 3 * len(t) // 5)
        kept[begin : begin + len(t) // 8] = False
    else:
        kept[1:] = random.random(len(t) - 1) > 0.1
    true = {"omega0_squared": square, "theta": start[0], "omega": start[1]}
    return of_angle(t[kept], theta[kept]), true | values | {"angle_offset": offset}


def clean(
    *,
    seconds: float = 20.0,
    rate: float = 50.0,
    square: float = 12.0,
    start: tuple[float, float] = (0.4, 0.3),
    noise: float = 1e-3,
    **frictions: float,
) -> Measurement:
    """An evenly sampled swing with white noise."""
    t = np.arange(round(seconds * rate)) / rate
    system = pendula.DrivenPendulum.body(1.0, 1.0, 1.0, square, **frictions)
    theta = pendula.solve(system, start, t).theta
    return of_angle(t, theta + noise * np.random.default_rng(1).normal(size=len(t)))


def recorded(
    system: System,
    start: tuple[float, ...],
    *,
    seconds: float = 10.0,
    n: int = 500,
    ahead: float = 0,
) -> Measurement:
    """The angles of a simulated motion with noise, by a clock that is ahead [s]."""
    t, bodies = np.linspace(0.0, seconds, 500), len(start) // 2
    angles = pendula.solve(system, start, t).states[:, :bodies]
    angles = angles + NOISE * np.random.default_rng(1).normal(size=angles.shape)
    names = ("theta",) if bodies == 1 else ("theta1", "theta2")
    return Measurement(t + ahead, angles, "angle", names, "rad", bodies=bodies)
