"""Fits of models to recordings, with uncertainties that can be believed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from pendula.measured.begun import Begun
from pendula.measured.double_start import refuse_upright
from pendula.measured.free_swing import ends_stick_out, free_swing
from pendula.measured.model import FRICTIONS
from pendula.measured.one_thread import on_one_thread
from pendula.measured.plan import Plan, planned
from pendula.measured.result import result_of
from pendula.measured.system_model import SystemModel
from pendula.measured.system_start import system_optimum
from pendula.measured.windows import asked_windows, horizon_of, shot, windows_told
from pendula.measured.words import Note

if TYPE_CHECKING:
    from pendula.measured.fitted import Fit
    from pendula.measured.measurement import Measurement
    from pendula.measured.problem import Sampled
    from pendula.systems import System


@on_one_thread
def fit(
    measurement: Measurement | Iterable[Measurement],
    system: System | str | Sequence[str] = "viscous",
    *,
    length: float | tuple[float, float] | None = None,
    gravity: float | tuple[float, float] | None = None,
    fixed: Mapping[str, float] | None = None,
    free: str | Sequence[str] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    shared: str | Sequence[str] | None = None,
    signs: str = "physical",
    start: Mapping[str, float] | None = None,
    t: tuple[float, float] | None = None,
    robust: bool = False,
    uncertainty: str = "corrected",
    seed: int = 0,
    windows: float | None = None,
    continuity: float = 1.0,
    tolerance: float = 0.1,
) -> Fit:
    """Least squares on the motion itself, by a model of a pendulum or a system of the catalogue.

    A model θ̈ = −ω0² sin θ − b ω − c sgn ω − q |ω| ω − r ω³, which is all that an angle tells, or a
    system by its own parameters is run from a start that is fitted too, with the exact derivatives
    of the core. No start values are needed.

    Args:
        measurement: one recording, or several of the same pendulum that are fitted together.
        system: kinds of friction joined by +, or a sequence of them: "viscous", "coulomb",
            "quadratic", "cubic"; "undamped": none; "linear" among them: −ω0² θ. Or a system such as
            `SimplePendulum(length=0.8)`: then its own parameters are fitted, those that are not
            free being known.
        length: from the pivot to the bob, or from pivot to joint, if known, or (value, sigma): then
            g is told [m]. Otherwise that of the recording, if it has one.
        gravity: if known, or (value, sigma): then the length is told [m/s²].
        fixed: values of parameters that are not fitted, by name.
        free: names of parameters that are fitted. Of a model besides its own: "scale", "torque",
            "drive_frequency", "drive_phase". Of a system: of its own, of "angle_offset" and
            "scale", or of "time_offset", by which the recording's clock is ahead; None: gravity,
            the frictions that are not zero and the offset of what is measured. The start is fitted
            always, or where a component of it is named, in the named ones alone, the others zero.
        bounds: (low, high) by names of parameters.
        shared: names of those that several recordings have in common; None: all but the start and
            the offset.
        signs: "physical": no friction is negative; "free": it may be, and the fit says so.
        start: values to start from, by name, where they are known better than the recording says.
        t: (from, to), the times that are fitted [s]; None: all.
        robust: outliers count less.
        uncertainty: "corrected": by the residuals' autocorrelation; "profile": by how the sum of
            squares grows when a parameter is held, the others fitted again; "bootstrap": by fits
            to recordings made again of blocks of residuals. Both take longer.
        seed: of the bootstrap.
        windows: of a double pendulum: length of the windows, which each have a start of their own
            [s]; None: one window, or several where the motion cannot be followed in one.
        continuity: of windows: how much the gap between the end of one and the start of the next
            counts: 1: as if all samples of a window were off by it; 0: not at all.
        tolerance: of a double pendulum: angle by which model and measurement may differ where
            `horizon` says how long they agree [rad].

    Returns:
        The fit; `flags` and `notes` say what has to be known about it.

    Raises:
        ValueError: for an argument out of range, or a recording that cannot be fitted.
    """
    given = {n: each for n, each in locals().items() if n not in ("measurement", "system")}
    plan, recordings = planned(measurement, system, **given)
    if plan.bodies == 2:
        return fitted_double(plan, recordings[0])
    if isinstance(plan.model, SystemModel):
        return result_of(plan, *system_optimum(plan, recordings))
    return fitted(plan, recordings, Begun(plan, recordings))


def fitted(plan: Plan, recordings: tuple[Sampled, ...], begun: Begun) -> Fit:
    """The fit that was planned."""
    problem = plan.problem(recordings)
    best = begun.best(plan, problem)
    viscous = best.rms  # what an undamped model is to be compared with
    if not plan.frictions and not any(plan.fixed.get(name) for name in FRICTIONS):
        damped = replace(plan, frictions=("viscous",))
        viscous = begun.best(damped, damped.problem(recordings)).rms
    made = result_of(plan, problem, best, viscous)
    if len(recordings) > 1 or "damped" in made.flags or not ends_stick_out(made):
        return made
    part = free_swing(plan, recordings[0], made.rms)
    if part is None:
        return made
    told = dict(zip(("begin", "end", "inside"), part, strict=True))
    note = Note("free_swing", {**told, "rms": made.rms, "unit": made.measurement.unit})
    return replace(made, notes=(*made.notes, note), flags=(*made.flags, note.key))


def fitted_double(plan: Plan, recording: Sampled) -> Fit:
    """The fit of a double pendulum that was planned."""
    refuse_upright(recording)
    parts = [recording] if plan.windows is None else asked_windows(recording, plan.windows)
    problem, best = shot(plan.problem(tuple(parts)), continuity=plan.continuity, robust=plan.robust)
    made = result_of(plan, problem, best, best.rms)
    if len(problem.recordings) > 1:
        note = Note("windows", windows_told(problem, best.x))
        made = replace(made, notes=(*made.notes, note), flags=(*made.flags, note.key))
    horizon = horizon_of(made, recording, plan.tolerance)
    if horizon is None:
        return made
    key = "lost" if horizon.trust < horizon.followed else "left" if horizon.left else "followed"
    note = Note(key, {name: float(x) for name, x in horizon._asdict().items() if name != "left"})
    return replace(made, horizon=horizon, notes=(*made.notes, note), flags=(*made.flags, note.key))
