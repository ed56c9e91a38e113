"""Many trajectories at once: each is what `solve` gives it alone, whatever is beside it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from catalogue import ADAPTIVE, SYSTEMS, TAKEN, any_states, control, label, taking
from horizons import horizon
from pendula import DoublePendulum, Ensemble, SimplePendulum, ensemble, solve
from pendula.events import angle, flip, tip_height, velocity_zero

if TYPE_CHECKING:
    from pendula._types import MethodName
    from pendula.systems import System

RODS = DoublePendulum.rods()
SIMPLE = SimplePendulum(0.5, 9.81, 2.0)
NAMES = [each.name for each in ADAPTIVE]
ONE_BOB = [each for each in SYSTEMS if each.can.degrees_of_freedom == 1]


def check_alone(
    many: Ensemble, systems: Any, states: Any, t: Any, method: MethodName, **options: Any
) -> None:
    """Each trajectory has the bits of `solve`."""
    for i in range(len(many)):
        system = systems[i] if isinstance(systems, list) else systems
        state = states if np.ndim(states) == 1 else states[i]
        run = solve(system, state, np.atleast_1d(t), method, **options)
        m = run.t.size
        np.testing.assert_array_equal(many.states[i, :m], run.states)
        assert np.isnan(many.states[i, m:]).all()
        assert many.outcomes[i] == run.outcome
        assert many.n_steps[i] == run.n_steps
        assert many.n_evaluations[i] == run.n_evaluations
        assert many.reached[i] == run.reached
        for mine, theirs in zip(many.events, run.events, strict=True):
            here = mine.trajectories == i
            np.testing.assert_array_equal(mine.times[here], theirs.times)
            np.testing.assert_array_equal(mine.states[here], theirs.states)
        if many.trust_horizon is not None:
            assert many.trust_horizon[i] == run.trust_horizon


# ---- the same bits ----


@pytest.mark.parametrize("count", [1, 7, 33])
@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_each_has_the_bits_of_a_run_alone(method: Any, system: System, count: int) -> None:
    states, t = any_states(system, count), [0.0, 0.3, 0.5001, 1.0]
    for threads in (1, 2, 3):
        many = ensemble(system, states, t, method.name, threads=threads, **control(method))
        assert many.states.shape == (count, 4, len(system.components))
        assert len(many) == count
        check_alone(many, system, states, t, method.name, **control(method))


@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_backward_in_time_from_another_origin(method: Any, system: System) -> None:
    states, t = any_states(system, 9), [1.7, 1.6, 0.913]
    options: dict[str, Any] = {"t0": 2.0, **control(method)}
    many = ensemble(system, states, t, method.name, **options)
    check_alone(many, system, states, t, method.name, **options)


@pytest.mark.parametrize("method", taking("double"), ids=label)
def test_systems_of_their_own(method: Any) -> None:
    lengths = np.linspace(0.5, 2.0, 19)
    systems = [DoublePendulum.rods(m2=x, l1=x) for x in lengths]
    states = any_states(systems[0], 19)
    for given in (states, states[3]):
        many = ensemble(systems, given, [0.5, 1.0], method.name, **control(method))
        check_alone(many, systems, given, [0.5, 1.0], method.name, **control(method))
        for i, system in enumerate(systems):
            np.testing.assert_array_equal(many.energy[i], system.energy(many.states[i]))


def test_a_list_of_one_system_is_that_system() -> None:
    states = any_states(RODS, 3)
    many, alike = (ensemble(given, states, [0.5, 1.0]) for given in ([RODS], RODS))
    np.testing.assert_array_equal(many.states, alike.states)
    np.testing.assert_array_equal(many.energy, alike.energy)
    assert alike.energy.shape == (3, 2)


@pytest.mark.parametrize("method", NAMES)
@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_many_outputs_within_a_step(method: MethodName, direction: float) -> None:
    states = any_states(RODS, 11)
    t = direction * np.concatenate([[0.0], np.geomspace(1e-9, 1.0, 200)])
    many = ensemble(RODS, states, t, method, tolerance=1e-4)
    assert (many.n_steps < 50).all()
    check_alone(many, RODS, states, t, method, tolerance=1e-4)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-8, 2.0**-52])
@pytest.mark.parametrize("method", NAMES)
def test_any_tolerance(method: MethodName, tolerance: float) -> None:
    states = any_states(RODS, 10)
    many = ensemble(RODS, states, [4.0], method, tolerance=tolerance)
    check_alone(many, RODS, states, [4.0], method, tolerance=tolerance)


@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_nothing_but_the_start(method: Any, system: System) -> None:
    states = any_states(system, 5)
    many = ensemble(system, states, [0.0], method.name, **control(method))
    np.testing.assert_array_equal(many.states[:, 0], states)
    check_alone(many, system, states, [0.0], method.name, **control(method))


@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_the_first_output_is_the_start_as_it_was_given(method: Any, system: System) -> None:
    """Through momenta and back a method may lose the last bits."""
    states = any_states(system, 20)
    for t in ([0.0], [0.0, 0.05]):
        many = ensemble(system, states, t, method.name, **control(method))
        np.testing.assert_array_equal(many.states[:, 0], states)
        for own in (t, 0.05):
            alone = solve(system, states[0], own, method.name, **control(method))
            np.testing.assert_array_equal(alone.states[0], states[0])


def test_one_end_time_is_one_output() -> None:
    states = any_states(RODS, 4)
    many = ensemble(RODS, states, 2.0)
    assert many.t.tolist() == [2.0]
    np.testing.assert_array_equal(many.states, ensemble(RODS, states, [2.0]).states)


def test_none_is_no_error() -> None:
    none = ensemble(RODS, np.zeros((0, 4)), [1.0, 2.0], events=flip(1), certify=1e-6)
    assert none.states.shape == (0, 2, 4)
    assert none.energy.shape == (0, 2)
    assert none.events[0].times.shape == (0,)


# ---- events ----


@pytest.mark.parametrize("direction", [1.0, -1.0])
@pytest.mark.parametrize("method", NAMES)
def test_events_are_recorded(method: MethodName, direction: float) -> None:
    states = 3.0 * any_states(RODS, 21)
    asked = (
        flip(1),
        flip(2, 1),
        velocity_zero(2),
        angle(2, 0.5, -1, every_turn=True),
        angle(2, 0.5001),  # two and more in a step
        angle(2, 0.5002),
        tip_height(0.2),
    )
    options: dict[str, Any] = {"events": asked, "tolerance": 1e-6}
    t = direction * np.array([1.0, 3.0])
    for threads in (1, 2, 3):
        many = ensemble(RODS, states, t, method, threads=threads, **options)
        assert all(each.times.size > 5 for each in many.events)
        for each in many.events:
            assert (np.diff(each.trajectories) >= 0).all()
    check_alone(many, RODS, states, t, method, **options)


@pytest.mark.parametrize("terminal", [1, 3])
@pytest.mark.parametrize("method", NAMES)
def test_an_event_ends_its_own_run(method: MethodName, terminal: int) -> None:
    states = 3.0 * any_states(RODS, 40)
    options: dict[str, Any] = {
        "events": (flip(1, terminal=terminal), flip(2, terminal=terminal), tip_height(0.0)),
        "tolerance": 1e-8,
    }
    t = np.linspace(0.0, 5.0, 11)
    many = ensemble(RODS, states, t, method, **options)
    assert set(many.outcomes) == {"event", "reached_end"}
    check_alone(many, RODS, states, t, method, **options)
    ended = many.outcomes == "event"
    assert (many.reached[ended] < 5.0).all()
    assert (many.reached[~ended] == 5.0).all()


@pytest.mark.parametrize("system", ONE_BOB, ids=label)
def test_events_of_one_bob(system: System) -> None:
    states = 4.0 * any_states(system, 17)
    options: dict[str, Any] = {"events": (flip(1), velocity_zero(1), tip_height(-0.1))}
    many = ensemble(system, states, [4.0], **options)
    check_alone(many, system, states, [4.0], "taylor", **options)


# ---- bad ones ----


@pytest.mark.usefixtures("starts_beyond_the_sine")
@pytest.mark.parametrize("method", taking("simple"), ids=label)
def test_one_that_goes_wrong_leaves_the_others_alone(method: Any) -> None:
    system = SIMPLE
    good = any_states(system, 12)
    bad = [[2.0**27, 0.0], [1.0, 1e300], [2.0**26 - 3.0, 50.0]]
    places = [0, 5, 6, 14]
    states = np.insert(good, [0, 4, 4, 11], [*bad, [-3e9, 1.0]], axis=0)
    options = control(method)
    t = [0.5, 1.0]
    many = ensemble(system, states, t, method.name, **options)
    assert [i for i in range(16) if many.outcomes[i] != "reached_end"] == places
    assert set(many.outcomes[places]) == {"not_finite"}
    check_alone(many, system, states, t, method.name, **options)
    rest = np.delete(many.states, places, axis=0)
    np.testing.assert_array_equal(rest, ensemble(system, good, t, method.name, **options).states)


@pytest.mark.parametrize("limit", [1, 7, 12])
@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_a_limit_of_steps(method: Any, system: System, limit: int) -> None:
    states, t = any_states(system, 20), [0.05, 0.11, 1.0]
    options: dict[str, Any] = {"max_steps": limit, **control(method)}
    many = ensemble(system, states, t, method.name, **options)
    assert "step_limit" in many.outcomes or method.needs == "analytic"  # whose steps are long
    check_alone(many, system, states, t, method.name, **options)


# ---- until when they are right ----


@pytest.mark.usefixtures("starts_beyond_the_sine")
@pytest.mark.parametrize(("method", "options"), [("taylor", {"tolerance": 1e-7}), ("rk4", {})])
def test_the_horizon_of_each_is_that_of_its_run(
    method: MethodName, options: dict[str, Any]
) -> None:
    options = {"step": 0.01} if method == "rk4" else options
    states = any_states(RODS, 6)
    states[2, 0] = 2.0**27  # right until its first step at most, as is the next one
    states[3, 2] = 1e300
    many = ensemble(RODS, states, [4.0, 8.0], method, certify=1e-5, threads=2, **options)
    check_alone(many, RODS, states, [4.0, 8.0], method, certify=1e-5, **options)
    assert many.trust_horizon is not None
    assert many.trust_horizon[2] == {"taylor": 0.0, "rk4": 0.01}[method]
    assert many.trust_horizon[3] == many.trust_horizon[2]
    single = horizon(RODS, states[0], method, 0.0, 8.0, certify=1e-5, **options)
    assert many.trust_horizon[0] == single
    assert np.isfinite(many.trust_horizon).any()


def test_events_and_certify_go_together() -> None:
    states = 3.0 * any_states(RODS, 6)
    options: dict[str, Any] = {"certify": 1e-6, "events": flip(2, terminal=True)}
    many = ensemble(RODS, states, [6.0], tolerance=1e-4, **options)
    check_alone(many, RODS, states, [6.0], "taylor", tolerance=1e-4, **options)


# ---- with digits ----


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_digits_are_those_of_a_run_alone(direction: float) -> None:
    states, t = np.array([[2.0, 2.5, 0.0, 0.0], [0.3, 0.1, 0.0, 1.0]]), [direction * 3.0]
    states = np.insert(states, 1, [2.0**51, 0.0, 0.0, 0.0], axis=0)
    told = list[float]()
    many = ensemble(RODS, states, t, digits=12, progress=told.append)
    assert many.outcomes.tolist() == ["reached_end", "not_finite", "reached_end"]
    assert many.reached.tolist() == [t[0], 0.0, t[0]]
    assert np.isnan(many.states[1]).all()
    for i in (0, 2):
        alone = solve(RODS, states[i], t, digits=12)
        np.testing.assert_array_equal(many.states[i], alone.states)
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_digits_of_systems_of_their_own_at_the_start_too() -> None:
    systems = [DoublePendulum.rods(), DoublePendulum.bobs()]
    with pytest.raises(ValueError, match="n of the same kind and form, got double bobs, double"):
        ensemble(systems, [1.0, 1.0, 0.0, 0.0], [0.0, 1.0], digits=10)
    systems = [DoublePendulum.rods(l1=l1) for l1 in (0.5, 1.0)]
    many = ensemble(systems, [1.0, 1.0, 0.0, 0.0], [0.0, 1.0], digits=10)
    for system, states in zip(systems, many.states, strict=True):
        alone = solve(system, [1.0, 1.0, 0.0, 0.0], [0.0, 1.0], digits=10)
        np.testing.assert_array_equal(states, alone.states)
    with pytest.raises(ValueError, match="digits is not taken together with tolerance"):
        ensemble(systems[0], [1.0, 1.0, 0.0, 0.0], 1.0, digits=10, tolerance=1e-9)
