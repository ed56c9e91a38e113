"""Events inside the steps of a run: when, which way, how many; and Poincaré sections."""

from __future__ import annotations

import math
from typing import Any, cast

import numpy as np
import pytest
from mpmath import mp, mpf

import truth
from pendula import (
    DoublePendulum,
    LinearPendulum,
    SimplePendulum,
    ensemble,
    poincare_section,
    solve,
    time_at,
)
from pendula.events import Event, angle, flip, tip_height, velocity_zero
from pendula.run.events import described, event_from

RODS = DoublePendulum.rods()
SIMPLE = SimplePendulum(0.5, 9.81)
WILD = (2.0, 2.5, 0.0, 0.0)
SWING, TURN = (2.0, 0.5), (0.5, 12.0)  # of the simple pendulum


def found(system: Any, state: Any, t: Any, *asked: Event, **options: Any) -> list[Any]:
    return [each.times for each in solve(system, state, t, events=asked, **options).events]


def truth_of(state: tuple[float, float], t: float) -> truth.Motion:
    with mp.workdps(60):
        return truth.simple(*state, SIMPLE.gravity, SIMPLE.length, mpf(t))


# ---- against the closed form ----


@pytest.mark.parametrize("value", [-2.0, -1e-3, 0.0, 1e-9, 1.0, 1.9])
def test_a_swing_passes_an_angle_when_the_closed_form_does(value: float) -> None:
    """Once up and once down in each period, which mpmath knows."""
    (rising,), (falling,) = (
        found(SIMPLE, SWING, 20.0, angle(1, value, direction)) for direction in (1, -1)
    )
    (both,) = found(SIMPLE, SWING, 20.0, angle(1, value))
    assert both.tolist() == sorted([*rising, *falling])
    assert both[0] == pytest.approx(time_at(SIMPLE, SWING, value), rel=1e-14)
    period = float(truth.period(*SWING, SIMPLE.gravity, SIMPLE.length))
    for times in (rising, falling):
        assert times.size in (10, 11)
        first = time_at(SIMPLE, SWING, value) if times[0] == both[0] else times[0]
        np.testing.assert_allclose(times, first + period * np.arange(times.size), rtol=1e-14)


def test_the_state_of_an_event_is_that_of_the_motion() -> None:
    (crossings,) = solve(SIMPLE, SWING, 10.0, events=angle(1, 1.0)).events
    assert crossings.states.shape == (crossings.times.size, 2)
    np.testing.assert_allclose(crossings.states[:, 0], 1.0, rtol=1e-15)
    for t, (_, omega) in zip(crossings.times, crossings.states, strict=True):
        assert omega == pytest.approx(float(truth_of(SWING, t).omega), rel=1e-12)


@pytest.mark.filterwarnings("ignore::pendula.DegreesWarning")
def test_a_rotation_passes_its_turns_when_the_closed_form_does() -> None:
    asked = angle(1, 1.0, every_turn=True), flip(1), angle(1, 7.0)
    turning, flips, alone = found(SIMPLE, TURN, 5.0, *asked)
    turns = np.arange(turning.size)
    assert turning.size == 9
    np.testing.assert_allclose(turning, time_at(SIMPLE, TURN, 1.0 + 2 * np.pi * turns), rtol=1e-14)
    np.testing.assert_allclose(
        flips, time_at(SIMPLE, TURN, np.pi + 2 * np.pi * np.arange(flips.size)), rtol=1e-14
    )
    assert alone == pytest.approx([time_at(SIMPLE, TURN, 7.0)], rel=1e-14)


