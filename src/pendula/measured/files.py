"""Which kind of file it is, by what is in it, and the tables that it holds."""

from __future__ import annotations

import math
import zipfile
from dataclasses import replace
from io import BytesIO
from pathlib import PurePosixPath
from typing import TYPE_CHECKING
from xml.etree import ElementTree

from pendula._messages import ArgumentError, one_line
from pendula.measured.decoding import decoded
from pendula.measured.matlab import matlab_tables
from pendula.measured.spreadsheets import sheet_tables
from pendula.measured.stored_tables import netcdf_table, parquet_table
from pendula.measured.tables import Table, table_of
from pendula.measured.text_tables import text_table
from pendula.measured.tracker import tracker_table

if TYPE_CHECKING:
    from collections.abc import Iterator

_HDF5 = b"\x89HDF\r\n\x1a\n"
_TABLES = (".csv", ".txt", ".tsv", ".dat", ".asc")
_FOLDERS = ("meta", "__MACOSX")


def tables_of(data: bytes) -> list[Table]:
    """The tables in a file's bytes.

    Raises:
        ArgumentError: for a file of no known kind, or one that is damaged.
        MissingExtraError: where a package for that kind is missing.
    """
    found = _tables(data)
    if not found or not any(table.columns for table in found):
        rule = "holds no table of numbers"
        raise ArgumentError("path", rule, "export the data as CSV, say")
    return found


def _tables(data: bytes) -> list[Table]:
    for start, tables in _KINDS.items():
        if data.startswith(start):
            return tables(data)
    if _HDF5 in data[128:1024]:  # behind MATLAB's own header
        return matlab_tables(data)
    start = data.lstrip(b"\xef\xbb\xbf \t\r\n")[:2000]
    if start.startswith((b"<?xml", b"<phyphox", b"<object")):
        return [tracker_table(data) if b"opensourcephysics" in start else _of_phyphox(data)]
    text, encoding = decoded(data)
    table = text_table(text)
    if table is None:
        return []
    return [table if encoding == "UTF-8" else table.noted(f"The text is {encoding}.")]


def _of_hdf5(data: bytes) -> list[Table]:
    """Tables of an HDF5 file: MATLAB's marks its variables with their class."""
    return matlab_tables(data) if b"MATLAB_class" in data else [netcdf_table(data)]


def _of_zip(data: bytes) -> list[Table]:
    """Tables of a spreadsheet, or of the text tables and the .trk file in an archive."""
    try:
        with zipfile.ZipFile(BytesIO(data)) as archive:
            names = archive.namelist()
            if "[Content_Types].xml" in names or "mimetype" in names:
                return _of_sheets(data)
            return list(_of_archive(archive))
    except (ArgumentError, ImportError):
        raise
    except Exception as error:  # whatever the reader stumbles over in a damaged file
        rule = "is no whole archive: {text}"
        raise ArgumentError("path", rule, text=one_line(error)) from None


def _of_archive(archive: zipfile.ZipFile) -> Iterator[Table]:
    for name in archive.namelist():
        path = PurePosixPath(name)
        if path.parts and any(each in _FOLDERS for each in path.parts[:-1]):
            continue
        if path.suffix.lower() == ".trk":
            yield replace(tracker_table(archive.read(name)), name=path.stem)
        elif path.suffix.lower() in _TABLES:
            table = text_table(decoded(archive.read(name))[0], name=path.stem)
            if table is not None:
                yield table


def _of_sheets(data: bytes) -> list[Table]:
    try:
        return sheet_tables(data)
    except ImportError:
        raise
    except Exception as error:  # whatever the reader stumbles over in a damaged file
        rule = "is no spreadsheet that can be read: {text}"
        raise ArgumentError("path", rule, text=one_line(error)) from None


def _float(cell: str) -> float:
    """A number of a buffer, NaN for what is none."""
    try:
        return float(cell)
    except ValueError:
        return math.nan


def _of_phyphox(data: bytes) -> Table:
    """The table that a saved state of phyphox holds: buffers, and the sets that name them."""
    import numpy as np

    try:
        root = ElementTree.fromstring(data)
    except ElementTree.ParseError as error:
        raise ArgumentError("path", "is no whole XML file: {text}", text=str(error)) from None
    buffers = {
        (each.text or "").strip(): np.array(
            [_float(cell) for cell in each.get("init", "").split(",")]
        )
        for each in root.iter("container")
    }
    for each in root.iter("set"):
        named = [(one.get("name", ""), buffers.get((one.text or "").strip())) for one in each]
        held = [(name, array) for name, array in named if array is not None and array.size > 1]
        if len(held) > 1:
            longest = max(array.size for _, array in held)
            columns = [np.pad(a, (0, longest - a.size), constant_values=np.nan) for _, a in held]
            labels = [name for name, _ in held]
            return table_of(each.get("name", ""), labels, columns, what="sample")
    rule = "holds no recorded data"
    raise ArgumentError("path", rule, "save the state in phyphox after a measurement, or export it")


_KINDS = {  # by the bytes they begin with
    b"PK\x03\x04": _of_zip,
    b"\xd0\xcf\x11\xe0": _of_sheets,
    b"PAR1": lambda data: [parquet_table(data)],
    b"CDF": lambda data: [netcdf_table(data)],
    b"MATLAB 5.0 MAT-file": matlab_tables,
    _HDF5: _of_hdf5,
}
