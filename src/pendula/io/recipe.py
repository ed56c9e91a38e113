"""The attributes a file carries: what was run, with which version, and how it ended."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from pendula import __version__
from pendula.systems import system_from
from pendula.trajectory import Request, Trajectory

if TYPE_CHECKING:
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


def attributes(trajectory: Trajectory) -> str:
    """One line of JSON; a float's shortest decimal form gives its bits back."""
    asked = trajectory.request
    return json.dumps(
        {
            "pendula": __version__,
            "system": trajectory.system.description(),
            "method": trajectory.method,
            "state": asked.state.tolist(),
            "t0": asked.t0,
            "end": asked.end,
            "step": asked.step,
            "max_steps": asked.max_steps,
            "outcome": trajectory.outcome,
            "n_steps": trajectory.n_steps,
            "n_evaluations": trajectory.n_evaluations,
        },
        ensure_ascii=True,
    )


def from_attributes(text: str, t: Array, states: Array, source: Path) -> Trajectory:
    """The trajectory of these attributes, times (n,) and states (n, d).

    Raises:
        ValueError: where the attributes are not those of a trajectory.
    """
    import numpy as np

    try:
        known: dict[str, Any] = json.loads(text)
        system = system_from(known["system"])
        state = np.array(known["state"], dtype=np.float64)
        request = Request(state, known["t0"], known["end"], known["step"], known["max_steps"])
        counts = known["outcome"], known["n_steps"], known["n_evaluations"]
        return Trajectory(system, known["method"], t, states, request, *counts)
    except (AttributeError, KeyError, TypeError, json.JSONDecodeError) as error:
        raise ValueError(
            f"{source} does not hold a trajectory of pendula: its attributes lack or spoil {error}"
        ) from None
