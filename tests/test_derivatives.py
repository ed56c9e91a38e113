"""How motions change with start and parameters, against solutions with many digits."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import refusals
from pendula import (
    DampedDoublePendulum,
    DoublePendulum,
    DrivenPendulum,
    SimplePendulum,
    ensemble,
    events,
    solve,
)
from stored import document


def told(call: Any, *args: Any, **options: Any) -> str:
    return refusals.told(lambda: call(*args, **options))


STORED = document("variational.json")


def double_of(given: dict[str, Any]) -> DoublePendulum:
    values = {key: given[key] for key in ("m1", "m2", "l1", "l2", "gravity")}
    made: DoublePendulum = getattr(DoublePendulum, given["form"])(**values)
    return made


@pytest.mark.parametrize("case", STORED["double"], ids=lambda case: case["name"])
def test_the_matrix_of_the_double_pendulum(case: dict[str, Any]) -> None:
    system, t = double_of(case["system"]), [float(each["t"]) for each in case["values"]]
    run = solve(system, case["state"], t, derivatives="state")
    plain = solve(system, case["state"], t)
    assert np.array_equal(run.states, plain.states)
    assert run.derivatives is not None
    assert run.derivative_names == system.components
    for time, found, stored in zip(t, run.derivatives, case["values"], strict=True):
        want = np.array(stored["phi"], dtype=float)
        size = np.abs(want).max()
        if size > 1e11:
            break
        allowed = 1e-12 if time <= 2.0 else 1e-11 + 200 * 2.0**-53 * size
        assert np.abs(found - want).max() / size < allowed


@pytest.mark.parametrize("case", STORED["double"], ids=lambda case: case["name"])
def test_the_matrix_through_lanes(case: dict[str, Any]) -> None:
    """Where the series of the variations is worked out by hand, and each column for itself."""
    system, t = double_of(case["system"]), [float(each["t"]) for each in case["values"]]
    many = ensemble(system, [case["state"]] * 5, t, derivatives="state")
    plain = ensemble(system, [case["state"]] * 5, t)
    column = ensemble(system, [case["state"]], t, derivatives="omega1")
    assert many.derivatives is not None
    assert column.derivatives is not None
    assert np.array_equal(many.states, plain.states)
    assert np.array_equal(many.n_steps, plain.n_steps)
    assert np.all(many.derivatives == many.derivatives[0])
    assert np.array_equal(column.derivatives[0, :, :, 0], many.derivatives[0, :, :, 2])
    for time, found, stored in zip(t, many.derivatives[0], case["values"], strict=True):
        want = np.array(stored["phi"], dtype=float)
        size = np.abs(want).max()
        if size > 1e11:
            break
        allowed = 1e-12 if time <= 2.0 else 1e-11 + 200 * 2.0**-53 * size
        assert np.abs(found - want).max() / size < allowed


@pytest.mark.parametrize("case", STORED["simple"], ids=lambda case: case["name"])
def test_the_matrix_of_the_simple_pendulum(case: dict[str, Any]) -> None:
    system = SimplePendulum(case["system"]["length"], case["system"]["gravity"])
    t = [float(each["t"]) for each in case["values"]]
    run = solve(system, case["state"], t, derivatives="state")
    assert run.derivatives is not None
    for time, found, stored in zip(t, run.derivatives, case["values"], strict=True):
        want = np.array(stored["phi"], dtype=float)
        allowed = 1e-13 * (1.0 + system.natural_frequency * time) * np.abs(want).max()
        assert np.abs(found - want).max() < allowed


@pytest.mark.parametrize("form", ["rods", "bobs"])
def test_the_flow_is_symplectic(form: str) -> None:
    system = getattr(DoublePendulum, form)(1.3, 0.7, 0.8, 1.1)
    start = np.array([1.0, -0.5, 0.5, -1.0])
    run = solve(system, start, np.linspace(0.5, 5.0, 10), derivatives="state")
    assert run.derivatives is not None
    constants = system.constants

    def momenta(y: Any) -> Any:  # d(θ, p)/d(θ, ω)
        coupling = constants["C"] * np.cos(y[0] - y[1])
        turning = constants["C"] * np.sin(y[0] - y[1])
        matrix = np.eye(4)
        matrix[2] = [-turning * y[3], turning * y[3], constants["A"], coupling]
        matrix[3] = [-turning * y[2], turning * y[2], coupling, constants["B"]]
        return matrix

    form_of = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.eye(2), np.zeros((2, 2))]])
    for y, matrix in zip(run.states, run.derivatives, strict=True):
        canonical = momenta(y) @ matrix @ np.linalg.inv(momenta(start))
        size = np.abs(canonical).max()
        assert np.abs(canonical.T @ form_of @ canonical - form_of).max() < 1e-12 * size**2


MOVED = DrivenPendulum.bob(
    0.9,
    9.81,
    1.2,
    viscous=0.1,
    cubic=0.01,
    torque=0.5,
    drive_frequency=2.0,
    drive_phase=0.3,
    pivot_amplitude=0.05,
    pivot_frequency=7.0,
    pivot_phase=0.2,
    pivot_direction=0.6,
)
STUCK = DrivenPendulum.body(1.2, 0.4, 0.5, 9.81, coulomb=1.0, torque=1.6, drive_frequency=1.5)
JOINTS = DampedDoublePendulum.rods(1.1, 0.9, 1.0, 0.8, viscous=(0.1, 0.05), coulomb=(0.4, 0.3))
BODIES = DoublePendulum.bodies(2.0, 1.0, 0.5, 0.2, 0.3, 0.1, 0.02)
REAL: list[tuple[Any, Any, float]] = [
    (MOVED, (1.0, 0.5), 5.0),
    (DrivenPendulum.bob(coulomb=0.5, quadratic=0.1), (1.5, 0.4), 6.0),
    (STUCK, (0.1, 0.7), 8.0),
    (JOINTS, (1.5, 1.0, 0.3, -0.2), 5.9),
    (BODIES, (1.5, 1.0, 0.0, 0.0), 3.0),
]


def moved(system: Any, start: Any, name: str, by: float) -> tuple[Any, Any]:
    """System and start with one number changed."""
    from pendula.systems import system_from

    if name in system.components:
        changed = list(start)
        changed[system.components.index(name)] += by
        return system, changed
    described = system.description()
    parameters = {**described["parameters"], name: described["parameters"][name] + by}
    return system_from({**described, "parameters": parameters}), start


def stencil(values: Any, h: float) -> Any:
    """The derivative of order h^4 of a function at −2h, −h, h and 2h."""
    weights = np.array([1.0, -8.0, 8.0, -1.0]) / (12.0 * h)
    return np.tensordot(weights, np.array(values), axes=1)


@pytest.mark.parametrize(("system", "start", "end"), REAL, ids=lambda x: getattr(x, "name", ""))
def test_derivatives_by_everything_are_those_of_differences(
    system: Any, start: Any, end: float
) -> None:
    t = np.linspace(0.0, end, 5)
    run = solve(system, start, t, derivatives="all")
    assert run.derivatives is not None
    assert run.derivative_names == (*system.components, *system.parameters)
    assert np.array_equal(run.derivatives[0][:, : len(start)], np.eye(len(start)))
    for k, name in enumerate(run.derivative_names):
        value = system.parameters.get(name, 1.0)
        if value == 0.0:
            continue  # friction begins there, and has no derivative from both sides
        h = 3e-4 * abs(value) if name in system.parameters else 3e-5
        runs = [
            solve(*moved(system, start, name, m * h), t[1:], digits=14).states
            for m in (-2, -1, 1, 2)
        ]
        want = stencil(runs, h)
        size = max(1.0, np.abs(run.derivatives).max())
        np.testing.assert_allclose(
            run.derivatives[1:, :, k], want, rtol=0, atol=1e-9 * size, err_msg=name
        )


@pytest.mark.parametrize("terminal", [0, 2])
@pytest.mark.parametrize(("system", "start", "end"), REAL, ids=lambda x: getattr(x, "name", ""))
def test_the_run_is_the_one_without_derivatives(
    system: Any, start: Any, end: float, terminal: int
) -> None:
    t = np.linspace(0.0, end, 23)
    asked = [events.velocity_zero(1, terminal=terminal), events.tip_height(-0.5)]
    with_them = solve(system, start, t, events=asked, derivatives="all")
    plain = solve(system, start, t, events=asked)
    assert with_them.states.tobytes() == plain.states.tobytes()
    assert with_them.t.tobytes() == plain.t.tobytes()
    for name in ("outcome", "n_steps", "n_evaluations", "reached"):
        assert getattr(with_them, name) == getattr(plain, name)
    for found, told in zip(with_them.events, plain.events, strict=True):
        assert found.times.tobytes() == told.times.tobytes()
        assert found.states.tobytes() == told.states.tobytes()
    between = np.linspace(0.0, plain.reached, 7)
    assert with_them.at(between).tobytes() == plain.at(between).tobytes()
    if hasattr(system, "coulomb"):
        assert repr(with_them.pieces) == repr(plain.pieces)


def test_events_times_and_states_change_too() -> None:
    system, start = DrivenPendulum.bob(coulomb=0.3), (1.2, 0.0)
    asked = [events.angle(1, 0.2), events.velocity_zero(1), events.tip_height(-0.9)]
    names = ("theta", "coulomb", "length")
    run = solve(system, start, 5.0, events=asked, derivatives=names)
    assert len(run.event_derivatives) == 3
    h = 1e-4
    for k, name in enumerate(names):
        runs = [
            solve(*moved(system, start, name, m * h), 5.0, events=asked).events
            for m in (-2, -1, 1, 2)
        ]
        for i, changes in enumerate(run.event_derivatives):
            count = len(run.events[i].times)
            assert changes.times.shape == (count, 3)
            assert changes.states.shape == (count, 2, 3)
            want = stencil([each[i].times for each in runs], h)
            np.testing.assert_allclose(changes.times[:, k], want, rtol=0, atol=1e-9)
            want = stencil([each[i].states for each in runs], h)
            np.testing.assert_allclose(changes.states[:, :, k], want, rtol=0, atol=1e-9)


def test_an_ensemble_has_the_derivatives_of_each_of_its_runs() -> None:
    t = np.linspace(0.0, 4.0, 3)
    for system, start, _ in REAL:
        starts = np.array(start) * np.linspace(0.5, 1.0, 7)[:, np.newaxis]
        asked = (system.components[0], list(system.parameters)[2])
        many = ensemble(system, starts, t, derivatives=asked, threads=2)
        assert many.derivative_names == asked
        assert many.derivatives is not None
        for found, each in zip(many.derivatives, starts, strict=True):
            alone = solve(system, each, t, derivatives=asked).derivatives
            assert alone is not None
            assert np.array_equal(found, alone)


def test_a_dataset_holds_them_by_name() -> None:
    system, start, end = REAL[3]
    run = solve(system, start, [1.0, end], derivatives=("omega2", "coulomb1"))
    data = run.to_xarray()
    assert run.derivatives is not None
    found = data["derivatives"].sel(component="theta1", derived_by="coulomb1")
    assert np.array_equal(found, run.derivatives[:, 0, 1])
    assert np.array_equal(data["work"] - data["heat"], run.work - run.heat)
    assert "derivatives" not in solve(system, start, [1.0]).to_xarray()


def test_what_derivatives_are_asked_for_wrongly() -> None:
    rods = DoublePendulum.rods()
    message = told(solve, rods, (1.0, 1.0, 0.0, 0.0), 1.0, derivatives="theta")
    assert "did you mean" in message
    assert "theta1" in message
    assert "Taylor" in told(
        solve, rods, (1.0, 1.0, 0.0, 0.0), 1.0, "rk4", step=0.1, derivatives="all"
    )
    assert "digits" in told(solve, rods, (1.0, 1.0, 0.0, 0.0), [1.0], digits=12, derivatives="all")
