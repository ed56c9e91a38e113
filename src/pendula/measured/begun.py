"""What the first swings of recordings say, from which all models of them start."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula.measured.driven_start import driven_values
from pendula.measured.ladder import Rungs, climbed
from pendula.measured.model import SingleModel
from pendula.measured.starts import first_window

if TYPE_CHECKING:
    from pendula.measured.plan import Plan
    from pendula.measured.problem import Optimum, Problem, Sampled


class Begun:
    """What the first swings say, and rungs that were climbed: the same for all models of a plan."""

    def __init__(self, plan: Plan, recordings: tuple[Sampled, ...]) -> None:
        self.first: dict[str, float] = {}
        self.length = math.inf
        self.rungs: Rungs = {}
        assert isinstance(plan.model, SingleModel)
        constants = plan.problem(recordings).constants
        for i, each in enumerate(recordings):
            own, length = first_window(each, plan.model, constants)
            if plan.model.quantity == "angle" and _is_driven(plan):
                own |= driven_values(each, constants)
                length = float(each.t[-1] - each.t[0])  # the drive holds the phase
            self.length = min(self.length, length)
            for name, value in {**own, **plan.start}.items():
                if len(recordings) > 1:
                    self.first[f"{name}[{i + 1}]"] = value
                self.first.setdefault(name, value)  # what is shared: as of the first recording

    def best(self, plan: Plan, problem: Problem) -> Optimum:
        """The optimum of a problem."""
        return climbed(problem, self.first, self.length, self.rungs, robust=plan.robust)


def _is_driven(plan: Plan) -> bool:
    """Whether a torque that swings is fitted."""
    return "torque" in plan.free and "drive_frequency" in {*plan.free, *plan.fixed}
