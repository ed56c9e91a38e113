"""Progress of work that consists of parts."""

from __future__ import annotations

from collections.abc import Callable

Progress = Callable[[float], None] | None
StepProgress = Callable[[str, float], None]  # what is being done, and the part that is done


def part(progress: Progress, start: float, end: float) -> Progress:
    """A callback for a part of the work that reports the part of the whole."""
    return progress and (lambda share: progress(start + (end - start) * share))
