import math
import signal
import subprocess
import sys
import time
from typing import Any

import numpy as np
import pytest

from catalogue import ENTRIES, FIXED, METHODS, label, made
from pendula import DoublePendulum, SimplePendulum, exact, solve
from pendula._types import MethodName
from pendula.systems import System
from stored import cases

RODS = DoublePendulum.rods(gravity=9.81)
SIMPLE = SimplePendulum(0.5, 9.81)
NAMES = [each.name for each in FIXED]
OF_RODS = [each.name for each in FIXED if "double" in each.systems]
CLOSED = [made(each.name, length=0.5) for each in ENTRIES if each.can.closed_form]

# Uniform rods, m = l = 1, g = 9.81, from rest at (2, 2.5): FLINT with 60 digits.
CHECK = {
    1.0: [-1.01478186187538306, -1.12244606910181525, -7.26181086506237487, 5.72845783468323474],
    5.0: [0.205462239524980870, -7.52104212191582645, 1.68158668590311311, 11.7276651341110641],
}


def test_the_catalogue() -> None:
    orders = {
        **{"euler": 1, "heun": 2, "rk4": 4, "symplectic-euler": 1, "verlet": 2, "yoshida4": 4},
        **{"yoshida6": 6, "yoshida8": 8, "midpoint": 2, "gauss4": 4, "gauss6": 6, "gauss8": 8},
    }
    assert {each.name: each.order for each in FIXED} == orders
    assert [each.name for each in METHODS if each.adaptive] == ["dop853", "taylor"]
    needs = {
        **dict.fromkeys(("euler", "heun", "rk4"), "flow"),
        **dict.fromkeys(("symplectic-euler", "verlet", "yoshida4", "yoshida6"), "separable"),
        **dict.fromkeys(("yoshida8",), "separable"),
        **dict.fromkeys(("midpoint", "gauss4", "gauss6", "gauss8"), "mechanical"),
        **{"dop853": "energetic", "taylor": "analytic"},
    }
    assert {each.name: each.needs for each in METHODS} == needs
    assert all(each.source for each in METHODS)
    assert {each.name for each in METHODS if each.symplectic} == {
        name for name, need in needs.items() if need in ("separable", "mechanical")
    }


def test_which_systems_a_method_takes_follows_from_what_it_needs() -> None:
    takers: dict[str, set[tuple[str, ...]]] = {}
    for each in METHODS:
        takers.setdefault(each.needs, set()).add(each.systems)
    assert all(len(systems) == 1 for systems in takers.values())
    all_systems = tuple(each.name for each in ENTRIES)
    assert takers["flow"] == {all_systems}
    assert all(set(systems) <= set(all_systems) for each in takers.values() for systems in each)


def test_rods_reach_the_check_values() -> None:
    run = solve(RODS, (2.0, 2.5, 0.0, 0.0), list(CHECK), "rk4", step=1e-4)
    np.testing.assert_allclose(run.states, list(CHECK.values()), rtol=0, atol=1e-9)
    assert (run.n_steps, run.n_evaluations, run.outcome) == (50000, 200000, "reached_end")


def test_the_stored_solutions_of_the_double_pendulum() -> None:
    for case in cases("double.json"):
        p = {key: float(value) for key, value in case["params"].items()}
        system = DoublePendulum.rods(p["m1"], p["m2"], p["l1"], p["l2"], p["g"])
        t = [float(x) for x in case["times"] if float(x) <= 2]
        run = solve(system, [float(x) for x in case["state"]], t, "rk4", step=1e-4)
        want = np.array(case["states"], dtype=float)[: len(t)]
        np.testing.assert_allclose(run.states, want, rtol=0, atol=2e-9)


