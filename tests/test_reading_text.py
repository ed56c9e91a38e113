"""Text tables of the dialects that people's programs write."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from pendula.measured import Measurement, read
from recordings import DEGREES, OTHER_SWING, RATE, SWING, TIMES, rows, same, text

if TYPE_CHECKING:
    from pathlib import Path

T, ROUNDED = TIMES, 1e-5  # written to six digits, in degrees or radians


def measured(path: Path, content: str | bytes, **given: Any) -> Measurement:
    """What is read from a file of that content; again with what was taken, it is the same."""
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    found = read(path, **given)
    assert isinstance(found, Measurement)
    same(read(path, **found.reading), found)
    return found


COMMA_DEGREES = rows(T, DEGREES)
SEMICOLON = rows(T, DEGREES, separator=";", mark=",")
TAB_COMMA = rows(T, DEGREES, separator="\t", mark=",")
FILES: dict[str, str | bytes] = {
    "English": text('"Time (s)","Angle (°)"', COMMA_DEGREES),
    "Spanish with CRLF": text("Tiempo (s),Ángulo (°)", COMMA_DEGREES).replace("\n", "\r\n"),
    "German in Latin-1": text("Zeit in s;Winkel in Grad", SEMICOLON).encode("latin-1"),
    "German in UTF-16": text("Zeit / s\tφ / °", TAB_COMMA).encode("utf-16"),
    "UTF-16 without a mark": text("t,theta_deg", COMMA_DEGREES).encode("utf-16-le"),
    "French in Latin-1": text("temps (s);angle (degrés)", SEMICOLON).encode("latin-1"),
    "Italian": text("Tempo [s];Angolo [gradi]", SEMICOLON),
    "Portuguese with a mark": "\ufeff" + text("Tempo (s);Ângulo (graus)", SEMICOLON),
    "units in the name": text("time_s,theta_deg", COMMA_DEGREES),
    "a row of units": text("t,theta", "[s],[deg]", COMMA_DEGREES),
    "a row of bare units": text("Tiempo;Posición angular", "s;grados", SEMICOLON),
    "Vernier": text('"Latest: Time (s)","Latest: Angle (°)"', COMMA_DEGREES),
    "PASCO": "\ufeff" + text("Time (s) Run #1,Angle (°) Run #1", COMMA_DEGREES),
    "a title above": text("Experiment 3, 12.1.2024", "", "length,0.6", "t,θ (°)", COMMA_DEGREES),
    "comments above": text("# by hand", "# L = 0.6", "# t theta", rows(T, DEGREES, separator=" ")),
    "numbers in a comment": text("# t theta", "# 0.6 0.2 1", rows(T, DEGREES, separator=" ")),
    "a header of units and blanks": text(
        "Time (s) Angle (deg) Angular velocity (rad/s)", rows(T, DEGREES, RATE, separator=" ")
    ),
    "no header": text(COMMA_DEGREES),
    "no header, commas and blanks": text(rows(T, DEGREES, separator=", ")),
    "no header, decimal commas": text(rows(T, DEGREES, separator="  ", mark=",")),
    "a header of blanks": text("Time (s)   Angle (deg)", rows(T, DEGREES, separator=" ")),
    "exponents": text("t;theta_deg", rows(T, DEGREES, separator=";", mark=",", form="%.9E")),
    "cells in quotes": text(
        "t,theta", [f'"{a}","{b}"' for a, b in (line.split(";") for line in SEMICOLON)]
    ),
    "empty lines between": text("t,theta", "", "\n\n".join(COMMA_DEGREES)),
    "empty cells at the right": text("t;theta;;", [f"{line};;" for line in SEMICOLON], ";;;"),
    "remarks in a column": text("t,theta,remark", [f"{line},ok" for line in COMMA_DEGREES]),
    "a mean below": text("t (s);theta (°)", SEMICOLON, "", "mean;0,1"),
    "times of the day": text(
        "Time,Angle (deg)", [f"00:00:{a:09.6f},{b:.6f}" for a, b in zip(T, DEGREES, strict=True)]
    ),
    "milliseconds": text("time (ms),angle (deg)", rows(1000 * T, DEGREES)),
    "a clock beside": text("time,seconds_elapsed,angle", rows(1e9 * T + 1.7e18, T, DEGREES)),
    "simulated beside": text("t,theta_mes,theta_simulado", rows(T, DEGREES, DEGREES + 1.0)),
    "a rate without a name": text(rows(T, DEGREES, np.degrees(RATE))),
    "both units": text("t,theta_deg,theta_rad", rows(T, DEGREES, SWING)),
}


@pytest.mark.parametrize("kind", FILES)
def test_dialects_are_read(kind: str, tmp_path: Path) -> None:
    found = measured(tmp_path / "swing.csv", FILES[kind])
    assert (found.quantity, found.names, found.unit) == ("angle", ("theta",), "rad")
    np.testing.assert_allclose(found.t, T, rtol=0, atol=1e-6)
    np.testing.assert_allclose(found.values[:, 0], SWING, rtol=0, atol=ROUNDED)


@pytest.mark.parametrize(
    ("separator", "mark"), [(",", "."), ("\t", "."), (";", "."), ("\t", ","), (";", ",")]
)
def test_the_five_dialects_of_phyphox(separator: str, mark: str, tmp_path: Path) -> None:
    labels = [f'"Gyroscope {axis} (rad/s)"' for axis in "xyz"]
    header = separator.join(['"Time (s)"', *labels, '"Absolute (rad/s)"'])
    axes = (0.6 * RATE, 0.0 * RATE, 0.8 * RATE, abs(RATE))
    lines = rows(T, *axes, separator=separator, mark=mark, form="%.9E")
    found = measured(tmp_path / "Raw Data.csv", text(header, lines))
    assert (found.quantity, found.names, found.unit) == ("rate", ("omega",), "rad/s")
    np.testing.assert_allclose(found.values[:, 0], RATE, rtol=0, atol=1e-8)
    assert "99.9 %" not in " ".join(found.notes)
    assert any("100.0 % of the variance" in note for note in found.notes)


def test_what_columns_are_taken_for_is_told(tmp_path: Path) -> None:
    lines = rows(T, DEGREES, RATE, separator=";", mark=",")
    found = measured(tmp_path / "a.csv", text("t;theta;omega (rad/s)", lines))
    assert found.notes[:4] == (
        "Semicolons between cells and decimal commas.",
        "Times from 't': no unit is told, seconds.",
        "Angle from 'theta'; not used: 'omega (rad/s)'.",
        "No unit is told: degrees, as their size shows it.",
    )
    assert found.reading == {"time": "t", "angle": "theta", "unit": "deg"}
    assert (
        found.checksum
        == __import__("hashlib").sha256((tmp_path / "a.csv").read_bytes()).hexdigest()
    )


def test_letters_of_latin_1(tmp_path: Path) -> None:
    content = text("temps;angle (degrés)", rows(T, DEGREES, separator=";"))
    found = measured(tmp_path / "a.csv", content.encode("latin-1"))
    assert found.reading["unit"] == "degrés"
    assert "The text is Latin-1." in found.notes


def test_missing_samples_stay_missing(tmp_path: Path) -> None:
    gone = SWING.copy()
    gone[[5, 70, 71]] = np.nan
    lines = [line.replace(",", ",NaN") if line.endswith(",") else line for line in rows(T, gone)]
    found = measured(tmp_path / "a.csv", text("t,theta (rad)", lines))
    np.testing.assert_array_equal(np.isnan(found.values[:, 0]), np.isnan(gone))
    assert "3 samples are missing in a column: left as they are." in found.notes


def test_columns_are_named_by_label_or_number(tmp_path: Path) -> None:
    content = text("t,theta (deg),phi (deg)", rows(T, DEGREES, 2 * DEGREES))
    for name in ("phi (deg)", "phi", "PHI", 3, "3"):
        found = measured(tmp_path / "a.csv", content, angle=name)
        np.testing.assert_allclose(found.values[:, 0], 2 * SWING, rtol=0, atol=ROUNDED)
    both = measured(tmp_path / "a.csv", content, angle=("theta", "phi"))
    assert (both.bodies, both.names) == (2, ("theta1", "theta2"))


def test_two_bodies(tmp_path: Path) -> None:
    content = text("t,θ₁ (rad),θ₂ (rad)", rows(T, SWING, OTHER_SWING))
    found = measured(tmp_path / "a.csv", content)
    assert (found.names, found.bodies) == (("theta1", "theta2"), 2)
    np.testing.assert_allclose(found.values.T, [SWING, OTHER_SWING], rtol=0, atol=ROUNDED)


def test_four_columns_without_names_are_angles_and_rates(tmp_path: Path) -> None:
    other_rate = -0.4 * 4.4 * np.sin(4.4 * T + 1.0)
    content = text(rows(T, SWING, OTHER_SWING, RATE, other_rate))
    found = measured(tmp_path / "a.csv", content)
    assert found.reading["angle"] == (2, 3)
    np.testing.assert_allclose(found.values.T, [SWING, OTHER_SWING], rtol=0, atol=ROUNDED)


@pytest.mark.parametrize(
    ("header", "run"),
    [
        ("t1,theta1,t2,theta2", 2),
        ("t,theta,t,theta", 2),
        ("Run 1: Time (s),Run 1: Angle (rad),Run 2: Time (s),Run 2: Angle (rad)", 2),
        ('"Tempo (s) Série #37","Angolo (rad) Série #37",t Série #38,Angolo (rad) Série #38', 38),
        ("Run 1,,Run 2,\nt (s),θ (rad),t (s),θ (rad)", 2),
    ],
)
def test_runs_side_by_side(header: str, run: int, tmp_path: Path) -> None:
    shorter = np.where(T < 5.0, SWING, np.nan)
    content = text(header, rows(T, OTHER_SWING, np.where(T < 5.0, T, np.nan), shorter))
    with pytest.raises(ValueError, match=r"holds 2 runs: \d+, \d+; name one with run="):
        measured(tmp_path / "a.csv", content)
    found = measured(tmp_path / "a.csv", content, run=run, unit="rad")
    np.testing.assert_allclose(found.values[:, 0], SWING[T < 5.0], rtol=0, atol=ROUNDED)


def test_runs_that_share_their_times_and_runs_below_one_another(tmp_path: Path) -> None:
    header = "t (s),Run 1 angle (°),Run 2 angle (°)"
    found = measured(tmp_path / "a.csv", text(header, rows(T, 0 * T, DEGREES)), run=2)
    np.testing.assert_allclose(found.values[:, 0], SWING, rtol=0, atol=ROUNDED)
    below = text("t,theta", rows(T, OTHER_SWING), rows(T, SWING))
    with pytest.raises(ValueError, match="holds 2 runs: 1, 2; name one with run=1$"):
        measured(tmp_path / "b.csv", below)
    found = measured(tmp_path / "b.csv", below, run="2")
    np.testing.assert_allclose(found.values[:, 0], SWING, rtol=0, atol=ROUNDED)
