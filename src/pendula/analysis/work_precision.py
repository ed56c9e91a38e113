"""Work and precision: what each method's errors cost, in evaluations and in time."""

from __future__ import annotations

import math
from functools import partial
from time import process_time
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from pendula import _engine
from pendula._angles import warn_of_degrees
from pendula._checks import checked_progress, finite_number, whole_number
from pendula._messages import ArgumentError
from pendula._progress import with_bar
from pendula._rules import refuse
from pendula.analysis.difference import angle_difference
from pendula.analysis.method_work import MethodWork, WorkPrecision
from pendula.run.exact import exact
from pendula.run.options import BEST_TOLERANCE, ROWS
from pendula.run.request import Request, checked_name, checked_state
from pendula.run.solve import solve
from pendula.run.trust import DigitsError
from pendula.systems import System, check_system

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from pendula._progress import StepProgress
    from pendula._types import Array, MethodName
    from pendula.run.trajectory import Trajectory


POINTS = 12
_MOST_POINTS = 100
_DIGITS = 15  # of a certified reference: all that a double holds
_EXACT = 4 * BEST_TOLERANCE  # error of the closed form, as a part of the largest angle
_OUTPUTS = 8  # in a time scale: the coarsest step of a method of high order
_MOST_OUTPUTS = 1000
_MOST_STEPS = 250_000  # of a run, unless its coarsest step needs as many
_MOST_SCALES = 100_000.0
_DECADES = 17  # of error that the steps of one method span
_WIDEST = 2.0**14  # ratio of its coarsest step to its finest
_LOW_ORDER = 4
# Rounds of timing, as something else may slow down one of them; seconds and repetitions in each.
_ROUNDS, _ENOUGH, _MOST_REPETITIONS = 3, 0.003, 30
_SLOW = 0.1  # a run that takes so many seconds is not repeated


@with_bar("compare")
def work_precision(
    system: System,
    state: ArrayLike,
    t_max: float,
    methods: Iterable[MethodName] | MethodName | None = None,
    *,
    t0: float = 0.0,
    points: int = POINTS,
    timed: bool = True,
    progress: StepProgress | bool | None = None,
) -> WorkPrecision:
    """Run methods with ever smaller steps or tolerances, and see what their errors cost.

    The reference is the closed form; for the double pendulum a run right to all the digits of a
    double. An evaluation is one of the right-hand side, those of iterations included. The Taylor
    method takes no right-hand side but the coefficients of its series: each counts as one, so a
    step counts as its order. Higher coefficients cost more, and the sine of a composed method less:
    the time says that. It is processor time, the
    least of several runs of the compiled core, without Python.

    Args:
        system: a pendulum.
        state: (θ, ω) or (θ1, θ2, ω1, ω2) at time t0, (d,) [rad, rad/s].
        t_max: end of the runs [s].
        methods: names that `pendula.methods()` lists; None: all that take the system.
        t0: time of the state [s].
        points: runs of each method, 2 to 100. The steps are parts of the motion's time scale.
        timed: measure times too, which differ from run to run.
        progress: called with the method and the part of all that is done, 0 to 1; True: a bar, in a
            notebook or a terminal.

    Raises:
        ValueError: for an unknown method or an argument out of range.
    """
    check_system(system)
    start = checked_state(state, system)
    warn_of_degrees("state", state, start[: system.can.degrees_of_freedom])
    origin, end = finite_number("t0", t0, "s"), finite_number("t_max", t_max, "s")
    count = whole_number("points", points, _MOST_POINTS)
    if count < 2:
        raise ArgumentError("points", "must be at least 2, got {value}", value=count)
    chosen = _chosen(system, methods)
    scales = abs(end - origin) / time_scale(system, start)
    t = np.linspace(origin, end, _outputs(scales) + 1)[1:]
    report: StepProgress = checked_progress(progress) or (lambda label, share: None)
    part = 1 / (len(chosen) + 1)
    report("reference", 0.0)
    reference, bound = _reference(
        system, start, t, origin, lambda share: report("reference", part * share)
    )
    done = []
    for i, method in enumerate(chosen):
        report(method.name, part * (i + 1))
        settings = _settings(method, scales, t.size, count)
        done.append(_work(method, settings, reference, timed=timed))
    report("done", 1.0)
    angles = start[: system.can.degrees_of_freedom]
    largest = float(np.abs([angles, *reference.theta.reshape(t.size, -1)]).max())
    digits, precision = reference.request.digits, reference.precision
    limits = bound * largest, BEST_TOLERANCE * largest
    judged = reference.method, digits, precision, *limits
    return WorkPrecision(system, start, origin, t, *judged, tuple(done))


def time_scale(system: System, state: ArrayLike) -> float:
    """The period of the motion's fastest part: of its fastest small swing, or of a turn [s]."""
    start = checked_state(state, system)
    speeds = start[system.can.degrees_of_freedom :]
    return math.tau / max(system.fastest_frequency, float(np.abs(speeds).max()))


