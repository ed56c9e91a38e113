"""Angles, rates and times as they are recorded, made what is computed with."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from recordings import DEGREES, RATE, SWING, TIMES, rows, text
from test_reading_text import measured

if TYPE_CHECKING:
    from pathlib import Path

    from pendula._types import Array

T = TIMES
TURNING = 2.0 * T + SWING  # turns over, without end


@pytest.mark.parametrize(
    ("wrapped", "unit"),
    [
        ((TURNING + np.pi) % (2 * np.pi) - np.pi, "rad"),
        (TURNING % (2 * np.pi), "rad"),
        (np.degrees(TURNING % (2 * np.pi)), "deg"),
        (np.degrees((TURNING + np.pi) % (2 * np.pi) - np.pi), "deg"),
    ],
)
def test_wrapped_angles_are_unwrapped(wrapped: Array, unit: str, tmp_path: Path) -> None:
    found = measured(tmp_path / "a.csv", text("t,theta", rows(T, wrapped)))
    assert found.reading["unit"] == unit
    np.testing.assert_allclose(
        found.values[:, 0] - found.values[0, 0], TURNING - TURNING[0], rtol=0, atol=1e-5
    )
    assert any("Wrapped angles were unwrapped" in note for note in found.notes)


def test_angles_beyond_a_turn_stay_as_they_are(tmp_path: Path) -> None:
    found = measured(tmp_path / "a.csv", text("t,theta (rad)", rows(T, TURNING)))
    np.testing.assert_allclose(found.values[:, 0], TURNING, rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    ("values", "unit"),
    [(SWING, "rad"), (5 * SWING, "rad"), (DEGREES, "deg"), (180 + DEGREES / 9, "deg")],
)
def test_degrees_are_told_by_their_size(values: Array, unit: str, tmp_path: Path) -> None:
    found = measured(tmp_path / "a.csv", text("t,theta", rows(T, values)))
    assert found.reading["unit"] == unit
    factor = np.pi / 180 if unit == "deg" else 1.0
    np.testing.assert_allclose(found.values[:, 0], values * factor, rtol=0, atol=1e-5)
    assert any(note.startswith("No unit is told") for note in found.notes)


def test_angles_that_may_be_either_are_asked_for(tmp_path: Path) -> None:
    content = text("t,theta", rows(T, 8 * SWING))
    with pytest.raises(ValueError, match="^unit is not told, and angles from -2.* to 2.4 may be"):
        measured(tmp_path / "a.csv", content)
    found = measured(tmp_path / "a.csv", content, unit="deg")
    np.testing.assert_allclose(found.values[:, 0], np.radians(8 * SWING), rtol=0, atol=1e-6)


def test_the_argument_goes_before_the_header(tmp_path: Path) -> None:
    content = text("t,theta (rad)", rows(T, DEGREES))
    found = measured(tmp_path / "a.csv", content, unit="°")
    np.testing.assert_allclose(found.values[:, 0], SWING, rtol=0, atol=1e-6)


@pytest.mark.parametrize(
    ("label", "given"), [("theta_rad_from_upright", {}), ("theta (rad)", {"zero": "up"})]
)
def test_angles_from_the_upright(label: str, given: dict[str, str], tmp_path: Path) -> None:
    content = text(f"t,{label}", rows(T, SWING - np.pi))
    found = measured(tmp_path / "a.csv", content, **given)
    np.testing.assert_allclose(found.values[:, 0], SWING, rtol=0, atol=1e-6)
    assert found.reading["zero"] == "up"


def test_rates_in_degrees_by_second(tmp_path: Path) -> None:
    labelled = measured(tmp_path / "a.csv", text("t,gyroZ (°/s)", rows(T, np.degrees(RATE))))
    bare = measured(tmp_path / "b.csv", text("t,gyroZ", rows(T, np.degrees(RATE))))
    for found in (labelled, bare):
        np.testing.assert_allclose(found.values[:, 0], RATE, rtol=0, atol=1e-6)
    radians = measured(tmp_path / "c.csv", text("t,gyroZ", rows(T, RATE)))
    np.testing.assert_allclose(radians.values[:, 0], RATE, rtol=0, atol=1e-6)


def test_one_axis_of_a_gyroscope_is_named(tmp_path: Path) -> None:
    content = text("t,wx,wy,wz", rows(T, 0.1 * RATE, RATE, 0.2 * RATE))
    found = measured(tmp_path / "a.csv", content, rate="wy")
    np.testing.assert_allclose(found.values[:, 0], RATE, rtol=0, atol=1e-6)


def test_axes_of_the_sensor_that_a_file_is_named_after(tmp_path: Path) -> None:
    content = text("seconds_elapsed,z,y,x", rows(T, RATE, 0 * T, 0 * T))
    found = measured(tmp_path / "Gyroscope.csv", content)
    assert found.quantity == "rate"
    np.testing.assert_allclose(found.values[:, 0], RATE, rtol=0, atol=1e-6)


@pytest.mark.parametrize("gravity", [True, False])
def test_the_axis_of_an_accelerometer_towards_the_pivot(gravity: bool, tmp_path: Path) -> None:
    radial = 0.6 * RATE**2 + 9.81 * np.cos(SWING) * gravity
    noise = np.random.default_rng(5).normal(0.0, 0.02, (2, T.size))
    sort = "Acceleration" if gravity else "Linear Acceleration"
    header = '"Time (s)",' + ",".join(f'"{sort} {axis} (m/s^2)"' for axis in "xyz")
    across = 3.0 * SWING + noise[0]
    content = text(header, rows(T, across, -radial + noise[1], noise[0]))
    found = measured(tmp_path / "a.csv", content)
    assert (found.quantity, found.names, found.unit) == ("acceleration", ("radial",), "m/s²")
    assert found.reading["linear"] is not gravity
    np.testing.assert_allclose(found.values[:, 0], radial - noise[1], rtol=0, atol=1e-5)
    named = measured(tmp_path / "a.csv", content, radial=f"{sort} y", linear=gravity)
    assert named.reading["linear"] is gravity


def test_accelerations_in_g(tmp_path: Path) -> None:
    content = text("time,gFx,gFy,gFz", rows(T, 0.02 * SWING, 1.0 + 0.05 * RATE**2, 0 * T))
    found = measured(tmp_path / "a.csv", content)
    expected = 9.80665 * (1.0 + 0.05 * RATE**2)
    np.testing.assert_allclose(found.values[:, 0], expected, rtol=0, atol=1e-4)


def test_a_force_is_divided_by_the_mass(tmp_path: Path) -> None:
    content = text("t;F", "s;N", rows(T - 1.0, -2.0 - RATE**2, separator=";", mark=","))
    with pytest.raises(ValueError, match=r"^mass is needed: 'F' is a force; .* mass=0.1$"):
        measured(tmp_path / "a.csv", content)
    found = measured(tmp_path / "a.csv", content, mass=0.2)
    assert found.t[0] == -1.0
    np.testing.assert_allclose(found.values[:, 0], (2.0 + RATE**2) / 0.2, rtol=0, atol=1e-5)


@pytest.mark.parametrize(("rate", "form"), [(30, "%.3G"), (120, "%.2f"), (59.94, "%.3G")])
def test_printed_times_that_repeat_are_made_again(rate: float, form: str, tmp_path: Path) -> None:
    times = np.arange(1500) / rate
    lines = [f"{form % t},{np.sin(t):.6f}" for t in times]
    found = measured(tmp_path / "a.csv", text("t (s),theta (rad)", lines))
    assert found.reading["frame_rate"] == rate
    np.testing.assert_allclose(found.t, times, rtol=1e-12)
    assert any("times are made again" in note for note in found.notes)


def test_samples_that_are_there_twice(tmp_path: Path) -> None:
    lines = rows(T, SWING)
    doubled = [*lines[:50], lines[49], *lines[50:]]
    jittered = [f"{float(a) + 3e-4 * np.sin(i * i):.6f},{b}"
                for i, (a, b) in enumerate(line.split(",") for line in lines)]  # fmt: skip
    found = measured(
        tmp_path / "a.csv", text("t,theta", [*jittered[:50], jittered[49], *jittered[50:]])
    )
    assert found.t.size == T.size
    assert "1 samples are there twice: each is kept once." in found.notes
    with pytest.raises(ValueError, match=r"^time stands still at 0.98 s, at line 52 of the file"):
        measured(tmp_path / "b.csv", text("t,theta", [*doubled[:50], "0.98,0.1", *doubled[51:]]))


def test_gaps_and_repeated_values_are_kept_and_told(tmp_path: Path) -> None:
    held = np.repeat(SWING[::2], 2)
    kept = np.r_[0:150, 200:400]
    found = measured(tmp_path / "a.csv", text("t,theta", rows(T[kept], held[kept])))
    np.testing.assert_allclose(found.t, T[kept], rtol=0, atol=1e-6)
    assert "1 gaps, the longest of 1.02 s: left as they are." in found.notes
    assert any("repeat the value before: left as they are" in note for note in found.notes)


@pytest.mark.parametrize("of_a_second", [1, 1e3, 1e6])
def test_times_counted_from_1970_are_from_the_first_sample(
    of_a_second: float, tmp_path: Path
) -> None:
    lines = rows((1.76e9 + T) * of_a_second, SWING)
    found = measured(tmp_path / "a.csv", text("timestamp, angle", lines))
    np.testing.assert_allclose(found.t, T, rtol=0, atol=1e-6)
    assert "Times from 'timestamp', counted from 1970: from the first sample on." in found.notes


def test_a_given_frame_rate_goes_before_the_times(tmp_path: Path) -> None:
    found = measured(tmp_path / "a.csv", text("t,theta", rows(T, SWING)), frame_rate=240)
    np.testing.assert_allclose(found.t, np.arange(T.size) / 240, rtol=1e-12)
    frames = text("frame,theta", rows(np.r_[0:100, 110:200], SWING[:190], form="%.5f"))
    found = measured(tmp_path / "b.csv", frames, frame_rate=50)
    np.testing.assert_allclose(found.t, np.r_[0:100, 110:200] / 50, rtol=1e-12)
