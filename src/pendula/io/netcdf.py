"""NetCDF, through HDF5, whose library believes the sizes in a damaged file and may never return.

A seal behind HDF5's last byte is compared before the library sees the file. HDF5 cuts the seal off
when it opens the file to write: from then on, as in files of earlier versions, the sizes that it
would count with are compared here, and the numbers with the checksums of the recipe.
"""

from __future__ import annotations

import re
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY
from pendula._checks import extra
from pendula.io.checksums import of_bytes
from pendula.io.tables import stored_dataset
from pendula.io.whole import Stored, damaged

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    import xarray as xr

    from pendula.run.trajectory import Trajectory

_SEAL = re.compile(rb"\npendula blake2b ([0-9a-f]+)\n\Z")
_HEAP = b"GCOL\x01\x00\x00\x00"  # of variable lengths: version 1 and three bytes for later
_LENGTH = 8  # bytes of a size in the file
_HEADER = 16  # bytes in front of the objects of a heap, and of each object


def write_netcdf(trajectory: Trajectory, path: Path) -> None:
    """Write a trajectory with h5netcdf, and seal."""
    write_sealed(stored_dataset(trajectory), path)


def write_sealed(dataset: xr.Dataset, path: Path) -> None:
    """Write any dataset, with a seal behind."""
    extra("h5netcdf", "io")
    dataset.to_netcdf(path, engine="h5netcdf")
    checksum = of_bytes(path.read_bytes())
    with path.open("ab") as file:
        file.write(f"\npendula blake2b {checksum}\n".encode())


@contextmanager
def read_netcdf(path: Path) -> Iterator[Stored]:
    """What a file holds; sizes that do not fit are refused before HDF5 counts with them."""
    h5py, data = extra("h5py", "io"), path.read_bytes()
    seal = _SEAL.search(data, max(0, len(data) - 100))
    if seal is not None and of_bytes(data[: seal.start()]) != seal[1].decode():
        raise damaged(path, "it does not fit the checksum at its end")
    if not _heaps_fit(data):
        raise damaged(path, "sizes inside it do not fit")
    with h5py.File(path, "r") as file:
        columns = {
            f"{name} [{_text(each.attrs.get('units'))}]": each for name, each in file.items()
        }

        def column(label: str) -> Any:
            each = columns[label]
            if (
                each.chunks is None
                and each.id.get_storage_size() != each.size * each.dtype.itemsize
            ):
                raise damaged(path, f"{label} has another size than its numbers")
            return each[...]

        shapes = {label: each.shape for label, each in columns.items()}
        recipe = _text(file.attrs.get(KEY, "{}"))
        yield Stored(recipe, shapes, column, len(data))


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _heaps_fit(data: bytes) -> bool:
    """Whether the objects of each global heap fill it (HDF5 File Format 3.0, III.E).

    The library goes on from object to object for ever where one in a damaged heap has no size.
    """

    def size_at(place: int) -> int:
        return int.from_bytes(data[place : place + _LENGTH], "little")

    start = data.find(_HEAP)
    while start >= 0:
        end, place = start + size_at(start + _LENGTH), start + _HEADER
        while place + _HEADER <= end <= len(data):
            index, size = int.from_bytes(data[place : place + 2], "little"), size_at(place + 8)
            if index == 0:  # the free rest, with its own header
                place += max(size, _HEADER)
                break
            place += _HEADER + -(-size // 8) * 8
        if not end - _HEADER < place <= end or end > len(data):
            return False
        start = data.find(_HEAP, end)
    return True