def test_a_velocity_is_zero_half_a_period_apart() -> None:
    (at_rest,) = found(SIMPLE, (2.0, 0.0), 20.0, velocity_zero(1))
    half = float(truth.period(2.0, 0.0, SIMPLE.gravity, SIMPLE.length)) / 2
    assert at_rest.size == 21
    np.testing.assert_allclose(at_rest, half * np.arange(1, 22), rtol=1e-14)  # not the start itself
    rising, falling = found(SIMPLE, (2.0, 0.0), 20.0, velocity_zero(1, 1), velocity_zero(1, -1))
    assert rising.tolist() == at_rest[0::2].tolist()  # at −2 it turns to the right
    assert falling.tolist() == at_rest[1::2].tolist()


def test_the_tip_passes_a_height() -> None:
    height = -0.25  # half way up: 60 degrees
    (times,) = found(SIMPLE, (0.0, 8.0), 3.0, tip_height(height))
    with mp.workdps(30):
        at = float(mp.acos(mpf(1) / 2))
    assert times[0] == pytest.approx(time_at(SIMPLE, (0.0, 8.0), at), rel=1e-14)
    assert times.size % 2 == 0
    up, down = found(SIMPLE, (0.0, 8.0), 3.0, tip_height(height, 1), tip_height(height, -1))
    assert sorted([*up, *down]) == times.tolist()


def test_the_linear_pendulum_has_events() -> None:
    system = LinearPendulum(1.0, 1.0)
    zero, rest = found(system, (0.5, 0.0), 20.0, angle(1, 0.0), velocity_zero(1))
    np.testing.assert_allclose(zero, np.pi * (np.arange(zero.size) + 0.5), rtol=1e-14)
    np.testing.assert_allclose(rest, np.pi * (np.arange(rest.size) + 1.0), rtol=1e-14)


# ---- hard ones ----


@pytest.mark.parametrize("below", [1e-3, 1e-6, 1e-9, 1e-12])
def test_a_swing_that_hardly_passes(below: float) -> None:
    """The top of a swing passes an angle just below it twice, and one just above it never."""
    (twice,), (never,) = (
        found(SIMPLE, (-2.0, 0.0), 9.0, angle(1, value)) for value in (2.0 - below, 2.0 + below)
    )
    period = float(truth.period(2.0, 0.0, SIMPLE.gravity, SIMPLE.length))
    assert never.size == 0
    assert twice.size == 2 * 5
    acceleration = SIMPLE.gravity / SIMPLE.length * math.sin(2.0)
    half_apart = math.sqrt(2.0 * below / acceleration)
    near = [(n + 0.5) * period + side * half_apart for n in range(5) for side in (-1, 1)]
    np.testing.assert_allclose(twice, near, rtol=0, atol=max(1e-2 * half_apart, 1e-8))


def test_a_start_on_the_value_is_no_crossing() -> None:
    period = float(truth.period(2.0, 0.0, SIMPLE.gravity, SIMPLE.length))
    (low,) = found(SIMPLE, (0.0, 4.0), 3.0, angle(1, 0.0))
    assert low[0] > 0.3
    (top,) = found(SIMPLE, (2.0, 0.0), 0.9 * period, angle(1, 2.0))
    assert top.size == 0


@pytest.mark.parametrize("state", [WILD, (3.0, 3.0, 0.0, 0.0), (0.1, 0.2, -9.0, 14.0)])
def test_the_double_pendulum_flips_where_a_fine_run_does(state: Any) -> None:
    t = np.linspace(0.0, 20.0, 20_001)
    run = solve(RODS, state, t, events=[flip(1), flip(2), flip(2, 1), flip(2, -1)])
    for rod in (0, 1):
        turns = np.floor((run.theta[:, rod] + np.pi) / (2 * np.pi))
        before = np.flatnonzero(np.diff(turns))
        times = run.events[rod].times
        assert times.size == np.abs(np.diff(turns)).sum()
        assert ((t[before] <= times) & (times <= t[before + 1])).all()
    ups, downs = run.events[2].times, run.events[3].times
    assert sorted([*ups, *downs]) == run.events[1].times.tolist()
    assert (run.events[2].states[:, 3] > 0).all()
    assert (run.events[3].states[:, 3] < 0).all()


