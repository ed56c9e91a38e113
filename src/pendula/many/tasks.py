"""What an ensemble hands to the kernels, and what comes back."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from pendula import _engine
from pendula._checks import LARGEST_COUNT, whole_number
from pendula._progress import part
from pendula.run._arguments import log2_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.run.events import Event


MOST_THREADS = 1024
_PLAIN_SHARE = 0.02  # of the work of a certified ensemble: the runs themselves


@dataclass(frozen=True)
class Task:
    """What all trajectories of an ensemble have in common, checked."""

    system: str
    form: str
    method: str
    t0: float
    t: Array
    step: float | None = None
    tolerance: float | None = None
    max_steps: int | None = None
    events: tuple[Event, ...] = ()
    certify: float | None = None

    @property
    def signed_step(self) -> float:
        """The step in the direction of time, 0 where the method chooses its own."""
        return math.copysign(self.step or 0.0, float(self.t[-1]) - self.t0)


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


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Runs:
    """How n trajectories went that have outputs at the same m times.

    Attributes:
        states: at those times, (n, m, d) [rad, rad/s]; NaN where a run did not come so far.
        outcomes: how each run ended, (n,): "reached_end", "event", "step_limit" or "not_finite".
        n_steps: steps that each took, (n,).
        reached: the time up to which each was made, (n,) [s].
        events: trajectories, times and states of each event.
        trust_horizon: (n,) [s], infinite where it is not passed within the run; None: not asked.
    """

    states: Array
    outcomes: NDArray[np.str_]
    n_steps: NDArray[np.int64]
    reached: Array
    events: tuple[EnsembleCrossings, ...] = ()
    trust_horizon: Array | None = None


def run_task(
    task: Task, parameters: Array, states: Array, threads: int, progress: Progress = None
) -> Runs:
    """The runs of checked rows.

    Args:
        task: what they have in common.
        parameters: of the systems, (n, p), or (1, p) for all.
        states: at t0, (n, d) [rad, rad/s].
        threads: how many.
        progress: as for `ensemble`.
    """
    import numpy as np

    share = 1.0 if task.certify is None else _PLAIN_SHARE
    form = _engine.system_entries()[task.system].form_index(task.form)
    common = task.system, form, parameters, task.method, states, task.t0
    accuracy = task.signed_step, log2_of(task.tolerance or 1.0)
    limit, rows = task.max_steps or LARGEST_COUNT, [each.row() for each in task.events]
    found, ended, steps, reached, crossings = _engine.ensemble(
        *common, task.t, *accuracy, limit, rows, threads, part(progress, 0.0, share)
    )
    horizons = None
    if task.certify is not None:
        horizons = _engine.trust_horizons(
            *common, reached, *accuracy, task.certify, threads, part(progress, share, 1.0)
        )
    if progress is not None:
        progress(1.0)
    outcomes, events = np.array(_engine.OUTCOMES)[ended], [EnsembleCrossings(*c) for c in crossings]
    if horizons is not None:  # beyond its end a run that broke down is right about nothing
        broken = (outcomes == "not_finite") & np.isinf(horizons)
        horizons[broken] = reached[broken]
    return Runs(
        states=found,
        outcomes=outcomes,
        n_steps=steps,
        reached=reached,
        events=tuple(events),
        trust_horizon=horizons,
    )


def checked_threads(threads: int | None) -> int:
    """How many threads: those asked for, or one for each processor that this process may use."""
    if threads is None:
        return (
            len(os.sched_getaffinity(0))
            if hasattr(os, "sched_getaffinity")
            else os.cpu_count() or 1
        )
    return whole_number("threads", threads, MOST_THREADS)
