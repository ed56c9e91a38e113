"""MATLAB files, of version 5 and of 7.3, which is HDF5."""

from __future__ import annotations

import warnings
from dataclasses import replace
from io import BytesIO
from typing import TYPE_CHECKING, Any

from pendula._checks import extra
from pendula._messages import ArgumentError, one_line
from pendula.measured.headings import Heading, heading_of
from pendula.measured.tables import Column, Table

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from pendula._types import Array

_OPAQUE = "holds MATLAB objects ({text}), which only MATLAB can read"
_WAY_OUT = "save its numbers in MATLAB with writematrix, or as plain arrays with save"
_HDF5 = b"\x89HDF\r\n\x1a\n"


def matlab_tables(data: bytes) -> list[Table]:
    """Tables of the vectors and matrices that have as many samples, a table for each such number.

    Rows of a matrix are columns of the table where the samples lie along its rows.

    Raises:
        ArgumentError: for a file that is damaged, or holds MATLAB's own objects only.
    """
    arrays, opaque = _of_hdf5(data) if _HDF5 in data[:1024] else _of_version_5(data)
    if not arrays and opaque:
        names = ", ".join(sorted(opaque))
        raise ArgumentError("path", _OPAQUE, _WAY_OUT, text=names)
    lengths: dict[int, dict[str, Array]] = {}
    for name, array in arrays.items():
        lengths.setdefault(max(array.shape), {})[name] = array
    columns = [_columns(each) for samples, each in lengths.items() if samples > 2]
    timed = [each for each in columns if any(one.heading.kind == "time" for one in each)]
    if len(timed) > 1:  # runs of different lengths
        columns = [_of_one_length([one for each in timed for one in each])]
    return [_with_step(_table(each), arrays) for each in columns if each]


def _columns(arrays: Mapping[str, Array]) -> list[Column]:
    """The columns of arrays of the same length; `y_1` with four rows has y_1[1] … y_1[4].

    Rows of a matrix have its name's meaning if that is an angle or a rate; "y" is one's name for
    what is measured, and no coordinate.
    """
    import numpy as np

    columns = list["Column"]()
    for name, array in arrays.items():
        rows = array if array.shape[0] <= array.shape[1] else array.T
        heading = heading_of(name)
        if len(rows) > 1:
            turning = heading.kind in ("angle", "rate")
            heading = heading if turning else Heading(index=heading.index, run=heading.run)
        for i, row in enumerate(rows, start=1):
            one = len(rows) == 1
            index = str(i) if len(rows) == 2 and heading.kind else heading.index
            label = name if one else f"{name}[{i}]"
            columns.append(
                Column(
                    len(columns) + 1,
                    label,
                    row.astype(np.float64),
                    heading if one else replace(heading, index=index),
                    name,
                )
            )
    return columns


def _of_one_length(columns: Sequence[Column]) -> list[Column]:
    """The columns, the shorter ones filled up with NaN."""
    import numpy as np

    longest = max(each.values.size for each in columns)
    return [
        replace(
            each,
            number=i,
            values=np.pad(each.values, (0, longest - each.values.size), constant_values=np.nan),
        )
        for i, each in enumerate(columns, start=1)
    ]


def _table(columns: Sequence[Column]) -> Table:
    import numpy as np

    rows = np.arange(1.0, columns[0].values.size + 1)
    return Table("", tuple(columns), rows, what="sample")


def _with_step(table: Table, arrays: Mapping[str, Array]) -> Table:
    """The table, with times where the file has only a step between samples."""
    import numpy as np

    if any(each.heading.kind == "time" for each in table.columns):
        return table
    step = next(
        (float(each.item()) for name, each in arrays.items()
         if each.size == 1 and name.lower() in ("dt", "ts", "h", "sampletime")),
        None,
    )  # fmt: skip
    if step is None or step <= 0.0:
        return table
    t: Array = np.arange(table.lines.size, dtype=np.float64) * step
    times = Column(0, "t (s)", t, heading_of("t (s)"))
    return table.of([times, *table.columns]).noted(f"Times from the file's step of {step:g} s.")


def _of_version_5(data: bytes) -> tuple[dict[str, Array], set[str]]:
    """Arrays of numbers by name, and the names of what cannot be read."""
    scipy_io = extra("scipy.io", "fit")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of duplicate names, and of objects it cannot read
        try:
            held = scipy_io.loadmat(BytesIO(data), struct_as_record=True)
        except Exception as error:  # whatever the reader stumbles over in a damaged file
            rule = "is no MATLAB file that can be read: {text}"
            raise ArgumentError("path", rule, text=one_line(error)) from None
    arrays, opaque = dict[str, "Array"](), set[str]()
    for name, value in held.items():
        if name.startswith("__") and name != "__function_workspace__":
            continue
        if type(value).__name__ == "MatlabOpaque" or name == "None":
            opaque.add(_class_of(value))
        elif name != "__function_workspace__":
            arrays.update(_numbers(name, value))
    return arrays, opaque


def _class_of(value: Any) -> str:
    """The class of an opaque object, as the file names it."""
    try:
        return bytes(value["s2"][0]).decode()
    except (KeyError, TypeError, ValueError, IndexError):
        return "of an unknown class"


def _numbers(name: str, value: Any) -> Iterator[tuple[str, Array]]:
    """The arrays of numbers in a variable, of a structure those of its fields."""
    import numpy as np

    array = np.asarray(value)
    if array.dtype.names and array.size == 1:
        for each in array.dtype.names:
            yield from _numbers(each, array.reshape(-1)[0][each])
    elif array.dtype.kind == "O" and array.size == 1:
        yield from _numbers(name, array.item())
    elif array.dtype.kind in "iufb" and array.ndim == 2 and array.size:
        yield name, array
    elif array.dtype.kind in "iufb" and array.ndim < 2 and array.size:
        yield name, array.reshape(1, -1)


def _of_hdf5(data: bytes) -> tuple[dict[str, Array], set[str]]:
    """As `_of_version_5`, of a file of version 7.3, whose matrices lie the other way round."""
    h5py = extra("h5py", "fit")
    arrays, opaque = dict[str, "Array"](), set[str]()

    def visit(name: str, item: Any) -> None:
        if not isinstance(item, h5py.Dataset) or name.startswith("#"):
            return
        kind = bytes(item.attrs.get("MATLAB_class", b"")).decode()
        if item.attrs.get("MATLAB_object_decode") is not None or kind in ("table", "timeseries"):
            opaque.add(kind or name)
        elif item.dtype.kind in "iuf" and item.ndim <= 2 and kind not in ("char", "cell"):
            arrays.update(_numbers(name.rpartition("/")[2], item[()].T))

    try:
        with h5py.File(BytesIO(data), "r") as file:
            file.visititems(visit)
    except (OSError, RuntimeError) as error:
        rule = "is no MATLAB file that can be read: {text}"
        raise ArgumentError("path", rule, text=one_line(error)) from None
    return arrays, opaque
