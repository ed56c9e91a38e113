"""How far long work has come: a bar on a terminal, plain lines otherwise."""

from __future__ import annotations

import sys
import time
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


_MOMENT = 0.7  # seconds


@contextmanager
def progress_bar() -> Iterator[Callable[[str, float], None]]:
    """A bar with the remaining time on a terminal, a line for each part of the work otherwise."""
    if not sys.stderr.isatty():
        yield _lines()
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda label, share: bar.update(task, description=label, completed=share)


@contextmanager
def late_bar(label: str) -> Iterator[Callable[[float], None] | None]:
    """A bar, on a terminal, for work that may take long: it is shown once it does."""
    if not sys.stderr.isatty():
        yield None
        return
    start, shown = time.monotonic(), None
    with ExitStack() as stack:

        def progress(share: float) -> None:
            nonlocal shown
            if shown is None and time.monotonic() - start > _MOMENT:
                shown = stack.enter_context(progress_bar())
            if shown is not None:
                shown(label, share)

        yield progress


def _lines() -> Callable[[str, float], None]:
    told = ""

    def progress(label: str, share: float) -> None:
        nonlocal told
        if label != told:
            click.echo(f"{share:4.0%} {label}", err=True)
        told = label

    return progress
