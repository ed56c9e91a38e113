"""The closed forms over arrays, and what they refuse."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula import _engine
from pendula._checks import check_finite
from pendula._messages import ArgumentError
from pendula.systems import with_closed_form

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.systems import ClosedForm, System


def exact_states(system: System, state: Array, t: Array, t0: float) -> Array:
    """The closed form at times (n,) from the state at t0: (n, 2), or (..., n, 2) for (..., 2).

    Raises:
        ValueError: where an angle or a time is so large that no digit of the motion is known.
    """
    import numpy as np

    solvable = with_closed_form(system)
    states = np.ascontiguousarray(state.reshape(-1, 2))
    out = np.empty((len(states), t.size, 2))
    if t.size == 0:
        check_finite("state", state)
    if not _engine.exact(system._description(), states, t, t0, out):
        check_finite("state", state)
        _refuse(solvable, states, t - t0, out)
    return out.reshape((*state.shape[:-1], t.size, 2))


def _refuse(system: ClosedForm, states: Array, elapsed: Array, out: Array) -> None:
    """Say which state or time the closed form refused."""
    import numpy as np

    which, when = divmod(int(np.isnan(out[..., 0]).argmax()), elapsed.size)
    system.check_start(states[which])
    raise ArgumentError(
        "t",
        "must lie within 2^{text} half periods of <t0>, which are all that is counted; take whole "
        "periods off; got t - t0 = {value} s from state {state}",
        text=round(math.log2(system.most_half_periods)),
        value=float(elapsed[when]),
        state=states[which].tolist(),
    )
