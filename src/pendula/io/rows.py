"""Tables of plain columns as CSV or JSON, with what they were made from."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pendula._checks import one_of
from pendula._writing import refuse_existing, replacing
from pendula.io.csv_files import MARK

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    Columns = Mapping[str, Sequence[Any]]


def write_rows(
    columns: Columns, attributes: Mapping[str, Any], path: Path, *, overwrite: bool = False
) -> None:
    """Write columns of one length; the name's ending chooses: .csv or .json.

    A number that is not there (nan) is an empty cell, or null; infinity is inf, or "inf".

    Raises:
        ValueError: for another ending.
        FileExistsError: where the path exists and `overwrite` is not set.
        OSError: where the path cannot be written.
    """
    check_rows_target(path, overwrite=overwrite)
    with (
        replacing(path, overwrite=overwrite) as unfinished,
        unfinished.open("w", encoding="utf-8", newline="") as file,
    ):
        if path.suffix.lower() == ".json":
            rows = [dict(zip(columns, row, strict=True)) for row in _rows(columns, None, "inf")]
            json.dump({**attributes, "rows": rows}, file, indent=1, allow_nan=False)
            file.write("\n")
            return
        file.write(f"{MARK}{json.dumps(attributes, allow_nan=False)}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(_rows(columns, "", math.inf))


def check_rows_target(path: Path, *, overwrite: bool = False) -> None:
    """Refuse, before long work, a path that `write_rows` could not write.

    Raises:
        ValueError, FileExistsError, OSError: as for `write_rows`.
    """
    try:
        one_of("ending", path.suffix.lower(), (".csv", ".json"))
    except ValueError:
        raise ValueError(f"the file name must end in .csv or .json, got {path.name!r}") from None
    refuse_existing(path, overwrite=overwrite)


def _rows(columns: Columns, missing: Any, infinite: Any) -> list[list[Any]]:
    def cell(value: Any) -> Any:
        if not isinstance(value, float) or math.isfinite(value):
            return value
        return missing if math.isnan(value) else infinite

    return [[cell(each) for each in row] for row in zip(*columns.values(), strict=True)]
