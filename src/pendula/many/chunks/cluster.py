"""Chunks on the workers of a Dask cluster."""

from __future__ import annotations

import logging
import re
import time
import uuid
from typing import TYPE_CHECKING, Any

from pendula._checks import extra
from pendula._messages import ArgumentError, Message
from pendula._version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from pendula.many.chunks.work import Arrays, Chunk, Compute

_AHEAD = 2  # tasks for each thread of the workers: one runs, one waits
_ADDRESS = re.compile(r"((tcp|tls|ws|wss|ucx|inproc)://)?(\[[^\s\]]+\]|[^\s:/]+):\d+")
_PATIENCE = "10s"  # for a scheduler to answer
_MOMENT, _UNATTENDED = 0.01, 5.0  # between looks at results, and at the workers [s]
_LOG = logging.getLogger("pendula")


def connect(scheduler: str) -> Any:
    """A Client of the scheduler at an address such as tcp://host:8786 (extra: cluster).

    Raises:
        ValueError: for what is no address.
        ConnectionError: where no scheduler answers.
    """
    distributed = extra("distributed", "cluster")
    if not _ADDRESS.fullmatch(scheduler):
        raise ArgumentError(
            "scheduler",
            "must be an address such as tcp://localhost:8786, got {value}",
            "it is what dask scheduler prints when it starts",
            value=scheduler,
        )
    try:
        return distributed.Client(scheduler, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError) as error:
        raise ConnectionError(
            f"no Dask scheduler answers at {scheduler!r} ({error}); start one with: dask scheduler"
        ) from error


def check_client(client: Any) -> None:
    """Refuse what is not a Client of dask.distributed.

    Raises:
        ValueError: for anything else, such as an address.
    """
    if not isinstance(client, extra("distributed", "cluster").Client):
        raise ArgumentError(
            "client",
            "must be a Client of dask.distributed, such as "
            'distributed.Client("tcp://host:8786"), got {value}',
            value=client,
        )


def spread(
    compute: Compute, chunks: Iterable[Chunk], client: Any, threads: int | None
) -> Iterator[tuple[Chunk, Arrays]]:
    """Each chunk with its arrays, in the order in which they are ready.

    Only so many tasks are submitted that their results fit in memory. A
    chunk whose worker dies is computed by another; they are cancelled when the caller stops.

    Raises:
        RuntimeError: where a chunk ended several workers, or the scheduler is gone.
    """
    distributed = extra("distributed", "cluster")
    run, waiting = uuid.uuid4().hex, iter(chunks)
    ready = distributed.as_completed(loop=client.loop, with_results=True)
    under_way: dict[Any, Chunk] = {}

    def submit() -> None:
        """Submit as many tasks as the workers have room for; workers may come and go."""
        room = max(1, _AHEAD * sum(client.nthreads().values()))
        while len(under_way) < room and (chunk := next(waiting, None)) is not None:
            name = f"pendula-{run}-{'-'.join(map(str, chunk.index))}"
            arguments = compute, chunk, threads or 1, __version__
            future = client.submit(_computed, *arguments, key=name, pure=False)
            under_way[future] = chunk
            ready.add(future)

    try:
        submit()
        while under_way:
            future, arrays = _next(ready, client)
            if isinstance(arrays, Exception):  # of a task that was cancelled
                raise arrays
            yield under_way.pop(future), arrays
            del future  # the workers may forget it
            submit()
    except Exception as error:
        lost = distributed.KilledWorker, distributed.CancelledError
        if client.status == "running" and not isinstance(error, lost):
            raise  # the chunk's own
        raise RuntimeError(_reason(error)) from error
    finally:
        if client.status == "running":
            client.cancel(list(under_way))


def _next(ready: Any, client: Any) -> Any:
    """The next result; warns where there is no worker to make one, as that may take long."""
    looked, warned = time.monotonic(), False
    while not ready.has_ready():
        time.sleep(_MOMENT)
        if not warned and time.monotonic() - looked > _UNATTENDED:
            looked, warned = time.monotonic(), not client.nthreads()
            if warned:
                _LOG.warning("no worker is at %s; waiting for one", client.scheduler.address)
    return next(ready)


def _computed(compute: Compute, chunk: Chunk, threads: int, version: str) -> Arrays:
    """What runs on a worker."""
    if version != __version__:
        raise RuntimeError(
            f"the worker has pendula {__version__}, the caller {version}; install the same"
        )
    return compute(chunk, threads, None)


def _reason(error: Exception) -> Message:
    """What a cluster's failure was, in one line, and the way out."""
    killed = getattr(error, "allowed_failures", None)
    if killed is not None:
        name = str(getattr(error, "task", "")).partition("-")[2].partition("-")[2]
        return Message(
            "",
            "{count} workers ended with chunk ({text}) or one beside it; see their logs, or take "
            "smaller chunks or workers with more memory; what is complete is kept",
            count=killed + 1,
            text=name.replace("-", ", "),
        )
    return Message(
        "",
        "the cluster dropped the work ({text}); mend it, then run <call=the same call again>; "
        "what is complete is kept",
        text=getattr(error, "reason", type(error).__name__),
    )
