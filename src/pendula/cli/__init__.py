"""The command `pendula`: parses, calls, prints; one module a subcommand."""

from __future__ import annotations

import signal
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; None: with the arguments of the process.

    Returns:
        The exit code: 0, 1 for a run that could not finish, 2 for wrong use, 130 for Ctrl-C.
    """
    interrupted = False

    def interrupt(number: int, frame: object) -> None:
        nonlocal interrupted
        interrupted = True
        raise KeyboardInterrupt

    usual = signal.getsignal(signal.SIGINT)
    if usual is signal.default_int_handler:  # otherwise the caller takes or ignores Ctrl-C
        signal.signal(signal.SIGINT, interrupt)
    try:
        from pendula.cli.app import run

        return run(arguments)
    except BaseException as error:  # a compiled module's import turns Ctrl-C into one of its own
        if not interrupted:
            raise
        reason = f"; {error}" if isinstance(error, KeyboardInterrupt) and str(error) else ""
        if sys.stderr is not None:  # print would take stdout in its place
            print(f"pendula: interrupted{reason}", file=sys.stderr)
        return INTERRUPTED
    finally:
        if signal.getsignal(signal.SIGINT) is interrupt:
            signal.signal(signal.SIGINT, usual)
