"""The default method, taylor: how right it is, its steps, its dense output, and how it ends."""

from __future__ import annotations

import math
import pickle
import signal
import subprocess
import sys
import time
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from catalogue import ADAPTIVE, ENTRIES, label, made
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, _engine, exact, solve
from stored import EPS, cases

if TYPE_CHECKING:
    from pendula._types import MethodName

RODS = DoublePendulum.rods(gravity=9.81)
SIMPLE = SimplePendulum(0.5, 9.81)
WILD = (2.0, 2.5, 0.0, 0.0)
NAMES = [each.name for each in ADAPTIVE]
CLOSED = [made(each.name, length=0.5) for each in ENTRIES if each.can.closed_form]


def largest(difference: Any) -> float:
    return float(np.abs(difference).max())


# ---- how right ----


@pytest.mark.parametrize("case", cases("double.json"), ids=lambda case: ",".join(case["state"]))
def test_the_stored_solutions_to_the_rounding_of_their_inputs(case: dict[str, Any]) -> None:
    """Up to 5 s no worse than three times what an ulp of each input makes of them."""
    names = ("m1", "m2", "l1", "l2", "g")
    inputs = np.array(
        [*(float(case["params"][name]) for name in names), *map(float, case["state"])]
    )
    t = [float(x) for x in case["times"] if float(x) <= 5]

    def states(given: Any) -> Any:
        return solve(DoublePendulum.rods(*given[:5]), given[5:], t).states

    run = states(inputs)
    carried = np.zeros_like(run)
    for i, value in enumerate(inputs):
        moved = inputs.copy()
        moved[i] += EPS * (abs(value) or 1.0)
        carried += np.abs(states(moved) - run)
    error = np.abs(run - np.array(case["states"], dtype=float)[: len(t)])
    assert (error <= 3 * carried.max(axis=1, keepdims=True)).all()


@pytest.mark.parametrize("system", CLOSED, ids=label)
@pytest.mark.parametrize(
    "state", [(0.1, 0.0), (3.1, 0.0), (-1.0, 5.0), (0.0, 9.5), (50.125, -20.0)]
)
def test_the_closed_form(system: Any, state: tuple[float, float]) -> None:
    t = np.linspace(0.0, 10.0, 101)
    run, truth = solve(system, state, t), exact(system, state, t)
    ulps = EPS * np.diag([max(1.0, abs(x)) for x in state])
    carried = largest(exact(system, state + ulps, t).states - truth.states)
    scale = max(1.0, largest(truth.states))
    assert largest(run.states - truth.states) <= 10 * (EPS * scale + carried)


def test_energy_over_ten_thousand_seconds() -> None:
    t = np.linspace(0.0, 1e4, 101)
    run = solve(DoublePendulum.rods(), WILD, t)
    assert largest(run.energy_error) <= 1e-12
    assert run.n_steps == pytest.approx(48 * 1e4, rel=0.2)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12, EPS])
def test_the_error_follows_the_tolerance(tolerance: float) -> None:
    run = solve(SIMPLE, (2.0, 0.0), [10.0], tolerance=tolerance)
    error = largest(run.states - exact(SIMPLE, (2.0, 0.0), [10.0]).states)
    assert tolerance / 10 < error < 100 * tolerance
    assert run.request.tolerance == tolerance


def test_nothing_is_chosen_for_the_best() -> None:
    run = solve(RODS, WILD, 1.0)
    best = solve(RODS, WILD, 1.0, "taylor", tolerance=EPS)
    assert run.method == "taylor"
    assert run.request.tolerance == EPS
    assert run.request.step is None
    assert run.states.tobytes() == best.states.tobytes()


def test_a_system_that_moves_alike_gives_the_same_bits() -> None:
    bobs, bodies = DoublePendulum.bobs(), DoublePendulum.bodies(1, 1, 1, 1, 1, 0, 0)
    a, b = (solve(each, (2, 1, 0, 0), 3.0).states for each in (bobs, bodies))
    assert a.tobytes() == b.tobytes()


# ---- times ----


