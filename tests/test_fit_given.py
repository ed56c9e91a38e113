"""What is wrong with the arguments of a fit is said in one line that names them."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

import pendula
from pendula.measured import fit
from simulated import NOISE, clean, recorded


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"system": "sticky"}, "system must be one of undamped"),
        ({"system": "linear + coulomb"}, 'system must be "linear" or "linear + viscous"'),
        ({"fixed": {"mass": 1.0}}, "fixed must be one of theta"),
        ({"fixed": 3}, "fixed must be values by the names of parameters, got 3"),
        ({"length": -1.0}, "length must be positive [m], got -1.0"),
        ({"length": (1.0, 2.0, 3.0)}, "length must be a value or"),
        ({"signs": "any"}, "signs must be one of physical, free"),
        ({"t": (5.0, 5.0)}, "t must be two rising times"),
        ({"t": (100.0, 200.0)}, "t must hold at least 8 samples"),
        ({"uncertainty": "guess"}, "uncertainty must be one of corrected"),
        ({"system": pendula.DoublePendulum.bobs()}, "system must be one pendulum as the recording"),
        ({"free": "mass"}, "free must be one of theta"),
        ({"bounds": 3}, "bounds must be (low, high) by the names of parameters, got 3"),
        ({"bounds": {"viscous": (1.0, 0.0)}}, "bounds of viscous must rise, got (1.0, 0.0)"),
        ({"bounds": {"viscous": 1.0}}, "bounds must be (low, high) by the names"),
    ],
)
def test_bad_arguments_are_named(given: dict[str, object], said: str) -> None:
    with pytest.raises(ValueError, match=re.escape(said)) as error:
        fit(clean(), **given)  # type: ignore[arg-type]
    assert "\n" not in str(error.value)


def test_what_is_no_recording_is_refused() -> None:
    with pytest.raises(ValueError, match=r"measurement must be a Measurement or several"):
        fit([1.0, 2.0])  # type: ignore[list-item]
    made = clean()
    with pytest.raises(ValueError, match="must have rising times"):
        fit(replace(made, t=made.t[::-1].copy()))
    rate = replace(made, quantity="rate")
    with pytest.raises(ValueError, match="must be of one kind, got angle of 1 and rate of 1"):
        fit([made, rate])
    with pytest.raises(ValueError, match="must hold a motion: one of its columns is 0.3 all the"):
        fit(replace(made, values=made.values * 0.0 + 0.3))


DRIVE = ("torque", "drive_frequency", "drive_phase")


@pytest.mark.parametrize(("seed", "start"), [(0, (0.0, 0.0)), (1, (0.6, 0.0)), (2, (-0.3, 1.0))])
def test_a_drive_is_found_without_start_values(seed: int, start: tuple[float, float]) -> None:
    random = np.random.default_rng(seed)
    square, frequency, phase = random.uniform((10.0, 2.0, -3.0), (40.0, 8.0, 3.0))
    true = {"torque": 3.0, "drive_frequency": frequency, "drive_phase": phase}
    system = pendula.DrivenPendulum.body(1.0, 1.0, 1.0, square, viscous=0.2, **true)
    made = recorded(system, start, seconds=20.0)
    found = fit(made, "viscous", free=DRIVE)
    assert found.rms < 1.1 * NOISE
    for name, value in {**true, "omega0_squared": square, "viscous": 0.2}.items():
        assert abs(found[name].value - value) < 4.0 * found[name].standard_error, name
    unlike = pendula.DrivenPendulum.body(
        1.0, 1.0, 1.0, 9.0, viscous=1.0, torque=0.5, drive_frequency=1.0
    )
    again = fit(made, unlike, free=("gravity", "viscous", "angle_offset", *DRIVE))
    assert again.rms == pytest.approx(found.rms, rel=1e-6)
    assert again["torque"].value == pytest.approx(found["torque"].value, rel=1e-4)
