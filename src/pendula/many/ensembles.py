"""Many trajectories at once."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._angles import warn_of_degrees
from pendula._checks import checked_progress, checked_threads, finite_number, states_array
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula._progress import part, with_bar
from pendula._rules import broken, refuse
from pendula._tables import html_table
from pendula.many.tasks import Runs, Task, run_task
from pendula.run.derivatives import check_method, checked_derivatives
from pendula.run.options import STANDARD_METHOD, checked_types, takes_options
from pendula.run.request import checked_name, times_array
from pendula.run.stiffness import warn_of_stiffness
from pendula.run.trust import DigitsError, digits_states
from pendula.systems import System, check_system

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from os import PathLike
    from typing import Unpack

    import pandas as pd
    import xarray as xr
    from numpy.typing import ArrayLike

    from pendula._progress import AskedProgress, Progress
    from pendula._types import Array, MethodName
    from pendula.run.options import RunOptions


_LOOKED_AT = 1000  # systems whose frequencies are compared, in some 20 ms


@with_promised
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Ensemble(Runs):
    """What `ensemble` returns: n trajectories, with all that `Runs` says of them.

    Attributes:
        systems: the pendulum of all, or one of each.
        starts: the states at t0, (n, d) [rad, rad/s].
        task: what all runs have in common, the options among it.
        derivative_names: components of the start, and parameters, (k,).
    """

    systems: System | tuple[System, ...]
    starts: Array
    task: Task
    derivative_names: tuple[str, ...] = ()

    @property
    def method(self) -> MethodName:
        """The name of the method."""
        return self.task.method

    @property
    def t(self) -> Array:
        """Times of the outputs, (m,) [s]."""
        return self.task.t

    def __len__(self) -> int:
        return len(self.states)

    def __repr__(self) -> str:
        return f"<Ensemble of {len(self)} trajectories at {self.t.size} times by {self.method}>"

    def _repr_html_(self) -> str:
        """What a notebook shows: what was run, and how the runs ended."""
        one = isinstance(self.systems, System)
        counts = Counter(self.outcomes.tolist())
        rows = [
            ("system" if one else "systems", repr(self.systems) if one else _several(self.systems)),
            ("trajectories", str(len(self))),
            ("times", f"{self.t.size}" + (f", until t = {self.t[-1]:g} s" if self.t.size else "")),
            ("outcomes", ", ".join(f"{count} {name}" for name, count in counts.most_common())),
        ]
        rows += [(f"event {i}", f"{len(each.times)} times") for i, each in enumerate(self.events)]
        if self.trust_horizon is not None and len(self):
            rows.append(("trusted until", f"{self.trust_horizon.min():g} s or later"))
        return html_table(f"Ensemble by {self.method}", rows)

    @property
    def energy(self) -> Array:
        """Total energy at the outputs, (n, m), NaN after the end of a run that ended early [J]."""
        import numpy as np

        systems = (self.systems,) if isinstance(self.systems, System) else self.systems
        lacking = np.asarray(~np.isfinite(self.states).all(axis=-1))
        states = np.where(lacking[..., np.newaxis], 0.0, self.states)
        if len(systems) == 1:
            energies = systems[0].energy(states)
        else:
            energies = np.stack(
                [each.energy(mine) for each, mine in zip(systems, states, strict=True)]
            )
        energies[lacking] = np.nan
        return energies

    if TYPE_CHECKING:  # attached by the module that defines them

        def to_xarray(self) -> xr.Dataset:
            """See `pendula.many.tables.to_xarray`."""

        def to_pandas(self) -> pd.DataFrame:
            """See `pendula.many.tables.to_pandas`."""

        def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> None:
            """See `pendula.many.tables.save`."""


def _several(systems: Any) -> str:
    """How many systems, and the first of them."""
    return f"{len(systems)}, the first {systems[0]!r}"


@with_bar("ensemble")
@takes_options()
def ensemble(
    system: System | Sequence[System],
    states: ArrayLike,
    t: ArrayLike,
    method: MethodName = STANDARD_METHOD,
    *,
    t0: float = 0.0,
    derivatives: str | Iterable[str] | None = None,
    threads: int | None = None,
    progress: AskedProgress = None,
    **options: Unpack[RunOptions],
) -> Ensemble:
    """The motions from many states, or of many systems, or both.

    Each has the bits that `solve` gives it alone, whatever the number of threads; what goes wrong
    with one is said by its outcome, and leaves the others alone.

    Args:
        system: a pendulum, or n of the same kind and form.
        states: (n, d) at time t0, or one state (d,) for n systems [rad, rad/s].
        t: output times, as `solve` takes them, (m,), or the end time alone, m = 1 [s].
        method: a name that `methods()` lists; all run through the processor's lanes, but those of
            dop853 with events.
        t0: time of the states [s].
        derivatives: as for `solve`, of the states at the outputs.
        threads: None: one for each processor.
        progress: called with the part of the trajectories that is done, 0 to 1; True: a bar, in
            a notebook or a terminal.
        **options: see `RunOptions`.

    `certify` takes some fifty times as long as the runs. With `digits` one trajectory is run after
    the other; where they cannot be computed the states are NaN and the outcome is "digits_limit".

    Returns:
        The ensemble, in the order of the states.

    Raises:
        ValueError: for an argument out of range.
    """
    report: Progress = checked_progress(progress)
    systems = _checked_systems(system)
    starts, parameters = _checked_rows(systems, states)
    angles = starts[:, : systems[0].can.degrees_of_freedom]
    warn_of_degrees("states", states, angles)
    task = _checked_task(systems, starts, t, method, t0, options)
    warn_of_stiffness(systems[:_LOOKED_AT], abs(float(task.t[-1]) - task.t0))
    count = checked_threads(threads)
    derived_by = checked_derivatives(derivatives, systems[0])
    if derived_by:
        check_method(task.method, task.digits)
    asked = system if isinstance(system, System) else systems
    if task.digits is None:
        found = run_task(task, parameters, starts, count, report, derived_by)
    else:
        found = _runs_with_digits(task, systems, starts, task.digits, report)
    return Ensemble(
        systems=asked, starts=starts, task=task, derivative_names=derived_by, **vars(found)
    )


def _checked_task(
    systems: tuple[System, ...],
    starts: Array,
    t: ArrayLike,
    method: object,
    t0: float,
    options: Mapping[str, Any],
) -> Task:
    """What all runs have in common, which goes together for each of the systems."""
    import numpy as np

    one = systems[0]
    origin = finite_number("t0", t0, "s")
    times = times_array(t)
    if times.ndim == 0 and float(times) == origin:
        raise broken("t", "differs_from_start", t0=origin, value=float(times))
    fields = checked_types(options, "ensemble")
    name = checked_name(method)
    task = Task(
        system=one.name, form=one.form, method=name, t0=origin, t=np.atleast_1d(times), **fields
    )
    first = np.ascontiguousarray(starts[0]) if len(starts) else np.zeros(starts.shape[1])
    for each in systems:
        parameters = np.array(list(each.parameters.values()))
        refuse(_engine.check(task.for_core(parameters, first)))
    return task


def _checked_systems(system: System | Sequence[System]) -> tuple[System, ...]:
    """The systems, one or as many as there are states, all of a kind."""
    if isinstance(system, System):
        return (system,)
    one = isinstance(system, str) or not isinstance(system, Iterable)
    systems: tuple[Any, ...] = (system,) if one else tuple(system)
    for each in systems:
        check_system(each)
    if len({type(each) for each in systems}) == 1 < len({each.name for each in systems}):
        systems = tuple(each.most_general() for each in systems)
    kinds = {(each.name, each.form) for each in systems}
    if len(kinds) != 1:
        given = ", ".join(sorted(" ".join(kind).strip() for kind in kinds)) or "none"
        raise ArgumentError(
            "system",
            "must be one pendulum, or n of the same kind and form, got {text}",
            "make an ensemble of each kind",
            text=given,
        )
    return systems


def _checked_rows(systems: tuple[System, ...], states: ArrayLike) -> tuple[Array, Array]:
    """Starts (n, d) and parameters (n, p) or (1, p)."""
    import numpy as np

    starts = states_array(states, systems[0].component_units, name="states")
    if starts.ndim == 1:
        starts = np.tile(starts, (len(systems), 1))
    if starts.ndim != 2 or (len(systems) > 1 and len(systems) != len(starts)):
        raise ArgumentError(
            "states",
            f"must be one for each trajectory, of shape (n, {starts.shape[-1]}), for "
            f"{len(systems)} systems, got {{value}}",
            value=starts.shape,
        )
    parameters = np.array([list(each.parameters.values()) for each in systems])
    return np.ascontiguousarray(starts), parameters


def _runs_with_digits(
    task: Task, systems: tuple[System, ...], starts: Array, digits: int, progress: Progress
) -> Runs:
    """Runs right to so many digits."""
    import numpy as np

    n, late = len(starts), task.t[task.t != task.t0]
    states = np.full((n, task.t.size, starts.shape[1]), np.nan)
    states[:, task.t == task.t0] = starts[:, np.newaxis]
    outcomes, reached = np.full(n, "reached_end", "U12"), np.full(n, task.t[-1])
    for i, start in enumerate(starts if late.size else ()):
        system = systems[i % len(systems)]
        share = part(progress, i / n, (i + 1) / n)
        try:
            states[i, task.t != task.t0] = digits_states(
                system, start, late, task.t0, digits, share
            )[0]
        except DigitsError as error:
            outcomes[i], reached[i] = error.outcome, task.t0
    counts = np.zeros(n, np.int64)
    return Runs(
        states=states, outcomes=outcomes, n_steps=counts, n_evaluations=counts, reached=reached
    )
