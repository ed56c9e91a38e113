"""The double pendulum to machine precision by heyoka's Taylor series and by SciPy's DOP853.

heyoka's own arithmetic is left as it comes: no fast_math, but multiplications and additions fused.
`report` sets runs of our own beside them: one trajectory, and 1024 from different starts.
"""

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import heyoka
import numpy as np
from scipy.integrate import solve_ivp

from benchmarks.taylor_forms import FORMS, A, B, C, D, E

TRAJECTORIES, END = 1024, 10.0  # s
LONG = 100.0  # s, of one trajectory: what a call costs is not what is compared
LEAST_CPU = 0.01  # s; a shorter run is repeated within one measurement
RELEASED = (2.0, 2.5)  # rad, at rest: the one trajectory, and the first of the many
EXACT = {  # θ1, θ2, ω1, ω2 by 60 digits, for the double nearest 9.81
    5.0: (0.205462239524980870, -7.52104212191582645, 1.68158668590311311, 11.7276651341110641),
    10.0: (-0.997012773703082562, 4.16303573609155265, 1.74876611705965533, -10.1872062958343787),
}
RIGHT = 1e-3  # what a run may be off at END: from 5 s to 10 s an error grows ten-thousandfold


@dataclass(frozen=True)
class Outcome:
    """Steps that trajectories took, and (θ1, θ2, ω1, ω2) of the one released at RELEASED."""

    steps: int
    state: Any
    busy: float = 1.0  # the share of the lanes' steps that a trajectory needed
    evaluations: int = 0


Run = Callable[[float], Outcome]  # from rest at t = 0 to a time


@dataclass(frozen=True)
class Figure:
    """CPU time [s], what was done in it, errors at 5 s and at 10 s, time to compile [s]."""

    seconds: float
    outcome: Outcome
    errors: tuple[float, float]
    compiling: float = 0.0

    @property
    def ns(self) -> float:
        """Nanoseconds a step and trajectory."""
        return self.seconds / self.outcome.steps * 1e9


@dataclass(frozen=True)
class Job:
    """What is measured."""

    run: Run
    compiling: float = 0.0


def starts() -> Any:
    """Angles (2, TRAJECTORIES) of the many, all from rest."""
    angles = np.random.default_rng(1).uniform(-np.pi, np.pi, (2, TRAJECTORIES))
    angles[:, 0] = RELEASED
    return angles


def by_energy(angles: Any) -> Any:
    """In the order of their energy, so that lanes side by side take about as many steps."""
    return angles[:, np.argsort(-D * np.cos(angles[0]) - E * np.cos(angles[1]))]


def compiled(make: Callable[[], Any]) -> tuple[Any, float]:
    """A heyoka integrator and the CPU time it took to compile, from nothing."""
    heyoka.llvm_state.set_diskcache_enabled(False)
    heyoka.llvm_state.clear_memcache()
    begin = time.process_time()
    return make(), time.process_time() - begin


def scalar(form: str, **options: Any) -> Job:
    """One trajectory by heyoka."""
    told = FORMS[form]
    start = told.start(np.array(RELEASED))
    engine, compiling = compiled(
        lambda: heyoka.taylor_adaptive(told.equations(), start.copy(), **options)
    )

    def run(end: float) -> Outcome:
        engine.time = 0.0
        engine.state[:] = start
        steps = engine.propagate_until(end)[3]
        return Outcome(steps, told.usual(engine.state))

    return Job(run, compiling)


def batch(form: str, lanes: int, angles: Any, **options: Any) -> Job:
    """Many trajectories by heyoka, side by side in lanes that begin together."""
    told = FORMS[form]
    start = told.start(angles)
    where = int(np.flatnonzero((angles.T == RELEASED).all(axis=1))[0])
    engine, compiling = compiled(
        lambda: heyoka.taylor_adaptive_batch(
            told.equations(), np.ascontiguousarray(start[:, :lanes]), **options
        )
    )

    def run(end: float) -> Outcome:
        last = np.empty_like(start)
        steps = longest = 0
        for first in range(0, angles.shape[1], lanes):
            engine.set_time(0.0)
            engine.state[:] = start[:, first : first + lanes]
            engine.propagate_until(end)
            each = [result[3] for result in engine.propagate_res]
            steps, longest = steps + sum(each), longest + max(each)
            last[:, first : first + lanes] = engine.state
        return Outcome(steps, told.usual(last[:, where]), steps / (longest * lanes))

    return Job(run, compiling)


def slopes(_: float, y: Any) -> list[float]:
    """Slopes of one state, in Python's own numbers: twice as fast as numpy's."""
    y1, y2, v1, v2 = y.tolist()
    sine, coupling = C * math.sin(y1 - y2), C * math.cos(y1 - y2)
    r1 = -sine * v2 * v2 - D * math.sin(y1)
    r2 = sine * v1 * v1 - E * math.sin(y2)
    inverse = 1.0 / (A * B - coupling * coupling)
    return [v1, v2, (B * r1 - coupling * r2) * inverse, (A * r2 - coupling * r1) * inverse]


