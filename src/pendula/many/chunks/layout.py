"""The contents of a store: the bytes of every file, Zarr v3 as zarr-python writes it."""

from __future__ import annotations

import math
import warnings
from typing import TYPE_CHECKING, Any

from pendula._attributes import UNFINISHED
from pendula._checks import extra

if TYPE_CHECKING:
    from pendula.many.chunks.work import Arrays, Chunk, Index, Variable, Work

ROOT = "zarr.json"  # of the whole, and in each array's folder
NOTE = "chunks are missing; the same call again computes them"
CHECKSUM = 4  # bytes of crc32c at the end of each chunk


class Layout:
    """The files of a store, by key.

    Chunks are plain bytes with a checksum. Compressed ones would depend on a library's version,
    and their size would not show that one is truncated.

    Attributes:
        work: what is laid out.
        root: first file of a finished store.
        unfinished: the same, of one whose chunks are not all there.
        rest: the other files that are not chunks: what the arrays are, and the coordinates.
    """

    def __init__(self, work: Work) -> None:
        self.work = work
        self.root = self._made({})[0]
        self.unfinished, files, self._arrays = self._made({UNFINISHED: NOTE})
        self.rest = {key: each.to_bytes() for key, each in files.items() if key != ROOT}
        self._files = files  # where zarr-python writes

    def _made(self, note: dict[str, str]) -> tuple[bytes, dict[str, Any], dict[str, Any]]:
        """The first file, all files and the arrays of a store in memory, without chunks."""
        zarr, work = extra("zarr", "io"), self.work
        files: dict[str, Any] = {}
        arrays: dict[str, Any] = {}
        store = zarr.storage.MemoryStore(files)
        attributes = {**work.attributes, **note}
        group = zarr.create_group(store, attributes=attributes, zarr_format=3)
        for axis in work.axes:
            if axis.values is not None:
                dtype, size = axis.values.dtype.name, (axis.size,)
                array = _described((axis.name,), size, size, dtype, 0, axis.attrs)
                group.create_array(axis.name, **array)[:] = axis.values
        for each in work.variables:
            sizes = work.shape(each), self._chunk_shape(each)
            dtype = "str" if each.is_text else each.dtype
            array = _described(each.dims, *sizes, dtype, each.fill, each.attrs)
            arrays[each.name] = group.create_array(each.name, **array)
        with warnings.catch_warnings():  # that it is no part of Zarr's specification yet
            warnings.simplefilter("ignore")
            zarr.consolidate_metadata(store)  # xarray asks for it
        return bytes(files[ROOT].to_bytes()), files, arrays

    def _chunk_shape(self, variable: Variable) -> tuple[int, ...]:
        steps = {axis.name: axis.step for axis in self.work.axes}
        return tuple(steps[dim] for dim in variable.dims)

    def size(self, variable: Variable) -> int | None:
        """Bytes of each chunk of a variable; one at the edge is padded. None: of texts, any."""
        import numpy as np

        if variable.is_text:
            return None
        return math.prod(self._chunk_shape(variable)) * np.dtype(variable.dtype).itemsize + CHECKSUM

    def name(self, variable: Variable, index: Index) -> str:
        """A chunk's file in the folder of its variable."""
        places = dict(zip((axis.name for axis in self.work.cut), index, strict=True))
        return ".".join(("c", *(str(places.get(dim, 0)) for dim in variable.dims)))

    def files(self, chunk: Chunk, arrays: Arrays) -> dict[str, bytes]:
        """A chunk's files: one for each variable."""
        made = {}
        for variable in self.work.variables:
            region = tuple(chunk[dim] for dim in variable.dims)
            self._arrays[variable.name][region] = arrays[variable.name]
            key = f"{variable.name}/{self.name(variable, chunk.index)}"
            made[key] = bytes(self._files.pop(key).to_bytes())
        return made


def _described(
    dims: tuple[str, ...],
    shape: tuple[int, ...],
    chunks: tuple[int, ...],
    dtype: str,
    fill: float | bool | str,
    attrs: Any,
) -> dict[str, Any]:
    """An array of the store, in zarr-python's words."""
    codecs = extra("zarr.codecs", "io")
    return {
        "shape": shape,
        "chunks": chunks,
        "dtype": dtype,
        "fill_value": fill,
        "filters": None,
        "serializer": "auto" if dtype == "str" else codecs.BytesCodec(endian="little"),
        "compressors": [codecs.Crc32cCodec()],
        "chunk_key_encoding": {"name": "default", "separator": "."},  # one folder an array
        "dimension_names": dims,
        "attributes": dict(attrs),
        "config": {"write_empty_chunks": True},  # a chunk of NaN is not a missing one
    }


def whole(data: bytes) -> bool:
    """Whether a chunk's bytes are those its checksum was made of."""
    if len(data) <= CHECKSUM:
        return False
    checksum = extra("google_crc32c", "io").value(data[:-CHECKSUM])
    return bool(data[-CHECKSUM:] == checksum.to_bytes(CHECKSUM, "little"))
