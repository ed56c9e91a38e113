"""Reading a map from its store or file."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from pendula._checks import extra
from pendula._messages import one_line
from pendula.chaos.indicators import INDICATORS
from pendula.many.chunks import opened

if TYPE_CHECKING:
    import xarray as xr

_VARIABLES = ("flip_time", "growth", *INDICATORS)  # what maps hold


def open_map(path: str | os.PathLike[str]) -> xr.Dataset:
    """The map in a store or file, read when it is used (extra: io).

    Args:
        path: a .zarr store, also at a URL, or a .nc file, as `flip_map`, `divergence_map` and
            `pendula map` write them.

    Returns:
        What made it returned; of a store that is not finished too, with the attribute "unfinished".

    Raises:
        FileNotFoundError: where there is none.
        ValueError: for a file that cannot be read, or holds no map.
    """
    name = os.fspath(path)
    found = _netcdf(Path(name)) if name.lower().endswith(".nc") else opened(name)
    if not any(variable in found for variable in _VARIABLES):
        found.close()
        raise ValueError(f"{name} holds no map: it has none of {', '.join(_VARIABLES)}")
    return found


def _netcdf(path: Path) -> xr.Dataset:
    xarray, _ = extra("xarray", "io"), extra("h5netcdf", "io")
    if not path.exists():
        raise FileNotFoundError(f"no such file: {path}")
    try:
        found: xr.Dataset = xarray.open_dataset(path, engine="h5netcdf")
    except Exception as error:  # the libraries raise whatever they like
        raise ValueError(f"{path} cannot be read as a map: {one_line(error)}") from error
    return found
