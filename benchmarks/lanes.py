"""RK4 of many states by pendula.ensemble, by the loops that are built for a machine."""

import os
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import pendula

START, STEP = (2.0, 2.5, 0.0, 0.0), 1e-4
TRAJECTORIES = 4096  # at once, where numpy computes many
AT_ONE = np.array(
    [-1.01478186187538306, -1.12244606910181525, -7.26181086506237487, 5.72845783468323474]
)


def best(run: Callable[[], Any], repeats: int) -> float:
    """Least time of several runs [s]."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        run()
        times.append(time.perf_counter() - start)
    return min(times)


def by_ensemble() -> float:
    """RK4 of many states by pendula.ensemble, one thread: seconds a step and trajectory."""
    system, starts = pendula.DoublePendulum.rods(gravity=9.81), np.tile(START, (TRAJECTORIES, 1))

    def ends(count: int) -> Any:
        done = pendula.ensemble(system, starts, [count * STEP], "rk4", step=STEP, threads=1)
        return done.states[:, -1]

    assert np.abs(ends(10_000)[-1] - AT_ONE).max() < 1e-9
    return best(lambda: ends(1000), 5) / (1000 * TRAJECTORIES)


def on_machine(name: str) -> float:
    """The same in a process of its own, by the loops that are built for a machine."""
    command, environment = [sys.executable, "-m", __name__], os.environ | {"PENDULA_MACHINE": name}
    told = subprocess.run(command, env=environment, check=True, capture_output=True, text=True)
    return float(told.stdout)


if __name__ == "__main__":
    print(by_ensemble())
