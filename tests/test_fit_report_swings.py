"""Swings read off a recording are those of the motion, found by other means."""

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from pendula.measured import fit
from pendula.measured.whole_swings import periods_at, rates, seen, swings
from swung import OMEGA2, START, VISCOUS, recording


def turns(until: float) -> NDArray[np.float64]:
    """Heights of all turns of the motion, the start not among them."""

    def turn(_: float, y: NDArray[np.float64]) -> float:
        return float(y[1])

    found = solve_ivp(
        lambda _, y: [y[1], -OMEGA2 * math.sin(y[0]) - VISCOUS * y[1]],
        (0.0, until),
        [START, 0.0],
        events=turn,
        rtol=1e-11,
        atol=1e-12,
    )
    later = found.t_events[0] > 0.1
    heights: NDArray[np.float64] = np.abs(found.y_events[0][later, 0])
    return heights


def test_amplitudes_are_the_heights_of_the_turns() -> None:
    found = swings(seen(fit(recording(noise=0.0), "viscous").recordings[0]))
    heights = turns(16.0)
    # the first passage upward comes after the first turn, which is below
    pairs = (heights[1:-1:2] + heights[2::2]) / 2.0
    assert found.amplitude == pytest.approx(pairs[: len(found.t)], rel=2e-4)
    assert len(found.t) >= 9


def test_periods_without_friction_are_elliptic_integrals() -> None:
    made = recording(noise=0.0, viscous=0.0)
    found = swings(seen(fit(made, "undamped").recordings[0]))
    exact = 4.0 * ellipk(math.sin(START / 2.0) ** 2) / math.sqrt(OMEGA2)
    assert found.period == pytest.approx(exact, rel=2e-5)
    assert found.amplitude == pytest.approx(START, rel=2e-4)
    assert periods_at(OMEGA2, np.array([START])) == pytest.approx(exact, rel=1e-14)


@pytest.mark.parametrize("quantity", ["angle", "rate"])
def test_noise_moves_periods_by_little_and_on_average_not(quantity: str) -> None:
    found = swings(seen(fit(recording(quantity), "viscous").recordings[0]))
    away = found.period - periods_at(OMEGA2, found.amplitude)
    assert np.abs(away).max() < 4e-3  # of 1.5 s; of single crossings it would be 1e-3 or so
    assert abs(away.mean()) < 1e-3


def test_what_is_measured_counts_and_not_the_model() -> None:
    fitted = fit(recording(), "viscous").recordings[0]
    recorded = seen(fitted)
    late = recorded._replace(values=1.01 * recorded.values)
    assert swings(late).amplitude == pytest.approx(1.01 * swings(recorded).amplitude, rel=1e-9)


def test_missing_samples_are_left_out() -> None:
    whole = recording()
    values = whole.values.copy()
    values[100:103] = np.nan
    found = swings(seen(fit(replace(whole, values=values), "viscous").recordings[0]))
    assert np.isfinite(found.period).all()
    assert len(found.t) >= 8


def test_rates_are_those_of_the_motion() -> None:
    recorded = seen(fit(recording(noise=0.0), "viscous").recordings[0])
    theta, omega = rates(recorded)
    known = np.isfinite(omega)
    assert np.count_nonzero(known) > 790
    assert omega[known] == pytest.approx(recorded.model.omega[known], abs=0.02)
    assert theta == pytest.approx(recorded.model.theta, abs=1e-5)


def test_accelerations_are_refused() -> None:
    fitted = fit(recording(), "viscous").recordings[0]
    other = replace(fitted, measurement=replace(fitted.measurement, quantity="acceleration"))
    with pytest.raises(ValueError, match="recording must be of angles or rates"):
        seen(other)
