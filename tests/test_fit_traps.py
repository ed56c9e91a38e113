"""What goes wrong with recordings is seen and said: hands, angles from the upright."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pendula import DampedDoublePendulum, DrivenPendulum
from pendula.measured import Measurement, compare_models, fit, read
from recordings import recording
from simulated import NOISE, recorded


def test_a_hand_at_the_ends_of_a_record_is_told_and_friction_that_is_wrong_is_none() -> None:
    made = recorded(DrivenPendulum.bob(0.8, viscous=0.05), (0.4, 0.0), seconds=20.0)
    held = np.where(made.t < 3.0, 0.4 + 0.1 * np.sin(7.0 * made.t), made.values[:, 0])
    held = np.where(made.t > 17.0, 0.02, held)
    found = fit(replace(made, values=held[:, np.newaxis]), "viscous")
    note = next(note for note in found.notes if note.key == "free_swing")
    begin, end = note.details["begin"], note.details["end"]
    assert 2.9 < float(begin) < 4.9  # type: ignore[arg-type]
    assert 15.1 < float(end) < 17.1  # type: ignore[arg-type]
    assert note.details["inside"] == pytest.approx(NOISE, rel=0.1)
    assert "with t from" in note.sentence()
    assert "con t de" in note.sentence("es")
    dry = recorded(DrivenPendulum.bob(0.8, coulomb=0.1), (1.0, 0.0), seconds=20.0)
    assert "free_swing" not in {*fit(made, "viscous").flags, *fit(dry, "viscous").flags}


def test_angles_of_a_double_pendulum_from_the_upright_are_noticed() -> None:
    made = recorded(DampedDoublePendulum.bobs(), (1.5, 1.0, 0.0, 0.0), seconds=3.0)
    upright = replace(made, values=made.values + np.pi)
    with pytest.raises(ValueError, match="zero seems to be up: .* read the file with zero=up"):
        fit(upright)
    assert fit(made).rms < 2.0 * NOISE


def test_quarters_are_of_the_parameters_in_their_order() -> None:
    made = recorded(DrivenPendulum.bob(0.8, viscous=0.05), (0.4, 0.0), seconds=20.0)
    said = next(note for note in fit(made, "viscous").notes if note.key == "quarters")
    assert ", 12." in said.sentence()
    assert ", 12," in said.sentence("es")
    for found in (fit(made, "viscous"), fit([made, made], "viscous")):
        i = found.names.index("omega0_squared")
        np.testing.assert_allclose(found.recordings[-1].quarters[:, i], found.values[i], rtol=5e-3)


def test_models_of_a_double_pendulum_are_not_compared() -> None:
    made = recorded(DampedDoublePendulum.bobs(), (0.5, 0.2, 0.0, 0.0), seconds=3.0)
    with pytest.raises(ValueError, match="must be of one pendulum for models to be compared"):
        compare_models(made)


def test_an_axis_that_is_off_the_string_sees_the_swing_along_it_too() -> None:
    made = recorded(DrivenPendulum.bob(0.26, viscous=0.001), (0.25, 0.0), seconds=15.0)
    theta, square = made.values[:, 0], 9.81 / 0.26
    rate = np.gradient(theta, made.t, edge_order=2)
    noise = 0.02 * np.random.default_rng(3).normal(size=len(theta))
    axis = 0.26 * (rate**2 * np.cos(0.07) - square * np.sin(theta) * np.sin(0.07)) + noise
    sensor = replace(made, values=axis[:, np.newaxis], quantity="acceleration", unit="m/s²")
    found = fit(replace(sensor, reading={"linear": True}), "viscous", length=0.26)
    assert found["gravity"].value == pytest.approx(9.81, rel=2e-3)
    assert abs(found["tilt"].value) == pytest.approx(0.07, abs=0.01)
    assert found.rms < 0.05


def test_the_free_swing_of_a_phone_is_found_in_its_acceleration() -> None:
    phone = read(recording("phone_linear_acceleration.csv"))
    assert isinstance(phone, Measurement)
    found = fit(phone, "viscous", length=0.26)
    note = next(note for note in found.notes if note.key == "free_swing")
    assert note.details["begin"] == pytest.approx(8.8, abs=0.3)
    assert note.details["end"] == pytest.approx(42.3, abs=0.3)
    assert note.details["inside"] == pytest.approx(0.021, abs=2e-3)
    assert found["period"].value == pytest.approx(1.021, abs=2e-3)
