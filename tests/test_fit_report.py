"""The report of a recording: experiment, formula and method, and what a student hands in."""

import csv
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipj, ellipk

from pendula import DampedDoublePendulum, DrivenPendulum, solve
from pendula.measured import (
    Apparatus,
    Fit,
    Horizon,
    Measurement,
    PeriodTable,
    compare_models,
    fit,
    fit_periods,
)
from pendula.measured.rounding import with_uncertainty
from pendula.plot.labels import labels
from pendula.plot.measured import autocorrelation
from pendula.study import run_study
from pendula.study.measured.facts import measured_facts
from pendula.study.measured.results import measured_results
from pendula.study.notation import Numbers
from pendula.study.report import catalogue
from report_page import page
from swung import NOISE, OMEGA2, START, motion, recording

FIGURES = ("fit", "autocorrelation", "damping", "portrait", "period", "methods")


@pytest.fixture(scope="module")
def fitted() -> Fit:
    return fit(recording(), "viscous", length=(0.49, 0.001))


def periods() -> PeriodTable:
    length = np.array([0.2, 0.4, 0.6, 0.8, 1.0])
    exact = math.tau * np.sqrt(length / 9.8)
    return PeriodTable(exact + 0.01 * np.array([1, -1, 2, 0, -1]), length=length, source="w/p.csv")


def test_methods_are_judged_by_the_experiment_and_by_the_model(fitted: Fit) -> None:
    compared = measured_results(fitted).compared
    assert compared is not None
    # ten periods of small swings, a hundredth of one a step, rounded down
    assert compared.t[-1] == pytest.approx(10.0 * math.tau / math.sqrt(OMEGA2), abs=0.02)
    assert compared.step == 0.01
    errors = {name: compared.errors(name) for name in compared.runs}
    assert list(errors) == ["undamped", "damped-linear", "model", "euler", "heun", "rk4"]
    assert errors["model"].rms == pytest.approx(NOISE, rel=0.1)
    own = [errors[name].of_the_method for name in ("euler", "heun", "rk4")]
    assert own[0] > 1.0
    assert 1e-3 < own[1] < 0.1
    assert 0.0 < own[2] < 1e-4
    assert errors["euler"].largest > 1.0
    assert errors["rk4"].largest == pytest.approx(errors["model"].largest, rel=0.05)


def test_errors_are_those_of_the_curves(fitted: Fit) -> None:
    compared = measured_results(fitted).compared
    assert compared is not None
    theta = compared.t * math.sqrt(OMEGA2)
    k = math.sin(START / 2.0)
    sn = ellipj(ellipk(k**2) + theta, k**2)[0]  # at rest at START: sin(θ/2) = k sn(K + ω0 t)
    undamped = 2.0 * np.arcsin(k * sn)
    expected = np.abs(undamped - motion(compared.t)[0]).max()
    assert compared.errors("undamped").largest == pytest.approx(expected, rel=0.02)


def test_a_failed_fit_with_a_far_too_fast_pendulum_is_not_compared(fitted: Fit) -> None:
    fast = DrivenPendulum.body(1.0, 1.0, 1.0, 1e12)
    t = fitted.t[:40]
    one = replace(
        fitted.recordings[0],
        system=fast,
        t=t,
        start=np.array([1e-3, 0.0]),
        measured=fitted.recordings[0].measured[:40],
        fitted=fitted.recordings[0].fitted[:40],
    )
    assert measured_results(replace(fitted, recordings=(one,))).compared is None


def test_a_rate_is_compared_as_a_rate() -> None:
    compared = measured_results(fit(recording("rate"), "viscous")).compared
    assert compared is not None
    assert not compared.is_angle
    assert compared.errors("model").rms == pytest.approx(NOISE, rel=0.1)


def test_autocorrelation_is_that_of_the_noise() -> None:
    rng = np.random.default_rng(3)
    noise = np.zeros(200_000)
    for i, each in enumerate(rng.standard_normal(len(noise) - 1)):
        noise[i + 1] = 0.9 * noise[i] + each
    noise[500] = np.nan
    assert autocorrelation(noise, 6) == pytest.approx(0.9 ** np.arange(6), abs=0.02)


def test_facts_are_rounded_to_their_uncertainty(fitted: Fit) -> None:
    words, catalog = labels("es"), catalogue("es")
    told = measured_facts(measured_results(fitted), words, catalog, Numbers(words))
    rows = dict(told["values"])
    found = fitted["gravity"]
    assert rows["gravedad g"] == with_uncertainty(*found, language="es")
    assert rows["gravedad g"].endswith("m/s²")
    assert "," in rows["gravedad g"]
    assert "." not in rows["gravedad g"]
    assert told["model"] == "rozamiento viscoso"
    theta = motion(fitted.t)[0]
    upward = np.count_nonzero((theta[:-1] < 0) & (theta[1:] >= 0))
    assert told["swings"]["count"] == upward - 1
    assert len(told["methods"]["rows"]) == 6


