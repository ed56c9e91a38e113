"""Standard errors of exponents, against the spread of many series and of starts in one sea."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pendula import DoublePendulum
from pendula.chaos import energy_surface, lyapunov
from pendula.chaos.verdict import standard_error_of_mean

RODS = DoublePendulum.rods(gravity=9.81)


def sticky(generator: np.random.Generator, stay: float) -> np.ndarray:
    """400 growths, 1 on average but 0.2 for a while now and then, as at the edge of an island."""
    leave, come = 1.0 / stay, 0.15 / 0.85 / stay
    stuck, rates = generator.random() < 0.15, np.empty(400)
    for i, draw in enumerate(generator.random(400)):
        stuck = draw >= leave if stuck else draw < come
        rates[i] = 0.2 if stuck else 1.0
    return rates + 0.3 * generator.standard_normal(400)


@pytest.mark.parametrize(("stay", "least"), [(1.0, 0.9), (20.0, 0.9), (60.0, 0.6)])
def test_an_error_sees_motions_that_stick(stay: float, least: float) -> None:
    generator = np.random.default_rng(7)
    series = [sticky(generator, stay) for _ in range(200)]
    errors = np.array([standard_error_of_mean(each) for each in series])
    spread = np.std([each.mean() for each in series], ddof=1)
    stated = np.sqrt(np.nanmean(errors**2))
    assert least < stated / spread < 1.25
    assert np.isnan(errors).mean() < 0.1


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
