"""Measures of chaos: exponents, indicators and what they are made of, with their errors."""

from pendula.chaos.alignment import Alignment, gali, sali
from pendula.chaos.lyapunov import Lyapunov, lyapunov
from pendula.chaos.megno import Megno, megno
from pendula.chaos.tangent_map import TangentMap, tangent_map

__all__ = [
    "Alignment",
    "Lyapunov",
    "Megno",
    "TangentMap",
    "gali",
    "lyapunov",
    "megno",
    "sali",
    "tangent_map",
]
