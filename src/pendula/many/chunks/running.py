"""Runs chunked work: here or on a cluster, into memory or into a store."""

from __future__ import annotations

import math
import os
from contextlib import closing
from typing import TYPE_CHECKING, Any

from pendula._checks import check_threads, checked_progress, extra
from pendula._messages import one_line
from pendula._progress import with_bar
from pendula.many.chunks.cluster import check_client, spread
from pendula.many.chunks.places import place_at
from pendula.many.chunks.store import Store

if TYPE_CHECKING:
    from collections.abc import Generator, Iterable, Iterator, Mapping

    import xarray as xr

    from pendula._progress import AskedProgress, Progress
    from pendula.many.chunks.work import Arrays, Chunk, Index, Work


@with_bar("work")
def run(
    work: Work,
    store: str | os.PathLike[str] | None = None,
    *,
    client: Any = None,
    progress: AskedProgress = None,
    threads: int | None = None,
    resume: bool = True,
    overwrite: bool = False,
) -> xr.Dataset:
    """Compute all chunks; the result depends on neither place, order nor interruptions.

    Args:
        work: what is computed.
        store: a path, or a URL such as s3://bucket/flips.zarr: a Zarr store, written chunk by
            chunk. The same call resumes a run that was stopped or killed. None: the
            result is made in memory.
        client: a Client of dask.distributed, whose workers compute (extra: cluster).
        progress: called with the part of the work that is done, 0 to 1; True: a bar, in a
            notebook or a terminal.
        threads: for each chunk. None: all cores here, one on a worker.
        resume: resume an existing store; else it is refused.
        overwrite: empty an existing store, whatever it holds, and start again.

    Returns:
        The dataset (extra: io); one in a store is read from there when it is used.

    Raises:
        ValueError: where the store has other inputs, or the client is none.
        FileExistsError: where something else is there, or a store with `resume` not set.
        OSError: where the store cannot be written, or another process writes it.
        KeyboardInterrupt: at Ctrl-C; it says how many chunks are in the store.
    """
    threads = check_threads(threads)
    report: Progress = checked_progress(progress)
    if client is not None:
        check_client(client)
    extra("xarray", "io")
    if store is None:
        return _in_memory(work, client, report, threads)
    _into_store(store, work, client, report, threads, resume=resume, overwrite=overwrite)
    return opened(store)


def opened(store: str | os.PathLike[str]) -> xr.Dataset:
    """The dataset of a store, read when it is used.

    A store whose chunks are not all there has the attribute "unfinished", and the variables' fill
    value for what is missing.

    Raises:
        FileNotFoundError: where there is no store.
        ValueError: for a store that cannot be read; later, where a chunk that is used is damaged,
            or missing though the store was finished.
    """
    xarray, _ = extra("xarray", "io"), extra("zarr", "io")
    from pendula.many.chunks.reading import checked_store

    try:
        dataset: xr.Dataset = xarray.open_zarr(checked_store(store), chunks=None, zarr_format=3)
    except FileNotFoundError:
        raise FileNotFoundError(f"no such store: {store}") from None
    except Exception as error:  # the libraries raise whatever they like
        raise ValueError(
            f"{store} cannot be read as a store of pendula: {one_line(error)}"
        ) from error
    return dataset


def computed(
    work: Work,
    indices: Iterable[Index] | None = None,
    *,
    client: Any = None,
    progress: Progress = None,
    threads: int | None = None,
) -> Generator[tuple[Chunk, Arrays], None, None]:
    """Chunks with their arrays, as they are ready; all of them where no indices are given."""
    wanted = dict.fromkeys(work.indices() if indices is None else indices)
    leaders = [each for each in wanted if not _second(work, each, wanted)]
    report = _Report(work, wanted, progress)
    for chunk, arrays in _each(work, leaders, client, report, threads):
        checked = work.checked(chunk, arrays)
        yield chunk, checked
        report.done += math.prod(chunk.shape)
        other = work.mirror(chunk.index)
        if other != chunk.index and other in wanted:
            yield work.chunk(other), work.reflected(checked)
            report.done += math.prod(chunk.shape)
        report.share()


class _Report:
    """Reports to the caller how much of the whole is done."""

    def __init__(self, work: Work, wanted: Mapping[Index, None], progress: Progress) -> None:
        self._work, self._wanted, self._progress = work, wanted, progress
        self._all = math.prod(axis.size for axis in work.cut)
        self.done = self._all - sum(math.prod(work.chunk(each).shape) for each in wanted)
        self.share()

    def share(self, cells: float = 0.0) -> None:
        """Report the share, with so many cells of a chunk that is under way."""
        if self._progress is not None:
            self._progress((self.done + cells) / self._all)

    def within(self, chunk: Chunk) -> Progress:
        """The progress callback of one chunk."""
        if self._progress is None:
            return None
        pair = {chunk.index, self._work.mirror(chunk.index)}
        cells = math.prod(chunk.shape) * sum(each in self._wanted for each in pair)
        return lambda share: self.share(share * cells)


def _each(
    work: Work, indices: list[Index], client: Any, report: _Report, threads: int | None
) -> Iterator[tuple[Chunk, Arrays]]:
    """Compute these chunks, here or on the workers."""
    chunks = map(work.chunk, indices)
    if client is None:
        return ((chunk, work.compute(chunk, threads, report.within(chunk))) for chunk in chunks)
    return spread(work.compute, chunks, client, threads)


def _second(work: Work, index: Index, wanted: Mapping[Index, None]) -> bool:
    """Whether a chunk is made as the mirror image of another."""
    other = work.mirror(index)
    return other < index and other in wanted


def _into_store(
    store: str | os.PathLike[str],
    work: Work,
    client: Any,
    progress: Progress,
    threads: int | None,
    *,
    resume: bool,
    overwrite: bool,
) -> None:
    place = place_at(store)
    with place.locked():
        target = Store(place, work)
        missing = target.begin(resume=resume, overwrite=overwrite)
        made = computed(work, missing, client=client, progress=progress, threads=threads)
        try:
            with closing(made):
                for chunk, arrays in made:
                    target.put(chunk, arrays)
        except KeyboardInterrupt:
            raise KeyboardInterrupt(target.summary()) from None
        target.finish()


def _in_memory(work: Work, client: Any, progress: Progress, threads: int | None) -> xr.Dataset:
    import numpy as np

    xarray = extra("xarray", "io")
    whole = {each.name: np.empty(work.shape(each), each.dtype) for each in work.variables}
    made = computed(work, client=client, progress=progress, threads=threads)
    with closing(made):
        for chunk, arrays in made:
            for each in work.variables:
                whole[each.name][tuple(chunk[dim] for dim in each.dims)] = arrays[each.name]
    dataset: xr.Dataset = xarray.Dataset(
        {each.name: (each.dims, whole[each.name], dict(each.attrs)) for each in work.variables},
        coords={
            axis.name: (axis.name, axis.values, dict(axis.attrs))
            for axis in work.axes
            if axis.values is not None
        },
        attrs=work.attributes,
    )
    return dataset
