"""Types that many modules use, imported for type checking only."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# The catalogue's, which a test compares: what an editor offers for `method`.
MethodName = Literal[
    "euler",
    "heun",
    "rk4",
    "symplectic-euler",
    "verlet",
    "yoshida4",
    "yoshida6",
    "yoshida8",
    "midpoint",
    "gauss4",
    "gauss6",
    "gauss8",
    "dop853",
    "taylor",
]