@pytest.mark.parametrize(
    ("method", "system"), [(m, s) for m in FIXED for s in CLOSED if s.name in m.systems], ids=label
)
def test_the_measured_order_is_the_order(system: Any, method: Any) -> None:
    start, end = (2.0, 0.0), 1.0
    truth = exact(system, start, end).states[-1]
    small = {1: 1e-3, 2: 1e-8, 4: 1e-9, 6: 1e-10, 8: 1e-10}[method.order]  # and above rounding
    step, errors = 0.25, [1.0]
    while errors[-1] > small:
        step /= 2
        run = solve(system, start, end, method.name, step=step)
        errors.append(np.abs(run.states[-1] - truth).max())
    slope = math.log2(errors[-2] / errors[-1])
    assert slope == pytest.approx(method.order, abs=0.3 if method.order == 8 else 0.1)


@pytest.mark.parametrize("method", OF_RODS)
def test_output_times_do_not_change_the_grid(method: MethodName) -> None:
    start = (1.0, -0.5, 0.2, 0.3)
    own = solve(RODS, start, 1.0, method, step=0.01)
    assert own.t.size == 101
    assert own.t[-1] == 1.0
    asked = solve(RODS, start, [0.0, 0.123, 0.3, 0.30000000000001, 0.999, 1.0], method, step=0.01)
    assert (asked.states[[0, 2, 5]] == own.states[[0, 30, 100]]).all()
    assert (asked.states[3] == own.states[30]).all()  # within 1e−9 of a step
    again = solve(RODS, own.states[12], [0.003], method, step=0.003)
    np.testing.assert_allclose(asked.states[1], again.states[0], rtol=1e-14)
    assert asked.n_steps == 102


def test_the_last_step_is_shortened_to_the_end() -> None:
    run = solve(SIMPLE, (1.0, 0.0), 0.25, "rk4", step=0.1)
    np.testing.assert_allclose(run.t, [0, 0.1, 0.2, 0.25])
    assert run.n_steps == 3


@pytest.mark.parametrize("method", NAMES)
def test_backward_in_time(method: MethodName) -> None:
    there = solve(SIMPLE, (1.0, 0.3), 5.0, method, t0=3.0, step=1e-4)
    back = solve(SIMPLE, there.states[-1], 3.0, method, t0=5.0, step=1e-4)
    assert back.t[0] == 5.0
    assert back.t[-1] == 3.0
    np.testing.assert_allclose(
        back.states[-1], (1.0, 0.3), atol=0.02 if "euler" in method else 1e-6
    )
    falling = solve(SIMPLE, (1.0, 0.3), [-1.0, -2.0], method, step=0.25)
    assert falling.t.tolist() == [-1.0, -2.0]


def test_a_late_start_changes_nothing() -> None:
    early = solve(SIMPLE, (1.0, 0.0), 2.0, "rk4", step=0.125)
    late = solve(SIMPLE, (1.0, 0.0), 1002.0, "rk4", t0=1000.0, step=0.125)
    assert (late.states == early.states).all()
    assert (late.t == early.t + 1000).all()


def test_two_descriptions_with_the_same_constants_give_the_same_bits() -> None:
    bobs = DoublePendulum.bobs(gravity=9.5)
    bodies = DoublePendulum.bodies(1, 1, 1, 1, 1, 0, 0, 9.5)
    a, b = (solve(each, (2, 1, 0, 0), 3.0, "rk4", step=0.01) for each in (bobs, bodies))
    assert (a.states == b.states).all()


def test_a_run_that_blows_up_ends_with_what_it_reached() -> None:
    run = solve(RODS, (2.0, 1.0, 0.0, 0.0), 1000.0, "euler", step=1.0)
    assert run.outcome == "not_finite"
    assert run.t.size == run.states.shape[0] < 100
    assert np.isfinite(run.states).all()


def test_an_angle_beyond_the_sine_ends_the_run() -> None:
    run = solve(SIMPLE, (2.0**26 - 1, 100.0), 1.0, "rk4", step=1e-3)
    assert run.outcome == "not_finite"
    assert 0.005 < run.t[-1] < 0.02


