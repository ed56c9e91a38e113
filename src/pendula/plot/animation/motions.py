"""Motions at the times of the frames, and finer in between for the path behind each bob."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from pendula._engine import method_named
from pendula._messages import ArgumentError
from pendula.run.request import Request, checked_name
from pendula.run.solve import solve
from pendula.run.trajectory import Trajectory

if TYPE_CHECKING:
    from collections.abc import Iterable

    from pendula._types import Array
    from pendula.run.options import RunOptions
    from pendula.systems import System

MOST_FRAMES = 20_000
_MOST_MOTIONS = 50
_FINE = 0.05  # rad: hardly more is turned from one point of a path to the next
_FINEST = 64  # points of a path for each frame


@dataclass(frozen=True, eq=False)
class Motion:
    """One motion, at times that all motions have in common.

    Attributes:
        system: the pendulum.
        points: the bob, or the ends of the rods, (n, d/2, 2) [m]; NaN before and after the motion.
        kinetic: energy, (n,) [J].
        potential: energy, (n,) [J].
    """

    system: System
    points: Array
    kinetic: Array
    potential: Array


def single(runs: Trajectory | Iterable[Trajectory]) -> list[Trajectory]:
    """The runs one by one; those of several exact solutions too.

    Raises:
        ValueError: for none, too many, what is no run, or one without a time.
    """
    given = [runs] if isinstance(runs, Trajectory) else list(runs)
    found: list[Trajectory] = []
    for run in given:
        if not isinstance(run, Trajectory):
            rule = "must be trajectories, as solve and exact return them, got {value}"
            raise ArgumentError("runs", rule, value=run)
        found.extend([run] if run.states.ndim == 2 else _separate(run))
    if not 1 <= len(found) <= _MOST_MOTIONS:
        rule = "must be from 1 to {most} motions, got {value}"
        raise ArgumentError("runs", rule, most=_MOST_MOTIONS, value=len(found))
    for run in found:
        if run.t.size == 0:
            raise ArgumentError("runs", "must have an output, got {value}", value=run)
    return found


def frame_times(runs: list[Trajectory], interval: float, speed: float) -> Array:
    """The times of the frames, (n,) [s]: from the first output of any run to the last.

    Args:
        runs: what is shown; where all go backward in time, so do the frames.
        interval: from frame to frame, as it is watched [s].
        speed: seconds of the motion in one that is watched.

    Raises:
        ValueError: where that is less than a frame, or too many.
    """
    spans = [span(run) for run in runs]
    backward = all(end < start for start, end in spans)
    first, last = min(map(min, spans)), max(map(max, spans))
    begin, direction = (last, -1.0) if backward else (first, 1.0)
    step = interval * speed
    count = math.floor((last - first) / step * (1 + 1e-12)) + 1
    if not 2 <= count <= MOST_FRAMES:
        rule = "must give from 2 to {most} frames, got {value} for {text}"
        text = f"{last - first:.4g} s in steps of {step:.4g} s"
        way_out = "a smaller <speed> gives more, a larger one fewer"
        raise ArgumentError("speed", rule, way_out, most=MOST_FRAMES, value=count, text=text)
    return np.asarray(begin + direction * step * np.arange(count))


def points_a_frame(runs: list[Trajectory], times: Array) -> int:
    """How many points of a path make it smooth from one frame to the next."""
    fastest = max(float(np.abs(run.omega).max()) for run in runs)
    turned = fastest * abs(float(times[1] - times[0]))
    return int(np.clip(math.ceil(turned / _FINE), 1, _FINEST))


def finer(times: Array, parts: int) -> Array:
    """Times with so many parts from each to the next; those given are among them as they are."""
    steps = np.arange(parts) / parts
    inner = times[:-1, np.newaxis] + np.diff(times)[:, np.newaxis] * steps
    return np.append(inner.ravel(), times[-1])


def motion(run: Trajectory, times: Array) -> Motion:
    """A run at these times (n,)."""
    first, last = sorted(span(run))
    rounding = 4 * np.spacing(max(abs(first), abs(last)))
    there = (times >= first - rounding) & (times <= last + rounding)
    states = np.full((times.size, run.states.shape[-1]), np.nan)
    states[there] = _states(run, np.clip(times[there], first, last))
    points = np.full((times.size, states.shape[1] // 2, 2), np.nan)
    kinetic, potential = np.full(times.size, np.nan), np.full(times.size, np.nan)
    points[there] = run.system.positions(states[there])
    kinetic[there] = run.system.kinetic_energy(states[there])
    potential[there] = run.system.potential_energy(states[there])
    return Motion(run.system, points, kinetic, potential)


def span(run: Trajectory) -> tuple[float, float]:
    """The first and the last time that is shown; of a single output, from the start to it [s]."""
    if run.method == "exact":
        if run.t.size == 1:
            return run.request.t0, float(run.t[0])
        first, last = float(run.t.min()), float(run.t.max())
        return (first, last) if run.t[0] <= run.t[-1] else (last, first)
    begin = run.t[0] if run.t.size > 1 else run.request.t0
    return float(begin), float(run.t[-1])


def _states(run: Trajectory, times: Array) -> Array:
    """States (n, d) at times (n,): dense output, or those of the same run with these outputs."""
    asked = run.request
    if asked.digits is None and (run.method == "exact" or method_named(run.method).adaptive):
        return run.at(times)
    wanted = np.unique(times)  # rising
    direction = 1 if asked.end >= asked.t0 else -1
    options: RunOptions = {"step": asked.step, "digits": asked.digits}
    again = solve(
        run.system,
        asked.state,
        wanted[::direction],
        checked_name(run.method),
        t0=asked.t0,
        **options,
    )
    return np.asarray(again.states[::direction][np.searchsorted(wanted, times)])


def _separate(run: Trajectory) -> list[Trajectory]:
    """Several exact solutions as runs of their own."""
    starts = run.request.state.reshape(-1, run.states.shape[-1])
    states = run.states.reshape(-1, *run.states.shape[-2:])
    return [
        replace(run, states=mine, request=Request(state=start, t=run.t, t0=run.request.t0))
        for start, mine in zip(starts, states, strict=True)
    ]
