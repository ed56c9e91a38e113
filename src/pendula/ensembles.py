"""Many trajectories at once."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula import _engine
from pendula._arguments import (
    check_rounding_of_times,
    checked_method,
    checked_tolerance,
    log2_of,
    output_times,
    step_size,
)
from pendula._checks import LARGEST_COUNT, finite_number, states_array, whole_number
from pendula._progress import part
from pendula.events import checked_events
from pendula.solving import check_together, checked_certify
from pendula.systems import System, check_system

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from pendula._progress import Progress
    from pendula.events import Event

    Array = NDArray[np.float64]

MOST_THREADS = 1024
_PLAIN_SHARE = 0.02  # of the work of a certified ensemble: the runs themselves


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


@dataclass(frozen=True, eq=False, repr=False)
class Ensemble:
    """What `ensemble` returns: n trajectories with outputs at the same times.

    Attributes:
        systems: the pendulum of all, or one of each.
        method: the name of the method.
        t: times of the outputs, (m,) [s].
        states: at those times, (n, m, d) [rad, rad/s]; NaN where a run did not come so far.
        outcomes: how each run ended, (n,): "reached_end", "event", "step_limit" or "not_finite".
        n_steps: steps that each took, (n,).
        reached: the time up to which each was made, (n,) [s].
        events: trajectories, times and states of each event.
        trust_horizon: (n,) [s], infinite where it is not passed within the run; None: not asked.
    """

    systems: System | tuple[System, ...]
    method: str
    t: Array
    states: Array
    outcomes: NDArray[np.str_]
    n_steps: NDArray[np.int64]
    reached: Array
    events: tuple[EnsembleCrossings, ...] = ()
    trust_horizon: Array | None = None

    def __len__(self) -> int:
        return len(self.states)

    def __repr__(self) -> str:
        return f"<Ensemble of {len(self)} trajectories at {self.t.size} times by {self.method}>"

    @property
    def energy(self) -> Array:
        """Total energy at the outputs, (n, m), NaN where a run did not come so far [J]."""
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


def ensemble(
    system: System | Sequence[System],
    states: ArrayLike,
    t: ArrayLike,
    method: str = "taylor",
    *,
    t0: float = 0.0,
    step: float | None = None,
    tolerance: float | None = None,
    max_steps: int | None = None,
    events: Event | Iterable[Event] = (),
    certify: float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Ensemble:
    """The motions from many states, or of many systems, or both.

    Each has the bits that `solve` gives it alone, whatever the number of threads; what goes wrong
    with one is told in its outcome, and leaves the others alone.

    Args:
        system: a pendulum, or n of the same kind and form.
        states: (n, d) at time t0, or one state (d,) for n systems [rad, rad/s].
        t: output times, as `solve` takes them, (m,), or the end time alone, m = 1 [s].
        method: a name that `methods()` lists; all but dop853 run through the processor's lanes.
        t0: time of the states [s].
        step: as for `solve`.
        tolerance: as for `solve`.
        max_steps: most steps of each run. None: no limit.
        events: as for `solve`.
        certify: as for `solve`; takes some fifty times as long as the runs.
        threads: None: one for each processor.
        progress: told the part of the trajectories that is done, 0 to 1, some times a second.

    Returns:
        The ensemble, in the order of the states.

    Raises:
        ValueError: for an argument out of range.
    """
    systems = _checked_systems(system)
    kind = systems[0]
    chosen = checked_method(method, kind)
    origin = finite_number("t0", t0, "s")
    times, _ = output_times(t, origin)
    together = {"step": step, "tolerance": tolerance, "certify": certify, "max_steps": max_steps}
    check_together(chosen, None, **together, events=events or None)
    for each in systems if chosen.adaptive else ():
        check_rounding_of_times(each, origin, float(times[-1]))
    task = Task(
        kind.name,
        kind.form,
        chosen.name,
        origin,
        times,
        None if chosen.adaptive else step_size(chosen.name, step, origin, float(times[-1])),
        checked_tolerance(tolerance) if chosen.adaptive else None,
        None if max_steps is None else whole_number("max_steps", max_steps, LARGEST_COUNT),
        checked_events(events, kind),
        None if certify is None else checked_certify(certify),
    )
    starts, parameters = _checked_rows(systems, states)
    found = run_task(task, parameters, starts, checked_threads(threads), progress)
    return Ensemble(system if isinstance(system, System) else systems, chosen.name, times, *found)


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


def run_task(
    task: Task, parameters: Array, states: Array, threads: int, progress: Progress = None
) -> tuple[
    Array,
    NDArray[np.str_],
    NDArray[np.int64],
    Array,
    tuple[EnsembleCrossings, ...],
    Array | None,
]:
    """States, outcomes, steps, times reached, crossings and trust horizons of checked rows.

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
    outcomes = np.array(_engine.OUTCOMES)[ended]
    return (
        found,
        outcomes,
        steps,
        reached,
        tuple(EnsembleCrossings(*c) for c in crossings),
        horizons,
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


def _checked_systems(system: System | Sequence[System]) -> tuple[System, ...]:
    """The systems, one or as many as there are states, all of a kind."""
    if isinstance(system, System):
        return (system,)
    one = isinstance(system, str) or not isinstance(system, Iterable)
    systems: tuple[Any, ...] = (system,) if one else tuple(system)
    for each in systems:
        check_system(each)
    kinds = {(each.name, each.form) for each in systems}
    if len(kinds) != 1:
        told = ", ".join(sorted(" ".join(kind).strip() for kind in kinds)) or "none"
        raise ValueError(
            f"system must be one pendulum, or n of the same kind and form, got {told}; "
            "make an ensemble of each kind"
        )
    return systems


def _checked_rows(systems: tuple[System, ...], states: ArrayLike) -> tuple[Array, Array]:
    """Starts (n, d) and parameters (n, p) or (1, p)."""
    import numpy as np

    starts = states_array(states, systems[0].components, name="states")
    if starts.ndim == 1:
        starts = np.tile(starts, (len(systems), 1))
    if starts.ndim != 2 or (len(systems) > 1 and len(systems) != len(starts)):
        raise ValueError(
            f"states must be one for each trajectory, of shape (n, {starts.shape[-1]}), for "
            f"{len(systems)} systems, got {starts.shape}"
        )
    parameters = np.array([list(each.parameters.values()) for each in systems])
    return np.ascontiguousarray(starts), parameters