@pytest.mark.parametrize(
    ("language", "expected"),
    [
        ("en", ("The measured pendulum", "Experiment, formula and numerical methods")),
        ("es", ("El péndulo medido", "Experimento, fórmula y métodos numéricos")),
    ],
)
def test_report_is_a_page_a_sheet_figures_and_numbers(
    fitted: Fit, tmp_path: Path, language: str, expected: tuple[str, str]
) -> None:
    folder = fitted.report(tmp_path / "report", language, author="Ana Gil")
    shown = page(folder).words
    for text in (*expected, "Ana Gil", "swing.csv"):
        assert text in shown
    value = with_uncertainty(*fitted["gravity"], language=language)
    assert value in shown
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")
    assert {each.stem for each in (folder / "figures").iterdir()} == {
        f"measured-{name}" for name in FIGURES
    }
    with (folder / "data" / "measured_fit.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == len(fitted.t)
    assert float(rows[7]["theta measured [rad]"]) == fitted.measurement.values[7, 0]


def test_report_of_several_models_has_their_verdict(tmp_path: Path) -> None:
    found = compare_models(recording(), ["undamped", "viscous", "coulomb"])
    folder = found.report(tmp_path / "report", "es")
    shown = page(folder).words
    assert found.verdict("es") in shown
    assert "sin amortiguamiento" in shown
    assert (folder / "figures" / "measured-models.svg").exists()


def test_the_same_report_has_the_same_bytes(fitted: Fit, tmp_path: Path) -> None:
    first, second = (fitted.report(tmp_path / name) for name in "ab")
    for path in ("report.html", "report.pdf", "figures/measured-fit.svg"):
        assert (first / path).read_bytes() == (second / path).read_bytes()


def test_report_is_not_overwritten_unasked(fitted: Fit, tmp_path: Path) -> None:
    (tmp_path / "report").mkdir()
    with pytest.raises(FileExistsError, match="report exists; choose another name"):
        fitted.report(tmp_path / "report")


def two_bobs(fitted: Fit) -> Fit:
    """A fit of a double pendulum, made by hand of the motion itself and noise."""
    system = DampedDoublePendulum.bobs(viscous=(0.01, 0.01))
    t, start = np.arange(0.0, 3.0, 0.01), np.array([0.8, 0.5, 0.0, 0.0])
    exact = solve(system, start, t).theta
    measured = exact + NOISE * np.random.default_rng(2).standard_normal(exact.shape)
    one = fitted.recordings[0]
    measurement = Measurement(t, measured, "angle", ("theta1", "theta2"), "rad", bodies=2)
    double = replace(
        one,
        measurement=measurement,
        t=t,
        measured=measured,
        fitted=exact,
        residuals=measured - exact,
        start=start,
        system=system,
    )
    horizon = Horizon(0.01, 0.64, True, 12.0)
    return replace(fitted, recordings=(double,), horizon=horizon)


@pytest.mark.parametrize(
    ("language", "said"),
    [
        ("en", "for 0.640 s; the computation itself is right for 12.0 s"),
        ("es", "durante 0,640 s; el cálculo mismo es correcto durante 12,0 s"),
    ],
)
def test_report_of_a_double_pendulum_says_how_long_it_is_followed(
    fitted: Fit, tmp_path: Path, language: str, said: str
) -> None:
    folder = two_bobs(fitted).report(tmp_path / "report", language)
    assert said in page(folder).words
    assert {each.stem for each in (folder / "figures").iterdir()} == {
        "measured-fit",
        "measured-autocorrelation",
        "measured-methods",
    }


def test_methods_are_judged_on_both_angles_of_a_double_pendulum(fitted: Fit) -> None:
    compared = measured_results(two_bobs(fitted)).compared
    assert compared is not None
    errors = {name: compared.errors(name) for name in compared.runs}
    assert list(errors) == ["model", "euler", "heun", "rk4"]
    # the scale of a column is found from it, to the few digits that noise leaves
    assert errors["model"].rms == pytest.approx(NOISE, rel=0.1)
    both = np.abs(compared.values("euler") - compared.values("model"))
    assert errors["euler"].of_the_method == both.max()
    assert errors["rk4"].of_the_method < 1e-3 < errors["heun"].of_the_method


@pytest.mark.parametrize(("language", "law"), [("en", "Birge's ratio"), ("es", "razón de Birge")])
def test_report_of_periods_has_its_corrections(tmp_path: Path, language: str, law: str) -> None:
    found = fit_periods(periods(), apparatus=Apparatus(amplitude=0.2), timing_error=0.01)
    folder = found.report(tmp_path / "report", language)
    shown = page(folder).words
    assert with_uncertainty(*found["gravity"], language=language) in shown
    assert law in shown
    change = f"{100 * found.corrections[0].change:.2f}".replace(".", labels(language).decimal)
    assert change in shown
    assert (folder / "data" / "measured_periods.csv").exists()


def test_report_of_amplitudes_says_that_the_law_is_contradicted(tmp_path: Path) -> None:
    amplitude = np.radians([10.0, 20.0, 30.0, 40.0, 50.0])
    table = PeriodTable(1.5 * (1.0 + 0.03 * amplitude**2), amplitude=amplitude)
    folder = fit_periods(table, timing_error=0.001).report(tmp_path / "report")
    assert "The table contradicts the law" in page(folder).words


def test_study_gives_a_recording_a_chapter(fitted: Fit, tmp_path: Path) -> None:
    recipe = {"report": {"sections": ["linear", "errata"]}}
    folder = run_study(recipe, tmp_path / "study", measured=fitted, figures="png")
    words = page(folder).words
    chapters = [
        words.index(text)
        for text in ("Linear against non-linear", "The measured pendulum", "Errata of the paper")
    ]
    assert "--measured FILE" in words
    assert chapters[0] < chapters[1]
    assert (folder / "figures" / "measured-methods.png").exists()
    assert (folder / "data" / "measured_swings.csv").exists()


def test_study_without_a_recording_does_not_speak_of_one(tmp_path: Path) -> None:
    recipe = {"report": {"sections": ["errata"]}}
    folder = run_study(recipe, tmp_path / "study")
    assert "--measured" not in page(folder).words
