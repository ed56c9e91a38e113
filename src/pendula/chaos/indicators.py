"""The indicators of chaos that tell the motions of a map or a section apart."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula.chaos.alignment import sali_of
from pendula.chaos.variations import Asked, first_variations

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.systems import System

# Name, unit and meaning of each.
INDICATORS = {
    "megno": ("1", "mean MEGNO at t_max"),
    "lyapunov": ("1/s", "finite-time Lyapunov exponent, ln of the growth over t_max"),
    "sali": ("1", "smaller alignment index at t_max"),
}


def indicator_of(
    system: System,
    starts: Array,
    indicator: str,
    t_max: float,
    options: Mapping[str, Any],
    threads: int | None,
    progress: Progress,
) -> Array:
    """An indicator of the motions from starts (n, d), (n,); NaN where a run does not come so far.

    Args:
        system: of all.
        starts: at t = 0.
        indicator: its name.
        t_max: the length of the runs [s].
        options: tolerance and most steps.
        threads: None: one for each processor.
        progress: called with the part that is done.
    """
    import numpy as np

    asked = Asked(system, starts, False, np.array([t_max]), 0.0, options)
    if indicator == "sali":
        runs = asked.runs(first_variations(system, None, 2, ""), "free", threads, progress)
        return sali_of(runs.directions)[:, 0]
    runs = asked.runs(first_variations(system, None, 1, ""), "megno", threads, progress)
    if indicator == "lyapunov":
        rate: Array = runs.growth[:, 0, 0] / t_max
        return rate
    assert runs.integrals is not None
    mean: Array = runs.integrals[:, 0, 1] / t_max
    return mean