def test_the_step_limit() -> None:
    run = solve(SIMPLE, (1.0, 0.0), 1.0, "rk4", step=0.01, max_steps=25)
    assert (run.outcome, run.t.size, run.n_steps) == ("step_limit", 26, 25)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"method": "rk5"},
            f"^method must be one of {', '.join(m.name for m in METHODS)}; got 'rk5'",
        ),
        ({"step": None}, "^step is needed by the fixed-step method 'rk4'"),
        ({"step": 0}, r"^step must be positive \[s\], got 0\.0"),
        ({"step": -1e-3}, "^step must be positive"),
        ({"step": math.nan}, "^step must be a finite number"),
        ({"step": 2.0}, r"^step must not exceed the span of 1\.0 s .*got 2\.0 s"),
        ({"step": 1e-9}, r"makes 1e\+09 outputs .*give output times"),
        ({"step": 1e-20, "t": [1.0]}, r"too small.*over 2\^53 steps"),
        ({"t": 0.0}, r"^t must differ from t0 = 0\.0 s"),
        ({"t": []}, r"^t must be one end time or output times of shape \(n,\)"),
        ({"t": [0.5, 0.2]}, r"^t must rise \(or fall\) strictly"),
        ({"t": [0.5, 0.5]}, r"^t must rise \(or fall\) strictly"),
        ({"t": [-1.0, 1.0]}, r"^t must rise \(or fall\) strictly"),
        ({"t": math.inf}, "^t must hold finite numbers"),
        ({"state": (1.0,)}, r"^state must be \(theta, omega\)"),
        ({"state": [(1.0, 0.0)]}, r"^state must be one state of shape \(2,\)"),
        ({"state": (1.0, math.nan)}, r"^state must hold finite numbers, got nan at state\[1\]"),
        ({"t0": math.nan}, "^t0 must be a finite number"),
        ({"max_steps": 0}, "^max_steps must be a whole number"),
        ({"max_steps": True}, "^max_steps must be a whole number"),
        ({"step": "0.1"}, "^step must be a number"),
        ({"step": 10**400}, "^step must be a finite number"),
        ({"t": "1"}, "^t must hold numbers"),
        ({"t0": 1e17, "t": 1e17 + 1600, "step": 1.0}, r"below the rounding of times"),
        ({"system": RODS}, r"^state must be \(theta1, theta2, omega1, omega2\)"),
    ],
)
def test_bad_arguments_get_one_clear_line(change: dict[str, Any], message: str) -> None:
    arguments = {"system": SIMPLE, "state": (1.0, 0.0), "t": 1.0, "method": "rk4", "step": 0.01}
    with pytest.raises(ValueError, match=message) as error:
        solve(**{**arguments, **change})
    assert "\n" not in str(error.value)


def test_a_run_does_not_change_with_what_it_was_made_from() -> None:
    start, times = np.array([1.0, 0.0]), np.array([0.5, 1.0])
    runs = solve(SIMPLE, start, times, "rk4", step=0.1), exact(SIMPLE, start, times)
    start[0] = times[0] = 9.0
    for run in runs:
        assert run.request.state.tolist() == [1.0, 0.0]
        assert run.t.tolist() == [0.5, 1.0]
        assert np.abs(run.energy_error).max() < 1e-3


def test_energy_error_is_relative_and_has_a_scale_at_rest() -> None:
    run = solve(RODS, (2.0, 2.5, 0.0, 0.0), 2.0, "heun", step=1e-2)
    energy = RODS.energy(run.states)
    np.testing.assert_allclose(run.energy_error, (energy - energy[0]) / energy[0])
    assert np.abs(run.energy_error).max() > 1e-6
    rest = solve(RODS, (0.0, 0.0, 0.0, 0.0), 1.0, "rk4", step=0.1)
    assert (rest.energy_error == 0).all()


