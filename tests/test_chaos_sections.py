"""Starts by the invariant measure, and sections, against quadrature and single runs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import refusals
from pendula import DoublePendulum, DrivenPendulum, SimplePendulum, events, poincare_section, solve
from pendula.chaos import energy_surface, megno, sali, section, section_starts

PINNED = [
    "0x1.926e545e3f061p-2",
    "0x1.3f7552b93d2e4p+1",
    "-0x1.517d8c3e55ecap+1",
    "-0x1.4ab09236c63bbp+1",
]
UNEQUAL = DoublePendulum.rods(1.3, 0.7, 0.8, 1.1, gravity=9.81)


def quadrature(system: DoublePendulum, energy: float) -> dict[str, float]:
    """Means over the measure √det M dθ1 dθ2 where V < E, on a fine grid of midpoints."""
    A, B, C, D, E = (system.constants[name] for name in "ABCDE")
    middle = (np.arange(3000) + 0.5) / 3000 * math.tau - math.pi
    theta1, theta2 = middle[:, np.newaxis], middle[np.newaxis]
    left = energy - D * (1.0 - np.cos(theta1)) - E * (1.0 - np.cos(theta2))
    density = np.sqrt(A * B - (C * np.cos(theta1 - theta2)) ** 2) * (left > 0.0)
    total = density.sum()
    values = {
        "kinetic": left,
        "theta1": theta1**2 + 0.0 * theta2,
        "theta2": theta2**2 + 0.0 * theta1,
        "across": np.cos(theta1 - theta2),
    }
    return {name: float((density * each).sum() / total) for name, each in values.items()}


@pytest.mark.parametrize("energy", [1.0, 8.0, 20.0, 60.0])
def test_moments_of_the_energy_surface(energy: float) -> None:
    states = energy_surface(UNEQUAL, energy, 40000, 3)
    assert abs(UNEQUAL.energy(states) / energy - 1.0).max() < 1e-14
    constants, want = UNEQUAL.constants, quadrature(UNEQUAL, energy)
    theta1, theta2, omega1, omega2 = states.T
    coupling = constants["C"] * np.cos(theta1 - theta2)
    momentum1 = constants["A"] * omega1 + coupling * omega2
    momentum2 = constants["B"] * omega2 + coupling * omega1
    found = {
        "kinetic": UNEQUAL.kinetic_energy(states),
        "theta1": theta1**2,
        "theta2": theta2**2,
        "across": np.cos(theta1 - theta2),
    }
    for name, values in found.items():
        error = values.std() / math.sqrt(values.size)
        assert abs(values.mean() - want[name]) < 4.5 * error + 1e-4 * abs(want[name])
    for each in (omega1 * momentum1, omega2 * momentum2):  # equipartition: both have a half of 2K
        error = each.std() / math.sqrt(each.size)
        assert abs(each.mean() - want["kinetic"]) < 4.5 * error
    for each in (omega1, omega2, theta1 * omega1):
        assert abs(each.mean()) < 4.5 * each.std() / math.sqrt(each.size)


def test_a_seed_gives_the_same_bits() -> None:
    """Everywhere, which is why they stand here."""
    first = energy_surface(UNEQUAL, 10.0, 2, 7)
    assert [float(each).hex() for each in first[0]] == PINNED
    assert np.array_equal(energy_surface(UNEQUAL, 10.0, 5000, 7)[:2], first)
    assert not np.array_equal(energy_surface(UNEQUAL, 10.0, 2, 8), first)


def test_starts_on_the_section_plane() -> None:
    states = section_starts(UNEQUAL, 10.0, np.array([[0.3], [-1.0]]), np.array([-0.5, 0.0, 0.2]))
    assert states.shape == (2, 3, 4)
    assert abs(UNEQUAL.energy(states) / 10.0 - 1.0).max() < 1e-14
    assert not states[..., 0].any()
    assert (states[..., 2] > 0.0).all()
    constants = UNEQUAL.constants
    coupling = constants["C"] * np.cos(states[..., 1])
    momentum = constants["B"] * states[..., 3] + coupling * states[..., 2]
    assert abs(momentum - [-0.5, 0.0, 0.2]).max() < 1e-15


def test_a_section_of_many_starts_is_that_of_each() -> None:
    found = section(UNEQUAL, energy=10.0, starts=6, crossings=40, threads=2)
    assert abs(UNEQUAL.energy(found.starts) / 10.0 - 1.0).max() < 1e-14
    surface = events.angle(1, 0.0, direction=1, every_turn=True)
    for start, times, states in zip(found.starts, found.times, found.states, strict=True):
        alone = poincare_section(UNEQUAL, start, surface, 40)
        assert np.array_equal(times, alone.times)
        assert np.array_equal(states, alone.states)
    assert set(found.outcomes) == {"event"}
    one = section(UNEQUAL, energy=10.0, starts=6, crossings=40, threads=1)
    assert np.array_equal(found.states, one.states)
    points = found.points
    lifted = section_starts(UNEQUAL, 10.0, points[..., 0], points[..., 1])
    assert abs(lifted[..., 2:] - found.states[..., 2:]).max() < 1e-9
    assert found.to_xarray().sizes == {"start": 6, "crossing": 40}


def test_starts_fill_the_plane_evenly() -> None:
    """Halves of the plane hold halves of the starts: its area by quadrature."""
    starts = section(UNEQUAL, energy=30.0, starts=2000, crossings=1).starts
    constants = UNEQUAL.constants
    coupling = constants["C"] * np.cos(starts[:, 1])
    momentum = constants["B"] * starts[:, 3] + coupling * starts[:, 2]
    angles = (np.arange(4000) + 0.5) / 4000 * math.tau - math.pi
    most = np.sqrt(2.0 * constants["B"] * (30.0 - constants["E"] * (1.0 - np.cos(angles))))
    inner = float(most[abs(angles) < 1.0].sum() / most.sum())
    assert np.mean(abs(starts[:, 1]) < 1.0) == pytest.approx(inner, abs=0.005)
    assert np.mean(momentum > 0.0) == pytest.approx(0.5, abs=0.005)


def test_a_stroboscopic_section() -> None:
    system = DrivenPendulum.scaled(2.0, 1.15, 2.0 / 3.0)
    found = section(system, [(0.1, 0.0), (1.0, 1.0)], crossings=50)
    times = 3.0 * math.pi * np.arange(1, 51)
    assert found.times[1] == pytest.approx(times, rel=1e-15)
    assert np.array_equal(found.states[1], solve(system, (1.0, 1.0), found.times[1]).states)
    assert (abs(found.points[..., 0]) <= math.pi).all()
    assert "t" in found.to_xarray()


@pytest.mark.parametrize("indicator", ["megno", "lyapunov", "sali"])
def test_a_section_has_an_indicator_of_each_motion(indicator: str) -> None:
    rods = DoublePendulum.rods()
    found = section(rods, energy=12.0, starts=5, crossings=2, indicator=indicator, t_max=30.0)
    starts = found.starts
    want = {
        "megno": lambda: megno(rods, starts, [30.0]).mean[:, -1],
        "lyapunov": lambda: megno(rods, starts, [30.0]).growth[:, -1] / 30.0,
        "sali": lambda: sali(rods, starts, [30.0]).value[:, -1],
    }[indicator]()
    assert found.values is not None
    assert found.values.tolist() == want.tolist()
    assert (found.recipe["indicator"], found.recipe["t_max"]) == (indicator, 30.0)
    assert found.to_xarray()[indicator].dims == ("start",)
    assert section(rods, energy=12.0, starts=5, crossings=2).values is None


def test_a_run_that_ends_early_leaves_gaps() -> None:
    found = section(UNEQUAL, (0.0, 0.5, 3.0, 0.0), crossings=500, max_steps=100)
    assert found.outcomes.tolist() == ["step_limit"]
    reached = int(np.isfinite(found.times).sum())
    assert 0 < reached < 500
    assert np.isnan(found.states[0, reached:]).all()


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: energy_surface(UNEQUAL, -1.0, 3, 0), "energy must be positive"),
        (lambda: energy_surface(UNEQUAL, 1.0, 0, 0), "n must be a whole number from 1"),
        (lambda: energy_surface(UNEQUAL, 1.0, 3, -1), "seed must be a whole number of at least 0"),
        (lambda: energy_surface(SimplePendulum(), 1.0, 3, 0), "system must be a DoublePendulum"),  # type: ignore[arg-type]
        (lambda: section(UNEQUAL), "states must be given, or energy"),
        (lambda: section(UNEQUAL, (0.0, 0.0, 0.0, 0.0)), "state is an equilibrium"),
        (lambda: section(UNEQUAL, energy=1.0, event="top"), "event must be made by"),  # type: ignore[arg-type]
        (lambda: section_starts(UNEQUAL, 10.0, 0.3, 50.0), "p2 must be a point that 10 J reach"),
    ],
)
def test_what_has_no_section(call: Any, says: str) -> None:
    assert says in refusals.told(call)
