"""What a run returns: times, states, how it ended, and what is needed to run it again."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from functools import cached_property
from typing import TYPE_CHECKING, Any, overload

from pendula import _engine
from pendula._checks import finite_array
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula._tables import html_table
from pendula.run.balance import EnergyBalance, Pieces, balance_of, pieces_of
from pendula.run.closed_form import exact_states
from pendula.run.facts import facts_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from os import PathLike

    import pandas as pd
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from pendula._progress import AskedProgress
    from pendula._types import Array
    from pendula.run.derivatives import CrossingDerivatives
    from pendula.run.events import Crossings
    from pendula.run.request import Request
    from pendula.systems import System


_ROUNDINGS = 2.0**43  # of an angle, which the energy of a swing of that size has to ten digits


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
        reached: the time up to which the motion is known [s]; inf: the closed form's is, always.
        events: times and states of each event asked for, in that order.
        trust_horizon: first time at which an angle of the run is off by more than `certify` [s];
            inf: not within the run; None: not asked.
        changes: what the run left for `pieces`; None: `pieces` makes the run again.
        dense: what a run with steps of its own left for `at`; None: `at` makes the run again.
        precision: decimal digits that a run with `digits` was computed with; None: a double's.
        derivatives: of the states by what `derivative_names` says, (n, d, k); None: not asked.
        derivative_names: components of the start, and parameters, (k,).
        event_derivatives: of the times and states of each event, in that order.
    """

    system: System
    method: str
    t: Array
    states: Array
    request: Request
    outcome: str = "reached_end"
    n_steps: int = 0
    n_evaluations: int = 0
    reached: float = math.inf
    events: tuple[Crossings, ...] = ()
    trust_horizon: float | None = None
    precision: int | None = None
    derivatives: Array | None = None
    derivative_names: tuple[str, ...] = ()
    event_derivatives: tuple[CrossingDerivatives, ...] = ()
    changes: _engine.Pieces | None = field(default=None, repr=False)
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
        """(E(t) − E(t0)) / E(t0), (n,); over mgL (or D + E) for a start at rest at the bottom.

        The start is at rest where its energy is no more than the rounding of its angles could make:
        whole turns from the bottom, a double is off by some 1e-16 of the angle. With friction or a
        drive it is the defect of the balance, (E(t) − E(t0) − work + heat) over mgL (or D + E); of
        a run with `digits` the change of the energy over that.
        """
        import numpy as np

        start = self.system.energy(self.request.state)[..., np.newaxis]
        change = self.energy - start
        if self.system.can.conservative:
            return change / self._energy_scale[..., np.newaxis]
        if self.request.digits is None:
            change = (change - self.energy_balance.net) - self.energy_balance.net_tail
        return change / self.system.energy_scale

    @cached_property
    def energy_balance(self) -> EnergyBalance:
        """Work of each drive and heat of each friction since t0, integrated with the motion."""
        return balance_of(self)

    @property
    def work(self) -> Array:
        """Work done by drive and pivot since t0, (n,) [J]."""
        return self._summed(self.energy_balance.work_by)

    @property
    def heat(self) -> Array:
        """Heat that friction gave off since t0, (n,) [J]."""
        return self._summed(self.energy_balance.heat_by)

    @property
    def pieces(self) -> Pieces:
        """When friction in a joint changed, and which way each slips from then on (1, -1, 0)."""
        found = self._result_again.pieces if self.changes is None else self.changes
        return pieces_of(found, self.system.can.degrees_of_freedom)

    @property
    def energy_error_name(self) -> str:
        """What `energy_error` is: an error, the balance's defect or, with `digits`, a change."""
        if self.system.can.conservative:
            return "energy error"
        return "defect of the energy balance" if self.request.digits is None else "energy change"

    @property
    def _energy_scale(self) -> Array:
        """What the energy's error is relative to, (), or (...) for several exact solutions [J]."""
        import numpy as np

        start = self.system.energy(self.request.state)
        scale: Array = np.where(start < np.finfo(float).tiny, self.system.energy_scale, start)
        if self.system.can.periodic:
            half = self.system.can.degrees_of_freedom
            beside = np.zeros_like(self.request.state)
            beside[..., :half] = np.spacing(np.abs(self.request.state[..., :half])) * _ROUNDINGS
            scale = np.maximum(scale, self.system.energy(np.minimum(beside, 1.0)))
        return scale

    @property
    def positions(self) -> Array:
        """The bob, or the end of each rod, (n, d/2, 2) [m]."""
        return self.system.positions(self.states)

    def _summed(self, parts: Mapping[str, Array]) -> Array:
        import numpy as np

        return sum(parts.values(), np.zeros(self.states.shape[:-1]))

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
        if asked.digits is not None or not _engine.method_named(self.method).adaptive:
            raise ArgumentError(
                "at",
                "needs a method with dense output, got {value}",
                "ask solve for these times: solve(system, state, t, ...)",
                value=self.method if asked.digits is None else "a run with digits",
            )
        last = self._dense.reached
        direction = -1.0 if last < asked.t0 else 1.0
        beyond = ((times - asked.t0) * direction < 0) | ((times - last) * direction > 0)
        if beyond.any():
            rule = f"must lie within the run, from {asked.t0!r} to {last!r} s, got {{value}}"
            raise ArgumentError("t", rule, value=float(times[beyond.argmax()]))
        order = np.argsort(direction * times, kind="stable")
        states = np.empty((times.size, asked.state.size))
        states[order] = self._dense.at(np.ascontiguousarray(times[order]), asked.state.size)
        return states

    @cached_property
    def _dense(self) -> _engine.DenseOutput:
        """The dense output of the run; of one read from a file, that of the same run made again."""
        if self.dense is not None:
            return self.dense
        again = self._result_again.dense
        assert again is not None  # the method has dense output
        return again

    @cached_property
    def _result_again(self) -> _engine.RunResult:
        """What the core gives when the same run is made once more."""
        return _engine.solve(self.request.for_core(self.system, self.method), None)

    def __getstate__(self) -> dict[str, Any]:
        """Without what the core keeps of the run, which can be made again."""
        kept = {field.name: getattr(self, field.name) for field in fields(self)}
        return {**kept, "dense": None, "changes": None}

    if TYPE_CHECKING:  # attached by the modules that define them

        def to_xarray(self) -> xr.Dataset:
            """See `pendula.io.to_xarray`."""

        def to_pandas(self) -> pd.DataFrame:
            """See `pendula.io.to_pandas`."""

        def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> None:
            """See `pendula.io.save`."""

        @overload
        def plot(self, *, ax: None = None, language: str = "en") -> Figure: ...

        @overload
        def plot(self, *, ax: Axes | Sequence[Axes], language: str = "en") -> Any: ...

        def plot(self, *, ax: Any = None, language: str = "en") -> Any:
            """See `pendula.plot.trajectory`."""

        def animate(
            self,
            path: str | PathLike[str],
            *,
            speed: float = 1.0,
            fps: int | None = None,
            trail: float = 1.0,
            energy: bool = True,
            size: tuple[int, int] = (720, 600),
            names: Sequence[str] | None = None,
            language: str = "en",
            overwrite: bool = False,
            progress: AskedProgress = None,
        ) -> None:
            """See `pendula.plot.animate`."""

    def __repr__(self) -> str:
        span = f"t = {self.t[0]:g} … {self.t[-1]:g} s" if self.t.size else "no times"
        return (
            f"<Trajectory of {self.system!r} by {self.method!r}: {self.t.size} times, {span}, "
            f"{self.outcome}>"
        )

    def _repr_html_(self) -> str:
        """What a notebook shows: what was run, from where to where, and how well."""
        return html_table(f"Trajectory by {self.method}", facts_of(self))

    def _half(self, which: int) -> Array:
        count = self.system.can.degrees_of_freedom
        part = self.states[..., which * count : (which + 1) * count]
        return part[..., 0] if count == 1 else part
