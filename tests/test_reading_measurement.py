"""What a recording can: windows, outliers, how it shows itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from pendula.measured import Measurement, read, read_all
from recordings import DEGREES, OTHER_SWING, RATE, SWING, TIMES, rows, same, text
from test_reading_text import measured

if TYPE_CHECKING:
    from pathlib import Path

T = TIMES
SPIKES = [3, 57, 58, 200, 396]


def spiky() -> Measurement:
    noise = np.random.default_rng(3).normal(0.0, 2e-4, T.size)
    values = SWING + noise
    values[SPIKES] += [0.02, -0.05, -0.05, 0.3, 0.02]
    return Measurement(T, values[:, np.newaxis], "angle", ("theta",), "rad")


def test_outliers_are_shown_and_none_is_left_out() -> None:
    found = spiky()
    assert np.flatnonzero(found.outliers()).tolist() == SPIKES
    assert found.t.size == T.size
    kept = found.without(found.outliers())
    assert kept.t.size == T.size - len(SPIKES)
    assert not kept.outliers().any()
    assert kept.notes[-1] == "5 samples are left out, at 0.06, 1.14, 1.16, 4, 7.92 s."
    assert not found.outliers(threshold=1e4).any()


@pytest.mark.parametrize("values", [SWING, np.round(SWING, 2), np.repeat(SWING[::10], 10), 0 * T])
def test_what_is_no_outlier(values: np.ndarray) -> None:
    found = Measurement(T, values[:, np.newaxis], "angle", ("theta",), "rad")
    assert not found.outliers().any()


def test_gaps_and_missing_samples_are_no_outliers() -> None:
    values = SWING.copy()
    values[50:60] = np.nan
    kept = np.r_[0:200, 250:400]
    found = Measurement(T[kept], values[kept, np.newaxis], "angle", ("theta",), "rad")
    assert not found.outliers().any()


def test_noise_that_dies_away_with_the_motion_is_no_outlier() -> None:
    noise = np.random.default_rng(5).normal(0.0, 0.003, T.size) * np.exp(-T)
    found = Measurement(T, (SWING + noise)[:, np.newaxis], "angle", ("theta",), "rad")
    assert not found.outliers().any()


def test_many_in_a_row_are_a_motion() -> None:
    values = SWING.copy()
    values[100:110] += 0.1
    values[300:303] += 0.1
    found = Measurement(T, values[:, np.newaxis], "angle", ("theta",), "rad")
    assert np.flatnonzero(found.outliers()).tolist() == [300, 301, 302]


def test_outliers_are_left_out_if_asked(tmp_path: Path) -> None:
    content = text("t,theta (rad)", rows(T, spiky().values[:, 0]))
    assert measured(tmp_path / "a.csv", content).t.size == T.size
    found = measured(tmp_path / "a.csv", content, outliers="leave out")
    np.testing.assert_allclose(found.t, np.delete(T, SPIKES), rtol=0, atol=1e-6)
    assert any(note.startswith("5 samples are left out") for note in found.notes)


def test_windows(tmp_path: Path) -> None:
    content = text("t,theta (rad)", rows(T, SWING))
    found = measured(tmp_path / "a.csv", content, t=(1, 3))
    assert (found.t[0], found.t[-1], found.t.size) == (1.0, 3.0, 101)
    narrower = found.window(0, 2)
    assert narrower.reading["t"] == (1.0, 2.0)
    same(read(tmp_path / "a.csv", **narrower.reading), narrower)
    assert narrower.notes[-1] == "51 of 101 samples, those from 0 to 2 s."
    without = narrower.without(narrower.t < 1.1)
    same(read(tmp_path / "a.csv", **without.reading), without)


def test_bad_masks_and_windows() -> None:
    found = spiky()
    with pytest.raises(ValueError, match="^mask must be 400 truth values, one a sample, got"):
        found.without(found.t)
    with pytest.raises(ValueError, match="^threshold must be positive"):
        found.outliers(0)
    with pytest.raises(
        ValueError, match="^measurement must be of positions or angles, is of rates"
    ):
        Measurement(T, RATE[:, np.newaxis], "rate", ("omega",), "rad/s").as_angle()


def test_sample_rate_and_evenness() -> None:
    found = spiky()
    assert found.sample_rate == pytest.approx(50.0)
    assert found.is_even
    uneven = Measurement(T + 1e-3 * np.sin(T), found.values, "angle", ("theta",), "rad")
    assert not uneven.is_even


def test_how_it_shows_itself(tmp_path: Path) -> None:
    content = text("t,theta", rows(T, DEGREES))
    found = measured(tmp_path / "<a>.csv", content)
    assert "theta [rad], 400 samples, t = 0 … 7.98 s>" in repr(found)
    page = found._repr_html_()
    assert "&lt;a&gt;.csv" in page
    assert "50 a second" in page
    assert "degrees, as their size shows it" in page
    table = tmp_path / "b.csv"
    table.write_text(text("L (m),T (s)", "0.5,1.42", "1,2.006"))
    periods = read(table)
    assert repr(periods).endswith("2 periods, 1.42 … 2.006 s>")
    assert "0.5 … 1 m" in periods._repr_html_()


def test_all_runs(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text(text("t1,theta1,t2,theta2", rows(T, SWING, T, OTHER_SWING)))
    runs = read_all(path, unit="rad")
    assert list(runs) == ["1", "2"]
    for name, run in runs.items():
        same(run, read(path, run=name, unit="rad"))
    path.write_text(text("t,theta", rows(T, SWING)))
    assert list(read_all(path)) == ["1"]
