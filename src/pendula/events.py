"""Events that `solve` looks for inside its steps, and what it returns of each."""

from pendula.run.events import Crossings, Event, angle, flip, tip_height, velocity_zero

__all__ = ["Crossings", "Event", "angle", "flip", "tip_height", "velocity_zero"]
