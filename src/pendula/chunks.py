"""Work in chunks: into memory or a store, here or on a cluster, with the same bytes each time."""

from pendula.many.chunks import (
    Axis,
    Chunk,
    Compute,
    Variable,
    Work,
    computed,
    connect,
    opened,
    run,
)

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
