"""What headers mean, in the words and languages in which people and programs write them."""

from __future__ import annotations

import pytest

from pendula.measured.headings import heading_of

MEANT = {
    "Latest: Time (s)": ("time", "", "s"),
    "Zeit / s": ("time", "", "s"),
    "seconds_elapsed": ("time", "", ""),
    "ms": ("time", "", "s"),
    "Time shift (s)": ("other", "", "s"),
    "fotograma": ("frame", "", ""),
    "Ángulo (°)": ("angle", "", "rad"),
    "Winkel in Grad": ("angle", "", "rad"),
    "θ₂ (rad)": ("angle", "2", "rad"),
    "theta1_mesure_deg": ("angle", "1", "rad"),
    "erreur_theta1_deg": ("other", "1", "rad"),
    "Sensor 1 (deg)": ("angle", "1", "rad"),
    "θ_v": ("other", "", ""),
    "ω": ("rate", "", ""),
    "dθ/dt": ("rate", "", ""),
    "thetaDot": ("rate", "", ""),
    "AngularVelocity": ("rate", "", ""),
    "Velocidad angular (°/s)": ("rate", "", "rad/s"),
    "Rotation x (rad/s)": ("rate", "", "rad/s"),
    "gyroscopeX": ("rate", "", ""),
    "Angular acceleration (rad/s^2)": ("other", "", "rad/s²"),
    "Linear Acceleration z (m/s²)": ("acceleration", "", "m/s²"),
    "accelerometerX": ("acceleration", "", ""),
    "gFx": ("acceleration", "", "m/s²"),
    "Força (N)": ("force", "", "N"),
    "x_m2": ("x", "2", ""),
    "Position Y (mm)": ("y", "", "m"),
    "pos_x": ("x", "", ""),
    "v_x": ("other", "", ""),
    "vy (m/s)": ("other", "", "m/s"),
    "Pendellänge (cm)": ("length", "", "m"),
    "Amplitud (°)": ("amplitude", "", "rad"),
    "Schwingungsdauer": ("period", "", ""),
    "T (s)": ("period", "", "s"),
    "3rd Run (second)": ("trial", "", "s"),
    "Latest: GateState": ("gate", "", ""),
    "Temperature (K)": ("other", "", ""),
    "Remark": ("", "", ""),
}


@pytest.mark.parametrize("label", MEANT)
def test_what_a_header_means(label: str) -> None:
    found = heading_of(label)
    assert (found.kind, found.index, found.unit) == MEANT[label]


@pytest.mark.parametrize(
    ("label", "swings"),
    [
        ("10T (s)", 10),
        ("t10/s", 10),
        ("Time for 20 swings (s)", 20),
        ("Tiempo de diez oscilaciones (s)", 10),
        ("Zeit für 5 Schwingungen", 5),
        ("t (s)", None),
    ],
)
def test_how_many_swings_a_time_is_of(label: str, swings: int | None) -> None:
    assert heading_of(label).swings == swings


@pytest.mark.parametrize(
    ("label", "run"),
    [
        ("Tempo (s) Série #37", "37"),
        ("Angle (rad) Run #1", "1"),
        ("Run 2: Angle (°)", "2"),
        ("Latest: Angle (°)", ""),
    ],
)
def test_which_run_a_header_names(label: str, run: str) -> None:
    assert heading_of(label).run == run
