"""What is wrong with the arguments of a fit is said in one line that names them."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

import pendula
from pendula.measured import fit
from simulated import clean


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
