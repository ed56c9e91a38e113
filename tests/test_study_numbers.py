"""What the study claims about its own numbers, with the default recipe."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pendula.plot.labels import labels
from pendula.study.facts import facts
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
