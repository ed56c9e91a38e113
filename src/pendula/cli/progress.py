"""Progress of long work: a bar on a terminal, plain lines otherwise."""

from __future__ import annotations

import sys
import time
from contextlib import ExitStack, contextmanager
from datetime import timedelta
from typing import TYPE_CHECKING

import click

from pendula._progress import terminal_bar

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


_MOMENT = 0.7  # seconds


@contextmanager
def progress_bar() -> Iterator[Callable[[str, float], None]]:
    """A bar with the remaining time on a terminal, a line for each part of the work otherwise."""
    if not sys.stderr.isatty():
        yield _lines()
        return
    with terminal_bar() as bar:
        yield bar


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


@contextmanager
def work_bar(label: str, total: int, unit: str) -> Iterator[Callable[[float], None]]:
    """A bar with rate and remaining time for many equal units, a line for each tenth otherwise.

    The rate is that of this run: chunks that a store already holds do not count.

    Args:
        label: what is done: "Sweep".
        total: how many there are.
        unit: what they are: "rows".
    """
    pace = _Pace(total, unit)
    if sys.stderr.isatty():
        with progress_bar() as bar:
            yield lambda share: bar(f"{label}: {pace.text(share)}", share)
        return
    tenth = 0

    def progress(share: float) -> None:
        nonlocal tenth
        done = pace.text(share)
        if int(10 * share) > tenth and pace.elapsed > _MOMENT:
            click.echo(f"{share:4.0%} {label}: {done}{pace.left(share)}", err=True)
            tenth = int(10 * share)

    yield progress


class _Pace:
    """Units done in a second, since the first report."""

    def __init__(self, total: int, unit: str) -> None:
        self._total, self._unit = total, unit
        self._first: tuple[float, float] | None = None  # share and moment

    @property
    def elapsed(self) -> float:
        """Since the work began [s]."""
        return 0.0 if self._first is None else time.monotonic() - self._first[1]

    def rate(self, share: float) -> float:
        """Units a second."""
        if self._first is None:
            self._first = share, time.monotonic()
        done = (share - self._first[0]) * self._total
        return done / self.elapsed if self.elapsed > 0.0 else 0.0

    def text(self, share: float) -> str:
        """How many are done, and how many a second."""
        rate, done = self.rate(share), round(share * self._total)
        number = f"{rate:.0f}" if rate >= 99.5 else f"{rate:.2g}"
        pace = f", {number} {self._unit}/s" if rate else ""
        return f"{done} of {self._total} {self._unit}{pace}"

    def left(self, share: float) -> str:
        """The time that the rest will take."""
        rate = self.rate(share)
        seconds = round((1.0 - share) * self._total / rate) if rate else 0
        return f", {timedelta(seconds=seconds)} left" if seconds else ""


def _lines() -> Callable[[str, float], None]:
    last = ""

    def progress(label: str, share: float) -> None:
        nonlocal last
        if label != last:
            click.echo(f"{share:4.0%} {label}", err=True)
        last = label

    return progress
