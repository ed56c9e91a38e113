"""How much of an energy surface is chaotic."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY
from pendula._checks import (
    checked_progress,
    extra,
    finite_array,
    positive_number,
    whole_number,
)
from pendula._messages import ArgumentError
from pendula._progress import part, with_bar
from pendula._version import __version__
from pendula.chaos.energy_surface import check_double, checked_seed, energy_surface
from pendula.chaos.megno import megno
from pendula.run.options import takes_options

if TYPE_CHECKING:
    from typing import Unpack

    import xarray as xr
    from numpy.typing import ArrayLike

    from pendula._progress import AskedProgress
    from pendula._types import Array
    from pendula.run.options import RunOptions
    from pendula.systems import DoublePendulum

_MOST_STARTS = 10**6
_OPTIONS = "tolerance", "max_steps"


@with_bar("chaotic share")
@takes_options(*_OPTIONS)
def chaotic_share(
    system: DoublePendulum,
    energies: ArrayLike,
    *,
    n: int = 400,
    t_max: float = 400.0,
    seed: int = 0,
    threads: int | None = None,
    progress: AskedProgress = None,
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
        threads: None: one for each processor; the bits do not depend on it.
        progress: called with the part that is done, 0 to 1; True: a bar.
        **options: see `RunOptions`.

    Returns:
        Dim `energy`; `share` of the starts that are chaotic and its binomial `standard_error`,
        `undecided`, the share of those that the verdict leaves open, and `exponent`, the mean of
        the chaotic ones at t_max [1/s], NaN where there is none.

    Raises:
        ValueError: for another system, or an argument out of range.
    """
    import numpy as np

    check_double(system)
    levels = _checked_energies(energies)
    count = whole_number("n", n, _MOST_STARTS)
    length, first = positive_number("t_max", t_max, "s"), checked_seed(seed)
    report = checked_progress(progress)
    rows = []
    for i, energy in enumerate(levels.tolist()):
        starts = energy_surface(system, energy, count, seed_of(first, i))
        done = part(report, i / levels.size, (i + 1) / levels.size)
        found = megno(system, starts, [length], threads=threads, progress=done, **options)
        rows.append(_told(found.verdict, found.growth[:, 0] / length))
    recipe = {"n": count, "t_max": length, "seed": first, **options}
    return _dataset(system, levels, np.array(rows), recipe)


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
