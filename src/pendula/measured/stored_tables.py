"""Tables that programs store with types of their own: Parquet and NetCDF."""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING, Any

from pendula._checks import extra
from pendula._messages import ArgumentError, one_line
from pendula.measured.tables import Table, table_of

if TYPE_CHECKING:
    from pendula._types import Array


def parquet_table(data: bytes) -> Table:
    """The columns of a Parquet file that hold numbers, its index among them.

    Raises:
        ArgumentError: for a file that is damaged.
    """
    pandas = extra("pandas", "fit")
    extra("pyarrow", "fit")
    try:
        frame = pandas.read_parquet(BytesIO(data))
    except Exception as error:  # whatever the reader stumbles over in a damaged file
        raise _damaged("Parquet", error) from None
    if frame.index.name is not None:
        frame = frame.reset_index()
    kept = [(str(name), _numbers(frame[name].to_numpy())) for name in frame.columns]
    return _of_arrays([(name, each) for name, each in kept if each is not None], {})


def netcdf_table(data: bytes) -> Table:
    """The variables of a NetCDF file along its longest dimension, with their units.

    Raises:
        ArgumentError: for a file that is damaged.
    """
    xarray = extra("xarray", "fit")
    engine = "scipy" if data.startswith(b"CDF") else "h5netcdf"
    extra("scipy" if engine == "scipy" else "h5netcdf", "fit")
    try:
        if engine == "h5netcdf":  # of a file that is not whole it leaves an open one behind
            extra("h5py", "fit").File(BytesIO(data), "r").close()
        with xarray.open_dataset(BytesIO(data), engine=engine, decode_times=False) as dataset:
            dataset.load()
    except ImportError:
        raise
    except Exception as error:  # whatever the reader stumbles over in a damaged file
        raise _damaged("NetCDF", error) from None
    if not dataset.sizes:
        raise ArgumentError("path", "holds no table of numbers")
    longest = max(dataset.sizes, key=lambda name: dataset.sizes[name])
    columns, units = list[tuple[str, "Array"]](), dict[str, str]()
    for name, variable in dataset.variables.items():
        if longest not in variable.dims or variable.ndim > 2:
            continue
        array = _numbers(variable.transpose(longest, ...).values)
        if array is None:
            continue
        parts = [array] if array.ndim == 1 else list(array.T)
        for i, part in enumerate(parts, start=1):
            label = str(name) if len(parts) == 1 else f"{name}{i}"
            columns.append((label, part))
            units[label] = str(variable.attrs.get("units", ""))
    return _of_arrays(columns, units)


def _of_arrays(columns: list[tuple[str, Array]], units: dict[str, str]) -> Table:
    labels = [name for name, _ in columns]
    return table_of(
        "",
        labels,
        [array for _, array in columns],
        units=[units.get(name, "") for name in labels],
        what="row",
    )


def _numbers(array: Any) -> Array | None:
    """An array as doubles, spans of time in seconds from the first; None: it holds no numbers."""
    if array.dtype.kind in "mM":
        spans = (array - array[0]).astype("timedelta64[ns]")
        found: Array = spans.astype("float64") * 1e-9
        return found
    return array.astype("float64") if array.dtype.kind in "iuf" else None


def _damaged(kind: str, error: Exception) -> ArgumentError:
    rule = "is no {text} file that can be read: {other}"
    return ArgumentError("path", rule, text=kind, other=one_line(error))
