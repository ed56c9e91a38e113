"""The double pendulum to machine precision: Taylor series and DOP853 beside their peers."""

import ctypes
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

import pendula
from benchmarks import taylor_peers
from benchmarks.taylor_peers import RELEASED, Outcome, Run
from pendula._engine import machines
from pendula._types import MethodName

SYSTEM = pendula.DoublePendulum.rods(gravity=9.81)
FIRST_SOLVE = """
import time, pendula
system = pendula.DoublePendulum.rods()
begin = time.perf_counter()
pendula.solve(system, (2.0, 2.5, 0.0, 0.0), 0.01)
print((time.perf_counter() - begin) * 1e3)
"""


def solved(method: MethodName, **control: Any) -> Run:
    """One trajectory by `pendula.solve`."""

    def run(end: float) -> Outcome:
        done = pendula.solve(SYSTEM, (*RELEASED, 0.0, 0.0), [end], method, **control)
        return Outcome(done.n_steps, done.states[-1], evaluations=done.n_evaluations)

    return run


def through_lanes(build: Path, machine: str) -> tuple[str, Run]:
    """All of the peers' starts through the lanes of the core, built for that machine."""
    library = ctypes.CDLL(str(build / "benchmarks" / "core" / f"libtaylor_lanes_{machine}.so"))
    library.taylor_lanes.restype = ctypes.c_long
    pointer = np.ctypeslib.ndpointer(dtype=np.float64, flags="C")
    library.taylor_lanes.argtypes = [pointer, ctypes.c_long, ctypes.c_double, pointer]
    angles: Any = np.ascontiguousarray(taylor_peers.starts())

    def run(end: float) -> Outcome:
        states = np.empty((angles.shape[1], 4))
        steps = library.taylor_lanes(angles, angles.shape[1], end, states)
        return Outcome(int(steps), states[0])

    return f"pendula, {library.taylor_lanes_width()} lanes, {machine}", run


def first_solve() -> float:
    """Least time of the first solve in a new process, after the import [ms]."""
    command = [sys.executable, "-c", FIRST_SOLVE]
    return min(
        float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
        for _ in range(5)
    )


def report(build: Path) -> None:
    """Print the tables and the ratios that are asked for."""
    one: dict[str, Run] = {
        "pendula taylor": solved("taylor"),
        "pendula dop853, 1e-12": solved("dop853", tolerance=1e-12),
    }
    known = machines()
    many = dict(through_lanes(build, machine) for machine in known[-2:])
    single, together = taylor_peers.report(one, many)
    theirs = min(row.seconds for name, row in single.items() if name.startswith("heyoka"))
    batch = min(row.seconds for name, row in together.items() if name.startswith("heyoka"))
    ours = min(row.seconds for name, row in together.items() if name.startswith("pendula"))
    scipy = single["SciPy DOP853, 1e-12"].seconds / single["pendula dop853, 1e-12"].seconds
    taylor = single["pendula taylor"].seconds
    for what, ratio, asked in (
        ("heyoka's best ÷ pendula taylor", theirs / taylor, "≥ 2"),
        ("heyoka's best batch ÷ lanes", batch / ours, "≥ 3"),
        ("SciPy's DOP853 ÷ pendula's", scipy, "≥ 100"),
        ("first solve of a process [ms]", first_solve(), "< 1"),
    ):
        print(f"{what + ':':34}{ratio:7.2f}   (asked: {asked})")
