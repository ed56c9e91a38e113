"""The file formats: a writer and a reader each. Readers give what a file claims."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import AbstractContextManager, contextmanager
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY
from pendula._checks import extra
from pendula.io.attributes import attributes
from pendula.io.csv_files import read_csv, write_csv
from pendula.io.netcdf import read_netcdf, write_netcdf
from pendula.io.tables import stored_dataset, to_pandas
from pendula.io.whole import Stored, damaged

if TYPE_CHECKING:
    from collections.abc import Iterator

    from pendula.run.trajectory import Trajectory


def packages(ending: str) -> tuple[str, ...]:
    """What reading and writing files of that ending needs beyond the base install."""
    return {
        ".csv": (),
        ".nc": ("xarray", "h5netcdf"),
        ".parquet": ("pandas", "pyarrow"),
        ".zarr": ("xarray", "zarr"),
    }[ending]


def _write_parquet(trajectory: Trajectory, path: Path) -> None:
    arrow, parquet = extra("pyarrow", "io"), extra("pyarrow.parquet", "io")
    table = arrow.Table.from_pandas(to_pandas(trajectory), preserve_index=False)
    parquet.write_table(table.replace_schema_metadata({KEY: attributes(trajectory)}), path)


@contextmanager
def _read_parquet(path: Path) -> Iterator[Stored]:
    with extra("pyarrow.parquet", "io").ParquetFile(path) as file:
        # Of the metadata of columns pyarrow ends the process where they are damaged: only what is
        # said of the whole file is asked for.
        count = file.metadata.num_rows

        @cache
        def table() -> Any:
            return file.read()

        yield Stored(
            (file.schema_arrow.metadata or {}).get(KEY.encode(), b"{}").decode(),
            dict.fromkeys(file.schema_arrow.names, (count,)),
            lambda label: table()[label].to_numpy(),
            path.stat().st_size,
        )


def _write_zarr(trajectory: Trajectory, path: Path) -> None:
    extra("zarr", "io")
    stored_dataset(trajectory).to_zarr(
        path, zarr_format=3, consolidated=False, write_empty_chunks=True
    )


@contextmanager
def _read_zarr(path: Path) -> Iterator[Stored]:
    group = extra("zarr", "io").open_group(path, mode="r", zarr_format=3, use_consolidated=False)
    arrays = {f"{name} [{each.attrs.get('units')}]": each for name, each in group.arrays()}

    def column(label: str) -> Any:
        array = arrays[label]
        chunks = math.prod(
            -(-size // step) for size, step in zip(array.shape, array.chunks, strict=True)
        )
        there = sum(each.is_file() for each in (path / array.basename / "c").rglob("*"))
        if there < chunks:  # zarr gives nan for them
            raise damaged(path, f"{label} lacks {chunks - there} of its {chunks} chunks")
        return array[...]

    size = sum(each.stat().st_size for each in path.rglob("*") if each.is_file())
    shapes = {label: each.shape for label, each in arrays.items()}
    yield Stored(str(group.attrs.get(KEY, "{}")), shapes, column, size)


FORMATS: dict[
    str, tuple[Callable[[Trajectory, Path], None], Callable[[Path], AbstractContextManager[Stored]]]
] = {
    ".csv": (write_csv, read_csv),
    ".nc": (write_netcdf, read_netcdf),
    ".parquet": (_write_parquet, _read_parquet),
    ".zarr": (_write_zarr, _read_zarr),
}