def by_scipy(end: float) -> Outcome:
    """One trajectory by SciPy."""
    tight: dict[str, Any] = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-12}
    done = solve_ivp(slopes, (0.0, end), [*RELEASED, 0.0, 0.0], **tight)
    return Outcome(len(done.t) - 1, done.y[:, -1], evaluations=done.nfev)


def one_by_peers() -> dict[str, Job]:
    """One trajectory: each form, and the switches that could help."""
    jobs = {f"heyoka {form}": scalar(form) for form in FORMS}
    for form in list(FORMS)[2:]:
        jobs[f"heyoka {form}; SLP"] = scalar(form, slp_vectorize=True)
    jobs["heyoka θ, p; compact"] = scalar("θ, p", compact_mode=True)
    return {**jobs, "SciPy DOP853, 1e-12": Job(by_scipy)}


def many_by_peers() -> dict[str, Job]:
    """Many trajectories: each form and number of lanes, in the given order and by energy.

    Where the processor has AVX-512, 8 lanes use it without being told (force_avx512).
    """
    mixed = starts()
    jobs = {f"heyoka {form}; {n}": batch(form, n, mixed) for n in (4, 8) for form in FORMS}
    ordered = by_energy(mixed)
    for form in list(FORMS)[1:]:
        jobs[f"heyoka {form}; 8, by energy"] = batch(form, 8, ordered)
    jobs["heyoka θ, p; 2"] = batch("θ, p", 2, mixed)
    jobs["heyoka θ, p; 8, compact"] = batch("θ, p", 8, mixed, compact_mode=True)
    return jobs


def measured(run: Run, end: float) -> float:
    """CPU time of one run [s], repeated if it is short."""
    times, begin = 0, time.process_time()
    while True:
        run(end)
        times += 1
        spent = time.process_time() - begin
        if spent >= LEAST_CPU:
            return spent / times


def error(run: Run, end: float) -> float:
    """Largest error of a run's state at a time for which it is known."""
    return float(np.abs(np.asarray(run(end).state) - EXACT[end]).max())


def figures(jobs: Mapping[str, Job], end: float, repeats: int) -> dict[str, Figure]:
    """The least CPU time of each job up to that time; they take turns."""
    outcomes = {name: job.run(end) for name, job in jobs.items()}
    errors = {name: (error(job.run, 5.0), error(job.run, END)) for name, job in jobs.items()}
    assert all(wrong[1] < RIGHT for wrong in errors.values()), errors
    least = dict.fromkeys(jobs, math.inf)
    for _ in range(repeats):
        for name, job in jobs.items():
            least[name] = min(least[name], measured(job.run, end))
    return {
        name: Figure(least[name], outcomes[name], errors[name], job.compiling)
        for name, job in jobs.items()
    }


def table(rows: Mapping[str, Figure]) -> str:
    """The figures, and each CPU time in units of heyoka's best."""
    best = min(row.seconds for name, row in rows.items() if name.startswith("heyoka"))
    titles = (
        "CPU [ms]",
        "÷ heyoka",
        "steps",
        "ns a step",
        "busy",
        "err 5 s",
        "err 10 s",
        "JIT [s]",
    )
    lines = [f"{'':44}" + "".join(f"{title:>10}" for title in titles)]
    for name, row in rows.items():
        done, (early, late) = row.outcome, row.errors
        lines.append(
            f"{name:44}{row.seconds * 1e3:10.3f}{row.seconds / best:10.2f}{done.steps:10}"
            f"{row.ns:10.0f}{done.busy:10.2f}{early:10.1e}{late:10.1e}{row.compiling:10.2f}"
        )
        if done.evaluations:
            lines[-1] += f"   {done.evaluations} evaluations"
    return "\n".join(lines)


def report(
    one: Mapping[str, Run] | None = None, many: Mapping[str, Run] | None = None, repeats: int = 7
) -> tuple[dict[str, Figure], dict[str, Figure]]:
    """Print both tables, with runs of our own for one trajectory and for all of `starts()`."""
    rods = "Two uniform rods, CPU time of one thread, at machine precision"
    tables = []
    for title, end, ours, theirs in (
        (f"{rods}, from rest at {RELEASED} to {LONG:.0f} s", LONG, one, one_by_peers),
        (f"{rods}, {TRAJECTORIES} starts to {END:.0f} s; lanes", END, many, many_by_peers),
    ):
        jobs = {name: Job(run) for name, run in (ours or {}).items()}
        tables.append(figures(jobs | theirs(), end, repeats))
        print(f"{title}\n\n{table(tables[-1])}\n")
    return tables[0], tables[1]


if __name__ == "__main__":
    report()
