"""Until when the states of a run are right, and to how many digits its exponents are till then."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from pendula._progress import part
from pendula.run.options import BEST_TOLERANCE
from pendula.run.solve import solve

if TYPE_CHECKING:
    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.chaos.growths import Plan
    from pendula.chaos.variations import Asked

_LEAST_OFF = 1e-16  # rad: nearer to the motion than a double is no run
_FARTHER = 8.0  # times as far as the states are off: where a displaced run ends from the motion
_ROUNDINGS = 8.0  # of a start: displaced by less, a run would show its own errors
_EPSILON = 2.0**-52
_A_STEP = 4.0  # roundings of the growth in a step, with room
_COARSER = 1.5, 2.0, 3.0  # times the tolerance: steps differ, what a step leaves out hardly
_ROOM = 4.0  # times the largest of three differences of errors, for one of the errors
_LOOKS = 32  # at which it is looked how far changes of a start have got


class Certified(NamedTuple):
    """Finite-time exponents along states that are right.

    Attributes:
        horizon: up to here they are, of each run, (n,); infinite: not within the run [s].
        exponents: at the horizon or the end, (n, k); NaN: it lies in the transient [1/s].
        errors: of them, at most, (n, k) [1/s].
    """

    horizon: Array
    exponents: Array
    errors: Array


def certified(asked: Asked, plan: Plan, certify: float, progress: Progress) -> Certified:
    """Exponents along states that are right to an angle, with bounds on their errors.

    Args:
        asked: the motions.
        plan: how their exponents are worked out.
        certify: by what angles may be off up to the horizon [rad].
        progress: called with the part that is done.
    """
    import numpy as np

    n, end = len(asked.starts), float(asked.t[-1])
    horizon = np.empty(n)
    exponents, errors = np.full((2, n, plan.count), math.nan)
    for i in range(n):
        one = replace(asked, starts=asked.starts[i : i + 1], single=False)
        done = part(progress, i / n, (i + 1) / n)
        horizon[i] = _horizon(one, end, certify, part(done, 0.0, 0.5))
        until = min(float(horizon[i]), end)
        if until > asked.t0 + plan.transient:
            exponents[i], errors[i] = _up_to(one, plan, until, certify)
        if done is not None:
            done(1.0)
    return Certified(horizon, exponents, errors)


def _horizon(one: Asked, end: float, certify: float, progress: Progress) -> float:
    """The trust horizon of a run [s]; infinite: not before its end."""
    run = solve(
        one.system,
        one.starts[0],
        [end],
        t0=one.t0,
        certify=certify,
        progress=progress,
        **one.options,
    )
    assert run.trust_horizon is not None
    return float(run.trust_horizon)


def _up_to(one: Asked, plan: Plan, until: float, certify: float) -> tuple[Array, Array]:
    """The exponents of one motion up to a time, and by how much they may be off, (k,) [1/s].

    The start is displaced along each component, so that angles get up to eight times as far away as
    they are off; in that proportion the exponents change by what they may be off. To that comes
    what rounding does to the variations, which of those that shrink is more than of others: runs
    with other steps show it.
    """
    import numpy as np

    start, off = one.starts[0], _off(one, until, certify)
    d = start.size
    asked = replace(one, t=plan.outputs(one.t0, np.array([until])))
    scales = np.where(np.arange(d) < d // 2, 1.0, one.system.fastest_frequency)
    reach = np.maximum(_reach(one, until, plan.threads), 1.0 / scales)
    least = _ROUNDINGS * _EPSILON * np.maximum(abs(start), scales)
    displaced = start + np.diag(np.maximum(_FARTHER * off / reach, least))
    moved = displaced.diagonal() - start  # what rounding leaves of it
    growths, _, runs = plan.growth(replace(asked, starts=np.vstack([start, displaced])), None)
    here, *there = growths[:, -1]
    slopes = abs(np.array(there) - here) / (reach * moved)[:, np.newaxis]
    rounding = np.maximum(_A_STEP * _EPSILON * runs.n_steps[0], _seen(asked, plan, here))
    elapsed = until - one.t0 - plan.transient
    return here / elapsed, (off * slopes.sum(axis=0) + rounding) / elapsed


def _off(one: Asked, until: float, certify: float) -> float:
    """By what the angles of a run are off up to a time, within a factor of ten, at most [rad]."""
    low, high = 0, 1 + max(0, math.floor(math.log10(certify / _LEAST_OFF)))
    while high - low > 1:  # that of 10^-low is known to be enough
        middle = (low + high) // 2
        if _horizon(one, until, certify * 10.0**-middle, None) >= until:
            low = middle
        else:
            high = middle
    return certify * 10.0**-low


def _reach(one: Asked, until: float, threads: object) -> Array:
    """By how much angles change up to a time by a unit of each component, at most, (d,)."""
    import numpy as np

    d = one.starts.shape[1]
    times = one.t0 + (until - one.t0) * np.arange(1, _LOOKS + 1) / _LOOKS
    runs = replace(one, t=times).runs(np.eye(d), "free", threads, None)
    angles = np.abs(runs.directions[0, ..., : d // 2]).max(axis=-1) * np.exp2(runs.taken_off[0])
    found: Array = angles.max(axis=0)
    return found


def _seen(asked: Asked, plan: Plan, here: Array) -> Array:
    """What rounding does to growths, by runs with other steps, with room, (k,)."""
    import numpy as np

    tolerance = asked.options.get("tolerance") or BEST_TOLERANCE
    most = np.zeros_like(here)
    for times in _COARSER:
        other = replace(asked, options={**asked.options, "tolerance": times * tolerance})
        most = np.maximum(most, abs(plan.growth(other, None)[0][0, -1] - here))
    return _ROOM * most
