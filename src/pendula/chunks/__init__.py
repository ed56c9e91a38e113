"""Work in chunks: into memory or a store, here or on a cluster, with the same bytes each time."""

from __future__ import annotations

from pendula.chunks.cluster import connect
from pendula.chunks.running import computed, opened, run
from pendula.chunks.work import Axis, Chunk, Compute, Variable, Work

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
