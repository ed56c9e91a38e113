"""A run, and a run among many: what they share has one name, and one value."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np
import pytest

from catalogue import ADAPTIVE, TAKEN, any_states, control, label
from pendula import DoublePendulum, Ensemble, Trajectory, _engine, ensemble, solve
from pendula.events import flip, velocity_zero

RODS = DoublePendulum.rods(gravity=9.81)
SHARED = ("n_steps", "n_evaluations", "reached", "events", "trust_horizon", "states", "t", "method")
DERIVED = ("derivatives", "derivative_names")
PLURAL = {"outcome": "outcomes", "system": "systems"}
OF_ONE = {"request", "precision", "dense", "event_derivatives", "changes"}  # of a trajectory alone
OF_MANY = {"starts", "task"}  # of an ensemble, whose task holds the method and the times


def names(of: type) -> set[str]:
    return {each.name for each in fields(of)}


def values(many: Ensemble, i: int) -> dict[str, Any]:
    """Those of one trajectory of an ensemble that takes all outputs."""
    return {
        "outcome": many.outcomes[i],
        "n_steps": many.n_steps[i],
        "n_evaluations": many.n_evaluations[i],
        "reached": many.reached[i],
        "trust_horizon": None if many.trust_horizon is None else many.trust_horizon[i],
    }


def test_a_trajectory_and_an_ensemble_share_the_names_of_what_they_share() -> None:
    one, many = names(Trajectory), names(Ensemble)
    assert one == {*SHARED, *DERIVED, *PLURAL, *OF_ONE}
    assert many | {"method", "t"} == {*SHARED, *DERIVED, *PLURAL.values(), *OF_MANY}


@pytest.mark.usefixtures("starts_beyond_the_sine")
@pytest.mark.parametrize("limit", [None, 1, 12])
@pytest.mark.parametrize("direction", [1.0, -1.0])
@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_each_of_an_ensemble_tells_what_a_run_alone_tells(
    method: Any, system: Any, direction: float, limit: int | None
) -> None:
    states = any_states(system, 10)
    states[4, 0] = 2.0**27  # beyond the sine: it ends at once, but for the linear pendulum
    t = 0.5 + direction * np.array([0.05, 0.113, 0.6])
    options: Any = {"t0": 0.5, "max_steps": limit, "certify": 1e-9, **control(method)}
    many = ensemble(system, states, t, method.name, **options)
    for i, state in enumerate(states):
        run = solve(system, state, t, method.name, **options)
        assert values(many, i) == {
            name: getattr(run, name) for name in ("outcome", *SHARED) if name in values(many, i)
        }


@pytest.mark.parametrize("method", ADAPTIVE, ids=label)
def test_what_an_event_ends_is_told_alike(method: Any) -> None:
    states = 3.0 * any_states(RODS, 12)
    options: Any = {
        "events": (flip(1, terminal=True), velocity_zero(2)),
        "certify": 1e-6,
        "tolerance": 1e-7,
    }
    many = ensemble(RODS, states, [4.0], method.name, **options)
    assert {"event", "reached_end"} == set(many.outcomes)
    for i, state in enumerate(states):
        run = solve(RODS, state, [4.0], method.name, **options)
        for name, value in values(many, i).items():
            assert value == getattr(run, name), name
        for mine, theirs in zip(many.events, run.events, strict=True):
            assert mine.times[mine.trajectories == i].tolist() == theirs.times.tolist()
        if run.outcome == "event":
            assert run.reached == run.events[0].times[-1]


def test_what_was_not_run_is_told_alike() -> None:
    """Digits are had or not: neither of them counts steps."""
    states, t = np.array([[1.0, 0.0, 0.0, 0.0], [2.0**51, 0.0, 0.0, 0.0]]), [0.5, 1.0]
    many = ensemble(RODS, states, t, digits=9)
    run = solve(RODS, states[0], t, digits=9)
    assert values(many, 0) == {name: getattr(run, name) for name in values(many, 0)}
    assert (many.outcomes[1], many.reached[1]) == ("not_finite", 0.0)


def test_digits_beyond_those_there_are_end_at_the_limit_of_digits(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A run alone is refused (test_trust); among others it ends, and they do not."""
    levels = _engine.long_run_digits()[:3]  # fewer of them are sooner at their end
    monkeypatch.setattr(_engine, "long_run_digits", lambda: levels)
    many = ensemble(RODS, [[2.0, 2.5, 0.0, 0.0], [0.0] * 4], [0.0, 200.0], digits=12)
    assert many.outcomes.tolist() == ["digits_limit", "reached_end"]
    assert many.reached.tolist() == [0.0, 200.0]
    assert many.states[0, 0].tolist() == [2.0, 2.5, 0.0, 0.0]
    assert np.isnan(many.states[0, 1]).all()
    assert (many.states[1] == 0.0).all()
