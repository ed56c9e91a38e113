"""Whether two trajectories are the same one."""

from __future__ import annotations

from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from pendula import Trajectory


def same(a: Trajectory, b: Trajectory) -> None:
    """In every bit of every field; what `at` and `pieces` use alone may be made again."""
    assert a.system == b.system
    for field in fields(a):
        if field.name not in ("system", "request", "events", "dense", "changes"):
            same_value(getattr(a, field.name), getattr(b, field.name), field.name)
    for field in fields(a.request):
        same_value(getattr(a.request, field.name), getattr(b.request, field.name), field.name)
    assert len(a.events) == len(b.events)
    for one, other in zip(a.events, b.events, strict=True):
        same_value(one.times, other.times, "times")
        same_value(one.states, other.states, "states")


def same_value(a: Any, b: Any, name: str) -> None:
    """Of one type, and shape."""
    assert type(a) is type(b), name
    if isinstance(a, np.ndarray):
        assert (a.dtype, a.shape, a.tobytes()) == (b.dtype, b.shape, b.tobytes()), name
    else:
        assert a == b, name
