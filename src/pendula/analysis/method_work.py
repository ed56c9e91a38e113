"""What runs of several methods cost and how wrong they are."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._attributes import KEY
from pendula._checks import extra
from pendula._version import __version__

if TYPE_CHECKING:
    import pandas as pd

    from pendula._types import Array
    from pendula.systems import System


@dataclass(frozen=True, eq=False)
class MethodWork:
    """Runs of one method, from coarse to fine; every array is (n,).

    Attributes:
        method: its name.
        adaptive: whether `settings` are tolerances; else they are steps [s].
        settings: what each run was asked for.
        evaluations: of the right-hand side; of the Taylor method its coefficients, see
            `work_precision`.
        seconds: least processor time of the compiled run; nan: not measured.
        errors: largest error of any angle at the output times; inf: the run broke down [rad].
        energy_errors: |E − E0| / E0 at the end; inf likewise.
        outcomes: how each run ended.
    """

    method: str
    adaptive: bool
    settings: Array
    evaluations: Array
    seconds: Array
    errors: Array
    energy_errors: Array
    outcomes: tuple[str, ...]

    @property
    def best(self) -> float:
        """The least error [rad]."""
        return float(self.errors.min())

    def to_reach(self, error: float) -> tuple[float, float]:
        """Evaluations and seconds after which the error is first so small [rad]; nan: never.

        Interpolated linearly in logarithms between two runs.
        """
        there = np.flatnonzero(self.errors <= error)
        if not there.size:
            return math.nan, math.nan
        i = int(there[0])
        share = 1.0
        if i and math.isfinite(self.errors[i - 1]) and self.errors[i] > 0.0:
            before, after = np.log(self.errors[i - 1 : i + 1])
            share = float((before - math.log(error)) / (before - after))
        low, costs = max(i - 1, 0), (self.evaluations, self.seconds)
        # where errors go up and down, a later run can be there for less
        cheapest = there[np.argmin(self.evaluations[there])]
        # a run so short that the clock saw no time has no logarithm
        at_first = [float(c[low] * (c[i] / c[low]) ** share if c[low] > 0 else c[i]) for c in costs]
        evaluations, seconds = min(at_first, [float(c[cheapest]) for c in costs])
        return evaluations, seconds

    def error_at(self, evaluations: float) -> float:
        """The error with so many evaluations [rad], interpolated likewise; nan: with too few."""
        order = np.argsort(self.evaluations, kind="stable")
        work, errors = self.evaluations[order], self.errors[order]
        if not work[0] <= evaluations < work[-1]:
            return math.nan if evaluations < work[0] else self.best
        i = max(int(np.searchsorted(work, evaluations)), 1)
        low, high = errors[i - 1], errors[i]
        if not math.isfinite(low) or min(low, high) == 0.0 or work[i - 1] == work[i]:
            return float(low if evaluations < work[i] else high)
        share = math.log(evaluations / work[i - 1]) / math.log(work[i] / work[i - 1])
        return float(low * (high / low) ** share)


@dataclass(frozen=True, eq=False)
class WorkPrecision:
    """What each method's errors cost for one motion.

    Attributes:
        system: the pendulum.
        state: at time t0, (d,).
        t0: time of that state [s].
        t: output times at which runs and reference are compared; the last is the end, (n,) [s].
        reference: "exact", or "taylor" for a run with `digits` right digits.
        digits: right digits of the reference's run; None: it is exact.
        precision: decimal digits that run was computed with.
        reference_error: bound of the reference's own error [rad].
        resolution: 2^-52 of the largest angle: what the last bit of a double is worth there [rad].
        methods: the runs of each method.
    """

    system: System
    state: Array
    t0: float
    t: Array
    reference: str
    digits: int | None
    precision: int | None
    reference_error: float
    resolution: float
    methods: tuple[MethodWork, ...]

    def equal_work(self) -> int:
        """A round number of evaluations at which the methods' errors can be set side by side."""
        fewest = max(float(each.evaluations.min()) for each in self.methods)
        most = min(float(each.evaluations.max()) for each in self.methods)
        middle = math.sqrt(fewest * max(fewest, most))
        power = 10 ** int(math.log10(middle))
        round_number: int = next(n * power for n in (1, 2, 5, 10) if n * power >= middle)
        return round_number

    def attributes(self) -> dict[str, Any]:
        """What was compared, as data that JSON can hold."""
        return {
            KEY: __version__,
            "system": self.system.description(),
            "state": self.state.tolist(),
            "t0": self.t0,
            "t_max": float(self.t[-1]),
            "outputs": len(self.t),
            "reference": self.reference,
            "digits": self.digits,
            "precision": self.precision,
            "reference_error": self.reference_error,
        }

    def to_dict(self) -> dict[str, list[Any]]:
        """One row per run, as columns with their units in the names."""
        each = [(m, i) for m in self.methods for i in range(len(m.settings))]
        return {
            "method": [m.method for m, _ in each],
            "step [s]": [math.nan if m.adaptive else float(m.settings[i]) for m, i in each],
            "tolerance [1]": [float(m.settings[i]) if m.adaptive else math.nan for m, i in each],
            "evaluations [1]": [int(m.evaluations[i]) for m, i in each],
            "processor time [s]": [float(m.seconds[i]) for m, i in each],
            "largest angle error at the outputs [rad]": [float(m.errors[i]) for m, i in each],
            "energy error at the end [1]": [float(m.energy_errors[i]) for m, i in each],
            "outcome": [m.outcomes[i] for m, i in each],
        }

    def to_pandas(self) -> pd.DataFrame:
        """The same as a table (extra: io)."""
        frame: pd.DataFrame = extra("pandas", "io").DataFrame(self.to_dict())
        return frame
