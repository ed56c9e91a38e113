"""Real recordings, as people have them: each is read, or asks one question."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares

from pendula.measured import Measurement, PeriodTable, read, read_all
from recordings import recording, same

# File, arguments, quantity, names, samples, and start and end of the times.
READ: list[tuple[str, dict[str, Any], str, tuple[str, ...], int, float, float]] = [
    ("single_pendulum_freeswing_1kHz.csv", {}, "angle", ("theta",), 55001, 0.0, 55.0),
    ("single_small_swing_encoder.csv", {}, "angle", ("theta",), 23176, 60.0, 83.175),
    ("single_no_header_degrees.csv", {}, "angle", ("theta",), 602, 0.00600147, 20.4707),
    ("single_three_runs_semicolon_degrees.csv", {"run": 1}, "angle", ("theta",), 1656, 0, 55.1667),
    ("single_three_runs_semicolon_degrees.csv", {"run": 3}, "angle", ("theta",), 1646, 0, 54.8333),
    ("phone_linear_acceleration.csv", {}, "acceleration", ("radial",), 4359, 0.00815, 43.4304),
    ("phyphox_single.xls", {}, "rate", ("omega",), 484, 0.0446777, 10.02),
    ("double_encoder_1kHz_windows.mat", {"run": 1}, "angle", ("theta1", "theta2"), 2667, 0, 2.666),
    ("double_pixels_no_header_no_time.csv", {"frame_rate": 501}, "position",
     ("x1", "y1", "x2", "y2"), 4000, 0.0, 3999 / 501),
    ("double_positions_bom_semicolon.csv", {"unit": "mm"}, "position", ("x1", "y1", "x2", "y2"),
     200, 0.0, 1.99),
    ("double_tracked.trk", {}, "position", ("x1", "y1", "x2", "y2"), 200, 0.0, 1.99),
    ("double_tracked_degrees.csv", {}, "angle", ("theta1", "theta2"), 199, 0.0, 1.98),
]  # fmt: skip


@pytest.mark.parametrize(("name", "given", "quantity", "names", "samples", "start", "end"), READ)
def test_recordings_are_read(
    name: str, given: dict[str, Any], quantity: str, names: tuple[str, ...], samples: int,
    start: float, end: float,
) -> None:  # fmt: skip
    path = recording(name)
    found = read(path, **given)
    assert isinstance(found, Measurement)
    assert (found.quantity, found.names, found.t.size) == (quantity, names, samples)
    np.testing.assert_allclose([found.t[0], found.t[-1]], [start, end], rtol=0, atol=5e-5)
    assert (np.diff(found.t) > 0).all()
    same(read(path, **found.reading), found)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("single_three_runs_semicolon_degrees.csv", "holds 3 runs: 1, 2, 3; name one with run=1$"),
        ("double_encoder_1kHz_windows.mat", "holds 3 runs: 1, 2, 3; name one with run=1$"),
        ("double_pixels_no_header_no_time.csv", "no column of times; .* frame_rate=30$"),
        ("double_positions_bom_semicolon.csv", "^unit is not told: .* unit=m, unit=mm or unit=px$"),
        ("periods_stopwatch.csv", r"^swings is not told .* 9.95 times .* swings=10$"),
    ],
)
def test_recordings_that_ask_one_question(name: str, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        read(recording(name))


def test_angles_from_the_upright() -> None:
    found = read(recording("single_pendulum_freeswing_1kHz.csv"))
    assert isinstance(found, Measurement)
    assert found.values[0, 0] == pytest.approx(1.52316373 - np.pi, abs=1e-12)
    assert abs(found.values[-5000:, 0].mean()) < 0.04  # at rest it hangs


def test_rates_of_the_encoder_are_told_from_its_angles() -> None:
    found = read(recording("double_encoder_1kHz_windows.mat"), run=2)
    assert isinstance(found, Measurement)
    assert found.reading["angle"] == ("y_2[1]", "y_2[2]")
    rates = read(recording("double_encoder_1kHz_windows.mat"), run=2, rate=("y_2[3]", "y_2[4]"))
    assert isinstance(rates, Measurement)
    slopes = np.gradient(found.values, found.t, axis=0)
    assert np.corrcoef(slopes.ravel(), rates.values.ravel())[0, 1] > 0.99


def test_pivot_and_lengths_of_the_films() -> None:
    pixels = read(recording("double_pixels_no_header_no_time.csv"), frame_rate=501)
    bobs = read(recording("double_positions_bom_semicolon.csv"), unit="mm")
    tracked = read(recording("double_tracked.trk"))
    assert isinstance(pixels, Measurement)
    assert isinstance(bobs, Measurement)
    assert isinstance(tracked, Measurement)
    assert (pixels.reading["x"], pixels.reading["y"]) == ((4, 6, 2), (3, 5, 1))
    assert pixels.reading["y_axis"] == "down"
    sizes = pixels.as_angle().geometry
    # The distances between the markers, by hand: 602 and 461 pixels.
    np.testing.assert_allclose((sizes["l1_px"], sizes["l2_px"]), (602, 461), atol=1.5)
    # The first bob starts at (-12.56, 440.70) mm, above the pivot: its length is about that.
    sizes = bobs.as_angle().geometry
    assert sizes["l1"] == pytest.approx(0.441, abs=0.01)
    assert sizes["circle_rms"] < 0.002
    # Both were let go near the upright; Tracker's tape is 20 of its units for 907 pixels.
    assert abs(bobs.as_angle().values[0, 0]) == pytest.approx(np.pi, abs=0.05)
    assert abs(tracked.as_angle().values[0, 0]) == pytest.approx(np.pi, abs=0.05)
    assert tracked.values[0, 1] == pytest.approx((933.364445 - 491.729904) / 45.364992, abs=1e-5)


def test_the_phone_turns_about_one_axis_and_pulls_along_another() -> None:
    gyroscope = read(recording("phyphox_single.xls"))
    assert any("0.984" in note and "99.0 % of the variance" in note for note in gyroscope.notes)
    pull = read(recording("phone_linear_acceleration.csv"))
    assert isinstance(pull, Measurement)
    assert pull.reading["radial"] == "Linear Acceleration y (m/s^2)"
    assert pull.reading["linear"] is True
    # let go from 15°: the mean of L ω² is g θ²/2 = 0.34 m/s² at first
    assert pull.window(4, 12).values.mean() == pytest.approx(0.34, abs=0.05)


def test_the_stopwatch() -> None:
    found = read(recording("periods_stopwatch.csv"), swings=10)
    assert isinstance(found, PeriodTable)
    assert found.length is not None
    assert found.repeats is not None
    np.testing.assert_allclose(found.length, np.arange(1, 11) / 10, rtol=1e-12)
    assert found.repeats.shape == (10, 5)
    assert found.period[-1] == pytest.approx(np.mean([1.96, 1.82, 1.75, 1.99, 1.86]))


def test_times_made_again_give_the_reference_fit() -> None:
    """Of run 1, 20 samples in: w2 17.3418 ± 0.0002, b 0.00501 ± 0.00003 1/s, rms 1.89 mrad.

    The printed times, 0.1 s apart beyond 10 s, would give an rms of some hundred mrad.
    """
    runs = read_all(recording("single_three_runs_semicolon_degrees.csv"))
    run = runs["1"]
    assert isinstance(run, Measurement)
    assert run.reading["frame_rate"] == 30.0
    t, theta = run.t[20:] - run.t[20], run.values[20:, 0]

    def off(p: np.ndarray) -> np.ndarray:
        made = solve_ivp(
            lambda _, s: (s[1], -p[2] * np.sin(s[0]) - p[3] * s[1]), (0, t[-1]), p[:2],
            t_eval=t, rtol=1e-7, atol=1e-9, method="DOP853",
        )  # fmt: skip
        return np.asarray(made.y[0] + p[4] - theta)

    rate = (theta[2] - theta[0]) / (t[2] - t[0])
    found = least_squares(
        off, (theta[0], rate, 17.34, 0.005, 0.0), x_scale=(0.1, 0.4, 1, 0.01, 0.1)
    )
    assert found.x[2] == pytest.approx(17.3418, abs=5e-4)
    assert found.x[3] == pytest.approx(0.00501, abs=5e-5)
    assert np.sqrt(np.mean(found.fun**2)) == pytest.approx(1.89e-3, abs=0.02e-3)
