"""Trust: until when a run in doubles is right, and states right to so many digits."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._messages import ArgumentError
from pendula.run.request import Request

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.systems import System

PROBES = 100  # times at which the growth of errors is looked at
PARTED = 1e-3  # rad, at which a run with doubles is taken to have parted from the motion
LOST = 13.0  # digits of a double there
RESERVE = 4.0  # digits
GROWTH_ALLOWED = 1.1  # of the logarithm of errors, beyond the growth that was seen


class DigitsError(ArgumentError):
    """Digits that cannot be computed.

    Attributes:
        outcome: how a run that asks for them ends: "digits_limit" or "not_finite".
        reason: why, and how far the run could be made.
    """

    def __init__(self, outcome: str, reason: str, rule: str, way_out: str, **details: Any) -> None:
        super().__init__("digits", rule, way_out, **details)
        self.outcome, self.reason = outcome, reason


def digits_states(
    system: System,
    state: Array,
    times: Array,
    t0: float,
    digits: int,
    progress: Progress = None,
) -> tuple[Array, int]:
    """States right to so many digits, each component by itself, at every one of the times.

    The working precision follows from the growth of errors. A run with more digits has to agree;
    where it does not, the two are repeated with more still.

    Args:
        system: a pendulum.
        state: at time t0, (d,) [rad, rad/s].
        times: strictly rising from t0, or falling, (n,) [s].
        t0: time of the state [s].
        digits: 1 to 15.
        progress: called with the part of the work that is done, 0 to 1, some times a second.

    Returns:
        States (n, d) and the decimal digits that they were computed with.

    Raises:
        ValueError: where more digits would be needed than there are.
    """
    runs = _LongRuns(system, state, t0, times, progress)
    level = runs.first_level(digits)
    runs.plan(level, level + 1)
    lower = runs.states(level)
    while True:
        level += 1
        higher = runs.states(level)
        good = _agreed(lower, higher, digits)
        if good.all():
            runs.report(1.0)
            return higher[..., 0].copy(), runs.levels[level]
        if level + 1 == len(runs.levels):
            last = times[good.argmin() - 1] if good[0] else t0
            raise runs.too_far(digits, float(last))
        lower = higher
        runs.plan(level + 1)


def _agreed(lower: Array, higher: Array, digits: int) -> NDArray[np.bool_]:
    """At which times all components have these digits in common, (n,)."""
    import numpy as np

    apart = abs((higher[..., 0] - lower[..., 0]) + (higher[..., 1] - lower[..., 1]))
    allowed = 0.5 * 10.0**-digits * abs(higher[..., 0]) + 2.0**-1022
    return np.asarray((apart <= allowed).all(axis=-1))


def _common_digits(lower: Array, higher: Array) -> Array:
    """Digits that angles and velocities as a whole have in common, (n,)."""
    import numpy as np

    apart = abs((higher[..., 0] - lower[..., 0]) + (higher[..., 1] - lower[..., 1]))
    size = abs(higher[..., 0])
    rows = *apart.shape[:-1], 2, -1
    sizes = np.maximum(size.reshape(rows).max(axis=-1), 1e-300)
    return np.asarray(-np.log10(apart.reshape(rows).max(axis=-1) / sizes + 1e-300).max(axis=-1))


@dataclass
class _LongRuns:
    """Runs of one motion with more and more digits, and how far all of them are."""

    system: System
    state: Array
    t0: float
    times: Array
    progress: Progress
    levels: tuple[int, ...] = field(default_factory=lambda: tuple(_engine.long_run_digits()))
    done: float = 0.0  # work
    planned: float = 0.0
    reported: float = 0.0  # part of it

    def first_level(self, digits: int) -> int:
        """The level that should be enough, one below the last at most."""
        import numpy as np

        end = float(self.times[-1])
        span = end - self.t0
        certified = Request(state=self.state, t=end, t0=self.t0, certify=PARTED)
        parted = _engine.trust_horizon(certified.for_core(self.system, "taylor"), None) - self.t0
        if math.isinf(parted) or parted == 0.0:  # an angle that doubles cannot run with
            return self._level_for(digits + LOST)
        lost = GROWTH_ALLOWED * LOST * span / parted
        # in about this time the errors of the lowest level grow to the size of the motion
        window = self.levels[0] / LOST * parted
        if abs(window) >= abs(span):
            return self._level_for(digits + lost)
        guess = self._level_for(digits + lost)
        self.plan(guess, guess + 1)
        self.planned += self._work(0, window) + self._work(1, window)
        probes = self.t0 + window * np.arange(1, PROBES + 1) / PROBES
        lost = self._digits_lost(probes)
        if lost / GROWTH_ALLOWED + digits > self.levels[-1]:
            part = (self.levels[-1] - digits) * GROWTH_ALLOWED / lost
            raise self.too_far(digits, self.t0 + part * span)
        return self._level_for(digits + lost)

    def _level_for(self, digits: float) -> int:
        enough = (there >= digits + RESERVE for there in self.levels[:-1])
        return next((level for level, good in enumerate(enough) if good), len(self.levels) - 2)

    def _digits_lost(self, probes: Array) -> float:
        """How many digits errors cost up to the end, from their growth at these times."""
        common = _common_digits(self.states(0, probes), self.states(1, probes))
        unlike = common <= 1.0
        last = max(int(unlike.argmax()) - 1, 0) if unlike.any() else PROBES - 1
        seen = float(probes[last]) - self.t0, float(self.times[-1]) - self.t0
        lost = self.levels[0] - float(common[: last + 1].min())
        return float(GROWTH_ALLOWED * lost * seen[1] / seen[0])

    def too_far(self, digits: int, t_max: float) -> DigitsError:
        """The error that says up to which time the digits can be computed."""
        return DigitsError(
            "digits_limit",
            f"they can be computed up to about t = {t_max:g} s",
            "= {digits} at t = {t} s would take more than the {precision} digits of working "
            "precision that there are",
            "end the run at about t = {t_max} s, or ask for fewer digits",
            digits=digits,
            t=float(self.times[-1]),
            precision=self.levels[-1],
            t_max=t_max,
        )

    def plan(self, *levels: int) -> None:
        """Plan runs at these levels, for the progress."""
        self.planned = self.done + sum(map(self._work, levels))

    def report(self, part: float) -> None:
        """Report how much is done, which never becomes less."""
        self.reported = max(self.reported, min(part, 1.0))
        if self.progress is not None:
            self.progress(self.reported)

    def states(self, level: int, times: Array | None = None) -> Array:
        """Heads and tails of the states at the times, (n, d, 2)."""
        import numpy as np

        wanted = self.times if times is None else times
        span = float(wanted[-1]) - self.t0
        work = self._work(level, span)

        def on_the_way(part: float) -> None:
            self.report((self.done + work * part) / self.planned)

        asked = Request(state=self.state, t=wanted, t0=self.t0)
        result = _engine.long_run(asked.for_core(self.system, "taylor"), level, on_the_way)
        if result.outcome != "reached_end":
            raise DigitsError(
                "not_finite",
                f"an angle grows beyond {_engine.LARGEST_LONG_ANGLE:.3g} rad",
                "needs angles below 2^50 = {most} rad all the way to t = {value} s",
                "start from a smaller angle, or end the run before",
                most=_engine.LARGEST_LONG_ANGLE,
                value=float(wanted[-1]),
            )
        self.done += work
        d = self.state.size
        return np.stack([result.states(d), result.tails(d)], axis=-1)

    def _work(self, level: int, span: float | None = None) -> float:
        """Of a run: the square of the order of the series, times that of a product."""
        length = abs(float(self.times[-1]) - self.t0 if span is None else span)
        return float(self.levels[level] ** 3.3) * length
