"""Runs with variations: small changes of a motion to first order, for all the indicators."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from pendula import _engine
from pendula._angles import warn_of_degrees
from pendula._checks import checked_threads, finite_array, finite_number, states_array
from pendula._messages import ArgumentError
from pendula._rules import refuse
from pendula.run.options import checked_types
from pendula.run.request import Request, times_array
from pendula.systems import System, check_system

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from pendula._progress import Progress
    from pendula._types import Array

    Use = Literal["free", "megno", "orthogonal"]

OPTIONS = "tolerance", "max_steps"
_TAKEN_OFF = 300.0  # the core keeps long variations short by powers of 2^300


@dataclass(frozen=True, eq=False)
class VariedRuns:
    """What n runs with k variations tell at their m outputs.

    Attributes:
        t: times of the outputs, (m,) [s].
        states: (n, m, d) [rad, rad/s].
        directions: of the variations in (θ…, ω…), of any length, (n, m, k, d).
        taken_off: from each of them, as a power of two, (n, m, k): 0 until it has grown by 2^300.
        growth: ln(|δ(t)|/|δ(0)|) of each variation; where they are made orthogonal, of the part of
            it that is orthogonal to those before it, (n, m, k).
        integrals: ∫ growth dt and ∫ MEGNO dt of the first one, (n, m, 2); None: not asked.
        outcomes: how each run ended, (n,).
        n_steps: (n,).
        reached: the time up to which each was made, (n,) [s].
    """

    t: Array
    states: Array
    directions: Array
    taken_off: Array
    growth: Array
    integrals: Array | None
    outcomes: NDArray[np.str_]
    n_steps: NDArray[np.int64]
    reached: Array


@dataclass(frozen=True, eq=False)
class Asked:
    """What a measure of chaos is asked for, checked.

    Attributes:
        system: the pendulum.
        starts: states at t0, (n, d) [rad, rad/s].
        single: whether one state (d,) was given.
        t: times of the outputs, rising or falling from t0, (m,) [s].
        t0: time of the starts [s].
        options: of the runs.
    """

    system: System
    starts: Array
    single: bool
    t: Array
    t0: float
    options: Mapping[str, Any]

    def recipe(self, tangents: ArrayLike | None, **arguments: Any) -> dict[str, Any]:
        """What a result was made with, beside system and start, as data that JSON can hold."""
        import numpy as np

        given = None if tangents is None else np.asarray(tangents, float).tolist()
        options = {name: each for name, each in self.options.items() if name in OPTIONS}
        return {**arguments, "t0": self.t0, "tangents": given, **options}

    def shaped(self, values: Any) -> Any:
        """Values (n, ...) as they were asked for: without the first axis for one state."""
        return values[0] if self.single else values

    def runs(self, variations: Array, use: Use, threads: object, progress: Progress) -> VariedRuns:
        """The runs with variations (k, d) of all starts."""
        import numpy as np

        (n, d), k, m = self.starts.shape, len(variations), self.t.size
        parameters = np.array([list(self.system.parameters.values())])
        result = _engine.varied(
            self._request().for_core(self.system, "taylor"),
            use,
            np.ascontiguousarray(variations),
            self.starts,
            parameters,
            checked_threads(threads),
            progress,
        )
        size = d + (d + 1) * k + (2 if use == "megno" else 0)
        told = result.states(m, size)
        each = told[..., d : d + (d + 1) * k].reshape(n, m, k, d + 1)
        directions, growth = each[..., :d], each[..., d]
        taken_off = np.zeros_like(growth) if use == "orthogonal" else growth * _TAKEN_OFF
        if use != "orthogonal":
            lengths = np.linalg.norm(directions, axis=-1) / np.linalg.norm(variations, axis=-1)
            growth = taken_off * math.log(2.0) + np.log(lengths)
        return VariedRuns(
            self.t,
            told[..., :d],
            directions,
            taken_off,
            growth,
            told[..., -2:] if use == "megno" else None,
            np.array(result.outcomes),
            np.asarray(result.n_steps, np.int64),
            result.reached,
        )

    def _request(self) -> Request:
        import numpy as np

        start = np.ascontiguousarray(self.starts[0])
        return Request(state=start, t=self.t, t0=self.t0, **self.options)


def asked_of(
    system: object, state: ArrayLike, t: ArrayLike, t0: float, function: str, **options: Any
) -> Asked:
    """The checked arguments of a measure of chaos, for one state (d,) or n of them, (n, d).

    Raises:
        TypeError: for an option that there is none of.
        ValueError: for an argument out of range.
    """
    import numpy as np

    one = check_system(system)
    starts = states_array(state, one.component_units)
    if starts.ndim not in (1, 2) or starts.size == 0:
        rule = "must be one state or states of shape (n, {wanted}), got shape {value}"
        raise ArgumentError("state", rule, wanted=starts.shape[-1], value=starts.shape)
    times = np.atleast_1d(times_array(t))
    given = checked_types(options, function, OPTIONS)
    rows = np.ascontiguousarray(np.atleast_2d(starts))
    asked = Asked(one, rows, starts.ndim == 1, times, finite_number("t0", t0, "s"), given)
    refuse(_engine.check(asked._request().for_core(one, "taylor")))
    warn_of_degrees("state", state, rows[:, : one.can.degrees_of_freedom])
    return asked


def first_variations(system: System, given: ArrayLike | None, count: int, name: str) -> Array:
    """Variations (count, d) to begin with: those given, or the usual ones.

    The usual first one has equal parts, the second alternating signs, (½, ½, ½, ½) and
    (½, −½, ½, −½) for the double pendulum; nothing is drawn at random.

    Raises:
        ValueError: for variations of another shape, or that are not independent.
    """
    import numpy as np

    d = len(system.components)
    if given is None:
        signs = [[1.0] * d, [(-1.0) ** i for i in range(d)]]
        signs += [[-1.0 if i in (1, 2) else 1.0 for i in range(d)]]
        signs += [[-1.0 if i in (2, 3) else 1.0 for i in range(d)]]
        return np.array(signs[:count]) / math.sqrt(d)
    values = np.atleast_2d(finite_array(name, given))
    if values.shape != (count, d):
        rule = "must be of shape ({count}, {wanted}), got {value}"
        raise ArgumentError(name, rule, count=count, wanted=d, value=np.shape(given))
    if np.linalg.matrix_rank(values) < count:
        raise ArgumentError(name, "must be independent, got {value}", value=values.tolist())
    return values
