"""Shared by the commands that write a store chunk by chunk, here or on a cluster."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pendula._messages import message_of

if TYPE_CHECKING:
    from collections.abc import Iterator


def store_options() -> list[click.Option]:
    """Where to compute, and what to do with an existing store."""
    return [
        click.Option(
            ["--scheduler"],
            metavar="ADDRESS",
            help="compute on a Dask cluster, e.g. tcp://host:8786",
        ),
        click.Option(
            ["--threads"],
            type=int,
            metavar="N",
            help="threads per chunk [default: one per processor; 1 on a cluster]",
        ),
        click.Option(["--resume"], is_flag=True, help="resume the store if it exists"),
        click.Option(["--force"], is_flag=True, help="overwrite existing files"),
    ]


def check_store_options(given: dict[str, Any]) -> None:
    """Refuse --resume together with --force.

    Raises:
        click.UsageError: where both are asked for.
    """
    if given["resume"] and given["force"]:
        raise click.UsageError("--resume and --force exclude one another; name one of them")


@contextmanager
def cluster(scheduler: str | None) -> Iterator[Any]:
    """The client of a scheduler, closed at the end; None without one. Errors are one line."""
    import logging

    from pendula.many.chunks import connect

    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # its errors are shown in one line
    client = None if scheduler is None else connect(scheduler)
    try:
        yield client
    except RuntimeError as error:  # of the cluster
        raise click.ClickException(message_of(error)) from error
    finally:
        if client is not None:
            client.close()


@contextmanager
def telling_how_to_resume(given: dict[str, Any]) -> Iterator[None]:
    """Add to Ctrl-C how to resume."""
    out, way = given["out"], "the same command and --resume"
    if given["force"]:
        way = "the same command with --resume, not --force"
    try:
        yield
    except KeyboardInterrupt as stopped:
        if out is None or Path(out).suffix != ".zarr":
            hint = "nothing is written; a .zarr store would be resumable"
        elif str(stopped):  # how much is in the store
            hint = f"{stopped}; resume with {way}"
        else:
            hint = f"{way} resumes {out}"
        raise KeyboardInterrupt(hint) from None
