"""A fit takes few runs, and gives the same bits each time."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from pendula import _engine
from pendula.measured import Measurement, compare_models, fit
from pendula.measured.model import SingleModel
from pendula.measured.noise import Series, filtered
from simulated import clean, swing
from test_fit import THREE

if TYPE_CHECKING:
    from pendula._types import Array


def simulated_long() -> Measurement:
    frictions = {"viscous": 0.01, "coulomb": 0.16, "quadratic": 0.004}
    return clean(seconds=55.0, rate=100.0, square=64.0, start=(-1.6, 1.8), **frictions)


def test_a_fit_is_made_again_of_its_recipe_to_the_same_bits() -> None:
    made, _ = swing(3, 0.9, ("viscous",))
    found = fit(made, "viscous", length=(0.8, 0.01), t=(1.0, 9.0))
    recipe = json.loads(json.dumps(found.recipe))
    again = fit(made, **recipe)
    for name in ("values", "standard_errors", "residuals"):
        np.testing.assert_array_equal(getattr(found, name), getattr(again, name))
    assert again.recipe == found.recipe


def test_the_long_swing_is_fitted_in_few_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    runs = []
    ensemble = _engine.ensemble

    def counted(request: Any, *arguments: Any) -> Any:
        runs.append(request)
        return ensemble(request, *arguments)

    monkeypatch.setattr(_engine, "ensemble", counted)
    fit(simulated_long(), THREE)
    assert len(runs) <= 160  # 0.12 s on an idle machine: `make bench`


def test_the_whole_long_swing_is_derived_at_few_places(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two frictions are nearly collinear: damped steps would creep along that direction."""
    made, places = simulated_long(), []
    slopes = SingleModel.slopes

    def counted(model: SingleModel, t: Array, *others: Any) -> Array:
        if len(t) == len(made.t):
            places.append(t)
        return slopes(model, t, *others)

    monkeypatch.setattr(SingleModel, "slopes", counted)
    fit(made, THREE)
    assert 1 <= len(places) <= 4  # what the uncertainties need among them


def test_noise_is_summed_as_its_covariance_says() -> None:
    random = np.random.default_rng(0)
    places = np.cumsum(random.integers(1, 4, 300))
    series = Series(np.zeros(300), random.normal(size=(300, 3)), places - places[0])
    far = np.abs(series.places[:, np.newaxis] - series.places)
    for rho in (0.0, -0.4, 0.98, 0.9999):
        covariance = 2.0 * np.where(far == 0, 1.0, rho**far)
        expected = series.jacobian.T @ covariance @ series.jacobian
        found = filtered(series, rho, 2.0)
        np.testing.assert_allclose(found, expected, atol=1e-13 * np.abs(expected).max())


OF_A_FIT = """
from simulated import clean
from pendula.measured import fit
swing = clean(seconds=60.0, rate=100.0, viscous=0.02, coulomb=0.01)
made = fit(swing, "viscous + coulomb")
bits = made.values.tobytes() + made.covariance.tobytes() + made.residuals.tobytes()
"""
# as large as those of a chaotic motion in fifty windows, which would take a minute
OF_LARGE_MATRICES = """
import numpy as np
from pendula.measured.one_thread import on_one_thread
random = np.random.default_rng(1)
rows, wanted = random.normal(size=(3000, 250)), random.normal(size=3000)
solved = on_one_thread(lambda: (np.linalg.lstsq(rows, wanted, rcond=None)[0], rows.T @ rows))
bits = b"".join(each.tobytes() for each in solved())
"""


@pytest.mark.parametrize("program", [OF_A_FIT, OF_LARGE_MATRICES], ids=["fit", "matrices"])
def test_the_bits_do_not_depend_on_threads(program: str) -> None:
    program = f"import hashlib, sys; sys.path[:0] = sys.argv[1:]\n{program}"
    program += "print(hashlib.sha256(bits).hexdigest())\n"

    def hashed(threads: int) -> str:
        names = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
        environment = {**os.environ, **dict.fromkeys(names, str(threads))}
        command = [sys.executable, "-c", program, str(Path(__file__).parent)]
        done = subprocess.run(command, check=True, capture_output=True, text=True, env=environment)
        return done.stdout

    assert hashed(1) == hashed(2) == hashed(4)


def test_fits_and_comparisons_run_on_one_thread() -> None:
    for function in (fit, compare_models):
        inner = vars(function)["__wrapped__"]
        assert inner.__name__ == function.__name__