@pytest.mark.parametrize(
    ("system", "start"),
    [
        (SIMPLE, (math.tau, 0.0)),
        (SIMPLE, (-2 * math.tau, 0.0)),
        (SIMPLE, (math.nextafter(math.tau, 7.0), 0.0)),
        (SIMPLE, (1e6 * math.tau, 0.0)),
        (SIMPLE, (math.tau, 1e-16)),
        (SIMPLE, (1e-160, 0.0)),  # 1e-320 J has three digits
        (RODS, (math.tau, -math.tau, 0.0, 0.0)),
        (RODS, (0.0, 3 * math.tau, 0.0, 0.0)),
    ],
)
def test_energy_error_of_a_start_at_rest_is_that_of_the_pendulum(
    system: System, start: tuple[float, ...]
) -> None:
    """The energy of such a start is the rounding of 2π n, and nothing that errors are parts of."""
    runs = [solve(system, start, end, "rk4", step=0.01) for end in (1.0, -1.0)]
    if system.can.closed_form:
        runs.append(exact(system, start, np.linspace(-1.0, 1.0, 9)))
    for run in runs:
        assert np.abs(run.energy_error).max() < 1e-15


@pytest.mark.parametrize("angle", [math.tau, -2 * math.tau, 100 * math.tau, math.tau + 1e-12])
@pytest.mark.parametrize("omega", [0.0, 6e-16, 6e-12, 1e-9, 1e-3])
def test_energy_error_beside_a_whole_turn_is_not_that_of_the_angle(
    angle: float, omega: float
) -> None:
    """Its rounding is far larger than in the same swing about 0, where dop853 takes tiny steps."""
    for system, start in ((SIMPLE, (angle, omega)), (RODS, (angle, -angle, 0.0, omega))):
        for run in (solve(system, start, 5.0), solve(system, start, 0.05, "dop853")):
            assert np.abs(run.energy_error).max() < 1e-12


@pytest.mark.parametrize("angle", [1e-3, 1e-9, 1e-100, math.tau + 0.1])
def test_energy_error_of_a_small_swing_is_relative_to_its_own_energy(angle: float) -> None:
    run = solve(SIMPLE, (angle, 0.0), 1.0, "heun", step=0.01)
    energy = SIMPLE.energy(run.states)
    np.testing.assert_allclose(run.energy_error, (energy - energy[0]) / energy[0])


def test_energy_error_of_several_starts_has_the_scale_of_each() -> None:
    starts = np.array([[math.tau, 0.0], [1.0, 0.0], [0.0, 0.0]])
    together = exact(SIMPLE, starts, np.linspace(0.0, 2.0, 7)).energy_error
    for start, errors in zip(starts, together, strict=True):
        alone = exact(SIMPLE, start, np.linspace(0.0, 2.0, 7)).energy_error
        np.testing.assert_array_equal(errors, alone)


def test_dense_output_is_refused_where_there_is_none() -> None:
    with pytest.raises(ValueError, match="dense output, got 'rk4'"):
        solve(SIMPLE, (1.0, 0.0), 1.0, "rk4", step=0.1).at(0.5)


def test_progress_is_told_and_may_end_the_run() -> None:
    told: list[float] = []
    solve(SIMPLE, (1.0, 0.0), [1.0], "rk4", step=1e-5, progress=told.append)
    assert told == pytest.approx([n * 2**14 / 100_000 for n in range(1, 7)])

    def enough(share: float) -> None:
        raise RuntimeError(f"stopped at {share}")

    with pytest.raises(RuntimeError, match=r"stopped at 0\.16384"):
        solve(SIMPLE, (1.0, 0.0), [1.0], "rk4", step=1e-5, progress=enough)


def test_an_interrupt_ends_a_long_run() -> None:
    """A run of a day ends when it is interrupted, with Python's own exception."""
    code = (
        "import numpy, pendula; print('ready', flush=True);"
        "pendula.solve(pendula.SimplePendulum(), (1, 0), [1e6], 'rk4', step=1e-6)"
    )
    with subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as run:
        assert run.stdout is not None
        assert run.stdout.readline() == "ready\n"
        time.sleep(0.3)
        run.send_signal(signal.SIGINT)
        _, errors = run.communicate(timeout=20)
    assert "KeyboardInterrupt" in errors
