"""Tables of periods, of a stopwatch or a light barrier."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from pendula.measured import PeriodTable, read
from recordings import rows, same, text

if TYPE_CHECKING:
    from pathlib import Path

L = np.array([0.2, 0.4, 0.6, 0.8, 1.0])
PERIOD = 2 * np.pi * np.sqrt(L / 9.81)
ANGLES = np.arange(10.0, 90.0, 10.0)


def table(path: Path, content: str, **given: Any) -> PeriodTable:
    path.write_text(content, encoding="utf-8")
    found = read(path, **given)
    assert isinstance(found, PeriodTable)
    same(read(path, **found.reading), found)
    return found


FILES = {
    "L (m),T (s)": rows(L, PERIOD),
    "L,T": rows(L, PERIOD),
    "Period (s),Length (m)": rows(PERIOD, L),
    "Longitud (cm),Tiempo de 10 oscilaciones (s)": rows(100 * L, 10 * PERIOD),
    "L/cm,t10/s": rows(100 * L, 10 * PERIOD),
    "Pendellänge (cm),Zeit für zehn Schwingungen (s)": rows(100 * L, 10 * PERIOD),
    "Length (m),10T (s),T (s)": rows(L, 10 * PERIOD, 0 * L),
    "n,L (cm),t (20 swings) (s)": rows(L, 100 * L, 20 * PERIOD),
    "Length (mm),Period (ms)": rows(1000 * L, 1000 * PERIOD),
    "String length,Trial 1,Trial 2,Trial 3,Average": rows(L, *[PERIOD] * 3, 0 * L),
}


@pytest.mark.parametrize("header", FILES)
def test_periods_against_length(header: str, tmp_path: Path) -> None:
    found = table(tmp_path / "a.csv", text(header, FILES[header]))
    assert found.length is not None
    np.testing.assert_allclose(found.length, L, rtol=1e-6)
    np.testing.assert_allclose(found.period, PERIOD, rtol=0, atol=1e-6)
    assert found.amplitude is None
    assert (found.repeats is not None) == ("Trial" in header)


def test_several_swings_timed_at_once_are_asked_for(tmp_path: Path) -> None:
    lines = rows(L, 10 * PERIOD, 10 * PERIOD + 0.2)
    content = text("Length,1st run (second),2nd run (second)", "(m),,", lines)
    message = (
        "^swings is not told by any header: the times are 10.* times the period of such a length; "
        "give the number of swings that were timed at once with swings=10$"
    )
    with pytest.raises(ValueError, match=message):
        table(tmp_path / "a.csv", content)
    found = table(tmp_path / "a.csv", content, swings=10)
    assert found.repeats is not None
    np.testing.assert_allclose(found.repeats[:, 1], PERIOD + 0.02, rtol=0, atol=1e-6)
    np.testing.assert_allclose(found.period, PERIOD + 0.01, rtol=0, atol=1e-6)


def test_a_repeat_that_is_missing(tmp_path: Path) -> None:
    second = PERIOD.copy()
    second[2] = np.nan
    found = table(tmp_path / "a.csv", text("L (m),Trial 1,Trial 2", rows(L, PERIOD, second)))
    np.testing.assert_allclose(found.period, PERIOD, rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    ("header", "values"),
    [
        ("Ángulo inicial (°),Periodo (s)", ANGLES),
        ("Amplitude (rad),Period (s)", np.radians(ANGLES)),
        ("theta,T", ANGLES),
        ("theta0 (deg),T (s)", ANGLES),
    ],
)
def test_periods_against_amplitude(header: str, values: Any, tmp_path: Path) -> None:
    periods = 1.5 + 0.01 * ANGLES
    found = table(tmp_path / "a.csv", text(header, rows(values, periods)))
    assert found.amplitude is not None
    assert found.length is None
    np.testing.assert_allclose(found.amplitude, np.radians(ANGLES), rtol=0, atol=1e-6)
    np.testing.assert_allclose(found.period, periods, rtol=0, atol=1e-6)


def test_lengths_without_a_unit_that_are_no_metres(tmp_path: Path) -> None:
    content = text("L,T (s)", rows(100 * L, PERIOD))
    with pytest.raises(ValueError, match="^unit of the lengths is not told, and they go up to 100"):
        table(tmp_path / "a.csv", content)
    found = table(tmp_path / "a.csv", content, unit="cm")
    assert found.length is not None
    np.testing.assert_allclose(found.length, L, rtol=1e-6)


def test_columns_of_times_that_differ_are_asked_for(tmp_path: Path) -> None:
    """A row for each swing: how long it took, and since when."""
    count = np.tile([1.0, 2.0, 3.0, 4.0, 5.0], 5)
    length, period = np.repeat(L, 5), np.repeat(PERIOD, 5)
    header = "longitud_m,repeticion,vuelta,t_vuelta_s,t_acumulado_s,amplitud_grados"
    content = text(
        header, rows(length, 0 * count + 1, count, period, count * period, 0 * count + 9)
    )
    with pytest.raises(
        ValueError, match="^period could be one of several columns that differ: 't_v"
    ):
        table(tmp_path / "a.csv", content)
    found = table(tmp_path / "a.csv", content, period="t_vuelta_s")
    assert found.amplitude is not None
    np.testing.assert_allclose(found.period, period, rtol=0, atol=1e-6)
    np.testing.assert_allclose(found.amplitude, np.radians(9.0), rtol=1e-12)


def test_columns_without_names_are_asked_for_and_named(tmp_path: Path) -> None:
    content = text(rows(L, PERIOD, separator=" "))
    with pytest.raises(ValueError, match=r"column 2 rises all the way; .* length=1 and period=2$"):
        table(tmp_path / "a.txt", content)
    found = table(tmp_path / "a.txt", content, length=1, period=2)
    np.testing.assert_allclose(found.period, PERIOD, rtol=0, atol=1e-6)


def test_a_light_barrier(tmp_path: Path) -> None:
    passes = np.cumsum(np.r_[0.1, np.tile([0.7, 0.72], 6)])  # the barrier is not at the middle
    changes = [f"{t:.6f},{state}" for at in passes for t, state in ((at, 1), (at + 0.01, 0))]
    found = table(tmp_path / "a.csv", text("Latest: Time (s),Latest: GateState", changes))
    np.testing.assert_allclose(found.period, 1.42, rtol=0, atol=1e-6)
    assert found.period.size == passes.size - 2