def test_backward_the_direction_is_still_that_of_time() -> None:
    there = solve(RODS, (1.0, 0.0, 0.0, 0.0), 5.0, events=angle(1, 0.3, 1))
    back = solve(RODS, there.states[-1], 0.0, t0=5.0, events=angle(1, 0.3, 1))
    assert there.events[0].times.size == 2
    np.testing.assert_allclose(back.events[0].times[::-1], there.events[0].times, rtol=1e-10)
    assert (back.events[0].states[:, 2] > 0).all()


# ---- what an event does to a run ----


def test_events_change_nothing_but_the_end() -> None:
    t = np.linspace(0.0, 10.0, 101)
    plain = solve(RODS, WILD, t)
    watched = solve(RODS, WILD, t, events=[flip(2), tip_height(0.0)])
    assert watched.states.tobytes() == plain.states.tobytes()
    ended = solve(RODS, WILD, t, events=[flip(2, terminal=True)])
    assert ended.outcome == "event"
    assert ended.states.tobytes() == plain.states[: ended.t.size].tobytes()
    assert ended.t[-1] <= ended.events[0].times[0] < t[ended.t.size]


@pytest.mark.parametrize("count", [1, 2, 4])
def test_so_many_end_the_run(count: int) -> None:
    endless = solve(RODS, WILD, 10.0, events=[flip(2), tip_height(0.0)])
    run = solve(RODS, WILD, 10.0, events=[flip(2, 0, count), tip_height(0.0)])
    assert run.outcome == "event"
    assert run.events[0].times.tolist() == endless.events[0].times[:count].tolist()
    last = run.events[0].times[-1]
    assert run.t[-1] == last
    heights = endless.events[1].times
    assert run.events[1].times.tolist() == heights[heights <= last].tolist()
    np.testing.assert_allclose(run.states[-1], run.events[0].states[-1], rtol=1e-13)
    assert run.at(last).tobytes() == run.states[-1].tobytes()


@pytest.mark.parametrize("event", [flip(1), tip_height(0.1)])
@pytest.mark.parametrize("state", [(1e150, 0.0), (1e12, 0.0)])
def test_crossings_without_number_end_the_run(event: Event, state: tuple[float, float]) -> None:
    """Also of one among others; and nobody waits for it."""
    linear, good = LinearPendulum(), (4.0, 0.0)
    alone = solve(linear, state, [2.0], events=event)
    assert (alone.outcome, alone.n_steps, alone.t.size) == ("not_finite", 0, 0)
    many = ensemble(linear, [good, state, good], [2.0], events=event)
    assert many.outcomes.tolist() == ["reached_end", "not_finite", "reached_end"]
    assert set(many.events[0].trajectories.tolist()) == {0, 2}


def test_an_event_that_does_not_come_ends_nothing() -> None:
    run = solve(SIMPLE, (1.0, 0.0), 5.0, events=[flip(1, terminal=True)])
    assert (run.outcome, run.t[-1]) == ("reached_end", 5.0)
    assert run.events[0].times.shape == (0,)
    assert run.events[0].states.shape == (0, 2)


def test_one_event_needs_no_list() -> None:
    run = solve(SIMPLE, (1.0, 0.0), 5.0, events=velocity_zero(1))
    assert run.request.events == (velocity_zero(1),)
    assert len(run.events) == 1


# ---- sections ----


def test_a_section_lies_on_its_surface() -> None:
    surface = angle(1, 0.0, direction=1)
    section = poincare_section(RODS, (0.3, 0.1, 0.0, 0.0), surface, 40)
    assert section.times.shape == (40,)
    assert section.states.shape == (40, 4)
    assert np.abs(section.states[:, 0]).max() <= 1e-16
    assert (section.states[:, 2] > 0).all()
    assert np.ptp(RODS.energy(section.states)) < 1e-14
    run = solve(RODS, (0.3, 0.1, 0.0, 0.0), [section.times[-1] + 0.1], events=[surface])
    assert run.events[0].times.tobytes() == section.times.tobytes()
    assert run.events[0].states.tobytes() == section.states.tobytes()


