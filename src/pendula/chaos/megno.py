"""MEGNO: the mean exponential growth of nearby orbits (Cincotta & Simó 2000)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula._checks import checked_progress
from pendula._late_methods import with_promised
from pendula._progress import with_bar
from pendula.chaos.datasets import dataset_of
from pendula.chaos.variations import OPTIONS, asked_of, first_variations
from pendula.chaos.verdict import verdict_of
from pendula.run.options import takes_options

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Unpack

    import xarray as xr
    from numpy.typing import ArrayLike

    from pendula._progress import AskedProgress
    from pendula._types import Array
    from pendula.run.options import RunOptions
    from pendula.systems import System


@with_promised
@dataclass(frozen=True, eq=False)
class Megno:
    """MEGNO of one motion, or of n motions (then with a first axis n).

    Attributes:
        system: the pendulum.
        start: the state at t0, (d,) [rad, rad/s].
        t: times (m,) [s].
        t0: time of the start [s].
        megno: Y(t), (m,).
        mean: ⟨Y⟩(t), (m,): it tends to 2 on a torus, and grows as λt/2 in chaos.
        growth: ln(|δ(t)|/|δ(0)|), (m,).
        states: (m, d) [rad, rad/s].
        n_steps: taken.
        outcome: how the run ended.
        recipe: the arguments that it was made with, beside system, start and times.
    """

    system: System
    start: Array
    t: Array
    t0: float
    megno: Array
    mean: Array
    growth: Array
    states: Array
    n_steps: Any
    outcome: Any
    recipe: Mapping[str, Any] = field(default_factory=dict)

    @property
    def rate(self) -> Array:
        """2⟨Y⟩/t, which tends to the largest exponent in chaos, (m,) [1/s]."""
        return 2.0 * self.mean / (self.t - self.t0)

    @property
    def verdict(self) -> Any:
        """By the last mean: "chaotic", "regular" or "undecided"."""
        return verdict_of(self.mean[..., -1])

    def to_xarray(self) -> xr.Dataset:
        """MEGNO, its mean and the growth over time (extra: io)."""
        told: dict[str, Any] = {
            "megno": (("t",), self.megno, "1", "MEGNO"),
            "mean": (("t",), self.mean, "1", "mean MEGNO"),
            "growth": (("t",), self.growth, "1", "ln of the growth of a variation"),
            "verdict": ((), self.verdict, "", "by the last mean"),
            "n_steps": ((), self.n_steps, "1", "steps of the run"),
            "outcome": ((), self.outcome, "", "how the run ended"),
        }
        return dataset_of("Megno", self.system, self.start, self.t, told, self.recipe)

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, ax: Any = None, language: str = "en") -> Any:
            """See `pendula.plot.running`."""

    def __repr__(self) -> str:
        end = f"⟨Y⟩ = {self.mean[-1]:.4g}" if self.mean.ndim == 1 else f"{len(self.mean)} motions"
        return f"<Megno of {self.system!r}: {end} at {self.t[-1]:g} s>"


@with_bar("MEGNO")
@takes_options(*OPTIONS)
def megno(
    system: System,
    state: ArrayLike,
    t: ArrayLike,
    *,
    tangent: ArrayLike | None = None,
    t0: float = 0.0,
    threads: int | None = None,
    progress: AskedProgress = None,
    **options: Unpack[RunOptions],
) -> Megno:
    """MEGNO Y(t) = (2/t) ∫ (δ̇·δ/δ·δ) s ds and its mean (Cincotta & Simó 2000, eqs. 19 and 21).

    With δ in (θ…, ω…), rad and rad/s, and L = ln|δ|: Y = 2 (L − ∫L ds/t), by Gauss's formula with
    eight nodes inside each step. The states have the bits of `solve`.

    Args:
        system: a pendulum.
        state: at t0, (d,), or n of them, (n, d) [rad, rad/s].
        t: a time or times (m,), rising or falling from t0 [s].
        tangent: δ(0), (d,); None: (½, ½, ½, ½), or (1, 1)/√2.
        t0: time of the state [s].
        threads: None: one for each processor.
        progress: called with the part that is done, 0 to 1; True: a bar.
        **options: see `RunOptions`.

    Raises:
        ValueError: for an argument out of range.
    """
    import numpy as np

    asked = asked_of(system, state, t, t0, "megno", **options)
    given = first_variations(asked.system, tangent, 1, "tangent")
    runs = asked.runs(given, "megno", threads, checked_progress(progress))
    assert runs.integrals is not None
    elapsed = runs.t - asked.t0
    growth = runs.growth[..., 0]
    with np.errstate(invalid="ignore"):  # at t0 itself, where both are 0
        of_growth, mean = (runs.integrals[..., i] / elapsed for i in (0, 1))
        at_start = elapsed == 0.0
    shaped = asked.shaped
    return Megno(
        asked.system,
        shaped(asked.starts),
        runs.t,
        asked.t0,
        shaped(np.where(at_start, 0.0, 2.0 * (growth - of_growth))),
        shaped(np.where(at_start, 0.0, mean)),
        shaped(growth),
        shaped(runs.states),
        shaped(runs.n_steps),
        shaped(runs.outcomes),
        asked.recipe(tangent),
    )
