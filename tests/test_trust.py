"""Trust horizons and right digits, against solutions that FLINT and mpmath give."""

from __future__ import annotations

import math
import signal
import threading
import time
from decimal import Decimal
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from mpmath import mp

import truth
from horizons import horizon
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, solve
from pendula.run.trust import DigitsError, digits_states
from stored import cases

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from pendula._types import MethodName

    Array = NDArray[np.float64]

DOUBLE = cases("double.json")
CHAOTIC = cases("horizon.json")
SPACING = 1.0 / 32.0


def rods(case: dict[str, Any]) -> tuple[DoublePendulum, Array]:
    m1, m2, l1, l2, g = (float(case["params"][name]) for name in ("m1", "m2", "l1", "l2", "g"))
    return DoublePendulum.rods(m1, m2, l1, l2, g), np.array([float(x) for x in case["state"]])


def right_digits(got: Array, want: Any) -> float:
    """Of the component that has the fewest."""
    relative = (
        abs((Decimal(float(g)) - Decimal(w)) / Decimal(w)) for g, w in zip(got, want, strict=True)
    )
    return min(math.inf if error == 0 else -math.log10(error) for error in relative)


@pytest.mark.parametrize("case", DOUBLE)
def test_twelve_digits_are_right_after_twenty_seconds(case: dict[str, Any]) -> None:
    system, state = rods(case)
    states, precision = digits_states(
        system, state, np.array([float(t) for t in case["times"]]), 0.0, 12
    )
    assert precision > 12
    for got, want in zip(states, case["states"], strict=True):
        assert right_digits(got, want) > 12.3  # half a unit in the twelfth


@pytest.mark.parametrize("case", DOUBLE[1:3])
def test_fifteen_digits_are_right(case: dict[str, Any]) -> None:
    system, state = rods(case)
    states, _ = digits_states(system, state, np.array([float(case["times"][-1])]), 0.0, 15)
    assert right_digits(states[0], case["states"][-1]) > 15.3


# Both ways in time, and with times that are not multiples of anything.
@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_digits_of_one_bob_are_those_of_the_closed_form(direction: float) -> None:
    state, times = np.array([3.0, direction * 0.1]), 7.0 + direction * np.array([0.3, 17.7, 90.1])
    simple, linear = SimplePendulum(1.3, 9.81), LinearPendulum(1.3, 9.81)
    for system, exact in ((simple, truth.simple), (linear, truth.linear)):
        states, _ = digits_states(system, state, times, 7.0, 15)
        with mp.workdps(60):
            for t, got in zip(times, states, strict=True):
                want = exact(state[0], state[1], 9.81, 1.3, mp.mpf(float(t)) - 7)
                assert right_digits(got, [mp.nstr(want.theta, 30), mp.nstr(want.omega, 30)]) > 15.3


def test_rest_stays_rest_and_small_swings_keep_their_digits() -> None:
    rest, _ = digits_states(DoublePendulum.rods(), np.zeros(4), np.array([1.0, 50.0]), 0.0, 15)
    assert (rest == 0.0).all()
    state = np.array([1e-200, 0.0])
    small, _ = digits_states(SimplePendulum(1.3, 9.81), state, np.array([5.0]), 0.0, 15)
    with mp.workdps(60):
        want = truth.linear(state[0], 0.0, 9.81, 1.3, 5.0)
        assert right_digits(small[0], [mp.nstr(want.theta, 30), mp.nstr(want.omega, 30)]) > 15.3


def test_more_digits_than_there_are_say_how_far_they_go() -> None:
    system, state = rods(CHAOTIC[0])
    message = r"digits = 12 at t = 5000 s .* end the run at about t = "
    with pytest.raises(DigitsError, match=message) as error:
        digits_states(system, state, np.array([5000.0]), 0.0, 12)
    assert error.value.outcome == "digits_limit"  # of an ensemble's run


def first_bad(case: dict[str, Any], angles: Array, tolerance: float) -> int:
    """Place of the first of the stored times at which an angle is off by more."""
    for place, (got, want) in enumerate(zip(angles, case["angles"], strict=True)):
        apart = max(abs(Decimal(float(g)) - Decimal(w)) for g, w in zip(got, want, strict=True))
        if apart > Decimal(tolerance):
            return place
    raise AssertionError("the run is right throughout")