def test_a_section_starts_at_its_time() -> None:
    early, late = (
        poincare_section(RODS, (0.3, 0.1, 0.0, 0.0), velocity_zero(2), 9, t0=t0)
        for t0 in (0.0, 512.0)
    )
    np.testing.assert_allclose(late.times - 512.0, early.times, rtol=0, atol=1e-11)


def test_a_section_of_a_motion_that_does_not_cross_ends() -> None:
    with pytest.raises(
        ValueError, match=r"^n must be .*: 0 of 3 were found in 50 steps \(step_lim"
    ):
        poincare_section(RODS, WILD, flip(1), 3, max_steps=50)


# ---- wrong arguments ----


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: angle(0, 1.0), "^i must be 1 or 2, counted from the pivot .*; got 0$"),
        (lambda: angle(3, 1.0), "^i must be 1 or 2, counted from the pivot .*; got 3$"),
        (
            lambda: angle(cast("Any", 1.0), 1.0),
            "^i must be 1 or 2, counted .*; got 1.0$",
        ),
        (lambda: angle(1, math.nan), r"^value must be a finite number \[rad\], got nan"),
        (lambda: angle(1, cast("Any", "up")), r"^value must be a number \[rad\], got 'up'"),
        (lambda: flip(1, 2), r"^direction must be 1 \(growing with time\), -1 .*, got 2"),
        (lambda: flip(1, True), "^direction must be 1 .*, got True"),
        (lambda: flip(1, cast("Any", "up")), "^direction must be 1 .*, got 'up'"),
        (lambda: velocity_zero(1, 0, -1), "^terminal must be a whole number from 1 to .*, got -1"),
        (
            lambda: velocity_zero(1, 0, cast("Any", 0.5)),
            "^terminal must be a whole number .*, got 0.5",
        ),
        (lambda: tip_height(math.inf), r"^y must be a finite number \[m\], got inf"),
        (lambda: solve(SIMPLE, SWING, 1.0, events=[flip(2)]), "^i must be 1 for the simple pend"),
        (
            lambda: solve(RODS, WILD, 1.0, events=cast("Any", ["flip"])),
            "^events must be made by .*got 'flip'",
        ),
        (lambda: solve(RODS, WILD, 1.0, events=cast("Any", 3)), "^events must be made by .*got 3"),
        (
            lambda: solve(RODS, WILD, 1.0, "rk4", step=0.1, events=[flip(1)]),
            "^events are not taken by the fixed-step method 'rk4', .*; take .*taylor",
        ),
        (
            lambda: solve(RODS, WILD, 1.0, digits=9, events=[flip(1)]),
            "^digits is not .* events: it",
        ),
        (lambda: poincare_section(RODS, WILD, flip(1), 0), "^n must be a whole number from 1"),
        (lambda: poincare_section(RODS, WILD, cast("Any", "flip"), 3), "^events? must be made by"),
        (lambda: poincare_section(SIMPLE, SWING, flip(2), 3), "^i must be 1 for the simple pend"),
        (lambda: poincare_section(RODS, SWING, flip(2), 3), "^state must be "),
        (lambda: poincare_section(RODS, WILD, flip(2), 3, tolerance=1), "^tolerance must lie betw"),
    ],
)
def test_wrong_arguments_get_one_clear_line(make: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message) as error:
        make()
    assert "\n" not in str(error.value)


def test_events_are_values() -> None:
    assert flip(1) == angle(1, math.pi, every_turn=True)
    assert len({flip(1), flip(1), flip(2), velocity_zero(1)}) == 3
    for event in (flip(1), angle(2, -0.3, -1, 7), tip_height(0.1, 1, True)):
        assert event_from(described(event)) == event
