"""Recordings that are made up: their truth is known, by other means than the package's."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from pendula.measured import Measurement

OMEGA2, VISCOUS, START, OFFSET = 20.0, 0.06, 1.2, 0.1
NOISE = 0.002  # rad


def motion(t: NDArray[np.float64], viscous: float = VISCOUS) -> Any:
    """Angle and rate of a pendulum with viscous friction that is released from rest."""
    return solve_ivp(
        lambda _, y: [y[1], -OMEGA2 * math.sin(y[0]) - viscous * y[1]],
        (0.0, float(t[-1])),
        [START, 0.0],
        t_eval=t,
        method="DOP853",
        rtol=1e-11,
        atol=1e-12,
    ).y


def recording(
    quantity: str = "angle", noise: float = NOISE, until: float = 16.0, viscous: float = VISCOUS
) -> Measurement:
    """A recording at 50 Hz with independent noise."""
    t = np.arange(0.0, until, 0.02)
    theta, omega = motion(t, viscous)
    values = theta + OFFSET if quantity == "angle" else omega
    values = values + noise * np.random.default_rng(1).standard_normal(len(t))
    name, unit = ("theta", "rad") if quantity == "angle" else ("omega", "rad/s")
    return Measurement(t, values[:, None], quantity, (name,), unit, source="made/swing.csv")
