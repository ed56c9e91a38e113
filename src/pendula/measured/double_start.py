"""Where the fit of a double pendulum starts: at what its accelerations say."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula._checks import extra
from pendula._messages import ArgumentError
from pendula.measured.double_model import JOINTS, SHAPE, STATE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array
    from pendula.measured.problem import Sampled

_SMOOTH = 12.0  # parts of a period that a smoothing polynomial spans
_DEGREE = 4  # of it
_DEFINITE = 1.05
_UPRIGHT = 0.3  # of what is left unexplained, where gravity pulls the other way
_LEAST = 1e-6  # of the constants


def first_values(recording: Sampled, constants: Mapping[str, float]) -> dict[str, float]:
    """State at the first sample, and the shape that goes with the accelerations.

    The equations of motion are linear in the constants: those of smoothed angles, rates and
    accelerations give them by least squares.
    """
    import numpy as np

    optimize = extra("scipy.optimize", "fit")
    theta, omega, alpha = smoothed(recording)
    found = dict(zip(STATE, [*theta[:, 0].tolist(), *omega[:, 0].tolist()], strict=True))
    rows, wanted = _equations(theta, omega, alpha)
    names = [*SHAPE, *JOINTS[:2]]
    free = [i for i, name in enumerate(names) if name not in constants]
    for i, name in enumerate(names):
        if name in constants:
            wanted = wanted - constants[name] * rows[:, i]
    if free:
        solved = optimize.lsq_linear(rows[:, free], wanted, (_LEAST, np.inf), "bvls")
        found |= {names[i]: float(x) for i, x in zip(free, solved.x, strict=True)}
    if "B_over_A" in found:  # kinetic energy is positive whatever the rates: A B > C²
        least = _DEFINITE * {**constants, **found}["C_over_A"] ** 2
        found["B_over_A"] = max(found["B_over_A"], least)
    return found


def refuse_upright(recording: Sampled) -> None:
    """Refuse angles that are counted from the upright position, which no model would describe.

    Raises:
        ValueError: where the accelerations say so: gravity, the other way round, explains them.
    """
    import numpy as np

    optimize = extra("scipy.optimize", "fit")
    rows, wanted = _equations(*smoothed(recording))
    pulled = np.array([1.0, 1.0, -1.0, -1.0, 1.0, 1.0])  # D and E are those of gravity
    down, up = (
        optimize.lsq_linear(rows * sign, wanted, (_LEAST, np.inf), "bvls").cost
        for sign in (np.ones(6), pulled)
    )
    if up < _UPRIGHT * down:
        rule = "seems to be up: the accelerations fit angles from the upright position"
        raise ArgumentError("zero", rule, "read the file with <zero=up>")


def quickness(recording: Sampled) -> float:
    """Angular frequency below which half of the motion is, of the quicker of two bobs [rad/s].

    That of their directions e^{iθ}: angles that turn on and on have no line in their spectrum.
    """
    import numpy as np

    step = float(np.median(np.diff(recording.t)))
    grid = np.arange(round((recording.t[-1] - recording.t[0]) / step) + 1) * step + recording.t[0]
    middles = []
    for column, there in zip(recording.values.T, recording.there.T, strict=True):
        way = np.exp(1j * np.interp(grid, recording.t[there], column[there]))
        n = len(way)
        padded = 1 << (4 * n - 1).bit_length()
        power = np.abs(np.fft.fft((way - way.mean()) * np.hanning(n + 2)[1:-1], padded)) ** 2
        both = power[1 : padded // 2] + power[: padded // 2 : -1]
        part = np.cumsum(both)
        middles.append(1.0 + float(np.searchsorted(part, 0.5 * part[-1])))
    return 2.0 * math.pi * max(middles) / (padded * step)


def smoothed(recording: Sampled) -> tuple[Array, Array, Array]:
    """Angles, rates and accelerations on an even grid of times, (2, n) each."""
    import numpy as np

    signal = extra("scipy.signal", "fit")
    step = float(np.median(np.diff(recording.t)))
    grid = recording.t[0] + step * np.arange(round((recording.t[-1] - recording.t[0]) / step) + 1)
    even = np.stack(
        [
            np.interp(grid, recording.t[there], column[there])
            for column, there in zip(recording.values.T, recording.there.T, strict=True)
        ]
    )
    points = round(2.0 * math.pi / quickness(recording) / _SMOOTH / step)
    points = min(max(2 * (points // 2) + 1, _DEGREE + 3), 2 * ((len(grid) - 1) // 2) + 1)
    theta, omega, alpha = (
        signal.savgol_filter(even, points, min(_DEGREE, points - 1), deriv=each, delta=step)
        for each in range(3)
    )
    return theta, omega, alpha


def _equations(theta: Array, omega: Array, alpha: Array) -> tuple[Array, Array]:
    """Both equations of motion as rows in (B, C, D, E, viscous1, viscous2), and what they give."""
    import numpy as np

    apart = theta[0] - theta[1]
    zero, relative = np.zeros_like(apart), omega[1] - omega[0]
    first = [
        zero,
        alpha[1] * np.cos(apart) + omega[1] ** 2 * np.sin(apart),
        np.sin(theta[0]),
        zero,
        omega[0],
        -relative,
    ]
    second = [
        alpha[1],
        alpha[0] * np.cos(apart) - omega[0] ** 2 * np.sin(apart),
        zero,
        np.sin(theta[1]),
        zero,
        relative,
    ]
    rows = np.concatenate([np.stack(first, axis=1), np.stack(second, axis=1)])
    return rows, np.concatenate([-alpha[0], zero])
