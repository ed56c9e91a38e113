"""Fits of single pendulums: against scipy, reference fits of real recordings, simulated truth."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import curve_fit

from pendula.measured import Fit, Measurement, fit
from recordings import recording
from simulated import clean, of_angle, swing

if TYPE_CHECKING:
    from pendula._types import Array

THREE = "viscous + coulomb + quadratic"


def long_swing(step: int = 10) -> Measurement:
    """The machined pendulum's free swing of 55 s; its angles are from the upright."""
    path = recording("single_pendulum_freeswing_1kHz.csv")
    rows = np.loadtxt(path, delimiter=",", skiprows=1)[::step]
    return of_angle(rows[:, 0].copy(), rows[:, 1] - np.pi)


def small_swing() -> Measurement:
    rows = np.loadtxt(recording("single_small_swing_encoder.csv"), delimiter=",", skiprows=1)[::5]
    return of_angle(rows[:, 0].copy(), rows[:, 1] - np.pi)


def video_runs() -> list[Measurement]:
    """Three runs from video at 30 frames a second, whose printed times are rounded."""
    path = recording("single_three_runs_semicolon_degrees.csv")
    rows = np.genfromtxt(path, delimiter=";", skip_header=1)
    angles = [np.radians(column[np.isfinite(column)])[20:] for column in rows[:, 1::3].T]
    return [of_angle(np.arange(20, 20 + len(each)) / 30.0, each) for each in angles]


def test_values_and_plain_errors_are_those_of_scipy() -> None:
    made = clean(seconds=6.0, viscous=0.1, noise=2e-3)

    def model(t: Array, theta: float, omega: float, square: float, b: float, o: float) -> Array:
        run = solve_ivp(
            lambda _, y: (y[1], -square * np.sin(y[0]) - b * y[1]),
            (0.0, t[-1]),
            (theta, omega),
            t_eval=t,
            rtol=1e-9,
            atol=1e-10,
        )
        return np.asarray(run.y[0] + o)

    theirs, covariance = curve_fit(model, made.t, made.values[:, 0], (0.41, 0.3, 12.1, 0.1, 0.0))
    ours = fit(made, "viscous")
    order = [ours.names.index(n) for n in ("theta", "omega", "omega0_squared", "viscous")]
    np.testing.assert_allclose(ours.values[order], theirs[:4], rtol=2e-5)
    np.testing.assert_allclose(
        ours.plain_standard_errors[order], np.sqrt(np.diagonal(covariance))[:4], rtol=1e-2
    )


@pytest.mark.parametrize(
    ("model", "signs", "rms", "values"),
    [
        ("viscous", "physical", 0.02789, {"omega0_squared": 64.074, "viscous": 0.05489}),
        ("coulomb", "physical", 0.1194, {"omega0_squared": 64.120, "coulomb": 0.3154}),
        ("quadratic", "physical", 0.1278, {"omega0_squared": 65.13, "quadratic": 0.00693}),
        ("viscous + coulomb", "physical", 0.01942, {"viscous": 0.04759, "coulomb": 0.0461}),
        (THREE, "free", 0.00276, {"omega0_squared": 64.0763, "viscous": -0.0276}),
        (THREE, "physical", 0.00765, {"viscous": 0.0, "coulomb": 0.164, "quadratic": 0.00405}),
        ("coulomb + quadratic", "physical", 0.00765, {"omega0_squared": 64.033}),
        ("viscous + coulomb + cubic", "physical", 0.00369, {"viscous": 0.0078, "cubic": 3.45e-4}),
    ],
)
def test_long_swing_has_its_reference_fits(
    model: str, signs: str, rms: float, values: dict[str, float]
) -> None:
    found = fit(long_swing(), model, signs=signs)
    assert found.rms == pytest.approx(rms, rel=2e-3)
    for name, value in values.items():
        assert found[name].value == pytest.approx(value, rel=6e-3, abs=1e-9), name
    assert found.unphysical == (("viscous",) if signs == "free" else ())
    assert (found.system is None) == (signs == "free")


def test_errors_of_the_long_swing_are_those_of_blocks() -> None:
    found = fit(long_swing(), THREE, signs="free")
    i = found.names.index("omega0_squared")
    assert found.plain_standard_errors[i] == pytest.approx(0.0006, rel=0.05)
    assert 0.004 < found.standard_errors[i] < 0.009  # block bootstrap 0.005, HAC 0.006
    assert 180 < found.n_effective < 250
    assert "structured" in found.flags


def test_video_runs_have_their_reference_fits() -> None:
    reference = [
        (17.3418, 0.00501, 1.89e-3),
        (17.3324, 0.0051, 5.28e-3),
        (17.3337, 0.0054, 2.25e-3),
    ]
    for run, (square, viscous, rms) in zip(video_runs(), reference, strict=True):
        found = fit(run, "viscous")
        assert found["omega0_squared"].value == pytest.approx(square, abs=1e-4)
        assert found["viscous"].value == pytest.approx(viscous, abs=6e-5)
        assert found.rms == pytest.approx(rms, rel=3e-3)
        assert "alike" in fit(run, THREE).flags