RUNS: list[tuple[str, dict[str, Any]]] = [
    ("taylor", {}),
    ("taylor", {"tolerance": 1e-7}),
    ("rk4", {"step": 2.0**-10}),
    ("gauss8", {"step": SPACING}),
    ("midpoint", {"step": SPACING}),
]


@pytest.mark.parametrize("direction", [1.0, -1.0])
@pytest.mark.parametrize("certify", [1e-11, 1e-6, 0.1])
@pytest.mark.parametrize(("method", "options"), RUNS)
@pytest.mark.parametrize("case", CHAOTIC)
def test_the_horizon_is_where_the_run_parts(
    case: dict[str, Any],
    method: MethodName,
    options: dict[str, Any],
    certify: float,
    direction: float,
) -> None:
    system, state = rods(case)
    state[2:] *= direction  # backward it is the same motion with the velocities turned
    times = direction * SPACING * np.arange(1, len(case["angles"]) + 1)
    run = solve(system, state, times, method, **options)
    found = direction * horizon(system, state, method, 0.0, times[-1], certify=certify, **options)
    late = SPACING * (first_bad(case, run.theta, certify) + 1)
    if options.get("step") == SPACING:  # and nothing between to be looked at
        assert found == late
    assert late - SPACING < found <= late


def test_the_horizon_is_infinite_where_the_run_is_right_to_its_end() -> None:
    system, state = rods(CHAOTIC[0])
    assert horizon(system, state, "taylor", 0.0, 3.0, certify=1e-6) == math.inf
    assert horizon(system, state, "taylor", 0.0, 100.0, certify=1e-6) < 100.0
    assert horizon(system, np.zeros(4), "rk4", 0.0, 50.0, step=0.01, certify=1e-9) == math.inf


def test_the_horizon_of_one_bob_is_where_the_closed_form_says() -> None:
    system, state = SimplePendulum(1.0, 9.81), np.array([2.0, 0.5])
    found = horizon(system, state, "rk4", 2.0, 60.0, step=0.01, certify=1e-8)
    times = 2.0 + 0.01 * np.arange(1, 5801)
    run = solve(system, state, times, "rk4", t0=2.0, step=0.01)
    with mp.workdps(40):
        bad = next(
            n
            for n, angle in enumerate(run.theta)
            if abs(angle - truth.simple(2.0, 0.5, 9.81, 1.0, mp.mpf("0.01") * (n + 1)).theta) > 1e-8
        )
    assert found == pytest.approx(float(times[bad]), abs=1e-9)


def test_progress_rises_to_the_end() -> None:
    system, state = rods(CHAOTIC[0])
    told: list[float] = []
    digits_states(system, state, np.array([30.0]), 0.0, 12, told.append)
    assert len(told) > 3
    assert all(0.0 <= a <= b for a, b in pairwise(told))
    assert told[-1] == 1.0


def many_digits() -> None:
    system, state = rods(CHAOTIC[0])
    digits_states(system, state, np.array([300.0]), 0.0, 12)


def many_steps() -> None:
    rest = np.zeros(4)
    horizon(DoublePendulum.rods(), rest, "gauss8", 0.0, 1e5, step=1e-3, certify=1e-6)


@pytest.mark.parametrize("method", ["euler", "rk4", "gauss8"])
@pytest.mark.parametrize("speed", [1e12, 1e300])
def test_a_run_beyond_all_bounds_is_wrong_at_once(method: MethodName, speed: float) -> None:
    run = solve(SimplePendulum(), (1.5, speed), [1.0], method, step=0.01, certify=1e-6)
    assert (run.outcome, run.trust_horizon) == ("not_finite", 0.01)


def one_long_step() -> None:
    """In which the pendulum turns millions of times."""
    solve(SimplePendulum(), (1.0, 5e7), [1.0], "rk4", step=0.5, certify=1.0)


@pytest.mark.parametrize("work", [many_digits, many_steps, one_long_step])
def test_an_interrupt_ends_it(work: Callable[[], None]) -> None:
    timer = threading.Timer(0.5, signal.raise_signal, [signal.SIGINT])
    started = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        work()
    assert time.monotonic() - started < 10.0  # 0.1 s after the signal; a machine may be busy
