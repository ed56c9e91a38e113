"""Friction, drive and a moving pivot against solutions with 40 digits, and against closed forms."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from mpmath import mp, mpf

import refusals
from pendula import (
    DampedDoublePendulum,
    DoublePendulum,
    DrivenPendulum,
    LinearPendulum,
    SimplePendulum,
    ensemble,
    exact,
    solve,
)
from pendula.events import velocity_zero
from pendula.plot import svg
from stored import document


def told(call: Any, *args: Any, **options: Any) -> str:
    return refusals.told(lambda: call(*args, **options))


CASES = document("driven.json")["cases"]


def system_of(given: dict[str, Any]) -> Any:
    """The system of a stored case, whose friction is per moment of inertia."""
    length = given["L"]
    inertia = length * length
    if given.get("linear"):
        return LinearPendulum(length, given["g"], 1.0, viscous=given.get("b", 0.0) * inertia)
    real = {
        "viscous": given.get("b", 0.0) * inertia,
        "coulomb": given.get("c", 0.0) * inertia,
        "quadratic": given.get("q", 0.0) * inertia,
    }
    if "A" in given:
        real |= {"torque": given["A"] * inertia, "drive_frequency": given["W"]}
    for name, direction in (("av", math.pi / 2), ("ah", 0.0)):
        if name in given:
            real |= {
                "pivot_amplitude": given[name] * length,
                "pivot_frequency": given["W"],
                "pivot_phase": given.get("phi", 0.0),
                "pivot_direction": direction,
            }
    return DrivenPendulum.bob(length, given["g"], 1.0, **real)


SOLVED = [each for each in CASES if not {"c", "linear"} <= set(each["parameters"])]
STOPPED = [each for each in SOLVED if "stops" in each]


def error_of_inputs(case: dict[str, Any]) -> np.ndarray[Any, Any]:
    """What half an ulp in the start and in gravity changes each output by, (n,)."""
    system, t = system_of(case["parameters"]), [each["t"] for each in case["results"]]
    run = solve(system, case["state"], t, derivatives=("theta", "omega", "gravity"))
    assert run.derivatives is not None
    inputs = np.abs([*case["state"], system.gravity])
    changes = np.abs(run.derivatives) @ (2.0**-53 * np.maximum(inputs, 1e-3))
    return np.asarray(np.maximum(changes.max(axis=1), 2.0**-53 * np.abs(run.states).max()))


@pytest.mark.parametrize("case", SOLVED, ids=lambda case: case["name"])
def test_the_stored_solutions(case: dict[str, Any]) -> None:
    system, results = system_of(case["parameters"]), case["results"]
    want = np.array([(float(each["theta"]), float(each["omega"])) for each in results])
    t = [each["t"] for each in results]
    error = np.abs(solve(system, case["state"], t).states - want).max(axis=1)
    assert (error < 100 * error_of_inputs(case)).all()
    loose = np.abs(solve(system, case["state"], t[:2], "dop853").states - want[:2]).max(axis=1)
    assert (loose < 1e-12 * np.abs(want).max()).all()
    guaranteed = solve(system, case["state"], t, digits=12).states
    assert (np.abs(guaranteed - want) < 1e-12 * np.maximum(1.0, np.abs(want))).all()


@pytest.mark.parametrize("case", STOPPED, ids=lambda case: case["name"])
def test_where_and_when_dry_friction_stops_it(case: dict[str, Any]) -> None:
    run = solve(system_of(case["parameters"]), case["state"], 60.0)
    turned = case["turning_points"]
    assert len(run.pieces.times) == len(turned)
    np.testing.assert_allclose(run.pieces.times, [float(each["t"]) for each in turned], rtol=1e-12)
    assert run.pieces.states[-1, 0] == 0.0
    np.testing.assert_allclose(run.theta[-1], float(case["stops"]["theta"]), rtol=1e-12)
    assert run.omega[-1] == 0.0


@pytest.mark.parametrize(("coulomb", "quadratic"), [(0.7, 0.0), (0.0, 0.3), (0.4, 0.2)])
def test_turning_points_obey_the_first_integral(coulomb: float, quadratic: float) -> None:
    # G(−α) e^(−2qα) = G(β) e^(2qβ), G(θ) = 2ω0² (cos θ − 2q sin θ)/(1 + 4q²) − c/q, per inertia
    system = DrivenPendulum.body(1.5, 0.4, 2.0, 9.81, coulomb=2 * coulomb, quadratic=2 * quadratic)
    run = solve(system, (2.5, 0.0), 20.0)
    angles = np.concatenate([[2.5], run.at(run.pieces.times)[:, 0]])
    turned = angles * np.resize(
        [1.0, -1.0], len(angles)
    )  # where it stops, it may be short of the bottom
    squared = 1.5 * 9.81 * 0.4 / 2.0
    assert len(turned) > 4
    for before, after in itertools.pairwise(turned):
        if quadratic == 0.0:
            assert (
                abs(np.cos(after) - np.cos(before) - coulomb / squared * (before + after)) < 1e-14
            )
            continue

        def integral(theta: float) -> float:
            swing = math.cos(theta) - 2 * quadratic * math.sin(theta)
            return 2 * squared * swing / (1 + 4 * quadratic**2) - coulomb / quadratic

        left = integral(-before) * math.exp(-2 * quadratic * before)
        assert abs(left - integral(after) * math.exp(2 * quadratic * after)) < 1e-12 * squared


def test_without_friction_and_drive_it_is_the_ideal_motion() -> None:
    t = np.linspace(0.0, 20.0, 41)
    for real, ideal in (
        (DrivenPendulum.bob(0.7, 9.81, 2.0), SimplePendulum(0.7, 9.81, 2.0)),
        (DampedDoublePendulum.rods(1.0, 2.0), DoublePendulum.rods(1.0, 2.0)),
        (DampedDoublePendulum.bobs(1.0, 2.0), DoublePendulum.bobs(1.0, 2.0)),
    ):
        start = (2.0, 1.0) if ideal.can.degrees_of_freedom == 1 else (2.0, 1.0, 0.0, 0.5)
        for method in ("taylor", "dop853"):
            apart = solve(real, start, t, method).states - solve(ideal, start, t, method).states
            assert np.abs(apart).max() < 1e-11 * np.exp(0.0 if len(start) == 2 else 3.0)


def test_a_body_like_a_bob_moves_like_it() -> None:
    real: dict[str, float] = {"viscous": 0.1, "cubic": 0.02, "torque": 0.5, "drive_frequency": 2.0}
    real |= {"pivot_amplitude": 0.1, "pivot_frequency": 5.0, "pivot_direction": 0.4}
    bob = DrivenPendulum.bob(0.8, 9.81, 1.5, **real)
    body = DrivenPendulum.body(1.5, 0.8, 1.5 * 0.8**2, 9.81, **real)
    runs = [solve(each, (1.0, 0.0), [10.0]) for each in (bob, body)]
    np.testing.assert_allclose(runs[0].states, runs[1].states, rtol=0, atol=1e-11)


def test_the_inverted_pendulum_stands_above_the_threshold_alone() -> None:
    for row in document("driven.json")["exact_thresholds"]["kapitza"]:
        for factor, stands in ((1.001, True), (0.999, False)):
            frequency = factor * float(row["critical_W_over_w0"])
            shaken = DrivenPendulum.bob(
                1.0, 1.0, 1.0, pivot_amplitude=float(row["a_over_L"]), pivot_frequency=frequency
            )
            run = solve(shaken, (math.pi + 1e-6, 0.0), np.linspace(0.0, 400.0, 4001))
            assert (np.abs(run.theta - math.pi).max() < 1e-2) == stands


def test_dry_friction_holds_a_release_from_rest() -> None:
    held = DrivenPendulum.bob(coulomb=2.0)
    run = solve(held, (0.2, 0.0), 1e4)  # m g L sin 0.2 = 1.95 N m
    assert run.outcome == "reached_end"
    assert (run.states == run.states[0]).all()
    assert len(run.pieces.times) == 0
    assert run.pieces.start.tolist() == [0.0]
    assert run.n_steps == 1  # nothing will change
    assert solve(held, (0.21, 0.0), 10.0).states[-1, 0] != 0.21


@pytest.mark.parametrize("speed", [6.505, 6.51])
def test_dry_friction_can_hold_it_beside_the_top(speed: float) -> None:
    run = solve(DrivenPendulum.bob(coulomb=0.5), (0.0, speed), 60.0)
    assert abs(run.theta[-1] - math.pi) < math.asin(0.5 / DrivenPendulum.bob().gravity)
    assert run.omega[-1] == 0.0
    assert run.pieces.states.ravel().tolist() == [0.0]


def test_turning_and_stopping_are_events_of_the_velocity() -> None:
    for method in ("taylor", "dop853"):
        run = solve(
            DrivenPendulum.bob(coulomb=0.2), (1.0, 0.0), 60.0, method, events=velocity_zero(1)
        )
        assert np.array_equal(run.events[0].times, run.pieces.times)
        assert (np.abs(run.events[0].states[:, 1]) < 1e-14).all()


def test_it_breaks_loose_where_the_drive_passes_friction() -> None:
    # at rest at the bottom, τ cos(Ω t − π/2) = τ sin Ω t passes τc
    driven = DrivenPendulum.bob(
        coulomb=1.0, torque=1.25, drive_frequency=0.5, drive_phase=-math.pi / 2
    )
    run = solve(driven, (0.0, 0.0), 20.0)
    assert run.pieces.states[0, 0] == 1.0
    with mp.workdps(40):  # of the doubles given
        phase = -mpf(driven.drive_phase) - mp.acos(mpf(1.0) / mpf(1.25))
        assert abs(run.pieces.times[0] - phase / mpf(0.5)) < 1e-14
    assert np.abs(run.energy_error).max() < 1e-15


JOINTS = [
    DampedDoublePendulum.rods(viscous=(0.05, 0.02), coulomb=(0.3, 0.2)),
    DampedDoublePendulum.bobs(1.0, 0.3, 0.5, 0.8, coulomb=(0.0, 0.3)),
    DampedDoublePendulum.bodies(2.0, 1.0, 0.5, 0.2, 0.3, 0.1, 0.02, coulomb=(0.5, 0.0)),
]


@pytest.mark.parametrize("system", JOINTS, ids=lambda each: each.form)
@pytest.mark.parametrize(
    "start", [(2.0, 1.0, 0.0, 0.0), (0.5, -0.4, 3.0, -8.0), (0.3, 0.3, 2.0, 2.0)]
)
def test_joints_slip_and_stick_by_the_rule(system: Any, start: Any) -> None:
    run = solve(system, start, 30.0)
    times, states = run.pieces.times, run.pieces.states
    edges = np.concatenate([times, run.t[-1:]])
    for sense, begin, end in zip(states, edges, edges[1:], strict=False):
        inside = begin + (end - begin) * np.linspace(0.02, 0.98, 25)
        y = run.at(inside)
        velocities = np.stack([y[:, 2], y[:, 3] - y[:, 2]], axis=1)
        for joint, limit in enumerate(system.coulomb):
            if limit == 0.0:
                continue
            if sense[joint] == 0.0:
                assert np.abs(velocities[:, joint]).max() < 1e-13
            else:
                assert (velocities[:, joint] * sense[joint] > -1e-13).all()
    assert np.abs(run.energy_error).max() < 1e-13
    other = solve(system, start, 30.0, "dop853")
    assert len(other.pieces.times) == len(times)
    np.testing.assert_allclose(other.pieces.times, times, rtol=0, atol=1e-10)
    np.testing.assert_allclose(other.states[-1], run.states[-1], rtol=0, atol=1e-10)


STICKING = (
    *JOINTS,
    DrivenPendulum.bob(coulomb=0.2, quadratic=0.05),
    DrivenPendulum.bob(coulomb=1.0, torque=1.5, drive_frequency=2.0),
)


@pytest.mark.parametrize("system", STICKING, ids=repr)
def test_pieces_go_through_dense_output_ensembles_and_more_digits(system: Any) -> None:
    start = np.array([1.0, 0.0] if system.can.degrees_of_freedom == 1 else [1.0, 0.5, 0.0, 1.0])
    t = np.linspace(0.0, 25.0, 101)
    run = solve(system, start, t)
    assert np.array_equal(solve(system, start, 25.0).at(t), run.states)
    starts = start * np.linspace(0.2, 1.0, 5)[:, np.newaxis]
    many = ensemble(system, starts, t)
    assert all(
        np.array_equal(many.states[i], solve(system, each, t).states)
        for i, each in enumerate(starts)
    )
    assert solve(system, start, 25.0, certify=1e-9).trust_horizon == math.inf
    digits = solve(system, start, t[1:20:6], digits=12)
    np.testing.assert_allclose(digits.states, run.states[1:20:6], rtol=0, atol=1e-11)


def test_linear_pendulums_with_and_without_friction_go_together() -> None:
    systems = [LinearPendulum(viscous=viscous) for viscous in (0.0, 0.1, 0.2)]
    assert [each.name for each in systems] == ["linear", "driven-linear", "driven-linear"]
    t = np.linspace(0.0, 10.0, 11)
    both: list[tuple[Any, dict[str, Any]]] = [
        ("taylor", {}),
        ("dop853", {}),
        ("rk4", {"step": 0.01}),
    ]
    for method, options in both:
        many = ensemble(systems, (0.5, 0.1), t, method, **options)
        for states, each in zip(many.states, systems, strict=True):
            assert np.array_equal(states, solve(each, (0.5, 0.1), t, method, **options).states)


def test_the_pieces_are_those_of_the_run_that_was_made() -> None:
    run = solve(DrivenPendulum.bob(coulomb=0.2), (1.0, 0.0), 60.0)
    again = replace(run, changes=None).pieces
    assert "_result_again" not in vars(run)  # no second run was needed
    assert all(np.array_equal(a, b) for a, b in zip(run.pieces, again, strict=True))


def test_what_real_pendulums_refuse() -> None:
    dry = DrivenPendulum.bob(coulomb=0.1)
    message = told(solve, dry, (1.0, 0.0), -5.0)
    assert message.startswith("t must be later than t0")
    assert "coulomb" in message
    for method in ("verlet", "gauss8", "midpoint"):
        message = told(solve, dry, (1.0, 0.0), 5.0, method, step=0.01)
        assert "without friction and drive" in message
        assert "taylor" in message
    assert "no closed form is known" in told(exact, dry, (1.0, 0.0), 1.0)
    assert "period" in told(LinearPendulum(viscous=0.1).period)
    assert "viscous must not be negative" in told(DrivenPendulum.bob, viscous=-0.1)
    assert "two numbers" in told(DampedDoublePendulum.rods, coulomb=0.1)
    assert "q must be positive" in told(DrivenPendulum.scaled, 0.0, 1.0, 1.0)


def test_the_picture_of_a_run_names_the_balance() -> None:
    run = solve(DrivenPendulum.bob(viscous=0.1), (1.0, 0.0), 10.0)
    assert b"balance" in svg(run.plot())
    assert b"balance" in svg(run.plot(language="es"))
