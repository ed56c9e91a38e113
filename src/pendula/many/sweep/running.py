"""Runs a sweep: into memory, a Zarr store or a Parquet file."""

from __future__ import annotations

import os
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

from pendula._checks import check_threads, checked_progress
from pendula._messages import ArgumentError
from pendula._progress import with_bar
from pendula.many.chunks import run
from pendula.many.chunks.cluster import check_client
from pendula.many.chunks.places import checked_name
from pendula.many.sweep.reading import read_sweep
from pendula.many.sweep.recipe import SweepRecipe
from pendula.many.sweep.rows import work_of

if TYPE_CHECKING:
    import xarray as xr

    from pendula._progress import AskedProgress, Progress
    from pendula._recipe_file import RecipeSource

ENDINGS = (".zarr", ".parquet")


@with_bar("sweep")
def sweep(
    recipe: RecipeSource | SweepRecipe,
    store: str | os.PathLike[str] | None = None,
    *,
    client: Any = None,
    threads: int | None = None,
    progress: AskedProgress = None,
    resume: bool = True,
    overwrite: bool = False,
) -> xr.Dataset:
    """The trajectories of many systems, from many starts, that a recipe describes.

    Each row has the bits that `solve` gives it alone, whatever the threads, chunks or workers. What
    goes wrong with one is said by its outcome: its numbers are NaN from there on.

    Args:
        recipe: a TOML file, a dict of its tables, or what `pendula.sweeping.read_sweep` made of it.
        store: where to write, chunk by chunk, so that the sweep may be larger than memory: a path
            or URL ending in .zarr, a store with which the same call goes on after it was stopped;
            or a path ending in .parquet, a file that is there once all of it is written, and
            is not resumable. None: in memory.
        client: of a Dask cluster that computes the chunks.
        threads: None: one for each processor; on a cluster one for each task.
        progress: called with the part that is done, 0 to 1; True: a bar, in a notebook or a
            terminal.
        resume: resume an existing store, also one of the same recipe with fewer draws: its rows
            stay, those of the other draws follow; else it is refused.
        overwrite: overwrite an existing one.

    Returns:
        Dims (row, t). For each row the parameters of its system, by name, its start (`theta1_start`
        …), `outcome`, `n_steps`, `reached` [s], and `trust_horizon` [s] if the recipe asks for it;
        over (row, t) the state (`theta1` …) [rad, rad/s] and the `energy` [J], and on request the
        positions (`x1` …) [m] and the state's rates of change (`dtheta1_dt` …). Of a store it is
        read when it is used; of a Parquet file it has only what each row has once.

    Raises:
        ValueError: for a broken recipe, a store of another recipe, or another ending.
        FileExistsError: where a file is there, or what is no store.
        OSError: where the recipe cannot be read, or the store not be written.
    """
    report: Progress = checked_progress(progress)
    chosen = recipe if isinstance(recipe, SweepRecipe) else read_sweep(recipe)
    work = work_of(chosen)
    place: dict[str, Any] = {"client": client, "threads": threads, "progress": report}
    if store is None or ending_of(store) == ".zarr":
        return run(work, store, **place, resume=resume, overwrite=overwrite)
    from pendula.many.sweep.parquet import write_parquet

    check_threads(threads)
    if client is not None:
        check_client(client)
    return write_parquet(work, os.fspath(store), **place, overwrite=overwrite)


def ending_of(store: str | os.PathLike[str]) -> str:
    """What a sweep is written as: ".zarr" or ".parquet".

    Raises:
        ValueError: for another ending, or a Parquet file that is not on this machine.
    """
    text = checked_name(store)
    ending = PurePath(text).suffix.lower()
    if ending not in ENDINGS:
        rule = "must end in {any_of}, got {value}"
        raise ArgumentError("store", rule, any_of=ENDINGS, value=text)
    if ending == ".parquet" and "://" in text:
        rule = "must be a path to write Parquet, got {value}"
        raise ArgumentError("store", rule, "use .zarr for URLs", value=text)
    return ending
