"""Progress of work that consists of parts, and bars that show it."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from html import escape
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
Result = TypeVar("Result")

Progress = Callable[[float], None] | None
StepProgress = Callable[[str, float], None]  # what is being done, and the part that is done
AskedProgress = Progress | bool  # True: a bar

_MOMENT = 0.1  # seconds between two pictures of a bar in a notebook


def part(progress: Progress, start: float, end: float) -> Progress:
    """A callback for a part of the work that reports the part of the whole."""
    return progress and (lambda share: progress(start + (end - start) * share))


def with_bar(what: str) -> Callable[[Callable[P, Result]], Callable[P, Result]]:
    """Let a function take `progress=True`: a bar called `what` while it works.

    It is shown in a notebook, or on a terminal; elsewhere nothing is.
    """

    def decorate(function: Callable[P, Result]) -> Callable[P, Result]:
        @wraps(function)
        def called(*args: P.args, **kwargs: P.kwargs) -> Result:
            asked = kwargs.get("progress")
            if not isinstance(asked, bool):
                return function(*args, **kwargs)
            kwargs["progress"] = None
            if not asked:
                return function(*args, **kwargs)
            with _bar() as show:
                if show is not None:
                    kwargs["progress"] = lambda *told: show(": ".join((what, *told[:-1])), told[-1])
                return function(*args, **kwargs)

        return called

    return decorate


@contextmanager
def _bar() -> Iterator[StepProgress | None]:
    """Where there is a place for one, a bar that takes a label and the part that is done."""
    if _in_notebook():
        with notebook_bar() as show:
            yield show
    elif sys.stderr is not None and sys.stderr.isatty():
        with terminal_bar() as show:
            yield show
    else:
        yield None


@contextmanager
def terminal_bar() -> Iterator[StepProgress]:
    """A bar with the remaining time on the terminal of stderr, gone at the end."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda label, share: bar.update(task, description=label, completed=share)


@contextmanager
def notebook_bar() -> Iterator[StepProgress]:
    """A bar below the cell of a notebook that is running, which stays, with the time it took."""
    from IPython.display import display

    put: Any = display

    start = shown = time.monotonic()
    last, handle = ("", 0.0), None

    def show(label: str, share: float) -> None:
        nonlocal shown, last, handle
        last, now = (label, share), time.monotonic()
        if handle is None:  # a call that is refused shows none
            handle = put(_drawn(label, share, ""), raw=True, display_id=True)
        elif now - shown >= _MOMENT:
            shown, spent = now, now - start
            left = f", {_duration(spent * (1.0 - share) / share)} left" if share > 0.0 else ""
            handle.update(_drawn(label, share, left), raw=True)

    try:
        yield show
    finally:
        if handle is not None:
            handle.update(_drawn(*last, f", {_duration(time.monotonic() - start)}"), raw=True)


def _drawn(label: str, share: float, rest: str) -> dict[str, str]:
    """The bar as HTML and as text."""
    text = f"{label} {share:.0%}{rest}".strip()
    bar = f'<progress value="{share:.4f}" max="1" style="width: 20em"></progress>'
    return {"text/html": f"{bar} {escape(text)}", "text/plain": text}


def _duration(seconds: float) -> str:
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    minutes, rest = divmod(whole, 60)
    return f"{minutes} min {rest} s" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"


def _in_notebook() -> bool:
    """Whether this runs in a kernel, which notebooks talk to."""
    ipython: Any = sys.modules.get("IPython")
    return ipython is not None and hasattr(ipython.get_ipython(), "kernel")