def test_backward_in_time() -> None:
    there = solve(SIMPLE, (1.0, 0.3), 5.0, t0=3.0)
    back = solve(SIMPLE, there.states[-1], 3.0, t0=5.0)
    assert (back.t[0], back.t[-1]) == (5.0, 3.0)
    assert (np.diff(back.t) < 0).all()
    np.testing.assert_allclose(back.states[-1], (1.0, 0.3), rtol=0, atol=1e-14)
    falling = solve(SIMPLE, (1.0, 0.3), [-1.0, -2.0])
    truth = exact(SIMPLE, (1.0, 0.3), [-1.0, -2.0])
    np.testing.assert_allclose(falling.states, truth.states, rtol=0, atol=1e-14)


def test_its_own_steps_are_its_outputs() -> None:
    run = solve(RODS, WILD, 10.0)
    assert run.t.size == run.n_steps + 1
    assert (run.t[0], run.t[-1]) == (0.0, 10.0)
    assert run.states[0].tolist() == list(WILD)
    assert (np.diff(run.t) > 0).all()
    assert run.outcome == "reached_end"


def test_output_times_do_not_change_the_run() -> None:
    own = solve(RODS, WILD, 20.0)
    few = solve(RODS, WILD, [0.0, 1e-9, 3.0, 20.0])
    assert few.n_steps == own.n_steps
    assert few.states[0].tolist() == list(WILD)
    assert (few.states[-1] == own.states[-1]).all()
    assert (solve(RODS, WILD, own.t).states == own.states).all()


def test_a_late_start_changes_nothing() -> None:
    early, late = (solve(RODS, WILD, t0 + np.arange(1.0, 9.0), t0=t0) for t0 in (0.0, 1024.0))
    np.testing.assert_allclose(late.states, early.states, rtol=0, atol=1e-9)


# ---- dense output ----


@pytest.mark.parametrize(("t0", "end"), [(0.0, 30.0), (-5.0, 400.0), (7.0, -20.0)])
@pytest.mark.parametrize("method", NAMES)
def test_dense_output_is_what_the_run_would_have_put_out(
    method: MethodName, t0: float, end: float
) -> None:
    run = solve(RODS, WILD, end, method, t0=t0)
    t = np.random.default_rng(3).uniform(min(t0, end), max(t0, end), 3000)
    t = np.unique(np.concatenate([t, run.t]))[:: 1 if end > t0 else -1]
    asked = solve(RODS, WILD, t, method, t0=t0)
    assert run.at(t).tobytes() == asked.states.tobytes()
    assert run.at(run.t).tobytes() == run.states.tobytes()
    shuffled = np.random.default_rng(4).permutation(t.size)
    assert asked.at(t[shuffled]).tobytes() == asked.states[shuffled].tobytes()


def test_dense_output_takes_any_shape() -> None:
    run = solve(RODS, WILD, 2.0)
    assert run.at(1.0).shape == (4,)
    assert run.at([]).shape == (0, 4)
    assert run.at([[0.5, 1.0, 0.5]]).shape == (1, 3, 4)
    assert (run.at([0.5, 0.5])[0] == run.at(0.5)).all()
    assert run.at(0.0).tolist() == list(WILD)


@pytest.mark.parametrize("t", [-0.1, 2.0001, [1.0, 3.0], math.nan])
def test_dense_output_ends_with_the_run(t: Any) -> None:
    with pytest.raises(
        ValueError, match="^t must (lie within the run, from 0.0 to 2.0 s|hold finite)"
    ):
        solve(RODS, WILD, 2.0).at(t)


def test_dense_output_of_a_run_longer_than_its_memory() -> None:
    """Beyond 16 thousand steps only some of their starts are kept."""
    run = solve(SIMPLE, (1.0, 0.0), [2000.0])
    assert run.n_steps > 2**14
    t = np.linspace(0.0, 2000.0, 501)
    assert run.at(t).tobytes() == solve(SIMPLE, (1.0, 0.0), t).states.tobytes()


def test_a_run_goes_through_pickle(monkeypatch: pytest.MonkeyPatch) -> None:
    run = solve(RODS, WILD, 10.0)
    again = pickle.loads(pickle.dumps(run))
    assert again.states.tobytes() == run.states.tobytes()
    t = np.linspace(10.0, 0.0, 77)
    assert again.at(t).tobytes() == run.at(t).tobytes()
    monkeypatch.setattr(_engine, "solve", None)  # made once
    assert again.at(t).tobytes() == run.at(t).tobytes()


