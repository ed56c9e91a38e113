"""Work that goes on with the result of a smaller one: more draws behind those that there are."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pendula.many.chunks.work import Work


def size_before(work: Work, there: Any) -> int | None:
    """How far along the cut axis a store reaches whose result is the beginning of this work's.

    Args:
        work: what is to be in the store.
        there: the identity of the work that is in it.

    Returns:
        The size of the cut axis there; None where this work is no larger one of the same kind.
    """
    if not work.growing:
        return None
    here, (axis,) = json.loads(work.identity), work.cut
    *outer, last = work.growing
    inner = here
    for key in outer:
        inner = inner[key]
    new, old = inner[last], _found(there, work.growing)
    if type(old) is not int or not 1 <= old < new:
        return None
    size = axis.size // new * old
    inner[last] = old
    here["chunks"] = {axis.name: min(axis.chunk or size, size)}
    return size if here == there else None


def _found(data: Any, keys: tuple[str, ...]) -> Any:
    """What stands at these keys of data within data; None: nothing."""
    for key in keys:
        data = data.get(key) if isinstance(data, dict) else None
    return data
