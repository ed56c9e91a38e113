"""The attributes a file carries: what was run, with which version, and how it ended."""

from __future__ import annotations

import json
import math
import operator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from pendula._checks import finite_number, numbers_array, one_of
from pendula._engine import OUTCOMES, methods
from pendula._messages import one_line
from pendula._version import __version__
from pendula.io.checksums import of_column, of_recipe
from pendula.io.columns import labelled
from pendula.run.derivatives import CrossingDerivatives
from pendula.run.events import Crossings
from pendula.run.options import options_from
from pendula.run.request import Request
from pendula.run.trajectory import Trajectory
from pendula.systems import system_from

if TYPE_CHECKING:
    from pathlib import Path

    from pendula._types import Array


class NotATrajectoryError(ValueError):
    """A file that does not hold a trajectory, or not all of one."""


def attributes(trajectory: Trajectory) -> str:
    """One line of JSON; a float's shortest decimal form gives its bits back.

    It ends with the number of times, a checksum of each column and one of all that stands before.
    """
    asked = trajectory.request
    known = {
        "pendula": __version__,
        "system": trajectory.system.description(),
        "method": trajectory.method,
        "state": asked.state.tolist(),
        "t": _asked_times(trajectory),
        "t0": asked.t0,
        **asked.described(),
        "outcome": trajectory.outcome,
        "n_steps": trajectory.n_steps,
        "n_evaluations": trajectory.n_evaluations,
        "reached": _number(trajectory.reached),
        "crossings": [
            {"times": each.times.tolist(), "states": each.states.tolist()}
            for each in trajectory.events
        ],
        "trust_horizon": _number(trajectory.trust_horizon),
        "precision": trajectory.precision,
        **_derived(trajectory),
        "n_times": trajectory.t.size,
        "columns": {name: of_column(each) for name, each in labelled(trajectory).items()},
    }
    known["checksum"] = of_recipe(known)
    return json.dumps(known, ensure_ascii=True, allow_nan=False)


def _derived(trajectory: Trajectory) -> dict[str, Any]:
    """What the columns of derivatives are by, and derivatives of events; of most runs nothing."""
    if trajectory.derivatives is None:
        return {}
    return {
        "derived_by": list(trajectory.derivative_names),
        "crossings_derived": [
            {"times": each.times.tolist(), "states": each.states.tolist()}
            for each in trajectory.event_derivatives
        ],
    }


def _number(value: float | None) -> float | str | None:
    """JSON has no infinity."""
    return "inf" if value == math.inf else value


def _asked_times(trajectory: Trajectory) -> float | list[float] | None:
    """The end, or the times; None: those that the file holds anyway."""
    t = trajectory.request.t
    if isinstance(t, float):
        return t
    return None if t.size == trajectory.t.size else t.tolist()


def from_attributes(
    known: dict[str, Any], t: Array, states: Array, derivatives: Array | None, source: Path
) -> Trajectory:
    """The trajectory of a file's recipe.

    Args:
        known: the recipe.
        t: times, (n,) [s].
        states: (..., n, d).
        derivatives: (..., n, d, k); None: it has none.
        source: the file, for errors.

    Raises:
        NotATrajectoryError: where the recipe is not that of a trajectory.
    """
    try:
        system = system_from(known["system"])
        state = numbers_array("state", known["state"])
        asked = t if known["t"] is None else numbers_array("t", known["t"], "s")
        times = asked if asked.ndim else float(asked)
        origin = finite_number("t0", known["t0"], "s")
        request = Request(state=state, t=times, t0=origin, **options_from(known))
        method = one_of("method", known["method"], ("exact", *(each.name for each in methods())))
        if states.shape[-1] != state.shape[-1] or state.shape[-1] != len(system.components):
            raise ValueError(f"states of {states.shape[-1]} components")
        counts = operator.index(known["n_steps"]), operator.index(known["n_evaluations"])
        outcome = one_of("outcome", known["outcome"], OUTCOMES)
        run = Trajectory(system, method, t, states, request, outcome, *counts, **_found(known))
        if derivatives is not None:
            run = replace(run, derivatives=derivatives, **_found_derived(known, len(run.events)))
        reached = known["reached"] if "reached" in known else _reached(run)
        return replace(run, reached=float(reached))
    except (AttributeError, KeyError, OverflowError, TypeError, ValueError) as error:
        raise NotATrajectoryError(
            f"{source} does not hold a trajectory of pendula: its attributes lack or spoil "
            f"{one_line(error)}"
        ) from None


def _reached(run: Trajectory) -> float:
    """The time up to which a run was made, as far as files tell that do not say so [s]."""
    asked = run.request
    if run.method == "exact":
        return math.inf
    if run.outcome == "reached_end":
        return asked.end
    direction = -1.0 if asked.end < asked.t0 else 1.0
    if asked.step is not None:
        return asked.t0 + direction * run.n_steps * asked.step
    known = (asked.t0, *run.t[-1:], *(time for each in run.events for time in each.times[-1:]))
    return float(max(known, key=lambda time: direction * time))


def _found(known: dict[str, Any]) -> dict[str, Any]:
    """What a run found besides its states; files of earlier versions have none of it."""
    import numpy as np

    width = len(known["state"])
    crossings = (
        Crossings(
            np.array(each["times"], dtype=np.float64),
            np.array(each["states"], dtype=np.float64).reshape(-1, width),
        )
        for each in known.get("crossings", ())
    )
    horizon = known.get("trust_horizon")
    return {
        "events": tuple(crossings),
        "trust_horizon": None if horizon is None else float(horizon),
        "precision": known.get("precision"),
    }


def _found_derived(known: dict[str, Any], events: int) -> dict[str, Any]:
    """What derivatives are by, and those of events."""
    import numpy as np

    names, width = tuple(map(str, known["derived_by"])), len(known["state"])
    derived = tuple(
        CrossingDerivatives(
            np.array(each["times"], dtype=np.float64).reshape(-1, len(names)),
            np.array(each["states"], dtype=np.float64).reshape(-1, width, len(names)),
        )
        for each in known["crossings_derived"]
    )
    if derived and len(derived) != events:
        raise ValueError(f"derivatives of {len(derived)} events of {events}")
    return {"derivative_names": names, "event_derivatives": derived}
