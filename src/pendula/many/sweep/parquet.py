"""A sweep as a Parquet file: one row per trajectory, lists over time, a row group per chunk."""

from __future__ import annotations

from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY
from pendula._checks import extra
from pendula._writing import replacing
from pendula.many.chunks import computed
from pendula.many.sweep.rows import ROW, TIME

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    import xarray as xr

    from pendula._progress import Progress
    from pendula.many.chunks import Chunk, Variable, Work
    from pendula.many.chunks.work import Arrays

_COMPRESSION = "zstd"


def write_parquet(
    work: Work, path: str, *, client: Any, threads: int | None, progress: Progress, overwrite: bool
) -> xr.Dataset:
    """Write all rows; what each has once.

    Columns are called as those of other tables, "theta1 [rad]".
    """
    import numpy as np

    xarray, parquet = extra("xarray", "io"), extra("pyarrow.parquet", "io")
    table = _Table(work)
    once = [each for each in work.variables if each.dims == (ROW,)]
    kept: dict[str, list[Any]] = {each.name: [] for each in once}
    with replacing(Path(path), overwrite=overwrite) as unfinished:
        made = computed(work, client=client, progress=progress, threads=threads)
        writer = parquet.ParquetWriter(
            unfinished,
            table.schema,
            compression=_COMPRESSION,
            use_dictionary=table.repeating,
            write_page_checksum=True,  # for readers with page_checksum_verification=True
        )
        with closing(made), writer:
            for chunk, arrays in _in_order(made):
                writer.write_table(table.of(chunk, arrays), row_group_size=chunk.shape[0])
                for each in once:
                    kept[each.name].append(arrays[each.name])
    dataset: xr.Dataset = xarray.Dataset(
        {each.name: ((ROW,), np.concatenate(kept[each.name]), dict(each.attrs)) for each in once},
        attrs=work.attributes,
    )
    return dataset


class _Table:
    """The columns of the file."""

    def __init__(self, work: Work) -> None:
        import numpy as np

        self._arrow = arrow = extra("pyarrow", "io")
        self._work = work
        self._times: Any = {axis.name: axis.values for axis in work.axes}[TIME]
        fields = [(ROW, arrow.int64()), ("t [s]", arrow.list_(arrow.float64()))]
        for each in work.variables:
            text = np.dtype(each.dtype).kind == "U"
            kind = arrow.string() if text else arrow.from_numpy_dtype(each.dtype)
            fields.append((_column(each), arrow.list_(kind) if TIME in each.dims else kind))
        self.schema = arrow.schema(fields, metadata={KEY: work.identity})

    @property
    def repeating(self) -> list[str]:
        """Columns with repeating values."""
        once = [_column(each) for each in self._work.variables if TIME not in each.dims]
        return ["t [s].list.element", *once]

    def of(self, chunk: Chunk, arrays: Arrays) -> Any:
        """A chunk's rows."""
        import numpy as np

        arrow, rows = self._arrow, np.arange(*chunk.spans[ROW])
        columns = [arrow.array(rows), self._lists(np.stack([self._times] * len(rows)))]
        for each in self._work.variables:
            values = arrays[each.name]
            if values.ndim == 1:
                columns.append(arrow.array(values))
            else:
                columns.append(self._lists(values))
        return arrow.Table.from_arrays(columns, schema=self.schema)

    def _lists(self, values: Any) -> Any:
        """One list per row."""
        import numpy as np

        ends = np.arange(len(values) + 1, dtype=np.int32) * values.shape[1]
        return self._arrow.ListArray.from_arrays(ends, values.ravel())


def _column(variable: Variable) -> str:
    unit = variable.attrs.get("units")
    return f"{variable.name} [{unit}]" if unit else variable.name


def _in_order(made: Iterable[tuple[Chunk, Arrays]]) -> Iterator[tuple[Chunk, Arrays]]:
    """Chunks in order; those that a cluster finishes early are held back."""
    waiting: dict[int, tuple[Chunk, Arrays]] = {}
    due = 0
    for chunk, arrays in made:
        waiting[chunk.index[0]] = chunk, arrays
        while due in waiting:
            yield waiting.pop(due)
            due += 1
