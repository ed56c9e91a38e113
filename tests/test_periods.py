"""g from a table of periods: its uncertainty holds what it says, and the law can be rejected."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import curve_fit

from pendula.measured.measurement import PeriodTable
from pendula.measured.period_corrections import Apparatus, amplitude_excess
from pendula.measured.periods import PeriodFit, fit_periods
from recordings import recording

G = 9.8


def stopwatch() -> PeriodTable:
    rows = np.genfromtxt(recording("periods_stopwatch.csv"), delimiter=",", skip_header=2)
    periods = rows[:, 1:] / 10.0  # times of ten swings
    return PeriodTable(periods.mean(axis=1), length=rows[:, 0], repeats=periods)


def timed(rows: int, repeats: int, error: float, rng: np.random.Generator) -> PeriodTable:
    """Periods of as many lengths, each timed as often."""
    length = np.linspace(0.2, 1.0, rows)
    exact = math.tau * np.sqrt(length / G)
    periods = exact[:, None] + error * rng.standard_normal((rows, repeats))
    return PeriodTable(
        periods.mean(axis=1), length=length, repeats=periods if repeats > 1 else None
    )


def swung(coefficient: float, error: float, rng: np.random.Generator) -> PeriodTable:
    """Periods of 1.5 s at amplitudes up to 60°, of a law with that coefficient."""
    amplitude = np.radians(np.linspace(5.0, 60.0, 12))
    exact = 1.5 * (1.0 + 16.0 * coefficient * amplitude_excess(amplitude))
    return PeriodTable(exact + error * rng.standard_normal(12), amplitude=amplitude)


def within_two_errors(fit: PeriodFit, name: str, truth: float) -> bool:
    found = fit[name]
    return abs(found.value - truth) <= 2.0 * found.standard_error


def test_stopwatch_table_gives_g() -> None:
    fit = fit_periods(stopwatch())
    table = fit.table
    assert table.length is not None
    # the same law by another least squares; the repeats' scatter grows with the period
    slope, _ = curve_fit(
        lambda length, g: math.tau * np.sqrt(length / g),
        table.length,
        table.period,
        p0=[9.0],
        sigma=np.sqrt(table.length),
    )
    assert fit["gravity"].value == pytest.approx(slope[0], abs=0.03)
    assert 0.2 < fit["gravity"].standard_error < 0.35
    assert within_two_errors(fit, "gravity", 9.81)
    assert fit.birge_ratio == pytest.approx(1.09, abs=0.01)


def test_stopwatch_table_has_no_offset() -> None:
    fit = fit_periods(stopwatch(), corrections=["offset"])
    assert fit.names == ("gravity", "length_offset")
    assert within_two_errors(fit, "length_offset", 0.0)


@pytest.mark.parametrize(
    ("rows", "repeats", "corrections"),
    [(3, 1, ()), (5, 1, ("offset",)), (4, 2, ()), (10, 5, ())],
)
def test_two_errors_hold_the_truth_as_often_as_they_say(
    rows: int, repeats: int, corrections: tuple[str, ...]
) -> None:
    rng = np.random.default_rng(rows)
    tables = [timed(rows, repeats, 0.01, rng) for _ in range(400)]
    held = [
        within_two_errors(fit_periods(each, corrections=corrections), "gravity", G)
        for each in tables
    ]
    assert 0.92 <= np.mean(held) <= 0.98  # 95 %, give or take 1 %: without Student's factor 82 %


def test_an_offset_of_the_lengths_is_found() -> None:
    table = timed(8, 5, 1e-4, np.random.default_rng(2))
    assert table.length is not None
    short = PeriodTable(table.period, length=table.length - 0.02, repeats=table.repeats)
    assert not within_two_errors(fit_periods(short), "gravity", G)
    fit = fit_periods(short, corrections=["offset"])
    assert within_two_errors(fit, "gravity", G)
    assert within_two_errors(fit, "length_offset", 0.02)
    (offset,) = fit.corrections
    assert offset.change == pytest.approx(
        fit["gravity"].value / fit_periods(short)["gravity"].value - 1.0
    )


def test_rows_that_scatter_more_than_their_timing_widen_the_error() -> None:
    table = timed(10, 1, 0.02, np.random.default_rng(3))
    fit = fit_periods(table, timing_error=0.005)
    assert fit.birge_ratio > 2.5
    alone = fit_periods(table)["gravity"].standard_error
    assert fit["gravity"].standard_error == pytest.approx(alone, rel=1e-6)


def test_error_of_the_timing_is_that_of_the_line() -> None:
    table = timed(10, 1, 1e-9, np.random.default_rng(4))
    fit = fit_periods(table, timing_error=0.01)
    assert table.length is not None
    # of T = 2π √(L/g): dT/dg = −T/2g, so that 1/σ² = Σ (T/2g)²/σ_T²
    expected = 0.01 / math.sqrt(((table.period / (2.0 * G)) ** 2).sum())
    assert fit["gravity"].standard_error == pytest.approx(expected, rel=1e-6)


def test_error_of_the_lengths_counts() -> None:
    table = timed(10, 1, 1e-9, np.random.default_rng(5))
    assert table.length is not None
    fit = fit_periods(table, timing_error=1e-9, length_error=0.01)
    # of g = 4π² L/T²: each row has the relative error σ_L/L
    expected = G * 0.01 / math.sqrt((table.length**2).sum())
    assert fit["gravity"].standard_error == pytest.approx(expected, rel=1e-6)


def test_error_of_one_length_does_not_fall_with_the_rows() -> None:
    period = np.full(20, math.tau * math.sqrt(0.5 / G))
    fit = fit_periods(PeriodTable(period), length=0.5, timing_error=1e-9, length_error=0.005)
    assert fit["gravity"].value == pytest.approx(G)
    assert fit["gravity"].standard_error == pytest.approx(G * 0.01, rel=1e-6)


def test_the_true_law_of_amplitudes_is_kept() -> None:
    fit = fit_periods(swung(1.0 / 16.0, 0.002, np.random.default_rng(6)), length=0.56)
    assert fit.names == ("period", "amplitude_coefficient", "gravity")
    assert within_two_errors(fit, "amplitude_coefficient", 1.0 / 16.0)
    assert within_two_errors(fit, "period", 1.5)
    assert within_two_errors(fit, "gravity", 4.0 * math.pi**2 * 0.56 / 1.5**2)
    assert not fit.rejects_the_law


def test_another_law_of_amplitudes_is_rejected() -> None:
    fit = fit_periods(swung(0.047, 0.005, np.random.default_rng(7)))
    found = fit["amplitude_coefficient"]
    assert found.standard_error == pytest.approx(0.003, abs=0.0015)
    assert within_two_errors(fit, "amplitude_coefficient", 0.047)
    assert fit.rejects_the_law
    assert fit.chance < 0.002


def test_the_true_law_is_rejected_as_seldom_as_chance_has_it() -> None:
    rng = np.random.default_rng(8)
    chances = [fit_periods(swung(1.0 / 16.0, 0.005, rng)).chance for _ in range(400)]
    # even between 0 and 1 (Kolmogorov and Smirnov: 0.08 is passed once in a hundred)
    apart = np.abs(np.sort(chances) - np.linspace(0.0, 1.0, 400)).max()
    assert apart < 0.08


def test_errors_of_the_amplitudes_weigh_the_large_ones_less() -> None:
    table = swung(1.0 / 16.0, 1e-6, np.random.default_rng(9))
    exact = fit_periods(table, timing_error=1e-3)
    read_badly = fit_periods(table, timing_error=1e-3, amplitude_error=math.radians(2.0))
    ratio = read_badly.errors / exact.errors
    assert (np.diff(ratio) > 0).all()
    # dT = T0 θ0/8 dθ0 of the smallest
    assert ratio[0] == pytest.approx(
        math.hypot(1.0, 1.5 * math.radians(5.0) / 8.0 * math.radians(2.0) / 1e-3), rel=2e-3
    )


@pytest.mark.parametrize(
    ("table", "arguments", "error"),
    [
        (PeriodTable(np.array([1.0])), {}, "table must have lengths, or amplitudes that differ"),
        (PeriodTable(np.array([1.0])), {"length": 0.5}, "table must have at least 2 rows"),
        (PeriodTable(np.array([1.0, -2.0])), {"length": 0.5}, r"period must be .* row 2; leave"),
        (
            PeriodTable(np.array([1.0, 2.0]), length=np.array([0.2, 1.0])),
            {"length": 0.5},
            "length goes with a table without lengths, got 0.5 m; leave it out",
        ),
        (
            PeriodTable(np.array([1.0, 2.0]), length=np.array([0.2, 1.0])),
            {"corrections": ["bob"]},
            "corrections must leave out what cannot be computed, got 'bob'; give bob_radius",
        ),
        (
            PeriodTable(np.array([1.0, 2.0]), length=np.array([0.2, 1.0])),
            {"corrections": ["bobb"]},
            "corrections .*'bobb'.*did you mean 'bob'",
        ),
        (
            PeriodTable(np.array([1.0, 2.0]), length=np.array([0.2, 1.0])),
            {"corrections": ["offset"]},
            "at least 3 rows for two values, that of the offset among them, got 2 .*timing_error",
        ),
        (
            PeriodTable(np.array([1.0, 2.0, 2.0])),
            {"length": 0.5, "corrections": ["offset"]},
            "of one length it cannot be told from g",
        ),
        (
            PeriodTable(np.array([1.0, 2.0]), amplitude=np.array([0.2, 4.0])),
            {},
            "table.amplitude must be below pi",
        ),
        (
            PeriodTable(np.array([1.0, 2.0]), length=np.array([0.2, 1.0])),
            {"apparatus": Apparatus(bob_radius=0.3)},
            "bob_radius must be below the shortest length of 0.2 m, got 0.3 m",
        ),
        (
            PeriodTable(np.array([1.0, 2.0]), length=np.array([0.2, 1.0])),
            {"length_error": -1.0},
            "length_error must",
        ),
    ],
)
def test_what_cannot_be_told_is_refused(
    table: PeriodTable, arguments: dict[str, Any], error: str
) -> None:
    with pytest.raises(ValueError, match=error):
        fit_periods(table, **arguments)
