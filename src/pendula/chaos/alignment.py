"""SALI and GALI: how small changes of a motion turn into the same direction."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula._checks import checked_progress, whole_number
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula._progress import with_bar
from pendula.chaos.datasets import dataset_of
from pendula.chaos.variations import OPTIONS, Asked, VariedRuns, asked_of, first_variations
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

ALIGNED = 1e-8  # below, directions are one: chaos, where they turn exponentially fast


@with_promised
@dataclass(frozen=True, eq=False)
class Alignment:
    """SALI or GALI of one motion, or of n motions (then with a first axis n).

    Attributes:
        system: the pendulum.
        start: the state at t0, (d,) [rad, rad/s].
        t: times (m,) [s].
        value: of the indicator, (m,).
        count: of the directions: 2 for SALI.
        aligned: the first of the times at which the value is below 1e-8; inf: none [s].
        n_steps: taken.
        outcome: how the run ended.
        reached: the time up to which the run was made [s].
        recipe: the arguments that it was made with, beside system, start and times.
    """

    system: System
    start: Array
    t: Array
    value: Array
    count: int
    aligned: Any
    n_steps: Any
    outcome: Any
    reached: Any
    recipe: Mapping[str, Any] = field(default_factory=dict)

    def to_xarray(self) -> xr.Dataset:
        """The indicator over time (extra: io)."""
        told: dict[str, Any] = {
            "value": (("t",), self.value, "1", f"alignment of {self.count} directions"),
            "aligned": ((), self.aligned, "s", f"first time below {ALIGNED:g}"),
            "n_steps": ((), self.n_steps, "1", "steps of the run"),
            "outcome": ((), self.outcome, "", "how the run ended"),
        }
        return dataset_of("Alignment", self.system, self.start, self.t, told, self.recipe)

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, ax: Any = None, language: str = "en") -> Any:
            """See `pendula.plot.running`."""

    def __repr__(self) -> str:
        end = f"{self.value[-1]:.3g}" if self.value.ndim == 1 else f"{len(self.value)} motions"
        return f"<Alignment of {self.count} directions, {self.system!r}: {end} at {self.t[-1]:g} s>"


@with_bar("SALI")
@takes_options(*OPTIONS)
def sali(
    system: System,
    state: ArrayLike,
    t: ArrayLike,
    *,
    tangents: ArrayLike | None = None,
    t0: float = 0.0,
    threads: int | None = None,
    progress: AskedProgress = None,
    **options: Unpack[RunOptions],
) -> Alignment:
    """The smaller alignment index, min |v1 ± v2| of two unit variations (Skokos 2001).

    J. Phys. A 34, 10029. It falls as exp(−(λ1 − λ2) t) in chaos, and keeps about its size on a
    torus of two dimensions. Variations in (θ…, ω…), rad and rad/s.

    Args:
        system: a pendulum.
        state: at t0, (d,), or n of them, (n, d) [rad, rad/s].
        t: a time or times (m,), rising or falling from t0 [s].
        tangents: the two at t0, (2, d); None: (½, ½, ½, ½) and (½, −½, ½, −½), over √2 for one bob.
        t0: time of the state [s].
        threads: None: one for each processor.
        progress: called with the part that is done, 0 to 1; True: a bar.
        **options: see `RunOptions`.

    Raises:
        ValueError: for an argument out of range.
    """
    asked = asked_of(system, state, t, t0, "sali", **options)
    given = first_variations(asked.system, tangents, 2, "tangents")
    runs = asked.runs(given, "free", threads, checked_progress(progress))
    return _alignment(asked, runs, sali_of(runs.directions), 2, asked.recipe(tangents))


@with_bar("GALI")
@takes_options(*OPTIONS)
def gali(
    system: System,
    state: ArrayLike,
    t: ArrayLike,
    k: int = 2,
    *,
    tangents: ArrayLike | None = None,
    t0: float = 0.0,
    threads: int | None = None,
    progress: AskedProgress = None,
    **options: Unpack[RunOptions],
) -> Alignment:
    """The generalised alignment index, the volume of k unit variations (Skokos et al. 2007).

    Physica D 231, 30: the product of the singular values of their matrix.

    Args:
        system: a pendulum.
        state: at t0, (d,), or n of them, (n, d) [rad, rad/s].
        t: a time or times (m,), rising or falling from t0 [s].
        k: how many directions, 2 to d.
        tangents: those at t0, (k, d); None: as for `sali`, and orthogonal ones.
        t0: time of the state [s].
        threads: None: one for each processor.
        progress: called with the part that is done, 0 to 1; True: a bar.
        **options: see `RunOptions`.

    Raises:
        ValueError: for an argument out of range.
    """
    asked = asked_of(system, state, t, t0, "gali", **options)
    count = whole_number("k", k, len(asked.system.components))
    if count < 2:
        raise ArgumentError("k", "must be 2 directions or more, got {value}", value=count)
    given = first_variations(asked.system, tangents, count, "tangents")
    runs = asked.runs(given, "free", threads, checked_progress(progress))
    return _alignment(asked, runs, gali_of(runs.directions), count, asked.recipe(tangents, k=count))


def sali_of(directions: Array) -> Array:
    """SALI of two variations (..., 2, d)."""
    import numpy as np

    first, second = np.moveaxis(_units(directions), -2, 0)
    both = [np.linalg.norm(first + sign * second, axis=-1) for sign in (1.0, -1.0)]
    smaller: Array = np.minimum(*both)
    return smaller


def gali_of(directions: Array) -> Array:
    """GALI of k variations (..., k, d)."""
    import numpy as np

    units = _units(directions)
    known = np.asarray(np.isfinite(units).all(axis=(-2, -1)))
    values = np.linalg.svd(np.where(known[..., np.newaxis, np.newaxis], units, 0.0))[1]
    volume: Array = np.where(known, values.prod(axis=-1), math.nan)
    return volume


def _units(directions: Array) -> Array:
    import numpy as np

    units: Array = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    return units


def _alignment(
    asked: Asked, runs: VariedRuns, value: Array, count: int, recipe: Mapping[str, Any]
) -> Alignment:
    import numpy as np

    below = np.argmax(np.asarray(value) < ALIGNED, axis=1)  # 0, too, where none is
    rows = np.arange(len(value))
    aligned = np.where(value[rows, below] < ALIGNED, runs.t[below], math.inf)
    shaped = asked.shaped
    return Alignment(
        asked.system,
        shaped(asked.starts),
        runs.t,
        shaped(value),
        count,
        shaped(aligned),
        shaped(runs.n_steps),
        shaped(runs.outcomes),
        shaped(runs.reached),
        recipe,
    )
