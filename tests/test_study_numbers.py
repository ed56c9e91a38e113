"""What the study claims about its own numbers, with the default recipe."""

from __future__ import annotations

import math
from typing import Any, cast

import numpy as np
import pytest

from pendula import DoublePendulum, SimplePendulum, exact, solve
from pendula._types import MethodName
from pendula.analysis import largest_energy_errors, step_energy_errors
from pendula.plot.labels import labels
from pendula.study.facts import facts
from pendula.study.figures import _energy_errors
from pendula.study.notation import Numbers
from pendula.study.recipe import read_recipe
from pendula.study.runs import Results, compute


@pytest.fixture(scope="module")
def results() -> Results:
    return compute(read_recipe(None))


def test_a_reference_that_is_trusted_is_right(results: Results) -> None:
    # The default rods by RK4 in 80-bit floats at a step of 12.5 µs, θ1 and θ2 to 1e-4 rad.
    truth = {
        10.0: (-0.3333, -14.8424),
        15.0: (-0.1168, 2.0311),
        17.5: (0.1928, -6.0735),
        19.0: (-1.4314, -0.1869),
        20.0: (1.5876, 0.9657),
        22.5: (1.2302, -8.0026),
    }
    double = results.double
    assert 15 < double.horizon < 25
    for time, angles in truth.items():
        if time < double.horizon:
            row = int(np.flatnonzero(np.isclose(double.reference.t, time))[0])
            error = np.abs(double.reference.theta[row] - angles).max()
            assert error < 2 * math.radians(1)


def test_the_energy_law_of_the_report_holds(results: Results) -> None:
    words = labels("en")
    for row in facts(results, words, Numbers(words), "0")["methods"]:
        measured, theory = row["linear_energy"], row["linear_energy_theory"]
        number = [float(x.split("×")[0].replace("−", "-")) for x in (measured, theory)]
        assert number[0] == pytest.approx(number[1], rel=0.005), row["name"]
        assert measured[-2:] == theory[-2:] or "×" not in measured


def test_energy_errors_of_the_report_are_largest_over_the_steps(results: Results) -> None:
    """Of the default rods within 10 s: Heun 1.237e-4, RK4 8.625e-9, which is 6.1e-9 at outputs."""
    double, part = results.double, results.recipe.double
    words = labels("en")
    rows = facts(results, words, Numbers(words), "0")["double"]["rows"]
    for name, row in zip(double.runs, rows, strict=True):
        asked = double.runs[name].request
        steps = solve(double.system, asked.state, part.t_max, cast("Any", name), step=part.step)
        error = np.abs(steps.energy_error)
        largest, early = double.energy_errors[name], double.reference.t <= 10.0
        if name != "euler":
            known = {"heun": 1.2371e-4, "rk4": 8.6250e-9}[name]
            assert largest[early].max() == pytest.approx(known, rel=1e-4)
        for i in (1, 437, len(largest) - 1):
            since = slice(10 * (i - 1) + 1, 10 * i + 1)  # ten steps an output
            assert largest[i] == error[since].max()
        parted = min(double.parting[name], part.t_max)
        assert row["energy_before"] == Numbers(words).plain(error[steps.t <= parted].max())
        assert row["energy_largest"] == Numbers(words).plain(error.max())


def test_the_energy_figure_draws_what_is_largest_over_the_steps(results: Results) -> None:
    drawn = _energy_errors("reference", results.double)
    assert list(drawn) == ["reference", *results.double.runs]
    for name, run in results.double.runs.items():
        np.testing.assert_array_equal(drawn[name], results.double.energy_errors[name])
        assert (drawn[name] >= np.abs(run.energy_error)).all()
    assert drawn["rk4"].max() > np.abs(results.double.runs["rk4"].energy_error).max()


@pytest.mark.parametrize("end", [2.0, -2.0])
@pytest.mark.parametrize(("method", "how"), [("rk4", {"step": 0.01}), ("taylor", {})])
def test_energy_errors_between_outputs_count(
    end: float, method: MethodName, how: dict[str, Any]
) -> None:
    system, start = DoublePendulum.rods(), (2.0, 2.5, 0.0, 0.0)
    thin = solve(system, start, np.linspace(0.0, end, 4), method, **how)
    steps = np.abs(solve(system, start, end, method, **how).energy_error)
    outputs = np.abs(thin.energy_error)
    assert largest_energy_errors(thin).max() == max(steps.max(), outputs.max()) > outputs.max()
    t, errors = step_energy_errors(thin)
    assert (np.diff(t) * end >= 0).all()
    assert errors.max() == largest_energy_errors(thin).max()


def test_energy_errors_of_runs_that_end_early_or_have_no_steps() -> None:
    t = np.linspace(0.0, 100.0, 11)
    wild = solve(DoublePendulum.rods(), (2.0, 2.5, 0.0, 0.0), t, "euler", step=0.5)
    assert largest_energy_errors(wild).shape == wild.t.shape
    closed = exact(SimplePendulum(), (1.0, 0.0), t)
    np.testing.assert_array_equal(largest_energy_errors(closed), np.abs(closed.energy_error))


@pytest.mark.parametrize(
    ("value", "english", "spanish"),
    [
        (0.0, "0", "0"),
        (1.5, "1.50", "1,50"),
        (-0.000123456, "−0.000123", "−0,000123"),
        (1.5e-7, "1.50\u202f×\u202f10⁻⁷", "1,50\u202f×\u202f10⁻⁷"),
        (1234.5, "1234", "1234"),
        (123456.0, "123\u202f456", "123\u202f456"),
        (9.999e-5, "0.000100", "0,000100"),
        (math.inf, "—", "—"),
    ],
)
def test_numbers_in_both_languages(value: float, english: str, spanish: str) -> None:
    assert Numbers(labels("en")).plain(value) == english
    assert Numbers(labels("es")).plain(value) == spanish


def test_values_someone_chose_are_written_as_chosen() -> None:
    numbers = Numbers(labels("es"))
    assert numbers.chosen_degrees(math.radians(5)) == "5°"
    assert numbers.chosen_degrees(math.radians(179.9)) == "179,9°"
    assert numbers.duration(7.8125e-5) == "0,078125\u00a0ms"
    assert numbers.duration(2.0) == "2\u00a0s"
    assert numbers.percent(0.001) == "0,1\u00a0%"
    assert numbers.degrees(math.radians(1.5e-6)) == "1,50\u202f×\u202f10⁻⁶\u202f°"
