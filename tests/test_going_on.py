"""Runs that go on from the event that ended the one before, to the next event."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

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
)
from pendula.events import Event, angle, flip, tip_height, velocity_zero

if TYPE_CHECKING:
    from pendula._types import MethodName

RODS, SIMPLE, LINEAR = DoublePendulum.rods(), SimplePendulum(0.5), LinearPendulum(0.5)
QUIET, WILD = (0.5, 0.7, 0.0, 0.0), (2.0, 2.5, 0.0, 0.0)
PERIOD = float(truth.period(1.0, 0.0, SIMPLE.gravity, SIMPLE.length))
LINEAR_PERIOD = 2 * math.pi * math.sqrt(LINEAR.length / LINEAR.gravity)
METHODS: list[MethodName] = ["taylor", "dop853"]
WAYS = [1, -1]


def ends(
    systems: Sequence[Any],
    state: Any,
    event: Event,
    n: int,
    method: MethodName,
    way: int,
    t0: float = 0.0,
) -> np.ndarray:
    """When n runs end, each of which starts from the end of the one before."""
    t, times = t0, []
    for system in itertools.islice(itertools.cycle(systems), n):
        run = solve(system, state, t + way * 1e3, method, t0=t, events=event)
        assert run.outcome == "event"
        assert run.t[-1] == run.events[0].times[-1]
        assert run.states[-1].tobytes() == run.events[0].states[-1].tobytes()
        t, state = float(run.t[-1]), run.states[-1]
        times.append(t)
    return np.array(times)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("system", [SIMPLE, LINEAR])
@pytest.mark.parametrize(
    ("event", "first", "each"),  # in periods, forward in time
    [
        (angle(1, 0.0, terminal=True), 0.25, 0.5),
        (angle(1, 0.0, direction=1, terminal=True), 0.75, 1.0),
        (angle(1, 0.0, terminal=3), 1.25, 1.5),
        (velocity_zero(1, terminal=True), 0.5, 0.5),
        (velocity_zero(1, direction=1, terminal=True), 0.5, 1.0),
    ],
)
def test_swing_by_swing(
    event: Event, first: float, each: float, system: Any, method: MethodName, way: int
) -> None:
    """A release from rest; backward in time, what rises with time is reached on the other way."""
    if way < 0 and event.direction:
        first = {0.75: 0.25, 0.5: 0.5}[first]
    n = 10_000 if system is SIMPLE and way > 0 else 1000
    times = ends([system], (1.0, 0.0), event, n, method, way)
    period = PERIOD if system is SIMPLE else LINEAR_PERIOD
    right = way * (first + each * np.arange(times.size)) * period
    np.testing.assert_allclose(times, right, rtol=1e-11)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("method", METHODS)
def test_turn_by_turn(method: MethodName, way: int) -> None:
    times = ends([SIMPLE], (0.0, 14.0), flip(1, terminal=True), 5500 + 4500 * way, method, way)
    turn = float(truth.period(0.0, 14.0, SIMPLE.gravity, SIMPLE.length))
    right = way * turn * (0.5 + np.arange(times.size))
    np.testing.assert_allclose(times, right, rtol={"taylor": 1e-11, "dop853": 1e-9}[method])


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("method", METHODS)
def test_height_by_height(method: MethodName, way: int) -> None:
    """Four in a period."""
    times = ends(
        [SIMPLE], (1.0, 0.0), tip_height(-0.45, terminal=True), 5500 + 4500 * way, method, way
    )
    np.testing.assert_allclose(times[4:] - times[:-4], way * PERIOD, rtol=1e-9)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("method", METHODS)
def test_a_nail_under_the_pivot(method: MethodName, way: int) -> None:
    """The length changes at the lowest point: half swings of 2 K(k) / ωn, k = ω / 2 ωn."""
    nail = SimplePendulum(0.45)
    times = ends(
        [SIMPLE, nail], (1.0, 0.0), angle(1, 0.0, terminal=True), 5500 + 4500 * way, method, way
    )
    with mp.workdps(30):
        g = mpf(SIMPLE.gravity)
        squared = 2 * g / mpf(0.5) * (1 - mp.cos(1))  # of the angular velocity at the lowest point
        long, short = (
            2 * mp.ellipk(squared * mpf(length) / (4 * g)) * mp.sqrt(mpf(length) / g)
            for length in (0.5, 0.45)
        )
    n = np.arange(times.size)
    right = float(long) / 2 + np.ceil(n / 2) * float(short) + np.floor(n / 2) * float(long)
    np.testing.assert_allclose(times, way * right, rtol=1e-11)


OF_RODS = [
    angle(1, 0.0, terminal=True),
    angle(2, 0.0, every_turn=True, terminal=True),
    velocity_zero(1, terminal=True),
    velocity_zero(2, direction=1, terminal=True),
    tip_height(-0.9 * RODS.l1 - 0.9 * RODS.l2, terminal=True),
]


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("event", OF_RODS)
def test_rods_go_on_as_if_nothing_had_ended(event: Event, method: MethodName, way: int) -> None:
    """A regular motion, whose pieces are one run with all its events."""
    times = ends([RODS], QUIET, event, 300, method, way)
    onward = dataclasses.replace(event, terminal=0)
    whole = solve(RODS, QUIET, times[-1] + way * 1e-3, method, events=onward)
    np.testing.assert_allclose(times, whole.events[0].times, rtol=1e-10)


@pytest.mark.parametrize("event", OF_RODS)
def test_wild_rods_always_move_on(event: Event) -> None:
    """Angles of hundreds of radians on the way, whose last bits are in the height of the tip."""
    for method, way in itertools.product(METHODS, WAYS):
        every_turn = dataclasses.replace(event, every_turn=event.kind == "angle")
        times = ends([RODS], WILD, every_turn, 1000, method, way)
        assert np.min(np.diff(times) * way) > 1e-6


@pytest.mark.parametrize("t0", [1.0, 1e6, -1e9])
def test_the_last_bits_of_a_late_start_hide_no_event(t0: float) -> None:
    """Half periods follow one another, as far as the bits of the time show them."""
    for method, event in itertools.product(METHODS, [OF_RODS[0], OF_RODS[2]]):
        times = ends([SIMPLE], (1.0, 0.0), event, 100, method, 1, t0)
        np.testing.assert_allclose(
            np.diff(times), PERIOD / 2, rtol=1e-13, atol=4 * abs(np.spacing(t0))
        )


def test_the_state_may_be_that_of_another_bit_of_the_time() -> None:
    """Found by the run to a time of ten digits more than it can be given."""
    t0, omega = 1e6, -4.2
    state = (0.5 * omega * np.spacing(t0), omega)  # half a bit of the time beyond the lowest point
    for method in METHODS:
        (crossings,) = solve(SIMPLE, state, t0 + 0.3, method, t0=t0, events=angle(1, 0.0)).events
        assert crossings.times.size == 0
        (crossings,) = solve(SIMPLE, state, 0.3, method, events=angle(1, 0.0)).events
        assert crossings.times.size == (state[0] * omega < 0)


@pytest.mark.parametrize("event", OF_RODS)
def test_sections_and_lanes_go_on(event: Event) -> None:
    """Crossing by crossing, as one section; and all the crossings at once, through the lanes."""
    whole = poincare_section(RODS, QUIET, dataclasses.replace(event, terminal=0), 100)
    state: Any = QUIET
    for n in range(100):
        one = poincare_section(RODS, state, dataclasses.replace(event, terminal=0), 1)
        state = one.states[0]
        np.testing.assert_allclose(state, whole.states[n], rtol=1e-8, atol=1e-10)
    runs = ensemble(RODS, whole.states[:99], [9.0], events=event)
    assert runs.events[0].trajectories.tolist() == list(range(99))
    np.testing.assert_allclose(runs.events[0].times, np.diff(whole.times), rtol=1e-9)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("ending", "other"),
    [
        (angle(1, 0.0, terminal=True), angle(1, 0.0)),
        (angle(1, 0.5, terminal=True), tip_height(-0.5 * math.cos(0.5))),
        (tip_height(-0.45, terminal=True), tip_height(-0.45)),
        (velocity_zero(1, terminal=True), velocity_zero(1, direction=1)),
    ],
)
def test_an_event_at_the_instant_of_the_end_is_reported(
    ending: Event, other: Event, method: MethodName, way: int
) -> None:
    """In whatever order they are listed; the next run, which starts there, would not find it."""
    counts = []
    for asked in ([ending, other], [other, ending]):
        t, state, found = 0.0, np.array([1.0, 0.0]), 0
        for _ in range(40):
            run = solve(SIMPLE, state, t + way * 50.0, method, t0=t, events=asked)
            t, state = run.t[-1], run.states[-1]
            found += run.events[asked.index(other)].times.size
            assert np.all(run.events[asked.index(other)].times * way <= t * way)
        whole = solve(SIMPLE, (1.0, 0.0), t + way * 1e-9, method, events=[other])
        assert found == whole.events[0].times.size
        lanes = ensemble(SIMPLE, [(1.0, 0.0), (0.9, 0.0)], [50.0], method, events=asked)
        counts.append([each.times.size for each in lanes.events])
    assert counts[0] == counts[1][::-1]


# ---- parity: velocities change their sign as often as the run reports it ----


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5, 1e-6, 1e-9])
@pytest.mark.parametrize("method", METHODS)
def test_every_change_of_sign_is_an_event(method: MethodName, tolerance: float) -> None:
    """Between any two steps, with loose tolerances, too, and through the lanes."""
    rng = np.random.default_rng(12)
    starts = [(0.5, 1.2, 0.0, 0.0), (0.6, 2.2, 0.0, 0.0), *rng.uniform(-3.0, 3.0, (200, 4))]
    asked = [velocity_zero(1), velocity_zero(2)]
    runs = ensemble(RODS, starts, [6.0], method, tolerance=tolerance, events=asked)
    for n, start in enumerate(starts):
        run = solve(RODS, start, 6.0, method, tolerance=tolerance, events=asked)
        for i in (0, 1):
            times, omega = run.events[i].times, run.states[:, 2 + i]
            in_lanes = runs.events[i].times[runs.events[i].trajectories == n]
            assert times.tobytes() == in_lanes.tobytes()
            told = np.histogram(times, run.t)[0]
            changed = np.signbit(omega[1:]) != np.signbit(omega[:-1])
            at_rest = omega[:-1] == 0.0
            assert np.all((told % 2 == changed) | at_rest)
            assert np.all(np.abs(run.events[i].states[:, 2 + i]) < 1e-13)