# ---- how it ends ----


def test_the_step_limit() -> None:
    run = solve(RODS, WILD, 10.0, max_steps=25)
    assert (run.outcome, run.t.size, run.n_steps) == ("step_limit", 26, 25)
    assert run.at(run.t).tobytes() == run.states.tobytes()


def test_its_own_steps_are_not_endless() -> None:
    """As long as nobody says how many there may be: ten million, at 400 MB."""
    run = solve(LinearPendulum(), (1.0, 0.0), 1e9, "dop853", tolerance=1e-3)
    assert (run.outcome, run.t.size) == ("step_limit", 10_000_001)
    assert 0.0 <= run.reached - run.t[-1] <= math.ulp(run.reached)  # never before its last output
    assert solve(RODS, WILD, [10.0]).outcome == "reached_end"


def test_an_angle_beyond_the_sine_ends_the_run() -> None:
    run = solve(SIMPLE, (2.0**26 - 1, 100.0), 1.0)
    assert run.outcome == "not_finite"
    assert 0.005 < run.t[-1] < 0.02
    assert np.isfinite(run.states).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"step": 0.01},
            "^step is not taken by the adaptive method 'taylor', got 0.01; leave it out",
        ),
        ({"tolerance": 0.0}, "^tolerance must lie between 2"),
        (
            {"tolerance": 1e-2},
            r"^tolerance must lie between 2\^-52 = 2\.22\S* and 0\.001, got 0\.01",
        ),
        ({"tolerance": 1e-17}, "got 1e-17; for more digits than a double has, take digits=12, say"),
        ({"tolerance": "best"}, "^tolerance must be a number, got 'best'"),
        (
            {"tolerance": 1e-9, "method": "rk4", "step": 0.1},
            "^tolerance is not taken by the fixed-st",
        ),
        ({"max_steps": 0}, "^max_steps must be a whole number from 1"),
        ({"certify": 0.0}, r"^certify must be positive \[rad\], got 0.0"),
        ({"certify": 2.0}, "^certify must be an angle of at most 1 rad, got 2.0"),
        ({"digits": 16}, "^digits must be a whole number from 1 to 15, got 16"),
        (
            {"digits": 9, "method": "rk4", "step": 0.1},
            "^digits is not taken together with .*method.*rk4",
        ),
        ({"digits": 9, "tolerance": 1e-9}, "^digits is not taken together with tolerance: it"),
        ({"digits": 9, "certify": 1e-9}, "^digits is not taken together with certify: it chooses"),
        ({"digits": 9, "max_steps": 9}, "^digits is not taken together with max_steps: it chooses"),
    ],
)
def test_bad_arguments_get_one_clear_line(change: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message) as error:
        solve(**{"system": RODS, "state": WILD, "t": 1.0, **change})
    assert "\n" not in str(error.value)


def test_progress_is_told_and_may_end_the_run() -> None:
    told: list[float] = []
    solve(RODS, WILD, [600.0], progress=told.append)
    assert len(told) > 10
    assert told == sorted(told)
    assert 0 < told[0] < told[-1] < 1

    def enough(share: float) -> None:
        raise RuntimeError(f"stopped at {share:.1f}")

    with pytest.raises(RuntimeError, match=r"stopped at 0\.1"):
        solve(RODS, WILD, [-500.0], progress=enough)


def test_progress_of_a_certified_run_is_that_of_the_whole() -> None:
    told: list[float] = []
    solve(SIMPLE, (1.0, 0.0), [1000.0], certify=1.0, progress=told.append)
    assert told == sorted(told)
    assert 0 < told[0] < 0.02
    assert 0.5 < told[-1] <= 1


def test_an_interrupt_ends_a_long_run_at_once() -> None:
    """A run of years ends within a second when it is interrupted."""
    code = (
        "import pendula; rods = pendula.DoublePendulum.rods(); print('ready', flush=True);"
        "pendula.solve(rods, (2, 2.5, 0, 0), [1e12])"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as run:
        assert run.stdout is not None
        assert run.stdout.readline() == "ready\n"
        time.sleep(0.3)
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=10)
    assert "KeyboardInterrupt" in errors
