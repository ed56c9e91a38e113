"""A fit takes little time, and gives the same bits each time."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from pendula.measured import fit
from simulated import swing
from test_fit import THREE, long_swing


def test_a_fit_is_made_again_of_its_recipe_to_the_same_bits() -> None:
    made, _ = swing(3, 0.9, ("viscous",))
    found = fit(made, "viscous", length=(0.8, 0.01), t=(1.0, 9.0))
    recipe = json.loads(json.dumps(found.recipe))
    again = fit(made, **recipe)
    for name in ("values", "standard_errors", "residuals"):
        np.testing.assert_array_equal(getattr(found, name), getattr(again, name))
    assert again.recipe == found.recipe


def test_the_long_swing_is_fitted_in_time() -> None:
    made = long_swing()

    def seconds() -> float:
        begin = time.process_time()
        fit(made, THREE)
        return time.process_time() - begin

    assert min(seconds() for _ in range(4)) < 0.4  # 0.15 s on an idle machine


def test_the_bits_do_not_depend_on_threads() -> None:
    program = (
        "import hashlib, sys; sys.path[:0] = sys.argv[1:]\n"
        "from simulated import clean\n"
        "from pendula.measured import fit\n"
        "swing = clean(seconds=60.0, rate=100.0, viscous=0.02, coulomb=0.01)\n"
        "made = fit(swing, 'viscous + coulomb')\n"
        "bits = made.values.tobytes() + made.covariance.tobytes() + made.residuals.tobytes()\n"
        "print(hashlib.sha256(bits).hexdigest())\n"
    )

    def hashed(threads: int) -> str:
        names = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
        environment = {**os.environ, **dict.fromkeys(names, str(threads))}
        command = [sys.executable, "-c", program, str(Path(__file__).parent)]
        done = subprocess.run(command, check=True, capture_output=True, text=True, env=environment)
        return done.stdout

    assert hashed(1) == hashed(2) == hashed(4)