def test_small_swing_is_not_left_in_a_poor_minimum() -> None:
    for model, rms in (("viscous", 2.405), ("coulomb", 0.618), ("viscous + coulomb", 0.582)):
        assert fit(small_swing(), model).rms == pytest.approx(1e-3 * rms, rel=1e-3)


def test_a_larger_model_never_fits_worse() -> None:
    for made in (small_swing(), video_runs()[0]):
        rms = {m: fit(made, m).rms for m in ("coulomb", "viscous", "viscous + coulomb", THREE)}
        four = fit(made, THREE + " + cubic").rms
        smaller = min(rms["coulomb"], rms["viscous"])
        assert four <= rms[THREE] * (1 + 1e-7)
        assert rms[THREE] <= rms["viscous + coulomb"] * (1 + 1e-7)
        assert rms["viscous + coulomb"] <= smaller * (1 + 1e-7)


def test_an_undamped_fit_of_a_damped_record_is_flagged() -> None:
    assert "damped" in fit(long_swing(), "undamped").flags
    assert "damped" in fit(clean(viscous=0.1), "undamped").flags
    undamped = fit(clean(), "undamped")
    assert "damped" not in undamped.flags
    assert undamped["omega0_squared"].value == pytest.approx(12.0, abs=2e-3)


@pytest.mark.parametrize("correlation", [0.0, 0.9, 0.98])
def test_true_values_lie_within_two_standard_errors(correlation: float) -> None:
    inside: list[bool] = []
    for seed in range(60):
        frictions = (("viscous",), ("coulomb",), ("quadratic",))[seed % 3]
        made, true = swing(seed, correlation, frictions)
        found = fit(made, frictions)
        apart = [abs(found[n].value - true[n]) / found[n].standard_error for n in found.names]
        inside += [each <= 2.0 for each in apart]
    assert 0.92 <= np.mean(inside) <= 0.985


def test_plain_errors_are_too_small_where_noise_is_correlated() -> None:
    apart = []
    for seed in range(40):
        made, true = swing(seed, 0.98, ("viscous",))
        found = fit(made, "viscous")
        i = found.names.index("angle_offset")
        apart.append(abs(found.values[i] - true["angle_offset"]) / found.plain_standard_errors[i])
    assert np.mean(np.array(apart) <= 2.0) < 0.5


def test_g_is_told_with_the_length_and_its_uncertainty() -> None:
    made = clean(square=9.81 / 0.8)
    found = fit(made, "viscous", length=(0.8, 0.004))
    assert found["gravity"].value == pytest.approx(9.81, abs=3 * found["gravity"].standard_error)
    assert found["gravity"].standard_error == pytest.approx(9.81 * 0.005, rel=0.02)
    assert ("gravity", "length") not in found.not_told_apart
    assert ("gravity", "length") in fit(made, "viscous").not_told_apart
    assert fit(made, "viscous", gravity=9.81)["length"].value == pytest.approx(0.8, abs=1e-3)
    of_file = replace(made, geometry={"length": 0.8})
    assert fit(of_file, "viscous")["gravity"].value == pytest.approx(9.81, abs=0.01)


def test_a_pendulum_that_first_turns_over_is_fitted() -> None:
    found = fit(clean(start=(0.0, 12.0), viscous=0.1, noise=5e-3), "viscous")
    assert np.ptp(found.recordings[0].measured) > 2 * np.pi
    assert found["omega0_squared"].value == pytest.approx(12.0, abs=0.01)
    assert found["viscous"].value == pytest.approx(0.1, abs=1e-3)
    assert found["angle_offset"].value == pytest.approx(0.0, abs=2e-3)


def test_liquids_stop_a_swing_soon() -> None:
    for viscous, most in ((1.5, 0.02), (9.0, 0.05)):
        found = fit(clean(seconds=6.0, start=(0.9, 0.0), viscous=viscous), "viscous")
        assert found["omega0_squared"].value == pytest.approx(12.0, rel=most)
        assert found["viscous"].value == pytest.approx(viscous, rel=most)


def test_a_record_that_is_no_free_swing_is_told() -> None:
    made = clean(start=(0.4, 0.0), viscous=0.05)
    held = np.concatenate([np.full(150, 0.4), made.values[:850, 0]])
    found = fit(replace(made, values=held[:, np.newaxis]), "viscous")
    assert "poor" in found.flags
    part = fit(replace(made, values=held[:, np.newaxis]), "viscous", t=(3.0, 20.0))
    assert part["omega0_squared"].value == pytest.approx(12.0, abs=2e-3)


