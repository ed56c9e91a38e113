"""Fits of a double pendulum, over windows: a chaotic motion cannot be fitted in one piece."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

from pendula._messages import ArgumentError
from pendula.measured.double_model import STATE, DoubleModel
from pendula.measured.double_start import first_values, quickness
from pendula.measured.fitted import Horizon
from pendula.measured.joints import gaps
from pendula.measured.least_squares import CLOSE
from pendula.measured.problem import Optimum, Problem, Sampled, minimise
from pendula.measured.starts import MOST
from pendula.measured.system_model import SystemModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array
    from pendula.measured.fitted import Fit

_FIRST = 0.75  # periods of the main oscillation: the first window
_GROWS = 1.6  # times as long is the next
_LOST = 0.1  # rad: residuals of a window that is not followed to its end
_SHORTEST = 100.0  # samples of a window
_FEWEST = 20.0  # samples of the first part of one
_MOST_STRETCHED = 1e3  # times a start's change grows in a window: beyond, minima are too many


def shot(
    problem: Problem, *, continuity: float = 1.0, robust: bool = False
) -> tuple[Problem, Optimum]:
    """The optimum of windows that each have a start of their own, and join.

    First they are fitted each from its own start, then with the gaps between them as residuals.

    A window is fitted from its beginning in longer and longer parts. Where all of one recording is
    not followed, it is cut into windows as long as the part that was.

    Args:
        problem: of one recording, or of windows of it.
        continuity: how much a gap counts, as parts of the samples of a window; 0: not at all.
        robust: as for `minimise`.

    Returns:
        The problem as it was solved, and its optimum.
    """
    import numpy as np

    whole = problem.recordings[0]
    first = problem.of([whole])
    best, followed = _grown(first, robust=robust)
    if len(problem.recordings) == 1:
        if followed >= _span(whole):
            return problem, minimise(problem, best, robust=robust)
        problem = problem.of(cut(whole, followed))
    known = dict(zip(first.names, best.tolist(), strict=True))
    shortest = 2.0 * _SHORTEST * float(np.median(np.diff(whole.t)))
    start, lost = _starts(problem, known, robust=robust)
    while lost:
        parts = [
            cut(each, 0.5 * _span(each)) if i in lost and _span(each) > shortest else [each]
            for i, each in enumerate(problem.recordings)
        ]
        if sum(map(len, parts)) == len(parts):
            break
        problem = problem.of([part for each in parts for part in each])
        start, lost = _starts(problem, known, robust=robust)
    begin = np.array([start[name] for name in problem.names])
    apart = minimise(problem, begin, robust=robust)
    if not continuity:
        return problem, apart
    joined = replace(problem, joints=_weights(problem, whole, continuity))
    return joined, minimise(joined, apart.x, robust=robust)


def _weights(problem: Problem, whole: Sampled, continuity: float) -> tuple[float, ...]:
    """Of gaps in angles and, over the frequency of the motion, in rates."""
    samples = continuity * sum(len(each.t) for each in problem.recordings)
    angle = math.sqrt(samples / len(problem.recordings))
    rate = angle / quickness(whole)
    return (angle, angle, rate, rate)


def windows_told(problem: Problem, x: Array) -> dict[str, float | str]:
    """How many windows there are, how long [s], and the largest gap between two [rad]."""
    import numpy as np

    lengths = [_span(each) for each in problem.recordings]
    ends = {"shortest": min(lengths), "longest": max(lengths)}
    apart = gaps(replace(problem, joints=(1.0,) * 4), x)[:, :2]
    return {"count": str(len(lengths)), **ends, "gap": float(np.abs(apart).max())}


def _starts(
    problem: Problem, known: Mapping[str, float], *, robust: bool
) -> tuple[dict[str, float], set[int]]:
    """Parameters of each window, what they share as known; and which were not followed."""
    start, lost = dict(known), set[int]()
    for i, each in enumerate(problem.recordings):
        own, followed = _grown(_held(problem, known).of([each]), robust=robust)
        if followed < _span(each):
            lost.add(i)
        mark = f"[{i + 1}]" if len(problem.recordings) > 1 else ""
        start |= {f"{n}{mark}": x for n, x in zip(_own(problem), own.tolist(), strict=True)}
    return start, lost


def asked_windows(recording: Sampled, length: float) -> list[Sampled]:
    """Windows as long as asked [s].

    Raises:
        ValueError: where one would hold too few samples to tell a start of its own.
    """
    parts = cut(recording, length)
    fewest = min(len(each.t) for each in parts)
    if fewest < _FEWEST:
        raise ArgumentError(
            "windows",
            "must hold {least} samples or more each; of {value} s one holds {count}",
            "take {enough} s or longer ones",
            least=int(_FEWEST),
            value=length,
            count=fewest,
            enough=float(f"{1.05 * length * _FEWEST / max(fewest, 1):.2g}"),
        )
    return parts


def cut(recording: Sampled, length: float) -> list[Sampled]:
    """Windows of a recording, all nearly as long as asked [s]."""
    import numpy as np

    span = _span(recording)
    count = max(math.ceil(span / length - 1e-9), 1)
    edges = recording.t[0] + span * np.arange(1, count) / count
    places = [0, *np.searchsorted(recording.t, edges).tolist(), len(recording.t)]
    return [recording.taken(slice(begin, end)) for begin, end in pairwise(places)]


def _span(recording: Sampled) -> float:
    """How long a recording is [s]."""
    return float(recording.t[-1] - recording.t[0])


def _own(problem: Problem) -> list[str]:
    """Parameters that each window has for itself."""
    return [name for name in problem.free if name not in problem.shared]


def _held(problem: Problem, known: Mapping[str, float]) -> Problem:
    """The problem with what windows share held at known values."""
    held = {name: known[name] for name in problem.shared}
    return replace(
        problem, free=tuple(_own(problem)), shared=(), constants={**problem.constants, **held}
    )


def _grown(problem: Problem, *, robust: bool) -> tuple[Array, float]:
    """Parameters of one window, and how much of it they describe [s]."""
    import numpy as np

    recording = problem.recordings[0]
    span = _span(recording)
    assert isinstance(problem.model, DoubleModel | SystemModel)
    known = {row.name: row.standard for row in problem.rows()}
    known |= first_values(recording, {**problem.constants, **problem.model.shape})
    x = np.array([known[name] for name in problem.names])
    length, followed = _FIRST * 2.0 * math.pi / quickness(recording), 0.0
    shortest = _FEWEST * float(np.median(np.diff(recording.t)))
    while followed < span:
        length = min(length, span)
        part = problem.within(length).sparser(MOST)
        found = minimise(part, x, robust=robust, search=CLOSE)
        if found.rms <= _LOST:
            x, followed = found.x, length
            if _stretched(part, x) > _MOST_STRETCHED:
                break
            length *= _GROWS
        elif followed == 0.0 and length > shortest:
            length *= 0.5
        else:
            break
    return x, followed


def _stretched(problem: Problem, x: Array) -> float:
    """How many times a change of the first angles has grown in one recording, at most."""
    import numpy as np

    columns = [problem.names.index(name) for name in STATE[:2] if name in problem.names]
    return float(np.abs(problem.jacobian(x)[:, columns]).max(initial=0.0))


def horizon_of(made: Fit, whole: Sampled, tolerance: float) -> Horizon | None:
    """How long the fitted motion follows the recording; None: no pendulum moves so.

    Args:
        made: the fit.
        whole: all samples of the recording, from the first that was fitted.
        tolerance: angle by which they may differ [rad].
    """
    import numpy as np

    from pendula.run.solve import solve

    first = made.recordings[0]
    if first.system is None:
        return None
    run = solve(first.system, first.start, whole.t, t0=float(whole.t[0]), certify=tolerance)
    offsets = first.fitted[0] - first.start[:2]
    apart = np.abs(run.states[:, :2] + offsets - whole.values)
    lost = np.nanmax(np.where(np.isfinite(apart), apart, 0.0), axis=1) > tolerance
    last = int(lost.argmax()) if lost.any() else len(whole.t) - 1
    begin = float(whole.t[0])
    trust = math.inf if run.trust_horizon is None else run.trust_horizon - begin
    return Horizon(tolerance, float(whole.t[last]) - begin, bool(lost.any()), trust)