def _chosen(system: System, names: Iterable[str] | None) -> list[_engine.Method]:
    """The methods of these names, each once."""
    if names is None:
        return [each for each in _engine.methods() if system.name in each.systems]
    try:
        given: list[object] = [names] if isinstance(names, str) else list(names)
    except TypeError:
        given = [names]
    known = dict.fromkeys(checked_name(name, "methods") for name in given)
    chosen = [_taken(name, system) for name in known]
    if not chosen:
        raise ArgumentError("methods", "must name at least one method, got none")
    return chosen


def _taken(name: str, system: System) -> _engine.Method:
    """The method of that name, which takes the system."""
    rest = np.zeros(len(system.components))
    asked = Request(state=rest, t=np.array([1.0]), step=None)
    refuse(_engine.check_method(asked.for_core(system, name)), method="methods")
    return _engine.method_named(name)


def _outputs(scales: float) -> int:
    """The number of output times for a motion of so many time scales."""
    if not 0.0 < scales <= _MOST_SCALES:
        raise ArgumentError(
            "t_max",
            "must differ from <t0>, by at most {most} of the motion's time scales, got {count} of "
            "them",
            most=_MOST_SCALES,
            count=scales,
        )
    return min(math.ceil(scales * _OUTPUTS), _MOST_OUTPUTS)


def _reference(
    system: System, start: Array, t: Array, t0: float, progress: Callable[[float], None]
) -> tuple[Trajectory, float]:
    """The motion itself, and the bound of its error as a part of the largest angle."""
    if not system.can.closed_form:
        try:
            run = solve(system, start, t, t0=t0, digits=_DIGITS, progress=progress)
        except DigitsError as error:
            raise ArgumentError(
                "t_max",
                "must be nearer for a reference right to {digits} digits: {text}",
                digits=_DIGITS,
                text=error.reason,
            ) from None
        return run, 10.0**-_DIGITS
    return exact(system, start, t, t0=t0), _EXACT


def _settings(method: _engine.Method, scales: float, outputs: int, points: int) -> Array:
    """Tolerances, or the numbers of steps between two outputs, rising."""
    if method.adaptive:
        return np.geomspace(ROWS["tolerance"].most, BEST_TOLERANCE, points)
    # A low order begins with finer steps: its coarse ones are useless.
    coarsest = math.ceil(scales * _OUTPUTS * (1 if method.order > _LOW_ORDER else 2) / outputs)
    finest = coarsest * min(10.0 ** (_DECADES / method.order), _WIDEST)
    finest = max(min(finest, _MOST_STEPS / outputs), coarsest + points - 1.0)
    return np.unique(np.round(np.geomspace(coarsest, finest, points)))


def _work(
    method: _engine.Method, settings: Array, reference: Trajectory, *, timed: bool
) -> MethodWork:
    """Run a method with each setting."""
    asked = reference.request
    if not method.adaptive:
        settings = abs(float(reference.t[-1]) - asked.t0) / reference.t.size / settings
    named = "tolerance" if method.adaptive else "step"
    runs: list[Trajectory] = [
        solve(
            reference.system,
            asked.state,
            reference.t,
            method.name,
            t0=asked.t0,
            **{named: each},
        )
        for each in settings.tolist()
    ]
    whole = np.array([run.outcome == "reached_end" for run in runs])
    counts = np.array([run.n_evaluations for run in runs], dtype=np.float64)
    if method.needs == "analytic":
        counts *= [_engine.series_order(each) for each in settings.tolist()]
    seconds = _least_times([_bare_run(method.name, run) for run in runs]) if timed else math.nan
    with np.errstate(over="ignore", invalid="ignore"):  # of a run that breaks down
        errors = [float(angle_difference(run, reference).max()) for run in runs]
        energies = [abs(float(run.energy_error[-1])) if run.t.size else math.inf for run in runs]
    return MethodWork(
        method.name,
        method.adaptive,
        settings,
        evaluations=counts,
        seconds=np.broadcast_to(seconds, settings.shape).copy(),
        errors=np.where(whole, errors, math.inf),
        energy_errors=np.where(whole, energies, math.inf),
        outcomes=tuple(run.outcome for run in runs),
    )


def _bare_run(method: str, run: Trajectory) -> Callable[[], object]:
    """The same run again without Python around it."""
    return partial(_engine.solve, run.request.for_core(run.system, method), None)


def _least_times(runs: Sequence[Callable[[], object]]) -> Array:
    """The least processor time of each run, of several rounds of all of them [s]."""
    least = np.full(len(runs), math.inf)
    for _ in range(_ROUNDS):
        for i, run in enumerate(runs):
            if least[i] < _SLOW or math.isinf(least[i]):
                least[i] = min(least[i], _least_time(run))
    return least


def _least_time(run: Callable[[], object]) -> float:
    """The least processor time of a run, of as many repetitions as are soon done [s]."""
    times: list[float] = []
    while sum(times) < _ENOUGH and len(times) < _MOST_REPETITIONS:
        begin = process_time()
        run()
        times.append(process_time() - begin)
    return min(times)
