"""Trajectories to tables and files and back; each file describes its run, version and outcome."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from pendula._checks import MissingExtraError, installed, one_of
from pendula._late_methods import method_of
from pendula._messages import one_line
from pendula._writing import refuse_existing, replacing
from pendula.io import files
from pendula.io.attributes import NotATrajectoryError, from_attributes
from pendula.io.ends import check_ends
from pendula.io.tables import to_pandas, to_xarray
from pendula.io.whole import UncheckedFileWarning, Whole, recipe_of, warn_unchecked
from pendula.run.trajectory import Trajectory

if TYPE_CHECKING:
    from os import PathLike

    from pendula._types import MethodName

__all__ = [
    "NotATrajectoryError",
    "UncheckedFileWarning",
    "check_target",
    "load",
    "rerun",
    "save",
    "to_pandas",
    "to_xarray",
]


@method_of(Trajectory)
def save(trajectory: Trajectory, path: str | PathLike[str], *, overwrite: bool = False) -> None:
    """Write a trajectory; the name's ending chooses: .csv, .nc, .parquet or .zarr.

    It is written beside the path and moved there when it is complete.

    Raises:
        ValueError: for another ending.
        FileExistsError: where the path exists and `overwrite` is not set.
        OSError: where the path cannot be written.
    """
    target = Path(path)
    write, _ = files.FORMATS[_ending(target)]
    with replacing(target, overwrite=overwrite) as unfinished:
        write(trajectory, unfinished)


def check_target(path: str | PathLike[str], *, overwrite: bool = False) -> None:
    """Refuse, before a long run, a path that `save` could not write.

    Raises:
        ValueError, FileExistsError, OSError: as for `save`.
        MissingExtraError: where the format's packages are not installed.
    """
    target = Path(path)
    for package in files.packages(_ending(target)):
        installed(package, "io")
    refuse_existing(target, overwrite=overwrite)


def load(path: str | PathLike[str]) -> Any:
    """Read what `save` wrote, if it is all there: counts and checksums are compared.

    A file of an earlier version, without checksums, is read with an `UncheckedFileWarning`.

    Returns:
        What was saved: a `Trajectory`, or of `pendula.measured` a `Measurement`, a `PeriodTable`, a
        `Fit` or a `PeriodFit`.

    Raises:
        ValueError: for another ending, a file that pendula did not write, or a damaged one: a line
            that names the file and what does not fit.
        FileNotFoundError: where there is no such file.
    """
    source = Path(path)
    found, known = _loaded(source)
    warn_unchecked(known, source)
    return found


def rerun(path: str | PathLike[str]) -> Any:
    """Make again what is saved, from its own attributes alone; the same numbers bit for bit.

    Returns:
        The trajectory run again, the fit fitted again, on the same machine with the same bits, or
        the recording read again, from the file it was read from.

    Raises:
        ValueError, FileNotFoundError: as for `load`.
    """
    source = Path(path)
    old, known = _loaded(source)
    warn_unchecked(known, source)
    if isinstance(old, Trajectory):
        return _run_again(old, source)
    from pendula.io import measured

    try:
        return measured.again(old, source)
    except NotATrajectoryError:
        raise
    except ValueError as error:
        raise NotATrajectoryError(f"{source} cannot be run again: {one_line(error)}") from error


def _run_again(old: Trajectory, source: Path) -> Trajectory:
    from pendula.run.exact import exact
    from pendula.run.solve import solve

    asked, derived_by = old.request, old.derivative_names or None
    try:
        if old.method == "exact":
            return exact(old.system, asked.state, old.t, t0=asked.t0, derivatives=derived_by)
        method = cast("MethodName", old.method)
        return solve(
            old.system,
            asked.state,
            asked.t,
            method,
            t0=asked.t0,
            derivatives=derived_by,
            **asked.options,
        )
    except ValueError as error:
        raise NotATrajectoryError(f"{source} cannot be run again: {one_line(error)}") from error


def _loaded(source: Path) -> tuple[Any, dict[str, Any]]:
    """What was saved, and its recipe."""
    is_json = source.suffix.lower() == ".json"
    read = None if is_json else files.FORMATS[_ending(source)][1]
    if not source.exists():
        raise FileNotFoundError(f"no such file: {source}")
    try:
        if read is None:
            from pendula.io import measured

            return measured.load_json(source), {"checksum": ""}
        with read(source) as stored:
            told = _measured(stored.recipe)
            if told is not None:
                from pendula.io import measured

                return measured.from_stored(told, stored, source), {"checksum": ""}
            known = recipe_of(stored, source)
            table = Whole(known, stored, source).table()
        run = from_attributes(known, *table, source)
        if "checksum" not in known:
            check_ends(run, source)
        return run, known
    except (MissingExtraError, NotATrajectoryError):
        raise
    except Exception as error:  # the formats' libraries raise whatever they like
        raise NotATrajectoryError(
            f"{source} cannot be read as a trajectory of pendula: {one_line(error)}"
        ) from error


def _measured(recipe: str) -> dict[str, Any] | None:
    """The recipe of a recording or a fit; None: of something else."""
    try:
        known = json.loads(recipe)
    except (RecursionError, ValueError):
        return None
    return known if isinstance(known, dict) and "measured" in known else None


def _ending(path: Path) -> str:
    try:
        return one_of("ending", path.suffix.lower(), files.FORMATS)
    except ValueError:
        raise ValueError(
            f"the file name must end in {', '.join(files.FORMATS)}, got {path.name!r}"
        ) from None
