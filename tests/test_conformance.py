"""What every method of the catalogue has to pass, on every system that it takes.

The order, the way back, the energy over a long run, the Jacobian of a step and the lanes' bits are
walked in core/tests (suite_catalog, test_symplectic, same_bits); here is what needs the truth.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest

from catalogue import ADAPTIVE, ENTRIES, FIXED, TAKEN, label, made, some_state, taking
from pendula import DoublePendulum, exact, solve
from stored import cases

CLOSED = [made(each.name, length=0.5, mass=1.0) for each in ENTRIES if each.can.closed_form]
FIXED_ON_CLOSED = [
    (each, system) for each in FIXED for system in CLOSED if system.name in each.systems
]
START = (2.0, 0.5)
TIMES = np.linspace(0.0, 3.0, 31)


class Fine(NamedTuple):
    """A step [s] and what it is good for: twice the largest error measured, or some roundings.

    Of the angle over 3 s against the closed form; of the stored double pendulums' states up to 1 s
    (at a fifth of the step from order 4 on); of the way back.
    """

    step: float
    closed_form: float
    double: float
    back: float


FINE = {
    "euler": Fine(1e-5, 2e-3, 1e-3, 4e-3),
    "heun": Fine(1e-4, 2e-6, 5e-6, 5e-9),
    "rk4": Fine(1e-3, 2e-10, 4e-12, 3e-10),
    "symplectic-euler": Fine(1e-5, 1e-4, 0.0, 3e-4),
    "verlet": Fine(1e-4, 4e-7, 0.0, 4e-15),
    "yoshida4": Fine(1e-3, 1e-9, 0.0, 4e-15),
    "yoshida6": Fine(1e-3, 6e-15, 0.0, 4e-15),
    "yoshida8": Fine(5e-3, 6e-15, 0.0, 4e-15),
    "midpoint": Fine(1e-4, 8e-7, 3e-6, 4e-15),
    "gauss4": Fine(1e-3, 3e-11, 6e-13, 4e-15),
    "gauss6": Fine(5e-3, 1e-13, 4e-15, 4e-15),
    "gauss8": Fine(1e-2, 6e-15, 4e-15, 4e-15),
}
BEST = Fine(0.0, 1e-14, 4e-15, 1e-14)  # at the best tolerance


WITH_DENSE_OUTPUT = [(method, system) for method, system in TAKEN if method.adaptive]


def control(method: Any, factor: float = 1.0) -> dict[str, Any]:
    return {} if method.adaptive else {"step": FINE[method.name].step * factor}


@pytest.mark.parametrize(("method", "system"), FIXED_ON_CLOSED, ids=label)
def test_fixed_steps_agree_with_the_closed_form(method: Any, system: Any) -> None:
    run = solve(system, START, TIMES, method.name, **control(method))
    error = np.abs(run.theta - exact(system, START, TIMES).theta).max()
    assert error < FINE[method.name].closed_form


@pytest.mark.parametrize("method", ADAPTIVE, ids=label)
@pytest.mark.parametrize("system", CLOSED, ids=label)
def test_adaptive_steps_keep_to_their_tolerance(method: Any, system: Any) -> None:
    truth = exact(system, START, TIMES).theta
    errors = []
    for tolerance in (1e-4, 1e-7, 1e-10, 1e-13):
        run = solve(system, START, TIMES, method.name, tolerance=tolerance)
        errors.append(np.abs(run.theta - truth).max())
        assert 1e-3 * tolerance < errors[-1] < 10 * tolerance
    assert errors == sorted(errors, reverse=True)
    best = solve(system, START, TIMES, method.name)
    assert np.abs(best.theta - truth).max() < BEST.closed_form


@pytest.mark.parametrize("method", taking("double"), ids=label)
def test_the_stored_solutions_of_the_double_pendulum(method: Any) -> None:
    tight = 1.0 if not method.adaptive and method.order < 4 else 0.2
    for case in cases("double.json")[::3]:
        p = {key: float(value) for key, value in case["params"].items()}
        system = DoublePendulum.rods(p["m1"], p["m2"], p["l1"], p["l2"], p["g"])
        t = [float(x) for x in case["times"] if float(x) <= 1]
        run = solve(
            system, [float(x) for x in case["state"]], t, method.name, **control(method, tight)
        )
        want = np.array(case["states"], dtype=float)[: len(t)]
        np.testing.assert_allclose(
            run.states, want, rtol=0, atol=FINE.get(method.name, BEST).double
        )


@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_a_run_goes_back_where_it_came_from(method: Any, system: Any) -> None:
    start = some_state(system)
    there = solve(system, start, [0.5], method.name, t0=-0.5, **control(method))
    back = solve(system, there.states[-1], [-0.5], method.name, t0=0.5, **control(method))
    # the symmetric ones come back but for rounding, the others but for their own error
    allowed = FINE.get(method.name, BEST).back
    np.testing.assert_allclose(back.states[-1], start, rtol=0, atol=allowed)


@pytest.mark.parametrize(("method", "system"), WITH_DENSE_OUTPUT, ids=label)
def test_dense_output_agrees_with_direct_steps(method: Any, system: Any) -> None:
    state = 2.0 * some_state(system)
    run = solve(system, state, 2.0, method.name)
    between = 0.5 * (run.t[1:] + run.t[:-1])
    other = max((each for each in FIXED if system.name in each.systems), key=lambda m: m.order)
    direct = solve(system, state, between, other.name, step=2e-3 if other.order > 4 else 1e-4)
    np.testing.assert_allclose(run.at(between), direct.states, rtol=0, atol=2e-11)
    as_output = solve(system, state, between, method.name)
    assert np.array_equal(run.at(between), as_output.states)
    assert np.array_equal(run.at(run.t), run.states)


@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_a_start_too_fast_ends_and_nothing_hangs(method: Any, system: Any) -> None:
    d = system.can.degrees_of_freedom
    fast = [0.0] * d + [1e9] * d  # reaches the end of the sine's range in 70 ms
    asked = {"max_steps": 10**5} if method.adaptive else {"step": 1e-3}
    run = solve(system, fast, [0.01, 1.0], method.name, **asked)
    assert run.outcome in {"not_finite", "step_limit"} or not system.can.periodic
    assert run.reached < 1.0 or not system.can.periodic
