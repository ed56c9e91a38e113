"""What a run returns: times, states, how it ended, and what is needed to run it again."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._checks import LARGEST_COUNT, check_finite, finite_array
from pendula._late_methods import with_promised
from pendula.run._arguments import MOST_OWN_STEPS, log2_of
from pendula.systems import LinearPendulum, SimplePendulum

if TYPE_CHECKING:
    from collections.abc import Callable
    from os import PathLike

    import pandas as pd
    import xarray as xr
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from pendula._types import Array
    from pendula.run.events import Crossings, Event
    from pendula.systems import System


@dataclass(frozen=True)
class Request:
    """What was asked for: enough to run it again.

    Attributes:
        state: at time t0, (d,), or (..., d) for several exact solutions.
        t0: time of that state [s].
        t: the one end time, where the output is the method's own steps, or output times, (n,) [s].
        step: of a fixed-step method [s].
        max_steps: most steps allowed; None: no limit.
        tolerance: of an adaptive method.
        events: looked for inside the steps.
        certify: angle by which the run may be off up to its trust horizon [rad].
        digits: that are right at every output time.
    """

    state: Array
    t: float | Array
    t0: float = 0.0
    step: float | None = None
    max_steps: int | None = None
    tolerance: float | None = None
    events: tuple[Event, ...] = ()
    certify: float | None = None
    digits: int | None = None


@with_promised
@dataclass(frozen=True, eq=False)
class Trajectory:
    """A motion at discrete times.

    Attributes:
        system: the pendulum.
        method: name of the method; "exact" for the closed form.
        t: output times, (n,) [s].
        states: (n, d), or (..., n, d) for exact solutions from (..., d): (θ, ω) or (θ1, θ2, ω1,
            ω2), in radians and radians per second.
        request: what was asked for.
        outcome: how the run ended: "reached_end", "event", "step_limit" or "not_finite"; the output
            holds what was reached before.
        n_steps: steps taken, shortened ones included.
        n_evaluations: of the right-hand side; of the series, with the Taylor method.
        events: times and states of each event asked for, in that order.
        trust_horizon: first time at which an angle of the run is off by more than `certify` [s];
            inf: not within the run; None: not asked.
        dense: what a run with steps of its own left for `at`; None: `at` makes the run again.
        precision: decimal digits that a run with `digits` was computed with; None: a double's.
    """

    system: System
    method: str
    t: Array
    states: Array
    request: Request
    outcome: str = "reached_end"
    n_steps: int = 0
    n_evaluations: int = 0
    events: tuple[Crossings, ...] = ()
    trust_horizon: float | None = None
    precision: int | None = None
    dense: _engine.DenseOutput | None = field(default=None, repr=False)

    @property
    def theta(self) -> Array:
        """Angles, never wrapped: (n,), or (n, 2) for the double pendulum [rad]."""
        return self._half(0)

    @property
    def omega(self) -> Array:
        """Angular velocities, shaped as the angles [rad/s]."""
        return self._half(1)

    @property
    def kinetic_energy(self) -> Array:
        """Kinetic energy at each time, (n,) [J]."""
        return self.system.kinetic_energy(self.states)

    @property
    def potential_energy(self) -> Array:
        """Potential energy at each time, zero at the lowest point, (n,) [J]."""
        return self.system.potential_energy(self.states)

    @property
    def energy(self) -> Array:
        """Total energy at each time, (n,) [J]."""
        return self.system.energy(self.states)

    @property
    def energy_error(self) -> Array:
        """(E(t) − E(t0)) / E(t0), (n,); over mgL (or D + E) for a start at rest at the bottom."""
        import numpy as np

        start = self.system.energy(self.request.state)[..., np.newaxis]
        scale = np.where(start == 0.0, self.system.constants["energy_scale"], start)
        return (self.energy - start) / scale

    @property
    def positions(self) -> Array:
        """The bob, or the end of each rod, (n, d/2, 2) [m]."""
        return self.system.positions(self.states)

    def at(self, t: ArrayLike) -> Array:
        """States (n, d) at any times (n,) of the run, in any order [rad, rad/s].

        The closed form takes any time; the methods with dense output (`methods()`: the adaptive
        ones) give what the run itself would have given as output at these times.

        Raises:
            ValueError: for a method without dense output, or a time outside the run.
        """
        times = finite_array("t", t, "s")
        if self.method == "exact":
            states = exact_states(self.system, self.request.state, times.ravel(), self.request.t0)
        else:
            states = self._inside_steps(times.ravel())
        return states.reshape((*self.request.state.shape[:-1], *times.shape, states.shape[-1]))

    def _inside_steps(self, times: Array) -> Array:
        """The dense output at times (n,) in any order."""
        import numpy as np

        asked = self.request
        if asked.tolerance is None:
            raise ValueError(
                f"at needs a method with dense output, got {self._told()}; "
                "ask solve for these times: solve(system, state, t, ...)"
            )
        last = self._dense.reached
        direction = -1.0 if last < asked.t0 else 1.0
        beyond = ((times - asked.t0) * direction < 0) | ((times - last) * direction > 0)
        if beyond.any():
            raise ValueError(
                f"t must lie within the run, from {asked.t0!r} to {last!r} s, "
                f"got {float(times[beyond.argmax()])!r}"
            )
        order = np.argsort(direction * times, kind="stable")
        states = np.empty((times.size, asked.state.size))
        states[order] = self._dense.at(np.ascontiguousarray(times[order]))
        return states

    @cached_property
    def _dense(self) -> _engine.DenseOutput:
        """What the run left, or, of one read from a file, the same run made again."""
        if self.dense is not None:
            return self.dense
        again: _engine.DenseOutput = run_adaptive(self.system, self.method, self.request, None)[-1]
        return again

    def _told(self) -> str:
        return repr(self.method) if self.request.digits is None else "a run with digits"

    def __getstate__(self) -> dict[str, Any]:
        """Without what can be made again."""
        kept = {field.name: getattr(self, field.name) for field in fields(self)}
        return {**kept, "dense": None}

    if TYPE_CHECKING:  # attached by the modules that define them

        def to_xarray(self) -> xr.Dataset:
            """See `pendula.io.to_xarray`."""

        def to_pandas(self) -> pd.DataFrame:
            """See `pendula.io.to_pandas`."""

        def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> None:
            """See `pendula.io.save`."""

        def plot(self) -> Figure:
            """See `pendula.plot.trajectory`."""

    def __repr__(self) -> str:
        span = f"t = {self.t[0]:g} … {self.t[-1]:g} s" if self.t.size else "no times"
        return (
            f"<Trajectory of {self.system!r} by {self.method!r}: {self.t.size} times, {span}, "
            f"{self.outcome}>"
        )

    def _half(self, which: int) -> Array:
        count = self.states.shape[-1] // 2
        part = self.states[..., which * count : (which + 1) * count]
        return part[..., 0] if count == 1 else part


def run_adaptive(
    system: System, method: str, asked: Request, progress: Callable[[float], None] | None
) -> tuple[Any, ...]:
    """What the core gives for a checked request.

    Times, states, how the run ended, steps, evaluations, (times, states) of each event, and the
    dense output.
    """
    import numpy as np

    own_steps = isinstance(asked.t, float)
    end = asked.t if isinstance(asked.t, float) else float(asked.t[-1])
    span = end - asked.t0
    return _engine.solve_adaptive(
        system._description(),
        method,
        asked.state.tolist(),
        asked.t0,
        end,
        log2_of(asked.tolerance or 1.0),
        asked.max_steps or (MOST_OWN_STEPS if own_steps else LARGEST_COUNT),
        None if own_steps else np.asarray(asked.t),
        [each.row() for each in asked.events],
        None if progress is None else lambda t: progress((t - asked.t0) / span),
    )


def exact_states(system: System, state: Array, t: Array, t0: float) -> Array:
    """The closed form at times (n,) from the state at t0: (n, 2), or (..., n, 2) for (..., 2).

    Raises:
        ValueError: where an angle or a time is so large that nothing of the motion is left of it.
    """
    import numpy as np

    length, gravity, _ = system.parameters.values()
    states = np.ascontiguousarray(state.reshape(-1, 2))
    out = np.empty((len(states), t.size, 2))
    if t.size == 0:
        check_finite("state", state)
    if not _engine.exact_solutions[system.name](length, gravity, states, t, t0, out):
        check_finite("state", state)
        _refuse(system, states, t - t0, out)
    return out.reshape((*state.shape[:-1], t.size, 2))


def _refuse(system: System, states: Array, elapsed: Array, out: Array) -> None:
    """Say which state or time the closed form refused."""
    import numpy as np

    where = int(np.isnan(out[..., 0]).argmax())
    which, when = divmod(where, elapsed.size)
    if isinstance(system, LinearPendulum | SimplePendulum):
        system.check_start(states[which])
    linear = isinstance(system, LinearPendulum)
    most = _engine.COUNTED_HALF_PERIODS if linear else _engine.MOST_HALF_PERIODS
    raise ValueError(
        f"t must lie within 2^{math.log2(most):.0f} half periods of t0, which are all that is "
        "counted; take whole periods off; "
        f"got t - t0 = {float(elapsed[when])!r} s from state {states[which].tolist()}"
    )
