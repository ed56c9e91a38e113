"""What a notebook shows of a run."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from pendula.run.trajectory import Trajectory


def facts_of(run: Trajectory) -> Iterator[tuple[str, str]]:
    """Names and values of what the run was and gave."""
    import numpy as np

    yield "system", repr(run.system)
    span = f", t = {run.t[0]:g} … {run.t[-1]:g} s" if run.t.size else ""
    yield "times", f"{run.t.size}{span}"
    if run.states.ndim == 2:
        for name, state in zip(
            ("start", "end"), (run.request.state, *run.states[-1:]), strict=False
        ):
            pairs = zip(run.system.component_units.items(), state.tolist(), strict=True)
            yield name, ", ".join(f"{each} = {x:.6g} {unit}" for (each, unit), x in pairs)
    else:
        yield "states", f"of shape {run.states.shape}"
    yield "outcome", run.outcome
    if run.n_steps:
        yield "steps", f"{run.n_steps}, {run.n_evaluations} evaluations"
    if run.t.size:
        name = run.energy_error_name
        with np.errstate(over="ignore", invalid="ignore"):  # of a run that blew up
            yield f"largest {name}", f"{abs(run.energy_error).max():.2g}"
    for event, crossings in zip(run.request.events, run.events, strict=False):
        yield repr(event), f"{len(crossings.times)} times"
    if run.trust_horizon is not None:
        passed = math.isfinite(run.trust_horizon)
        until = f"{run.trust_horizon:g} s" if passed else "the end"
        yield "trusted until", until
