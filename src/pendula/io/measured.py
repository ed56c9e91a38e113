"""Recordings and fits to files and back, with their recipe: JSON and NetCDF."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY
from pendula._checks import extra, one_of
from pendula._late_methods import method_of
from pendula._messages import one_line
from pendula._version import __version__
from pendula._writing import replacing
from pendula.io.attributes import NotATrajectoryError
from pendula.io.checksums import of_column, of_recipe
from pendula.io.measured_tables import to_pandas, to_xarray
from pendula.io.measured_tree import Decoder, Encoder
from pendula.io.netcdf import write_sealed
from pendula.io.whole import damaged
from pendula.measured.compare import Comparison, compare_models
from pendula.measured.fit import fit
from pendula.measured.fitted import Fit
from pendula.measured.measurement import Measurement, PeriodTable
from pendula.measured.period_corrections import Apparatus
from pendula.measured.periods import PeriodFit, fit_periods
from pendula.measured.reading import read
from pendula.measured.storable import Storable
from pendula.systems import system_from

if TYPE_CHECKING:
    from os import PathLike

    from pendula._types import Array
    from pendula.io.whole import Stored

__all__ = ["again", "from_stored", "load_json", "save", "to_pandas", "to_xarray"]

MEASURED = "measured"  # key of what a file says it holds, by the name of its class


@method_of(Storable)
def save(measured: Storable, path: str | PathLike[str], *, overwrite: bool = False) -> None:
    """Write a recording, a table of periods, a fit or a comparison of models, as .json or .nc.

    The name's ending chooses. `pendula.load` gives the same back, bit for bit, and `pendula.rerun`
    fits, or reads, again.

    Raises:
        ValueError: for another ending.
        FileExistsError: where the path exists and `overwrite` is not set.
        OSError: where the path cannot be written.
    """
    target = Path(path)
    write = _WRITERS[_ending(target)]
    encoder = Encoder()
    content = encoder.data(measured)
    known = {"pendula": __version__, MEASURED: type(measured).__name__, "content": content}
    with replacing(target, overwrite=overwrite) as unfinished:
        write(known, encoder, unfinished)


def load_json(source: Path) -> Storable:
    """What a file of JSON holds.

    Raises:
        ValueError: for a file that pendula did not write, or a damaged one.
    """
    try:
        known = json.loads(source.read_text(encoding="utf-8"))
        checksum = known.pop("checksum")
        arrays, kind = known["arrays"], known[MEASURED]
    except (AttributeError, KeyError, RecursionError, TypeError, ValueError) as error:
        raise NotATrajectoryError(
            f"{source} holds no recording or fit that pendula saved: {one_line(error)}"
        ) from None
    if of_recipe(known) != checksum:
        raise damaged(source, "it does not fit its checksum")
    return _decoded(known, {name: _array(each) for name, each in arrays.items()}, kind, source)


def from_stored(known: dict[str, Any], stored: Stored, source: Path) -> Storable:
    """What an open file of NetCDF holds.

    Raises:
        ValueError: where it is damaged.
    """
    import numpy as np

    checksum, sums = known.pop("checksum", None), known.get("columns", {})
    if of_recipe(known) != checksum:
        raise damaged(source, "its recipe does not fit the recipe's checksum")
    labels = {label.rpartition(" [")[0]: label for label in stored.shapes}
    arrays = {}
    for name, wanted in sums.items():
        if name not in labels:
            raise damaged(source, f"the variable {name} is missing")
        arrays[name] = np.asarray(stored.column(labels[name]), dtype=np.float64)
        if of_column(arrays[name]) != wanted:
            raise damaged(source, f"{name} does not fit its checksum")
    return _decoded(known, arrays, str(known[MEASURED]), source)


def again(measured: Storable, source: Path) -> Storable:
    """A saved fit or comparison made again by its recipe, or a recording read again from its file.

    Raises:
        ValueError: where the recording's file is another now, or was none.
        FileNotFoundError: where it is not there.
    """
    if isinstance(measured, Fit):
        return _fitted_again(measured)
    if isinstance(measured, Comparison):
        recordings = [each.measurement for each in measured.best.recordings]
        return compare_models(recordings, **measured.recipe)
    if isinstance(measured, PeriodFit):
        known = dict(measured.recipe)
        apparatus = known.pop("apparatus")
        return fit_periods(measured.table, apparatus=apparatus and Apparatus(**apparatus), **known)
    assert isinstance(measured, Measurement | PeriodTable)
    if not measured.source:
        raise NotATrajectoryError(f"{source} cannot be run again: its recording is of no file")
    found = read(measured.source, **measured.reading)
    if found.checksum != measured.checksum:
        raise NotATrajectoryError(
            f"{source} cannot be run again: {measured.source} is not the file it was read from"
        )
    return found


def _fitted_again(measured: Fit) -> Fit:
    """The fit of its recordings; those of a double pendulum are windows of one."""
    asked = dict(measured.recipe)
    system = asked.pop("system")
    windows = measured.measurement.bodies == 2
    recordings = [each.measurement for each in measured.recordings[: 1 if windows else None]]
    given = system_from(system) if isinstance(system, dict) else system
    return fit(recordings, given, **asked)


def _ending(path: Path) -> str:
    try:
        return one_of("ending", path.suffix.lower(), _WRITERS)
    except ValueError:
        raise ValueError(
            f"the file name must end in {', '.join(_WRITERS)}, got {path.name!r}"
        ) from None


def _write_json(known: dict[str, Any], encoder: Encoder, path: Path) -> None:
    arrays = {name: _listed(each) for name, (_, each) in encoder.arrays.items()}
    whole = {**known, "arrays": arrays}
    whole["checksum"] = of_recipe(whole)
    path.write_text(json.dumps(whole, allow_nan=False) + "\n", encoding="utf-8")


def _write_netcdf(known: dict[str, Any], encoder: Encoder, path: Path) -> None:
    xarray = extra("xarray", "io")
    whole = {
        **known,
        "columns": {name: of_column(each) for name, (_, each) in encoder.arrays.items()},
    }
    whole["checksum"] = of_recipe(whole)
    attributes = {KEY: json.dumps(whole, allow_nan=False)}
    variables = {
        name: (dims, each, {"units": "SI"}) for name, (dims, each) in encoder.arrays.items()
    }
    write_sealed(xarray.Dataset(variables, attrs=attributes), path)


_WRITERS: dict[str, Callable[[dict[str, Any], Encoder, Path], None]] = {
    ".json": _write_json,
    ".nc": _write_netcdf,
}


def _listed(values: Array) -> dict[str, Any]:
    """An array as JSON has it: no number is null, what is infinite is text."""
    flat = [
        each if math.isfinite(each) else None if math.isnan(each) else str(each)
        for each in values.ravel().tolist()
    ]
    return {"shape": list(values.shape), "values": flat}


def _array(listed: Mapping[str, Any]) -> Array:
    import numpy as np

    flat = [math.nan if each is None else float(each) for each in listed["values"]]
    return np.array(flat, dtype=np.float64).reshape(listed["shape"])


def _decoded(
    known: Mapping[str, Any], arrays: Mapping[str, Array], kind: str, source: Path
) -> Storable:
    try:
        found = Decoder(arrays).value(known["content"])
    except (KeyError, TypeError, ValueError) as error:
        raise NotATrajectoryError(
            f"{source} is of another version of pendula, {known.get('pendula')}: {one_line(error)}"
        ) from None
    if not isinstance(found, Storable):
        raise damaged(source, f"it holds no {kind}")
    return found
