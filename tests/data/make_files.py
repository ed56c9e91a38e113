"""Write trajectories in every format, for tests/test_old_files.py of later versions.

python tests/data/make_files.py tests/data/f4a9f5e.zip, with the package of that commit installed.
"""

from __future__ import annotations

import sys
import tempfile
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pendula import DoublePendulum, LinearPendulum, SimplePendulum, exact, solve
from pendula.events import angle, flip, tip_height, velocity_zero

if TYPE_CHECKING:
    from collections.abc import Callable

    from pendula import Trajectory

RODS, WILD = DoublePendulum.rods(gravity=9.81), (2.0, 2.5, 0.0, 0.0)
BODIES = DoublePendulum.bodies(1.2, 0.7, 0.9, 0.4, 0.3, 0.05, 0.02, 9.81, l2=0.8)
SIMPLE, LINEAR = SimplePendulum(0.5, 9.81, 2.0), LinearPendulum(0.5, 9.81)
EVENTS = [flip(2, 1), angle(1, 0.5, -1, every_turn=True), velocity_zero(2), tip_height(-0.7)]
ENDING = [flip(2, terminal=3), velocity_zero(1)]

RUNS: dict[str, Callable[[], Trajectory]] = {
    "fixed": lambda: solve(BODIES, WILD, 0.3, "gauss4", step=0.01),
    "fixed_times": lambda: solve(SIMPLE, (1.0, 0.3), [0.25, 0.11], "yoshida4", t0=0.5, step=0.03),
    "fixed_limited": lambda: solve(LINEAR, (1.0, 0.0), [0.1, 9.0], "rk4", step=0.01, max_steps=25),
    "fixed_certified": lambda: solve(RODS, WILD, [1.0, 9.0], "rk4", step=0.01, certify=1e-5),
    "broken": lambda: solve(RODS, WILD, np.arange(1.0, 50.0), "euler", step=1.0, certify=0.1),
    "adaptive": lambda: solve(RODS, WILD, 1.0),
    "adaptive_times": lambda: solve(
        LINEAR, (1.0, 0.3), [-0.5, -2.0], "dop853", t0=0.25, tolerance=1e-9, max_steps=1000
    ),
    "adaptive_limited": lambda: solve(SIMPLE, (1.0, 0.3), [0.2, 90.0], max_steps=20),
    "adaptive_certified": lambda: solve(RODS, WILD, [2.0, 12.0], tolerance=1e-7, certify=1e-4),
    "events": lambda: solve(RODS, WILD, [1.0, 5.0], events=EVENTS, certify=1e-9),
    "ending_event": lambda: solve(
        RODS, WILD, np.arange(0.0, 30.0), "dop853", events=ENDING, tolerance=1e-8
    ),
    "digits": lambda: solve(RODS, WILD, [1.0, 20.0], digits=12),
    "digits_of_steps": lambda: solve(SIMPLE, (3.0, 0.0), 1.0, digits=15),
    "exact": lambda: exact(SIMPLE, (2.9, 0.1), [5.0, -1.0, 0.5], t0=0.5),
    "exact_linear": lambda: exact(LINEAR, (0.1, 0.7), [0.0, 3.0]),
}
ENDINGS = (".csv", ".nc", ".parquet", ".zarr")


def main(target: Path) -> None:
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(target, "w") as archive:
        for name, run in RUNS.items():
            trajectory = run()
            for ending in ENDINGS:
                trajectory.save(Path(folder) / f"{name}{ending}")
        for file in sorted(path for path in Path(folder).rglob("*") if path.is_file()):
            archive.write(file, file.relative_to(folder), zipfile.ZIP_DEFLATED, 9)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
