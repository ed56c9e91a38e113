"""Fits of systems of the catalogue by their own parameters, and what a fit says of itself."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from pendula import DampedDoublePendulum, DrivenPendulum, LinearPendulum, SimplePendulum
from pendula.measured import Fit, fit, g_from_periods
from pendula.systems.base import System
from simulated import NOISE, recorded


def off(found: Fit, name: str, true: float) -> float:
    """How many standard errors a value is from the true one."""
    value, error, _ = found[name]
    return abs(value - true) / error


BOB = DrivenPendulum.bob(0.8, 9.79, 2.0, viscous=0.1, coulomb=0.05)
BODY = DrivenPendulum.body(0.2, 0.3, 0.02, 9.79, viscous=0.002)
SHAKEN = DrivenPendulum.bob(0.5, viscous=0.1, torque=0.5, drive_frequency=3.0)


@pytest.mark.parametrize(
    ("true", "given", "start", "free", "expected"),
    [
        (
            SimplePendulum(0.8, 9.79),
            SimplePendulum(0.8),
            (1.0, 0.0),
            None,
            {"gravity": 9.79, "theta": 1.0, "omega": 0.0, "angle_offset": 0.0},
        ),
        (
            SimplePendulum(0.8, 9.79),
            SimplePendulum(0.3, 9.79),
            (2.5, 1.0),
            ("length",),
            {"length": 0.8, "theta": 2.5, "omega": 1.0},
        ),
        (
            LinearPendulum(0.8, 9.79, 2.0, viscous=0.1),
            LinearPendulum(0.8, 9.0, 2.0, viscous=0.01),
            (0.1, 0.0),
            ("gravity", "viscous"),
            {"gravity": 9.79, "viscous": 0.1},
        ),
        (
            BOB,
            DrivenPendulum.bob(0.8, 9.0, 2.0, viscous=0.01, coulomb=0.01),
            (1.0, 0.0),
            None,
            {"gravity": 9.79, "viscous": 0.1, "coulomb": 0.05},
        ),
        (
            BODY,
            DrivenPendulum.body(0.2, 0.3, 0.05, 9.79),
            (1.0, 0.0),
            ("inertia", "viscous", "angle_offset"),
            {"inertia": 0.02, "viscous": 0.002},
        ),
        (
            DrivenPendulum.scaled(5.0, 0.0, 0.6),
            DrivenPendulum.scaled(2.0, 0.0, 0.6),
            (1.0, 0.0),
            None,
            {"q": 5.0},
        ),
        (
            SHAKEN,
            DrivenPendulum.bob(0.5, viscous=0.05, torque=0.4, drive_frequency=3.0),
            (0.3, 0.0),
            ("viscous", "torque", "drive_phase"),
            {"viscous": 0.1, "torque": 0.5, "drive_phase": 0.0},
        ),
        (
            DrivenPendulum.bob(0.5, viscous=0.02, pivot_amplitude=0.03, pivot_frequency=10.0),
            DrivenPendulum.bob(0.5, viscous=0.03, pivot_amplitude=0.02, pivot_frequency=10.0),
            (0.5, 0.0),
            ("viscous", "pivot_amplitude"),
            {"viscous": 0.02, "pivot_amplitude": 0.03},
        ),
        (
            DampedDoublePendulum.bobs(1.0, 0.5, 0.3, 0.25, 9.81, viscous=(2e-3, 1e-3)),
            DampedDoublePendulum.bobs(1.0, 0.5, 0.3, 0.25, 9.5, viscous=(1e-3, 2e-3)),
            (1.5, 1.0, 0.0, 0.0),
            None,
            {"gravity": 9.81, "viscous1": 2e-3, "viscous2": 1e-3, "theta2": 1.0},
        ),
    ],
)
def test_a_system_is_fitted_by_its_own_parameters(
    true: System, given: System, start: Any, free: Any, expected: dict[str, float]
) -> None:
    found = fit(recorded(true, start, seconds=10.0 if len(start) == 2 else 2.0), given, free=free)
    for name, value in expected.items():
        assert off(found, name, value) < 3.0, name
    assert found.rms == pytest.approx(NOISE, rel=0.1)
    assert type(found.system) is type(true)
    assert found.system is not None
    assert found.system.form == given.form
    angles = found.trajectory.states[:, : len(start) // 2]
    offsets = found.fitted[0] - angles[0]
    np.testing.assert_allclose(angles + offsets, found.fitted, atol=1e-7)


def test_a_system_is_its_model_by_other_names() -> None:
    made = recorded(BOB, (1.0, 0.0))
    system, model = fit(made, BOB), fit(made, "viscous + coulomb")
    inertia = 2.0 * 0.8**2
    for name, scale in (("viscous", inertia), ("coulomb", inertia), ("theta", 1.0)):
        assert system[name].value == pytest.approx(scale * model[name].value, rel=1e-4)
        assert system[name].standard_error == pytest.approx(
            scale * model[name].standard_error, rel=1e-2
        )
    assert system["omega0_squared"].value == pytest.approx(model["omega0_squared"].value, rel=1e-7)
    assert system["gravity"].unit == "m/s²"
    assert system["viscous"].unit == "N m s"
    assert system.model == "DrivenPendulum.bob"


def test_what_an_angle_tells_only_together_has_no_error_of_its_own() -> None:
    together = {"mass", "viscous", "coulomb"}
    found = fit(recorded(BOB, (1.0, 0.0)), BOB, free=("gravity", *sorted(together)))
    assert set(found.not_told_apart[0]) == together
    errors = zip(found.names, found.standard_errors, found.plain_standard_errors, strict=True)
    assert {name for name, *both in errors if np.isinf(both).all()} == together
    assert "flat" in found.flags
    said = next(note for note in found.notes if note.key == "flat")
    assert "by themselves" in said.sentence()
    assert "por separado" in said.sentence("es")


def test_g_and_length_of_an_angle_are_known_as_their_ratio() -> None:
    made = recorded(SimplePendulum(0.8, 9.79), (1.0, 0.0))
    found = fit(made, SimplePendulum(1.0), free=("gravity", "length"))
    assert found.not_told_apart == (("gravity", "length"),)
    assert np.isinf([found["gravity"].standard_error, found["length"].standard_error]).all()
    assert off(found, "omega0_squared", 9.79 / 0.8) < 3.0
    assert found["omega0_squared"].standard_error < 1e-3


def test_a_start_is_fitted_as_far_as_it_is_not_held() -> None:
    made = recorded(SimplePendulum(0.8, 9.79), (1.0, 0.0))
    assert fit(made, SimplePendulum(0.8), free=("gravity",)).names == ("gravity", "theta", "omega")
    rest = fit(made, SimplePendulum(0.8), free=("gravity", "theta"))
    assert rest.names == ("gravity", "theta")
    assert rest.start[1] == 0.0
    held = fit(made, SimplePendulum(0.8), free=("gravity",), fixed={"theta": 1.0, "omega": 0.0})
    assert held.names == ("gravity",)
    assert off(held, "gravity", 9.79) < 3.0


@pytest.mark.parametrize("t", [None, (2.0, 9.0)])
def test_a_clock_that_is_ahead_of_a_release_from_rest(t: tuple[float, float] | None) -> None:
    true = SimplePendulum(0.8, 9.79)
    made = recorded(true, (1.0, 0.0), ahead=0.37)
    found = fit(made, SimplePendulum(0.8), free=("gravity", "theta", "time_offset"), t=t)
    assert found.rms == pytest.approx(NOISE, rel=0.1)
    half = true.period(1.0) / 2.0  # between the times at which it is at rest
    begin = float(found.t[0]) + found["time_offset"].value
    away = (begin - 0.37) / half
    assert abs(away - round(away)) * half < 3.0 * found["time_offset"].standard_error
    assert abs(found["theta"].value) == pytest.approx(1.0, abs=1e-3)


def test_a_drive_by_another_clock() -> None:
    made = recorded(SHAKEN, (0.3, 0.0), ahead=0.1)
    found = fit(made, SHAKEN, free=("time_offset",))
    assert off(found, "time_offset", 0.1) < 3.0
    np.testing.assert_allclose(found.trajectory.theta, found.fitted[:, 0], atol=1e-7)


def test_derivatives_of_what_is_seen_are_those_of_differences() -> None:
    from pendula.measured.problem import Problem, Sampled
    from pendula.measured.system_model import SystemModel

    system = DrivenPendulum.bob(0.5, viscous=0.1, torque=0.5, drive_frequency=3.0)
    t = np.linspace(0.0, 3.0, 40)
    free = ("theta", "omega", "gravity", "viscous", "time_offset")
    for quantity, more in (
        ("angle", ("scale", "angle_offset")),
        ("rate", ("scale", "rate_offset")),
        ("acceleration", ("sensor_radius", "acceleration_offset")),
    ):
        names = (*free, *more)
        made = Sampled(recorded(system, (0.3, 0.0)), t, np.zeros((40, 1)))
        held = {"gravity_seen": 1.0}
        problem = Problem(SystemModel(system, quantity), (made,), names, (), held)
        x = np.array([0.4, 0.2, 9.7, 0.12, 0.5, 0.9, 0.02])
        for j, step in enumerate(1e-5 * np.eye(len(x))):
            difference = (problem.residuals(x + step) - problem.residuals(x - step)) / 2e-5
            np.testing.assert_allclose(
                problem.jacobian(x)[:, j], difference, atol=3e-6, err_msg=f"{quantity} {names[j]}"
            )


def test_several_recordings_share_the_system_and_have_their_own_starts() -> None:
    true = SimplePendulum(0.8, 9.79)
    several = [recorded(true, (a, 0.0)) for a in (0.5, 1.0, 2.0)]
    found = fit(several, SimplePendulum(0.8), free=("gravity",))
    assert found.names[0] == "gravity"
    assert len(found.names) == 7
    assert off(found, "theta[3]", 2.0) < 3.0
    assert off(found, "gravity", 9.79) < 3.0


def test_bounds_are_kept_and_named() -> None:
    made = recorded(SimplePendulum(0.8, 9.79), (1.0, 0.0))
    found = fit(made, SimplePendulum(0.8), bounds={"gravity": (9.8, 9.9)})
    assert found["gravity"].value == 9.8
    assert found.at_bounds == ("gravity",)
    assert "The fit ended at the bound of g, 9.8." in [note.sentence() for note in found.notes]
    model = fit(made, "viscous", bounds={"omega0_squared": (0.0, 12.0)})
    assert model.at_bounds[0] == "omega0_squared"
    negative = fit(made, "viscous", bounds={"viscous": (-1.0, -0.1)})
    assert negative.unphysical == negative.at_bounds == ("viscous",)


def test_an_undamped_system_of_a_damped_record_is_flagged() -> None:
    made = recorded(DrivenPendulum.bob(0.8, viscous=0.1), (1.0, 0.0))
    assert "damped" in fit(made, SimplePendulum(0.8)).flags
    assert "damped" not in fit(made, DrivenPendulum.bob(0.8, viscous=0.1)).flags


def test_a_wrong_scale_of_time_is_told_by_g() -> None:
    made = recorded(SimplePendulum(0.8, 9.79 * 0.6), (1.0, 0.0))
    assert "gravity_unlikely" in fit(made, SimplePendulum(0.8)).flags


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"free": ("height",)}, "free must be one of theta, omega, length, gravity, mass"),
        ({"length": 0.8}, "length cannot be given beside a system, which has its own"),
        ({"fixed": {"gravity": 9.8}, "free": "gravity"}, "gravity cannot be named in both free"),
        ({"free": "time_offset"}, "time_offset cannot be told beside a start that is fitted"),
        ({"bounds": {"grvity": (9.0, 10.0)}}, "bounds must be one of theta"),
    ],
)
def test_what_cannot_be_fitted_is_refused_in_one_line(given: dict[str, Any], said: str) -> None:
    made = recorded(SimplePendulum(0.8), (1.0, 0.0))
    with pytest.raises(ValueError, match=re.escape(said)) as error:
        fit(made, SimplePendulum(0.8), **given)
    assert "\n" not in str(error.value)


def test_a_fit_of_a_system_has_a_report(tmp_path: Any) -> None:
    found = fit(recorded(BOB, (1.0, 0.0)), BOB)
    folder = found.report(tmp_path / "report", lang="es")
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "rozamiento viscoso" in page
    assert "N m s" in page


def test_g_of_arrays_of_periods() -> None:
    lengths = np.array([0.4, 0.6, 0.8, 1.0])
    wrong = 1.0 + 1e-4 * np.array([1.0, -2.0, 2.0, -1.0])
    periods = 2.0 * np.pi * np.sqrt(lengths / 9.79) * wrong
    found = g_from_periods(lengths, periods)
    assert found["gravity"].value == pytest.approx(9.79, rel=1e-3)
    assert off(found, "gravity", 9.79) < 3.0  # type: ignore[arg-type]
    repeats = np.stack([periods * (1 - 1e-4), periods, periods * (1 + 1e-4)], axis=1)
    assert g_from_periods(lengths, repeats).table.repeats is not None
    amplitudes = np.radians([5.0, 20.0, 40.0, 60.0])
    swung = SimplePendulum(0.8, 9.79).period(amplitudes) * wrong
    by_amplitude = g_from_periods(amplitudes=amplitudes, periods=swung, length=0.8)
    assert off(by_amplitude, "gravity", 9.79) < 3.0  # type: ignore[arg-type]
    assert not by_amplitude.rejects_the_law
    with pytest.raises(ValueError, match="lengths must hold one value for each of the 3 periods"):
        g_from_periods(lengths, periods[:3])
    with pytest.raises(ValueError, match="periods is needed"):
        g_from_periods(lengths)
