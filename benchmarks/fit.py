"""A fit of a swing of 55 s, beside scipy; of a double pendulum; and a large file read."""

import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import curve_fit

import pendula
from pendula.measured import Measurement, fit, read

RATE, SECONDS = 100.0, 55.0
FRICTIONS = {"viscous": 0.01, "coulomb": 0.16, "quadratic": 0.004}
SQUARE, START = 64.05, (-1.6, 1.8)
REPEATS = 5


def swing(**frictions: float) -> Measurement:
    """A swing like that of a machined pendulum, with an encoder's noise."""
    t = np.arange(round(SECONDS * RATE) + 1) / RATE
    system = pendula.DrivenPendulum.body(1.0, 1.0, 1.0, SQUARE, **frictions)
    noise = 1e-3 * np.random.default_rng(0).normal(size=len(t))
    theta = pendula.solve(system, START, t).theta + noise
    return Measurement(t, theta[:, np.newaxis], "angle", ("theta",), "rad")


def double() -> Measurement:
    """A second of a double pendulum at 500 Hz."""
    t = np.arange(501) / 500.0
    system = pendula.DampedDoublePendulum.bobs(1.0, 0.5, 0.3, 0.25, viscous=(2e-3, 1e-3))
    noise = 1e-3 * np.random.default_rng(0).normal(size=(len(t), 2))
    angles = pendula.solve(system, (1.5, 1.0, 0.0, 0.0), t).states[:, :2] + noise
    return Measurement(t, angles, "angle", ("theta1", "theta2"), "rad", bodies=2)


def by_scipy(made: Measurement) -> Any:
    """The viscous model by curve_fit, from a start that is nearly right."""

    def model(t: Any, theta: float, omega: float, square: float, viscous: float) -> Any:
        return solve_ivp(
            lambda _, y: (y[1], -square * np.sin(y[0]) - viscous * y[1]),
            (0.0, t[-1]),
            (theta, omega),
            t_eval=t,
            rtol=1e-8,
            atol=1e-10,
        ).y[0]

    start = (*START, SQUARE + 0.01, 0.05)
    return curve_fit(model, made.t, made.values[:, 0], start)[0]


def seconds(job: Callable[[], Any], repeats: int = REPEATS) -> float:
    """The least wall time of a job [s]."""
    least = float("inf")
    for _ in range(repeats):
        begin = time.perf_counter()
        job()
        least = min(least, time.perf_counter() - begin)
    return least


def reading() -> dict[str, float]:
    """Times of reading 55 s at 1 kHz from a file [s]."""
    t = np.arange(55001) / 1e3
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "swing.csv"
        np.savetxt(
            file, np.column_stack([t, np.sin(t)]), "%.9g", ",", header="t,theta", comments=""
        )
        return {
            "a file of 55 001 lines": seconds(lambda: read(file)),
            "numpy.genfromtxt, the same": seconds(
                lambda: np.genfromtxt(file, delimiter=",", skip_header=1)
            ),
        }


def report() -> None:
    """Print the times and the ratio that are asked for."""
    viscous, three, two = swing(viscous=0.055), swing(**FRICTIONS), double()
    fit(viscous, "viscous")  # imports
    ours = seconds(lambda: fit(viscous, "viscous"))
    rows = {
        "viscous, 55 s at 100 Hz": ours,
        "viscous + coulomb + quadratic, the same": seconds(lambda: fit(three, list(FRICTIONS))),
        "double pendulum, 1 s at 500 Hz": seconds(lambda: fit(two, "viscous")),
        "curve_fit with solve_ivp, viscous": seconds(lambda: by_scipy(viscous), 1),
        **reading(),
    }
    print(f"Fits without start values, with their uncertainties\n\n{'':44}{'s':>10}")
    for name, least in rows.items():
        print(f"{name:44}{least:10.3f}")
    print()
    ratio = rows["curve_fit with solve_ivp, viscous"] / ours
    print(f"{'curve_fit ÷ viscous:':34}{ratio:7.0f}   (asked: ≥ 50)")
    print(f"{'three frictions [s]:':34}{list(rows.values())[1]:7.3f}   (asked: ≤ 0.2)")
    print(f"{'double pendulum [s]:':34}{list(rows.values())[2]:7.3f}   (asked: ≤ 0.5)")


if __name__ == "__main__":
    report()
