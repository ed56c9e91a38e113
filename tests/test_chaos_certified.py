"""Certified exponents against stored values, and what results say of how they were made."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from indicated import CALM, RODS, WILD, double_of, each_case, of
from pendula import (
    solve,
)
from pendula.chaos import gali, lyapunov, megno, sali, tangent_map


def test_a_certified_exponent_ends_with_the_trust_in_the_states() -> None:
    found = lyapunov(RODS, WILD, 60.0, certify=1e-6)
    assert 10.0 < found.trust_horizon < 60.0
    right = solve(RODS, WILD, [60.0], certify=1e-6).trust_horizon
    assert found.trust_horizon == right
    short = lyapunov(RODS, WILD, float(found.trust_horizon))
    assert found.finite_time[0] == pytest.approx(short.exponents[0], abs=1e-5)


@each_case
def test_certified_exponents_are_off_by_no_more_than_they_say(case: dict[str, Any]) -> None:
    system = double_of(case["system"])
    for t, want in list(zip(*of(case, "finite_time_lyapunov", 20.0), strict=True))[1::2]:
        found = lyapunov(system, case["state"], t, certify=1e-3)
        if found.trust_horizon < t:
            continue
        (error,) = found.finite_time_error
        assert abs(found.finite_time[0] - want) <= error
        assert found.digits[0] >= (12 if t <= 2.0 else 7 if t <= 10.0 else 2)
        printed = float(f"{found.finite_time[0]:.{found.digits[0]}f}")
        assert abs(printed - want) <= 10.0 ** -float(found.digits[0])


@each_case
def test_a_certified_spectrum_is_off_by_no_more_than_it_says(case: dict[str, Any]) -> None:
    system = double_of(case["system"])
    for row in case["values"][2:4]:  # at 5 and 10 s
        found = lyapunov(
            system, case["state"], row["t"], exponents=4, tangent=np.eye(4), certify=1e-3
        )
        want = [float(each) for each in row["exponents_of_unit_frame"]]
        assert (np.abs(found.finite_time - want) <= found.finite_time_error).all()
        assert found.finite_time_error.max() <= 1e-7


def test_an_exponent_is_certified_from_the_end_of_the_transient_on() -> None:
    found = lyapunov(RODS, WILD, 40.0, transient=5.0, certify=1e-6)
    whole = megno(RODS, WILD, [5.0, found.trust_horizon])
    grown = (whole.growth[1] - whole.growth[0]) / (found.trust_horizon - 5.0)
    assert found.finite_time[0] == pytest.approx(grown, abs=1e-5)
    late = lyapunov(RODS, np.array([WILD, CALM]), 10.0, transient=40.0, certify=1e-6)
    assert np.isnan(late.finite_time[0, 0])
    assert np.isfinite(late.finite_time[1, 0])
    assert late.digits.tolist() == [[0], [late.digits[1, 0]]]


@pytest.mark.parametrize(
    ("made", "arguments"),
    [
        (
            lambda: lyapunov(RODS, WILD, 40.0, exponents=2, transient=5.0, tolerance=1e-10),
            {"t_max": 40.0, "exponents": 2, "transient": 5.0, "certify": None, "tolerance": 1e-10},
        ),
        (
            lambda: megno(RODS, WILD, [1.0], tangent=(1.0, 0.0, 0.0, 0.0), t0=0.5),
            {"t0": 0.5, "tangents": [1.0, 0.0, 0.0, 0.0]},
        ),
        (lambda: sali(RODS, WILD, [1.0]), {"t0": 0.0, "tangents": None}),
        (lambda: gali(RODS, WILD, [1.0], 3, max_steps=500), {"k": 3, "max_steps": 500}),
        (lambda: tangent_map(RODS, WILD, [1.0], tolerance=1e-10), {"tolerance": 1e-10}),
    ],
)
def test_a_result_says_what_it_was_made_with(made: Any, arguments: dict[str, Any]) -> None:
    found = made()
    assert arguments.items() <= found.recipe.items()
    stored = json.loads(found.to_xarray().attrs["pendula"])
    assert stored["recipe"] == found.recipe
    assert stored["system"] == RODS.description()
    assert found.n_steps > 0
    assert "DoublePendulum" in repr(found)
