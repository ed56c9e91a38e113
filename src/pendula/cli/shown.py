"""What a file holds that some other command wrote: which kind of file it is, and its recipe."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pendula._attributes import KEY, kind_of
from pendula._checks import extra
from pendula._messages import one_line

ENDINGS = (".csv", ".json", ".nc", ".parquet", ".zarr", ".toml")


@dataclass(frozen=True)
class Held:
    """What a file says of itself.

    Attributes:
        path: of the file, or the URL of a store.
        ending: of its name.
        kind: "trajectory", "map", "sweep", "ensemble", "comparison", "events", "chaos", "recipe" or
            "recording or fit".
        known: its description.
    """

    path: str
    ending: str
    kind: str
    known: dict[str, Any]


def held(path: str) -> Held:
    """The kind of a file, by what it says of itself.

    Raises:
        ValueError: for a file that no command writes.
        FileNotFoundError: where there is none.
    """
    ending = Path(path).suffix.lower()
    if ending not in ENDINGS:
        raise ValueError(f"the file name must end in {', '.join(ENDINGS)}, got {path!r}")
    if "://" not in path and not Path(path).exists():
        raise FileNotFoundError(f"no such file: {path}")
    if ending == ".toml":
        return Held(path, ending, "recipe", {})
    try:
        known = _READERS[ending](path)
    except (ImportError, FileNotFoundError):
        raise
    except Exception as error:  # the formats' libraries raise whatever they like
        raise ValueError(
            f"{path} cannot be read as a file of pendula: {one_line(error)}"
        ) from error
    kind = kind_of(known)
    if kind is None:
        raise ValueError(f"{path} was not written by pendula: it holds no description of its own")
    return Held(path, ending, kind, known)


def rows_of(found: Held) -> tuple[list[str], list[list[str]]]:
    """The header and the rows of a table, short enough for a terminal: words above one another."""
    if found.ending == ".json":
        records = found.known["rows"]
        header = list(records[0]) if records else []
        rows = [list(map(str, each.values())) for each in records]
    else:
        with Path(found.path).open(encoding="utf-8-sig", newline="") as file:
            file.readline()
            header, *rows = list(csv.reader(file))
    return [name.replace(" ", "\n") for name in header], [
        list(map(_shortened, row)) for row in rows
    ]


def _shortened(cell: str) -> str:
    try:
        return f"{float(cell):.6g}"
    except ValueError:
        return cell


def _of_zarr(path: str) -> Any:
    attributes = extra("zarr", "io").open_group(path, mode="r").attrs
    return json.loads(str(attributes.get(KEY, "{}")))


def _of_netcdf(path: str) -> Any:
    with extra("h5py", "io").File(path, "r") as file:
        found = file.attrs.get(KEY, "{}")
    return json.loads(found)


def _of_parquet(path: str) -> Any:
    schema = extra("pyarrow.parquet", "io").read_schema(path)
    return json.loads((schema.metadata or {}).get(KEY.encode(), b"{}"))


def _of_csv(path: str) -> Any:
    with Path(path).open(encoding="utf-8-sig", newline="") as file:
        first = file.readline()
    mark = f"# {KEY}: "
    return json.loads(first[len(mark) :]) if first.startswith(mark) else {}


def _of_json(path: str) -> Any:
    found = json.loads(Path(path).read_text(encoding="utf-8"))
    return found if isinstance(found, dict) else {}


_READERS = {
    ".zarr": _of_zarr,
    ".nc": _of_netcdf,
    ".parquet": _of_parquet,
    ".csv": _of_csv,
    ".json": _of_json,
}
