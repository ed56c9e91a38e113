"""Trust horizons straight from the core, beside those that runs tell."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pendula import _engine
from pendula.run.request import Request

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from pendula.systems import System


def horizon(
    system: System, state: ArrayLike, method: str, t0: float, end: float, **options: Any
) -> float:
    """Of a run that comes to its end: when an angle is first off by more than `certify` [s]."""
    asked = Request(state=np.array(state, dtype=float), t=float(end), t0=t0, **options)
    return _engine.trust_horizon(asked.for_core(system, method), None)