def test_a_wrong_frame_rate_is_told() -> None:
    made = clean(square=9.81 / 0.8)
    slow = replace(made, t=made.t * 1.2579)  # g fits as 6.2 m/s²
    found = fit(slow, "viscous", length=0.8)
    assert "gravity_unlikely" in found.flags
    note = next(each for each in found.notes if each.key == "gravity_unlikely")
    assert "g fits as 6.2 m/s²: check frame rate or scale" in note.sentence()
    assert "g resulta 6,2 m/s²" in note.sentence("es")
    assert "gravity_unlikely" not in fit(made, "viscous", length=0.8).flags


def test_rate_and_acceleration_tell_the_same_pendulum() -> None:
    made = clean(square=9.81 / 0.8, viscous=0.03, noise=0.0)
    run = fit(made, "viscous").trajectory
    theta, omega = run.theta, run.omega
    noise = 0.01 * np.random.default_rng(2).normal(size=len(theta))
    seen = {
        "rate": omega + 0.05,
        "acceleration": 0.8 * (omega**2 + 9.81 / 0.8 * np.cos(theta)),
    }
    for quantity, values in seen.items():
        other = replace(made, quantity=quantity, values=(values + noise)[:, np.newaxis])
        found = fit(other, "viscous")
        for name, value in (("omega0_squared", 9.81 / 0.8), ("viscous", 0.03), ("theta", 0.4)):
            apart = abs(found[name].value - value)
            assert apart < 3.5 * found[name].standard_error, (quantity, name)
            assert found[name].standard_error < 2e-3
    linear = replace(
        made,
        quantity="acceleration",
        values=(0.8 * omega**2 + noise)[:, np.newaxis],
        reading={"linear": True},
    )
    assert fit(linear, "viscous", length=0.8)["gravity"].value == pytest.approx(9.81, abs=0.005)
    with pytest.raises(ValueError, match="length is needed for an acceleration without gravity"):
        fit(linear, "viscous")


def test_several_recordings_share_the_pendulum_and_not_the_start() -> None:
    runs = video_runs()
    found = fit(runs, "viscous")
    assert found.names[:3] == ("omega0_squared", "viscous", "theta[1]")
    assert "theta[3]" in found.names
    assert len(found.recordings) == 3
    apart = fit(runs, "viscous", shared=())
    alone = [fit(each, "viscous") for each in runs]
    for i, each in enumerate(alone):
        name = f"omega0_squared[{i + 1}]"
        assert apart[name].value == pytest.approx(each["omega0_squared"].value, abs=1e-6)
    assert apart.rms < found.rms


def test_fixed_values_and_windows_are_kept() -> None:
    made = clean(viscous=0.05, coulomb=0.02)
    found = fit(made, "viscous + coulomb", fixed={"coulomb": 0.02, "angle_offset": 0.0})
    assert found.names == ("omega0_squared", "viscous", "theta", "omega")
    assert found["viscous"].value == pytest.approx(0.05, abs=3 * found["viscous"].standard_error)
    part = fit(made, "viscous", t=(5.0, 12.0))
    assert part.t[0] == 5.0
    assert part.t[-1] == 12.0


def test_outliers_count_less_where_asked() -> None:
    made = clean(viscous=0.05)
    bad = made.values.copy()
    bad[::50] += 0.3
    spoilt = replace(made, values=bad)
    robust, plain = (fit(spoilt, "viscous", robust=each) for each in (True, False))
    assert abs(robust["angle_offset"].value) < 1e-3
    assert abs(plain["angle_offset"].value) > 3e-3


def test_profile_and_bootstrap_agree_with_white_noise() -> None:
    made = clean(viscous=0.05, noise=3e-3)
    plain = fit(made, "viscous").plain_standard_errors
    for kind, most in (("profile", 0.15), ("bootstrap", 0.35)):
        found = fit(made, "viscous", uncertainty=kind)
        np.testing.assert_allclose(found.standard_errors, plain, rtol=most)
        assert kind in found.error_kinds


def test_the_fitted_motion_is_the_trajectory() -> None:
    found = fit(clean(viscous=0.05), "viscous")
    offset = found["angle_offset"].value
    np.testing.assert_allclose(found.trajectory.theta + offset, found.fitted[:, 0], atol=1e-8)
    np.testing.assert_allclose(found.residuals, found.recordings[0].measured - found.fitted)
    unphysical = fit(long_swing(50), THREE, signs="free")
    with pytest.raises(ValueError, match='fit with signs="physical"'):
        _ = unphysical.trajectory


def test_notes_are_worded_in_both_languages() -> None:
    found: Fit = fit(long_swing(50), THREE, signs="free")
    assert {"unphysical", "only_ratio"} <= set(found.flags)
    for note in found.notes:
        english, spanish = note.sentence("en"), note.sentence("es")
        assert english != spanish
        assert "{" not in english + spanish
