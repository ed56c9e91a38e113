"""The command, and how it ends: an error is one line on stderr and an exit code."""

from __future__ import annotations

import io
import os
import sys
import warnings
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from typing import TYPE_CHECKING

import click

from pendula._checks import MissingExtraError
from pendula._version import __version__
from pendula.cli import (
    animate,
    chaos,
    compare,
    exact,
    fit,
    lab,
    map,
    methods,
    period,
    rerun,
    show,
    solve,
    study,
    sweep,
)
from pendula.cli.groups import ChoiceGroup
from pendula.cli.naming import CommandNaming

if TYPE_CHECKING:
    from collections.abc import Sequence

FAILED, WRONG_USE = 1, 2
_COMPLETE = "_PENDULA_COMPLETE"  # a shell sets it, to be given its script or words
_OLD_OPTIONS = {"until": "t-max"}  # what options were called before is still read
BAD_PATH = (
    FileExistsError,
    FileNotFoundError,
    IsADirectoryError,
    NotADirectoryError,
    PermissionError,
)


@click.group(
    cls=ChoiceGroup,
    kind="command",
    epilog="Quantities take units: 50cm, 30deg, 9.81m/s^2; angles need one, others are SI.",
    context_settings={
        "help_option_names": ["-h", "--help"],
        "token_normalize_func": lambda name: _OLD_OPTIONS.get(name, name),
    },
)
@click.version_option(__version__, message="pendula %(version)s")
def _pendula() -> None:
    """A laboratory for the simple and the double pendulum."""


_COMMANDS = (
    solve,
    exact,
    rerun,
    period,
    methods,
    compare,
    chaos,
    map,
    sweep,
    animate,
    show,
    lab,
    fit,
    study,
)
for module in _COMMANDS:
    _pendula.add_command(module.command)


def run(arguments: Sequence[str] | None) -> int:
    """Run the command and return its exit code; Ctrl-C is left to the caller."""
    given = list(sys.argv[1:] if arguments is None else arguments) or ["--help"]
    with (
        Path(os.devnull).open("w", encoding="utf-8") as nowhere,  # a closed stream is None
        redirect_stdout(sys.stdout or nowhere),
        redirect_stderr(sys.stderr or nowhere),
        warnings.catch_warnings(),
    ):
        warnings.showwarning = _tell
        return _complete() if _COMPLETE in os.environ else _run(given)


def _tell(message: Warning | str, *_: object, **__: object) -> None:
    """Show a warning in one line, without the code that it came from."""
    print(f"pendula: warning: {message}", file=sys.stderr)


def _complete() -> int:
    """Give a shell its script, or the words that can follow."""
    from click.shell_completion import shell_complete

    return shell_complete(_pendula, {}, "pendula", _COMPLETE, os.environ[_COMPLETE])


def _run(given: list[str]) -> int:
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")  # an ASCII terminal gets "?" for "§"
    try:
        with _pendula.make_context("pendula", given) as context:
            _pendula.invoke(context)
        sys.stdout.flush()
    except click.exceptions.Exit as end:
        return end.exit_code
    except BrokenPipeError:  # the reader has seen enough, as `head` does
        _end_output()
        return 0
    except (click.ClickException, MissingExtraError, ValueError, OSError, MemoryError) as error:
        print(f"pendula: {CommandNaming(_pendula).one_line(error)}", file=sys.stderr)
        _end_output()
        return _exit_code(error)
    return 0


def _exit_code(error: Exception) -> int:
    if isinstance(error, click.ClickException):
        return error.exit_code
    return WRONG_USE if isinstance(error, (ValueError, *BAD_PATH)) else FAILED


def _end_output() -> None:
    """Drop what a closed pipe or a full disk did not take, or it would fail again at the exit."""
    try:
        sys.stdout.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
