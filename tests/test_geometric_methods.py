"""Methods that preserve the symplectic form: accuracy, energy, refusals and evaluations."""

import numpy as np
import pytest

from catalogue import ENTRIES, METHODS, label, made
from pendula import DoublePendulum, SimplePendulum, exact, solve
from pendula._types import MethodName
from pendula.systems import System

RODS = DoublePendulum.rods(gravity=9.81)
SIMPLE = SimplePendulum(1.0, 9.81)
GEOMETRIC = [each for each in METHODS if each.symplectic]
ROUNDING = 3e-14  # of 10⁴ to 10⁵ steps: Gauss' methods conserve the linear pendulum's energy
NAMES = [each.name for each in GEOMETRIC]
BOBS = [
    made(each.name, length=1.0)
    for each in ENTRIES
    if each.can.conservative and each.can.degrees_of_freedom == 1
]
OF_RODS = [each.name for each in GEOMETRIC if "double" in each.systems]


def drift_and_width(energy: np.ndarray) -> tuple[float, float]:
    """What the best straight line gains over the run, and the width of what goes about it."""
    along = np.linspace(0.0, 1.0, energy.size)
    slope, start = np.polyfit(along, energy, 1)
    return abs(float(slope)), float(np.ptp(energy - start - slope * along))


# Errors after ten swings or so with steps of 10 ms; twice what was found.
AFTER_TWENTY_SECONDS = {
    "symplectic-euler": 0.12,
    "verlet": 1.2e-3,
    "yoshida4": 1.7e-6,
    "yoshida6": 1.6e-10,
    "yoshida8": 1e-13,
    "midpoint": 1.3e-2,
    "gauss4": 1.8e-7,
    "gauss6": 4.1e-12,
    "gauss8": 1e-13,
}


@pytest.mark.parametrize("method", NAMES)
def test_they_follow_the_exact_solution(method: MethodName) -> None:
    t = np.linspace(0.0, 20.0, 201)
    want = exact(SIMPLE, (1.5, 0.3), t).states
    error = np.abs(solve(SIMPLE, (1.5, 0.3), t, method, step=0.01).states - want).max()
    assert AFTER_TWENTY_SECONDS[method] / 10 < error < AFTER_TWENTY_SECONDS[method]


@pytest.mark.parametrize("method", NAMES)
@pytest.mark.parametrize("system", BOBS, ids=label)
def test_energy_stays_within_bounds(system: System, method: MethodName) -> None:
    run = solve(system, (2.0, 0.0), np.linspace(0.0, 2000.0, 40001), method, step=0.05)
    drift, width = drift_and_width(run.energy_error)
    assert drift < width + ROUNDING
    lossy = solve(system, (2.0, 0.0), np.linspace(0.0, 2000.0, 40001), "rk4", step=0.05)
    drift, width = drift_and_width(lossy.energy_error)
    assert drift > width


@pytest.mark.parametrize("method", OF_RODS)
def test_energy_of_the_rods_stays_within_bounds(method: MethodName) -> None:
    t = np.linspace(0.0, 600.0, 12001)
    drift, width = drift_and_width(
        solve(RODS, (0.5, 0.5, 0.0, 0.0), t, method, step=0.01).energy_error
    )
    assert drift < width


def test_rounding_leaves_no_trace_in_the_energy() -> None:
    """A regular motion of the rods, some 10⁵ steps: what is left is the rounding of the output."""
    t = np.linspace(0.0, 1000.0, 2001)
    run = solve(RODS, (0.5, 0.5, 0.0, 0.0), t, "gauss8", step=0.01)
    assert np.abs(run.energy_error).max() < 2e-14


def test_the_rods_refuse_what_needs_a_separable_energy() -> None:
    refused = [each for each in GEOMETRIC if "double" not in each.systems]
    assert refused == [each for each in METHODS if each.needs == "separable"]
    for each in refused:
        with pytest.raises(
            ValueError, match=rf"method '{each.name}' needs a system whose energy sep"
        ) as error:
            solve(RODS, (1.0, 0.0, 0.0, 0.0), 1.0, each.name, step=0.01)
        assert ", ".join(OF_RODS) in str(error.value)


def test_evaluations_are_counted() -> None:
    for each in GEOMETRIC:
        run = solve(SIMPLE, (1.0, 0.0), [0.503, 1.0], each.name, step=0.01)
        assert run.n_steps == 101
        if each.evaluations_per_step is None:
            stages = each.order // 2
            assert run.n_evaluations % stages == 0
            assert 2 * stages <= run.n_evaluations / run.n_steps <= 12 * stages
        else:
            assert run.n_evaluations == 101 * each.evaluations_per_step


@pytest.mark.parametrize("method", OF_RODS)
def test_a_step_too_large_to_iterate_ends_the_run(method: MethodName) -> None:
    run = solve(RODS, (2.0, 2.5, 0.0, 0.0), 100.0, method, step=2.0)
    assert run.outcome == "not_finite"
    assert np.isfinite(run.states).all()
