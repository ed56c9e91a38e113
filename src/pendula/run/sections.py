"""Poincaré sections: a motion at each of its crossings of a surface."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from pendula import _engine
from pendula._angles import warn_of_degrees
from pendula._checks import checked_progress, finite_number, whole_number
from pendula._messages import ArgumentError
from pendula._progress import with_bar
from pendula._rules import refuse
from pendula.run.events import Crossings, Event, checked_events, crossings_of
from pendula.run.options import checked_types, takes_options
from pendula.run.reach import check_reachable
from pendula.run.request import Request, check_angles, checked_state
from pendula.systems import System, check_system

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any, Unpack

    from numpy.typing import ArrayLike

    from pendula._progress import AskedProgress
    from pendula._types import Array
    from pendula.run.options import RunOptions

_MOST_CROSSINGS = 10**8  # 4 GB
_MOST_STEPS = 10**8  # about a minute
_OPTIONS = "tolerance", "max_steps"


@with_bar("section")
@takes_options(*_OPTIONS, max_steps="a hundred million")
def poincare_section(
    system: System,
    state: ArrayLike,
    event: Event,
    n: int,
    *,
    t0: float = 0.0,
    progress: AskedProgress = None,
    **options: Unpack[RunOptions],
) -> Crossings:
    """The first n crossings of a surface by the motion from a state, with the Taylor method.

    A surface that the motion cannot reach with its energy is refused before the run.

    Args:
        system: a pendulum.
        state: (θ, ω) or (θ1, θ2, ω1, ω2) at time t0, (d,) [rad, rad/s].
        event: the surface, such as angle(1, 0.0, direction=1, every_turn=True).
        n: how many crossings.
        t0: time of the state [s].
        progress: called with the part of the crossings that is found, 0 to 1; True: a bar.
        **options: see `RunOptions`.

    Returns:
        Times (n,) [s] and states (n, d) [rad, rad/s] of the crossings.

    Raises:
        ValueError: for an argument out of range, or where the motion does not cross so often.
    """
    check_system(system)
    report = checked_progress(progress)
    count, surface = whole_number("n", n, _MOST_CROSSINGS), _surface(event)
    start = checked_state(state, system, "call poincare_section for each")
    check_angles(system, start)
    warn_of_degrees("state", state, start[: system.can.degrees_of_freedom])
    asked = _asked(start, t0, replace(surface, terminal=count), options).for_core(system, "taylor")
    refuse(_engine.check(asked), digits=False)
    check_reachable(system, start, surface, count)
    result = _engine.solve(asked, report)
    (found,) = crossings_of(result.events, start.size)
    if len(found.times) < count:
        raise ArgumentError(
            "n",
            "must be a number of crossings that the motion makes: {text} were found in "
            f"{result.n_steps} steps ({result.outcome})",
            "take a larger <max_steps> or another event",
            text=f"{len(found.times)} of {count}",
        )
    return found


def _surface(event: object) -> Event:
    """The one event."""
    surfaces = checked_events(event, "event")
    if len(surfaces) != 1:
        raise ArgumentError("event", "must be one event, got {value} of them", value=len(surfaces))
    return surfaces[0]


def _asked(start: Array, t0: float, surface: Event, options: Mapping[str, Any]) -> Request:
    """A run without outputs or an end, but for the crossings."""
    import numpy as np

    return Request(
        state=start,
        t=np.array([math.inf]),
        t0=finite_number("t0", t0, "s"),
        **{
            "max_steps": _MOST_STEPS,
            **checked_types(options, "poincare_section", _OPTIONS),
            "events": (surface,),
        },
    )
