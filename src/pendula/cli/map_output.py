"""What `pendula map` writes: a file, a picture, a summary."""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pendula.cli.map_picture import checked_map_picture, draw_map
from pendula.cli.pictures import ENDINGS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import xarray as xr

_BAND = 256  # rows read at once, where a store does not say how many


def check_targets(given: dict[str, Any]) -> tuple[str | None, Path | None]:
    """The file and the picture; refuses before long work what cannot be written.

    Raises:
        ValueError: for an unknown ending.
        OSError: where one cannot be written, or exists without --force.
    """
    from pendula._checks import installed
    from pendula._writing import refuse_existing

    out = given["out"]
    installed("xarray", "io")
    ending = None if out is None else Path(out).suffix
    if ending not in (None, ".zarr", ".nc"):
        hint = f"; for a picture name --picture {out}" if ending in ENDINGS else ""
        raise ValueError(f"--output must end in .zarr or .nc, got {Path(out).name!r}{hint}")
    if given["resume"] and ending != ".zarr":
        raise click.UsageError("--resume needs a .zarr store: -o map.zarr")
    if ending == ".nc":
        installed("h5netcdf", "io")
        refuse_existing(Path(out), overwrite=given["force"])
    return out, checked_map_picture(given)


def write(found: xr.Dataset, out: str | None, picture: Path | None, given: dict[str, Any]) -> None:
    """Draw first, so that a picture that fails leaves no file behind; a store is there already."""
    from pendula._writing import replacing

    if picture is not None:
        draw_map(found, picture, given)
    if out is not None:
        with replacing(Path(out), overwrite=given["force"]) as unfinished:
            found.to_netcdf(unfinished, engine="h5netcdf")


def summary(found: xr.Dataset) -> str:
    """A summary of all cells, read in bands: a store may be larger than memory."""
    variable = next(name for name in _NUMBERS if name in found)
    sizes = " x ".join(str(found.sizes[name]) for name in found[variable].dims)
    return f"{sizes} cells; {_NUMBERS[variable](found)}"


def _bands(found: xr.Dataset) -> Iterator[xr.Dataset]:
    first = next(iter(found.data_vars.values()))
    axis = str(first.dims[0])
    step = first.encoding.get("preferred_chunks", {}).get(axis, _BAND)
    for start in range(0, found.sizes[axis], step):
        yield found.isel({axis: slice(start, start + step)}).load()


def _of_flips(found: xr.Dataset) -> str:
    flipped = forbidden = unresolved = 0
    earliest = math.inf
    for band in _bands(found):
        flipped += int((band["flipped_rod"] > 0).sum())
        forbidden += int(band["forbidden"].sum())
        earliest = min(earliest, float(band["flip_time"].min().fillna(math.inf)))
        if "resolved" in band:
            unresolved += int((~band["resolved"]).sum())
    cells = found["flip_time"].size
    counts = {"flipped": flipped, "forbidden": forbidden}
    counts[f"neither until {found.attrs['t_max']:g} s"] = cells - flipped - forbidden
    if "resolved" in found:
        counts["not verified"] = unresolved
    shares = ", ".join(f"{count / cells:.1%} {name}" for name, count in counts.items())
    return shares + (f"; earliest flip after {earliest:.6g} s" if flipped else "")


def _of_divergence(found: xr.Dataset) -> str:
    import numpy as np

    low, high, total, count = math.inf, -math.inf, 0.0, 0
    for band in _bands(found):
        with np.errstate(divide="ignore"):
            logarithms = np.log(band["growth"].values) / found.attrs["t_max"]
        known = logarithms[np.isfinite(logarithms)]
        if known.size:
            low, high = min(low, float(known.min())), max(high, float(known.max()))
            total, count = total + float(known.sum()), count + known.size
    if count == 0:
        return "the rate of divergence is unknown in every cell"
    unknown = found["growth"].size - count
    rates = f"mean rate of divergence {low:.3g} to {high:.3g} 1/s, {total / count:.3g} on average"
    return rates + (f"; {unknown} unknown" if unknown else "")


def _of_indicator(name: str, found: xr.Dataset) -> str:
    """The range and mean of an indicator, and of MEGNO the verdicts; where nothing could start."""
    import numpy as np

    from pendula.chaos.verdict import verdict_of

    low, high, total, count, forbidden = math.inf, -math.inf, 0.0, 0, 0
    told = dict.fromkeys(_VERDICTS, 0)
    for band in _bands(found):
        known = band[name].values[np.isfinite(band[name].values)]
        forbidden += int(band["forbidden"].sum()) if "forbidden" in band else 0
        if known.size:
            low, high = min(low, float(known.min())), max(high, float(known.max()))
            total, count = total + float(known.sum()), count + known.size
            verdicts = verdict_of(known)
            told = {each: n + int((verdicts == each).sum()) for each, n in told.items()}
    unit, cells = " 1/s" if name == "lyapunov" else "", found[name].size
    if count == 0:
        why = "the energy reaches no" if forbidden == cells else f"{name} is unknown in every"
        return f"{why} cell"
    parts = [f"{name} {low:.3g} to {high:.3g}{unit}, {total / count:.3g} on average"]
    if name == "megno":
        parts.append(", ".join(f"{n / count:.1%} {each}" for each, n in told.items()))
    parts += [f"{forbidden / cells:.1%} of the cells beyond the energy"] if forbidden else []
    unknown = cells - count - forbidden
    return "; ".join([*parts, *([f"{unknown} unknown"] if unknown else [])])


_VERDICTS = ("chaotic", "regular", "undecided")
_NUMBERS: dict[str, Callable[[xr.Dataset], str]] = {
    "flip_time": _of_flips,
    "growth": _of_divergence,
    **{name: partial(_of_indicator, name) for name in ("megno", "lyapunov", "sali")},
}
