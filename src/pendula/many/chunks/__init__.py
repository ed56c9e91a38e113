"""Work in chunks: into memory or a store, here or on a cluster, with the same bytes each time."""

from __future__ import annotations

from pendula.many.chunks.cluster import connect
from pendula.many.chunks.running import computed, opened, run
from pendula.many.chunks.work import Axis, Chunk, Compute, Variable, Work

__all__ = [
    "Axis",
    "Chunk",
    "Compute",
    "Variable",
    "Work",
    "computed",
    "connect",
    "opened",
    "run",
]
