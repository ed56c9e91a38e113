"""Poincaré sections: a motion at each of its crossings of a surface."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from pendula import _engine
from pendula._checks import LARGEST_COUNT, finite_number, whole_number
from pendula.run._arguments import checked_state, checked_tolerance, log2_of
from pendula.run.events import Crossings, Event, checked_events
from pendula.systems import System, check_system

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

_MOST_CROSSINGS = 10**8  # 4 GB
_MOST_STEPS = 10**8  # about a minute


def poincare_section(
    system: System,
    state: ArrayLike,
    event: Event,
    n: int,
    *,
    t0: float = 0.0,
    tolerance: float | None = None,
    max_steps: int | None = None,
) -> Crossings:
    """The first n crossings of a surface by the motion from a state, with the Taylor method.

    Args:
        system: a pendulum.
        state: (θ, ω) or (θ1, θ2, ω1, ω2) at time t0, (d,) [rad, rad/s].
        event: the surface, such as angle(1, 0.0, direction=1, every_turn=True).
        n: how many crossings.
        t0: time of the state [s].
        tolerance: of the method, 1e-3 down to 2^-52 (the standard).
        max_steps: most steps to look for them; about 10^8, a minute, if none is named.

    Returns:
        Times (n,) [s] and states (n, d) [rad, rad/s] of the crossings.

    Raises:
        ValueError: for an argument out of range, or where the motion does not cross so often.
    """
    import numpy as np

    check_system(system)
    start = checked_state(state, system)
    (surface,) = checked_events(event, system, "event")
    count = whole_number("n", n, _MOST_CROSSINGS)
    origin = finite_number("t0", t0, "s")
    limit = (
        _MOST_STEPS if max_steps is None else whole_number("max_steps", max_steps, LARGEST_COUNT)
    )
    *_, outcome, steps, _, crossings, _ = _engine.solve_adaptive(
        system._description(),
        "taylor",
        start.tolist(),
        origin,
        math.inf,
        log2_of(checked_tolerance(tolerance)),
        limit,
        np.array([math.inf]),  # no outputs
        [replace(surface, terminal=count).row()],
        None,
    )
    found = Crossings(*crossings[0])
    if len(found.times) < count:
        raise ValueError(
            f"n must be a number of crossings that the motion makes: {len(found.times)} of {count} "
            f"were found in {steps} steps ({outcome}); take a larger max_steps or another event"
        )
    return found
