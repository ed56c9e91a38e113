"""Standard errors of exponents, against the spread of many series and of starts in one sea."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pendula import DoublePendulum
from pendula.chaos import energy_surface, lyapunov
from pendula.chaos.verdict import falls_slowly, standard_error_of_mean

RODS = DoublePendulum.rods(gravity=9.81)


def sticky(generator: np.random.Generator, stay: float) -> np.ndarray:
    """400 growths, 1 on average but 0.2 for a while now and then, as at the edge of an island."""
    leave, come = 1.0 / stay, 0.15 / 0.85 / stay
    stuck, rates = generator.random() < 0.15, np.empty(400)
    for i, draw in enumerate(generator.random(400)):
        stuck = draw >= leave if stuck else draw < come
        rates[i] = 0.2 if stuck else 1.0
    return rates + 0.3 * generator.standard_normal(400)


@pytest.mark.parametrize(
    ("stay", "least", "most"), [(1.0, 0.9, 1.4), (20.0, 0.9, 1.55), (60.0, 0.9, 1.45)]
)
def test_an_error_sees_motions_that_stick(stay: float, least: float, most: float) -> None:
    """Rather too large: what lasts 20 to 60 of 400 parts could be a memory that never ends."""
    generator = np.random.default_rng(7)
    series = [sticky(generator, stay) for _ in range(200)]
    errors = np.array([standard_error_of_mean(each) for each in series])
    spread = np.std([each.mean() for each in series], ddof=1)
    stated = np.sqrt(np.nanmean(errors**2))
    assert least < stated / spread < most
    assert np.isnan(errors).mean() < 0.1


def autoregressive(generator: np.random.Generator, time: float) -> tuple[np.ndarray, float]:
    """300 series of 400 that forget as e^(-i/time), (300, 400), and their means' deviation."""
    kept = math.exp(-1.0 / time)
    series = np.empty((300, 400))
    series[:, 0] = generator.standard_normal(300)
    pushes = math.sqrt(1.0 - kept**2) * generator.standard_normal((300, 400))
    for i in range(1, 400):
        series[:, i] = kept * series[:, i - 1] + pushes[:, i]
    whole = (1.0 + kept) / (1.0 - kept) - 2.0 * kept * (1.0 - kept**400) / 400 / (1.0 - kept) ** 2
    return series, math.sqrt(whole / 400)


def fractional(generator: np.random.Generator, memory: float) -> tuple[np.ndarray, float]:
    """300 series of 400 of fractional Gaussian noise, (300, 400), and their means' deviation.

    By a circulant matrix (Davies & Harte 1987, Biometrika 74, 95).
    """
    powers = np.abs(np.arange(-1.0, 402.0)) ** (2.0 * memory)
    covariance = 0.5 * (powers[2:] - 2.0 * powers[1:-1] + powers[:-2])
    spectrum = np.fft.fft(np.concatenate([covariance, covariance[-2:0:-1]])).real
    draws = generator.standard_normal((2, 300, 800))
    waves = np.sqrt(spectrum / 800) * (draws[0] + 1j * draws[1])
    return np.fft.fft(waves, axis=1)[:, :400].real, 400.0 ** (memory - 1.0)


@pytest.mark.parametrize("time", [1.0, 10.0, 40.0, 60.0])
def test_an_error_is_that_of_a_series_that_forgets_slowly(time: float) -> None:
    """Blocks alone gave 0.75 and 0.6 of it at correlation times of 40 and 60 parts of 400."""
    series, known = autoregressive(np.random.default_rng(7), time)
    errors = np.array([standard_error_of_mean(each) for each in series])
    assert 0.9 < np.sqrt(np.nanmean(errors**2)) / known < 1.6


@pytest.mark.parametrize(("memory", "least"), [(0.5, 0.98), (0.6, 0.98), (0.7, 0.9), (0.8, 0.46)])
def test_an_error_is_that_of_a_series_that_remembers(memory: float, least: float) -> None:
    """Within a factor of two in so many of 300; blocks alone: 0.99, 0.97, 0.79 and 0.42."""
    series, known = fractional(np.random.default_rng(7), memory)
    ratios = np.array([standard_error_of_mean(each) for each in series]) / known
    assert ((ratios > 0.5) & (ratios < 2.0)).mean() > least
    slowly = np.mean([falls_slowly(each) for each in series])
    assert slowly < 0.08 if memory <= 0.6 else slowly > 0.08


def test_equal_parts_have_no_error() -> None:
    assert standard_error_of_mean(np.full(400, 0.5)) == 0.0
    assert not falls_slowly(np.full(400, 0.5))


def test_a_series_of_few_correlation_times_has_no_error() -> None:
    assert math.isnan(standard_error_of_mean(np.linspace(0.0, 1.0, 400)))


def test_an_error_is_that_of_other_starts() -> None:
    """Of eight in the chaotic sea at 60 J, where motions stick to islands."""
    found = lyapunov(RODS, energy_surface(RODS, 60.0, 12, 5), 1000.0)
    sea = np.flatnonzero(found.exponents[:, 0] > 0.5)[:8]
    spread = found.exponents[sea, 0].std(ddof=1)
    stated = np.sqrt(np.mean(found.standard_error[sea, 0] ** 2))
    assert len(sea) == 8
    assert 0.5 < stated / spread < 2.0
    told = found.standard_error_settled
    assert told.shape == (12,)
    one = lyapunov(RODS, found.start[0], 1000.0)
    assert one.standard_error_settled == told[0]
