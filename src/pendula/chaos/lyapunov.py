"""Lyapunov exponents with their errors."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from pendula._checks import checked_progress, number, positive_number, whole_number
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula._progress import part, with_bar
from pendula._tables import html_table
from pendula.chaos.certified import Certified, certified
from pendula.chaos.datasets import dataset_of
from pendula.chaos.growths import Plan, errors_that_fall_slowly, standard_errors
from pendula.chaos.variations import OPTIONS, Asked, asked_of
from pendula.chaos.verdict import verdict_of
from pendula.run.options import takes_options

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Unpack

    import xarray as xr
    from numpy.typing import ArrayLike

    from pendula._progress import AskedProgress
    from pendula._types import Array
    from pendula.chaos.variations import VariedRuns
    from pendula.run.options import RunOptions
    from pendula.systems import System

_PARTS = 400  # of a run, whose growths the error comes from


@with_promised
@dataclass(frozen=True, eq=False)
class Lyapunov:
    """Lyapunov exponents of one motion, or of n motions (then with a first axis n).

    Attributes:
        system: the pendulum.
        start: the state at t0, (d,) [rad, rad/s].
        t: times of the running estimate, from the end of the transient on, (m,) [s].
        exponents: mean growth of ln|δ|, of the orthogonal parts for several, (k,) [1/s].
        standard_error: of each, from block means and the memory that they show, (k,); NaN where the
            run is too short for eight blocks of two correlation times [1/s].
        running: the estimates up to each time, (m, k) [1/s].
        verdict: "chaotic", "regular" or "undecided", by the mean MEGNO of the whole run.
        mean_megno: of the whole run; NaN where several exponents are asked for.
        transient: time left out at the start [s].
        trust_horizon: up to here the states are right to `certify`; None: not asked [s].
        finite_time: the exponents up to the trust horizon or the end, along states that are right,
            (k,) [1/s]; NaN: it lies in the transient; None: not asked.
        finite_time_error: by how much those may be off, (k,) [1/s]; None: not asked.
        n_steps: taken.
        outcome: how the run ended.
        recipe: the arguments that it was made with, beside system, and start.
    """

    system: System
    start: Array
    t: Array
    exponents: Array
    standard_error: Array
    running: Array
    verdict: Any
    mean_megno: Any
    transient: float
    trust_horizon: Any
    finite_time: Any
    finite_time_error: Any
    n_steps: Any
    outcome: Any
    recipe: Mapping[str, Any] = field(default_factory=dict)

    @property
    def sum(self) -> Array:
        """Of all exponents [1/s]: 0 without friction, but for 1/T; a check, no result.

        Raises:
            ValueError: where not all were asked for.
        """
        self._check_all()
        total: Array = self.exponents.sum(axis=-1)
        return total

    @property
    def pairing_error(self) -> Array:
        """|λi + λ(d+1−i)| of each pair, (d/2,) [1/s]: 0 without friction, but for 1/T.

        Raises:
            ValueError: where not all were asked for.
        """
        self._check_all()
        half = self.exponents.shape[-1] // 2
        return abs(self.exponents[..., :half] + self.exponents[..., : half - 1 : -1])

    @property
    def digits(self) -> Any:
        """Decimals of the finite-time exponents that are right, (k,); None: not certified.

        Printed with so many decimals, each is off by no more than one in the last.
        """
        import numpy as np

        if self.finite_time_error is None:
            return None
        with np.errstate(invalid="ignore"):
            decimals = np.floor(-np.log10(2.0 * self.finite_time_error))
        return np.where(np.isfinite(decimals), np.maximum(decimals, 0.0), 0.0).astype(int)

    @property
    def settled(self) -> Any:
        """Whether the second half of the run agrees with the whole to two standard errors."""
        import numpy as np

        half, span = len(self.t) // 2, self.t[-1] - self.t[0]
        until = self.t[half - 1] - self.t[0] + span / len(self.t)
        whole = span + span / (len(self.t) - 1)
        first = self.running[..., half - 1, 0]
        second = (self.exponents[..., 0] * whole - first * until) / (whole - until)
        return np.abs(second - self.exponents[..., 0]) <= 2.0 * self.standard_error[..., 0]

    @property
    def standard_error_settled(self) -> Any:
        """Whether the run's blocks let the error of the largest fall about as 1/√T.

        False: they remember each other, so that more time helps little and other starts tell more.
        True is no promise: a run knows nothing of what it has not met, such as an island's edge. At
        100 J, where motions stick for longer than 10 000 s, it is False in three or four of ten.
        """
        import numpy as np

        elapsed = self.t - self.t[0] + (self.t[1] - self.t[0])
        growth = np.atleast_2d(self.running[..., 0] * elapsed)[..., np.newaxis]
        slowly = errors_that_fall_slowly(growth, float(elapsed[-1]))[:, 0]
        return np.logical_not(slowly) if self.running.ndim > 2 else not slowly[0]

    def to_xarray(self) -> xr.Dataset:
        """Exponents, their errors and the running estimates (extra: io)."""
        rate = "1/s"
        told: dict[str, Any] = {
            "exponent": (("order",), self.exponents, rate, "Lyapunov exponent"),
            "standard_error": (("order",), self.standard_error, rate, "of the exponent"),
            "running": (("t", "order"), self.running, rate, "estimate up to each time"),
            "verdict": ((), self.verdict, "", "by the mean MEGNO"),
            "mean_megno": ((), self.mean_megno, "1", "mean MEGNO of the whole run"),
            "n_steps": ((), self.n_steps, "1", "steps of the run"),
            "outcome": ((), self.outcome, "", "how the run ended"),
        }
        if self.finite_time is not None:
            told["finite_time"] = (("order",), self.finite_time, rate, "up to the trust horizon")
            error = self.finite_time_error
            told["finite_time_error"] = (("order",), error, rate, "of that, at most")
            told["trust_horizon"] = ((), self.trust_horizon, "s", "until when states are right")
        return dataset_of("Lyapunov", self.system, self.start, self.t, told, self.recipe)

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, ax: Any = None, language: str = "en") -> Any:
            """See `pendula.plot.running`."""

    def _check_all(self) -> None:
        have, all_of_them = self.exponents.shape[-1], len(self.system.components)
        if have != all_of_them:
            rule = "must be {wanted} for their sum and pairs, got {value}"
            raise ArgumentError("exponents", rule, wanted=all_of_them, value=have)

    def __repr__(self) -> str:
        return f"<Lyapunov of {self.system!r}: {self._told()}>"

    def _repr_html_(self) -> str:
        """What a notebook shows."""
        facts = [("system", repr(self.system)), ("exponents [1/s]", self._told())]
        return html_table("Lyapunov exponents", facts)

    def _told(self) -> str:
        if self.exponents.ndim > 1:
            return f"{len(self.exponents)} motions"
        pairs = zip(self.exponents, self.standard_error, strict=True)
        return ", ".join(f"{value:.4g} ± {error:.2g}" for value, error in pairs) + (
            f", {self.verdict}"
        )


@with_bar("exponents")
@takes_options(*OPTIONS, "certify")
def lyapunov(
    system: System,
    state: ArrayLike,
    t_max: float,
    *,
    exponents: int = 1,
    transient: float = 0.0,
    tangent: ArrayLike | None = None,
    t0: float = 0.0,
    threads: int | None = None,
    progress: AskedProgress = None,
    **options: Unpack[RunOptions],
) -> Lyapunov:
    """Lyapunov exponents: how fast neighbours part, ln(|δ(t)|/|δ(0)|)/t, with standard errors.

    δ is carried by the variational equations, in (θ…, ω…), rad and rad/s. Several exponents by
    orthogonal frames (Benettin et al. 1980, Meccanica 15, 9). The states have the bits of `solve`.

    Args:
        system: a pendulum.
        state: at t0, (d,), or n of them, (n, d) [rad, rad/s].
        t_max: length of the run after the transient [s].
        exponents: how many, the largest first.
        transient: time at the start that is left out [s].
        tangent: δ(0), (d,), or (k, d); None: (½, ½, ½, ½), or (1, 1)/√2, the others orthogonal.
        t0: time of the state [s].
        threads: None: one for each processor.
        progress: called with the part that is done, 0 to 1; True: a bar.
        **options: see `RunOptions`.

    Raises:
        ValueError: for an argument out of range.
    """
    import numpy as np

    report = checked_progress(progress)
    length, before = positive_number("t_max", t_max, "s"), _checked_transient(transient)
    elapsed = length * np.arange(1, _PARTS + 1) / _PARTS
    plan = Plan(exponents, tangent, before, threads)
    t = t0 + (before + elapsed)
    certify = options.pop("certify", None)
    asked = asked_of(system, state, plan.outputs(t0, t), t0, "lyapunov", **options)
    plan = replace(plan, count=whole_number("exponents", exponents, len(asked.system.components)))
    runs = part(report, 0.0, 0.1 if certify is not None else 1.0)
    growth, mean_megno, found = plan.growth(asked, runs)
    right = None
    if certify is not None:
        right = certified(asked, plan, certify, part(report, 0.1, 1.0))
    running = growth / elapsed[:, np.newaxis]
    errors = standard_errors(growth, length)
    how = {"t_max": length, "exponents": plan.count, "transient": before, "certify": certify}
    recipe = asked.recipe(tangent, **how)
    return _collected(asked, t, running, errors, mean_megno, right, found, recipe)


def _collected(
    asked: Asked,
    t: Array,
    running: Array,
    errors: Array,
    mean_megno: Array,
    right: Certified | None,
    found: VariedRuns,
    recipe: Mapping[str, Any],
) -> Lyapunov:
    """The result, for one motion or several as they were asked for."""
    shaped = asked.shaped
    return Lyapunov(
        asked.system,
        shaped(asked.starts),
        t,
        shaped(running[:, -1]),
        shaped(errors),
        shaped(running),
        shaped(verdict_of(mean_megno)),
        shaped(mean_megno),
        recipe["transient"],
        None if right is None else shaped(right.horizon),
        None if right is None else shaped(right.exponents),
        None if right is None else shaped(right.errors),
        shaped(found.n_steps),
        shaped(found.outcomes),
        recipe,
    )


def _checked_transient(transient: object) -> float:
    before = number("transient", transient, "s")
    if before < 0.0:
        raise ArgumentError("transient", "must be 0 or more [s], got {value}", value=before)
    return before
