"""The coefficients of DOP853 in the core are those of SciPy, which has them from dop853.f."""

import re
from pathlib import Path

import numpy as np
import pytest

ours = Path(__file__).parents[1] / "core/include/pendula/method/dop853_tableau.hpp"
theirs = pytest.importorskip("scipy.integrate._ivp.dop853_coefficients")

Row = dict[int, float]


def rows(table: str) -> list[Row]:
    """Return the rows of one table of the header: a coefficient for each number of a slope."""
    text = re.search(rf"std::tuple {table}\{{(.*?)\}};", ours.read_text(), re.DOTALL)
    assert text is not None
    found = []
    for count, row in re.findall(r"weighted<(\d+)>(.*?)(?=weighted|$)", text[1], re.DOTALL):
        pairs = re.findall(r"\{(\d+), (-?[0-9.e-]+)\}", row)
        assert len(pairs) == int(count)
        found.append({int(slope): float(coefficient) for slope, coefficient in pairs})
    return found


def not_zero(row: np.ndarray) -> Row:
    """Return the coefficients that are not zero."""
    return {int(i): float(row[i]) for i in np.flatnonzero(row)}


def test_slopes() -> None:
    """Every slope but the first has its row."""
    assert rows("toward") == [not_zero(row) for row in theirs.A[1:]]


def test_error() -> None:
    """The second row is what SciPy takes off the step."""
    fifth, taken_off = rows("error")
    assert fifth == not_zero(theirs.E5)
    difference = np.append(theirs.B, 0.0)
    for slope, coefficient in taken_off.items():
        difference[slope] -= coefficient
    assert not_zero(difference) == not_zero(theirs.E3)


def test_dense_output() -> None:
    """Hermite's part has no coefficients of its own."""
    assert rows("dense") == [not_zero(row) for row in theirs.D]
