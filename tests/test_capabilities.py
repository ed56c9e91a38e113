"""What the catalogue says that a system can is what it can."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from catalogue import SYSTEMS, TAKEN, any_states, control, label, some_state
from pendula import DoublePendulum, action, divergence_map, exact, flip_map, solve, time_at
from pendula._messages import ArgumentError
from pendula.cli.groups import one_each
from pendula.systems import ClosedForm, System, class_names_that, systems_that

every_system = pytest.mark.parametrize("system", SYSTEMS, ids=label)


def works(call: Any) -> bool:
    """Whether it does, or the system is refused by name."""
    try:
        call()
    except ArgumentError as error:
        if error.argument != "system":
            raise
        return False
    return True


@every_system
def test_a_closed_form_is_a_solution(system: System) -> None:
    start, t = some_state(system), np.linspace(0.0, 2.0, 9)
    assert isinstance(system, ClosedForm) == system.can.closed_form
    assert works(lambda: exact(system, start, t)) == system.can.closed_form
    for call in (lambda: time_at(system, start, 0.1), lambda: action(system, start)):
        assert works(call) == (system.can.closed_form and system.can.period)
    if system.can.closed_form:
        np.testing.assert_allclose(
            exact(system, start, t).states, solve(system, start, t).states, rtol=0, atol=1e-13
        )


@every_system
def test_a_period_brings_the_motion_back(system: System) -> None:
    has_period = hasattr(system, "period") and works(
        lambda: system.period(state=some_state(system))
    )
    assert has_period == system.can.period
    if system.can.period:
        start: Any = some_state(system)
        period = system.period(state=start)  # type: ignore[attr-defined]
        assert 0.0 < period < math.inf
        run = solve(system, start, [period / 2, period])
        np.testing.assert_allclose(run.states[-1], start, rtol=0, atol=1e-13)
        assert np.abs(run.states[0] - start).max() > 0.1


@every_system
def test_maps_are_made_of_what_can_be_mapped(system: Any) -> None:
    square: Any = (-1.0, 1.0), (-1.0, 1.0), (3, 3), 0.5
    for make in (flip_map, divergence_map):
        assert works(lambda make=make: make(system, *square)) == system.can.mapped
    if system.can.mapped:
        assert flip_map(system, *square)["flip_time"].shape == (3, 3)


@every_system
def test_what_conserves_energy_keeps_it(system: System) -> None:
    run = solve(system, 2.0 * some_state(system), np.linspace(0.0, 5.0, 51))
    change = run.energy / run.energy[0] - 1.0
    assert (np.abs(change).max() < 1e-13) == system.can.conservative
    assert np.abs(run.energy_error).max() < 1e-13  # of the others the balance's


@every_system
def test_equations_depend_on_time_where_they_say_so(system: System) -> None:
    states = any_states(system, 20)
    slopes = [system.rhs(states, t) for t in (0.0, 0.3, 3.0, -1e3)]
    alike = all(each.tobytes() == slopes[0].tobytes() for each in slopes)
    assert alike == system.can.autonomous


@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_a_late_start_changes_nothing_but_the_times(method: Any, system: System) -> None:
    start, t = some_state(system), np.array([0.25, 0.5, 1.0])
    early, late = (
        solve(system, start, t0 + t, method.name, t0=t0, **control(method, 2.0**-7))
        for t0 in (0.0, 3.0)
    )
    # a step of an adaptive method ends where times round otherwise
    allowed = 1e-14 if method.adaptive else 0.0
    alike = np.abs(late.states - early.states).max() <= allowed
    assert alike == system.can.autonomous
    assert late.n_steps == early.n_steps or not system.can.autonomous


@every_system
def test_whole_turns_change_nothing_where_angles_are_directions(system: System) -> None:
    d = system.can.degrees_of_freedom
    states = any_states(system, 20)
    turned = states + np.array([math.tau] * d + [0.0] * d)
    np.testing.assert_allclose(system.positions(turned), system.positions(states), atol=1e-14)
    alike = np.allclose(system.rhs(turned), system.rhs(states), rtol=0, atol=1e-11)
    assert alike == system.can.periodic


@every_system
def test_degrees_of_freedom_are_the_angles(system: System) -> None:
    d = system.can.degrees_of_freedom
    assert len(system.components) == 2 * d
    assert system.positions(some_state(system)).shape == (d, 2)
    slope = system.rhs(some_state(system))
    np.testing.assert_array_equal(slope[:d], some_state(system)[d:])  # θ' = ω
    run = solve(system, some_state(system), [0.1, 0.2])
    shape = (2,) if d == 1 else (2, d)
    assert run.theta.shape == run.omega.shape == shape


@every_system
def test_the_largest_frequency_bounds_small_oscillations(system: System) -> None:
    """Eigenvalues of the equations next to rest, by differences; friction slows them down."""
    n, size = len(system.components), 1e-6
    jacobian = (system.rhs(size * np.eye(n)) / size).T
    fastest = np.abs(np.linalg.eigvals(jacobian).imag).max()
    assert fastest <= system.largest_frequency * (1 + 1e-9)
    if system.can.conservative:
        assert fastest == pytest.approx(system.fastest_frequency, rel=1e-6)
        bound = system.largest_frequency / math.sqrt(n / 2)  # whose square is the sum of theirs
        assert fastest >= bound * (1 - 1e-9)


@every_system
def test_what_is_said_of_a_pendulum_is_of_its_size(system: System) -> None:
    assert system.energy_scale > 0.0
    assert system.energy(some_state(system)) < 10 * system.energy_scale
    assert all(math.isfinite(value) for value in system.constants.values())


def test_a_system_of_the_core_alone_is_offered_nowhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """Until it has its class the command and the ways out name the others."""
    assert {each.name for each in systems_that()} == {cls.name for cls in System.classes.values()}
    monkeypatch.delitem(System.classes, "linear")
    monkeypatch.delitem(System.classes, "driven-linear")
    others = ["simple", "double", "driven", "damped-double"]
    assert [each.name for each in systems_that()] == others
    group = one_each("solve", "Solve.", systems_that(), lambda _: [], lambda _: None)
    assert list(group.commands) == others
    with pytest.raises(ArgumentError, match="^system must be a SimplePendulum, got"):
        exact(DoublePendulum.rods(), (1.0, 0.0), [1.0])


@every_system
def test_who_cannot_be_mapped_reads_who_can(system: Any) -> None:
    square: Any = (-1.0, 1.0), (-1.0, 1.0), (3, 3), 0.5
    if not system.can.mapped:
        names = " or ".join(class_names_that(lambda can: can.mapped))
        for make in (flip_map, divergence_map):
            with pytest.raises(ArgumentError, match=f"^system must be a {names}, got"):
                make(system, *square)
