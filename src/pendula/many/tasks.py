"""What an ensemble hands to the kernels, and what comes back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from pendula import _engine
from pendula._rules import refuse
from pendula.run.derivatives import names_derived_by
from pendula.run.events import crossings_table
from pendula.run.options import Options
from pendula.run.request import core_request

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd
    from numpy.typing import NDArray

    from pendula._progress import Progress
    from pendula._types import Array, MethodName


@dataclass(frozen=True, kw_only=True)
class Task(Options):
    """What all trajectories of an ensemble have in common, checked, with the options of a run.

    Attributes:
        system: name in the catalogue.
        form: of the system's description.
        method: name in the catalogue.
        t0: time of the starts [s].
        t: times of the outputs, (m,) [s].
    """

    system: str
    form: str
    method: MethodName
    t0: float = 0.0
    t: Array

    def for_core(self, parameters: Array, state: Array) -> _engine.Request:
        """The request of the trajectory with these parameters (p,) and this start (d,)."""
        description = _engine.describe(self.system, self.form, tuple(parameters.tolist()))
        return core_request(description, self.method, state, self.t0, self.t, self)


class EnsembleCrossings(NamedTuple):
    """Where an event took place in the trajectories of an ensemble.

    Attributes:
        trajectories: numbers of the trajectories, rising, (k,).
        times: in the order of each run, (k,) [s].
        states: at those times, (k, d) [rad, rad/s].
    """

    trajectories: NDArray[np.int64]
    times: Array
    states: Array

    def to_pandas(self) -> pd.DataFrame:
        """A table with a row for each crossing, the trajectory's number first (extra: io)."""
        return crossings_table(self.states, {"trajectory": self.trajectories, "t [s]": self.times})


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Runs:
    """The results of n trajectories with outputs at the same m times.

    Attributes:
        states: at those times, (n, m, d) [rad, rad/s]; NaN where a run did not come so far.
        outcomes: how each run ended, (n,): "reached_end", "event", "step_limit" or "not_finite".
        n_steps: steps that each took, (n,).
        n_evaluations: of the right-hand side, or of the series, (n,).
        reached: the time up to which each was made, (n,) [s].
        events: trajectories, times and states of each event.
        trust_horizon: (n,) [s], infinite where it is not passed within the run; None: not asked.
        derivatives: of the states, (n, m, d, k); None: not asked.
    """

    states: Array
    outcomes: NDArray[np.str_]
    n_steps: NDArray[np.int64]
    n_evaluations: NDArray[np.int64]
    reached: Array
    events: tuple[EnsembleCrossings, ...] = ()
    trust_horizon: Array | None = None
    derivatives: Array | None = None


def run_task(
    task: Task,
    parameters: Array,
    states: Array,
    threads: int,
    progress: Progress = None,
    derived_by: tuple[str, ...] = (),
) -> Runs:
    """The runs of checked rows.

    Args:
        task: what they have in common.
        parameters: of the systems, (n, p), or (1, p) for all.
        states: at t0, (n, d) [rad, rad/s].
        threads: how many.
        progress: as for `ensemble`.
        derived_by: components of the start and parameters to derive the states by.
    """
    import numpy as np

    (count, dimension), columns = states.shape, len(derived_by)
    if count == 0:
        return _no_runs(task, dimension, columns)
    asked = task.for_core(parameters[0], np.ascontiguousarray(states[0]))
    places = [names_derived_by(task.system, task.form).index(name) for name in derived_by]
    result = _engine.ensemble(asked, states, parameters, places, threads, progress)
    refuse(result.refused)
    if progress is not None:
        progress(1.0)
    return Runs(
        states=result.states(task.t.size, dimension),
        outcomes=np.array(result.outcomes),
        n_steps=np.asarray(result.n_steps, np.int64),  # zarr takes no long long
        n_evaluations=np.asarray(result.n_evaluations, np.int64),
        reached=result.reached,
        events=tuple(
            EnsembleCrossings(
                np.asarray(each.trajectories, np.int64), each.times, each.states(dimension)
            )
            for each in result.events
        ),
        trust_horizon=None if task.certify is None else result.trust_horizon,
        derivatives=result.derivatives(task.t.size, dimension, columns) if columns else None,
    )


def _no_runs(task: Task, dimension: int, columns: int) -> Runs:
    """The result of no starts."""
    import numpy as np

    none, no_counts = np.empty(0), np.empty(0, np.int64)
    nothing = EnsembleCrossings(no_counts, none, np.empty((0, dimension)))
    return Runs(
        states=np.empty((0, task.t.size, dimension)),
        outcomes=np.empty(0, str),
        n_steps=no_counts,
        n_evaluations=no_counts,
        reached=none,
        events=(nothing,) * len(task.events),
        trust_horizon=None if task.certify is None else none,
        derivatives=np.empty((0, task.t.size, dimension, columns)) if columns else None,
    )
