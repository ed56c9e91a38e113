"""How much of an energy surface is chaotic."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY
from pendula._checks import (
    extra,
    finite_array,
    positive_number,
    whole_number,
)
from pendula._messages import ArgumentError
from pendula._progress import with_bar
from pendula._version import __version__
from pendula.chaos.energy_surface import check_double, checked_seed, energy_surface
from pendula.chaos.megno import megno
from pendula.chaos.verdict import verdict_of
from pendula.many.chunks import Axis, Variable, Work, run
from pendula.run.options import checked_types, takes_options

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path
    from typing import Unpack

    import numpy as np
    import xarray as xr
    from numpy.typing import ArrayLike, NDArray

    from pendula._progress import AskedProgress, Progress
    from pendula._types import Array
    from pendula.many.chunks import Chunk
    from pendula.run.options import RunOptions
    from pendula.systems import DoublePendulum

_MOST_STARTS = 10**6
_OPTIONS = "tolerance", "max_steps"
_CHUNK = 1024  # starts: a second or so of one processor


@with_bar("chaotic share")
@takes_options(*_OPTIONS)
def chaotic_share(
    system: DoublePendulum,
    energies: ArrayLike,
    *,
    n: int = 400,
    t_max: float = 400.0,
    seed: int = 0,
    store: str | Path | None = None,
    client: Any = None,
    threads: int | None = None,
    progress: AskedProgress = None,
    resume: bool = True,
    overwrite: bool = False,
    **options: Unpack[RunOptions],
) -> xr.Dataset:
    """The share of each energy surface that is chaotic, by the invariant measure (extra: io).

    Starts of `energy_surface` are run, and told by the verdict of `megno`. The surface of
    energy i is drawn with the seed (seed, i), so that no energy has the draws of another.

    Args:
        system: a double pendulum.
        energies: (k,) [J].
        n: starts on each surface.
        t_max: length of the runs [s].
        seed: of the draws, not negative.
        store: as for `flip_map`; it holds the mean MEGNO and the growth of every start.
        client: as for `flip_map`.
        threads: as for `flip_map`.
        progress: as for `flip_map`.
        resume: as for `flip_map`.
        overwrite: as for `flip_map`.
        **options: see `RunOptions`.

    Returns:
        Dim `energy`; `share` of the starts that are chaotic and its binomial `standard_error`,
        `undecided`, the share of those that the verdict leaves open, and `exponent`, the mean of
        the chaotic ones at t_max [1/s], NaN where there is none.

    Raises:
        ValueError: for another system, an argument out of range, or a store of something else.
    """
    import numpy as np

    check_double(system)
    levels = _checked_energies(energies)
    count = whole_number("n", n, _MOST_STARTS)
    length, first = positive_number("t_max", t_max, "s"), checked_seed(seed)
    chosen = checked_types(options, "chaotic_share", _OPTIONS)
    limits = {name: chosen[name] for name in _OPTIONS if name in chosen}
    told = {"n": count, "t_max": length, "seed": first, **limits}
    asked = _Starts(system, tuple(levels.tolist()), count, length, first, limits)
    how: dict[str, Any] = {"client": client, "progress": progress, "threads": threads}
    found = run(asked.work(told), store, **how, resume=resume, overwrite=overwrite)
    means, growths = found["megno"].values, found["growth"].values
    rows = [
        _told(verdict_of(mean), growth / length)
        for mean, growth in zip(means, growths, strict=True)
    ]
    return _dataset(system, levels, np.array(rows), told)


@dataclass(frozen=True)
class _Starts:
    """What computes the MEGNO of starts on the surfaces of several energies.

    Attributes:
        system: the double pendulum.
        energies: of the surfaces [J].
        n: starts on each.
        t_max: length of the runs [s].
        seed: of the draws.
        limits: tolerance and most steps of the runs.
    """

    system: DoublePendulum
    energies: tuple[float, ...]
    n: int
    t_max: float
    seed: int
    limits: Mapping[str, Any]

    def work(self, told: Mapping[str, Any]) -> Work:
        """All of them, one energy and some starts in a chunk."""
        import numpy as np

        meanings = {"megno": "mean MEGNO at t_max", "growth": "ln of the growth of a variation"}
        of_energy = {"units": "J", "long_name": "energy"}
        described = {KEY: __version__, "chaos": "share", "system": self.system.description()}
        return Work(
            inputs={**described, "energies": list(self.energies), **told},
            axes=(
                Axis("energy", len(self.energies), 1, np.array(self.energies), of_energy),
                Axis("start", self.n, _CHUNK),
            ),
            variables=tuple(
                Variable(name, ("energy", "start"), "float64", math.nan, {"long_name": meaning})
                for name, meaning in meanings.items()
            ),
            compute=self,
            attrs={"title": "Starts on energy surfaces", "t_max": self.t_max},
        )

    def __call__(
        self, chunk: Chunk, threads: int | None, progress: Progress
    ) -> dict[str, NDArray[np.generic]]:
        """Mean MEGNO and growth of the starts of a chunk, (1, starts)."""
        i, (low, high) = chunk.spans["energy"][0], chunk.spans["start"]
        drawn = energy_surface(self.system, self.energies[i], high, seed_of(self.seed, i))
        runs = megno(
            self.system,
            drawn[low:],
            [self.t_max],
            threads=threads,
            progress=progress,
            **self.limits,
        )
        return {"megno": runs.mean.T, "growth": runs.growth.T}


def seed_of(seed: int, i: int) -> int:
    """The seed of an energy's draw, from the caller's and the place of the energy."""
    import numpy as np

    return int(np.random.SeedSequence([seed, i]).generate_state(1, np.uint64)[0] >> 11)


def _told(verdicts: Any, exponents: Array) -> tuple[float, float, float, float]:
    """Share, its standard error, undecided, mean exponent of the chaotic ones."""
    chaotic = verdicts == "chaotic"
    share = float(chaotic.mean())
    error = math.sqrt(share * (1.0 - share) / chaotic.size)
    mean = float(exponents[chaotic].mean()) if chaotic.any() else math.nan
    return share, error, float((verdicts == "undecided").mean()), mean


def _dataset(
    system: DoublePendulum, energies: Array, rows: Array, recipe: dict[str, Any]
) -> xr.Dataset:
    """The rows (k, 4) over energy, with what they were made from."""
    names = {
        "share": ("1", "share of the energy surface that is chaotic"),
        "standard_error": ("1", "binomial standard error of the share"),
        "undecided": ("1", "share of the starts that are undecided"),
        "exponent": ("1/s", "mean Lyapunov exponent of the chaotic starts"),
    }
    data = {
        name: ("energy", rows[:, i], {"units": units, "long_name": meaning})
        for i, (name, (units, meaning)) in enumerate(names.items())
    }
    described = {KEY: __version__, "system": system.description(), "chaotic_share": recipe}
    made: xr.Dataset = extra("xarray", "io").Dataset(
        data,
        coords={"energy": ("energy", energies, {"units": "J", "long_name": "energy"})},
        attrs={"title": "Chaotic share of energy surfaces", KEY: json.dumps(described)},
    )
    return made


def _checked_energies(energies: ArrayLike) -> Array:
    """The energies, (k,)."""
    import numpy as np

    levels = np.atleast_1d(finite_array("energies", energies, "J"))
    if levels.ndim != 1 or levels.size == 0:
        raise ArgumentError("energies", "must have shape (k,), got {value}", value=levels.shape)
    for energy in levels.tolist():
        positive_number("energies", energy, "J")
    return levels
