"""What a file holds that some other command wrote: which kind of file it is, and its recipe."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pendula._attributes import KEY
from pendula._checks import extra
from pendula._messages import one_line

ENDINGS = (".csv", ".json", ".nc", ".parquet", ".zarr", ".toml")


@dataclass(frozen=True)
class Held:
    """What a file says of itself.

    Attributes:
        path: of the file, or the URL of a store.
        ending: of its name.
        kind: "trajectory", "map", "sweep", "ensemble", "comparison" or "recipe".
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
    kind = next((kind for kind, names in _KINDS.items() if names <= known.keys()), None)
    if kind is None:
        raise ValueError(f"{path} was not written by pendula: it holds no description of its own")
    return Held(path, ending, kind, known)


_KINDS = {  # by keys of the description
    "sweep": {"sweep"},
    "map": {"map"},
    "ensemble": {"ensemble"},
    "comparison": {"reference", "outputs"},
    "trajectory": {"method", "state"},
}


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
