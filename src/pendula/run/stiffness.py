"""Systems whose fast swing costs most of the work: said before a run that would take long."""

from __future__ import annotations

import math
import sys
import warnings
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from pendula.systems import System

_RATIO = 1e3  # of the fast mode to the slow one: masses or lengths of a million to one
_SWINGS = 1e5  # of the fast mode, each of several steps: a second of work and more


class StiffWarning(UserWarning):
    """A run takes very many steps for a swing that is far faster than the motion of interest."""


def warn_of_stiffness(systems: Iterable[System], span: float) -> None:
    """Warn of a stiff system, at the line that called the public function.

    Args:
        systems: of which the first stiff one is named.
        span: of the run [s].
    """
    for system in systems:
        fast = system.fastest_frequency
        swings = span * fast / math.tau
        if swings > _SWINGS and fast > _RATIO * (slow := system.slowest_frequency):
            warnings.warn(
                f"{system!r} is stiff: its fast mode swings {swings:.1g} times in the {span:g} s "
                f"of the run, {fast / slow:.1g} times as often as the slow one, and each swing "
                "takes several steps; take masses and lengths nearer to one another, or less time",
                StiffWarning,
                stacklevel=_level(),
            )
            return


def _level() -> int:
    """How far above `warn_of_stiffness` the first frame outside of the package is."""
    level = 2
    while sys._getframe(level).f_globals.get("__name__", "").partition(".")[0] == "pendula":
        if sys._getframe(level).f_back is None:
            break
        level += 1
    return level
