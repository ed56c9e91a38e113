"""The Python interface's arguments and calls in errors, as the command's options."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

from pendula._engine import option_unit
from pendula._messages import ArgumentError, Message, Naming, message_of

if TYPE_CHECKING:
    from collections.abc import Iterator

_ARGUMENTS = {  # those whose option has another name, or none
    "t": "--t-max",  # but `exact` may take --at: see `renaming`
    "state": "the start",
    "store": "--output",
    "shape": "--size",
    "i": "the rod of an --event",
    "events": "events",
    "language": "--lang",
}
_GIVEN = {
    "overwrite=True": "--force",
    "resume=True": "--resume",
    "resolve=False": "--no-resolve",
    "state=(theta0, omega0)": "--theta and --omega",
    "t=numpy.linspace(t0, t_end, 1001)": "--every",
}
_CALLS = {
    "the same call again": "the same command again with --resume",
    "the call that made the store again": "the command that made the store again with --resume",
}


class CommandNaming(Naming):
    """How the command shows arguments: as its options.

    Args:
        command: whose options they are, and those of its subcommands.
    """

    def __init__(self, command: click.Command) -> None:
        self._options = dict(_options_of(command)) | _ARGUMENTS

    def argument(self, name: str) -> str:
        """The option for an argument; what is none stays as it is."""
        return self._options.get(name, name)

    def given(self, name: str, value: str) -> str:
        """The option with a value, in its SI unit."""
        argument = f"{name}={value}"
        return _GIVEN.get(argument, f"{self.argument(name)} {value}{option_unit(name)}")

    def call(self, name: str) -> str:
        """The subcommand of that name."""
        return _CALLS.get(name, f"pendula {name}")

    def one_line(self, error: Exception) -> str:
        """What an error says, in one line."""
        if isinstance(error, MemoryError):
            return "not enough memory; ask for fewer outputs with a larger --every"
        if isinstance(error, click.ClickException):
            message, hint = error.format_message(), _help_hint(error)
        elif isinstance(error, OSError) and error.strerror:
            place = f"{error.filename}: " if error.filename else ""
            message, hint = f"{place}{error.strerror}", ""
        else:
            message, hint = message_of(error), ""
        text = message.named(self) if isinstance(message, Message) else message
        return " ".join(text.split()) + hint


@contextmanager
def renaming(**names: str) -> Iterator[None]:
    """Call arguments by other names in errors: `t` by that of the option it was made from."""
    try:
        yield
    except ArgumentError as error:
        made = error.message
        if made.argument not in names:
            raise
        name = names[made.argument]
        raise ArgumentError(name, made.rule, made.way_out, **made.details) from None


def _options_of(command: click.Command) -> Iterator[tuple[str, str]]:
    """Each option's name in Python, and the long one on the command line."""
    for each in command.params:
        if isinstance(each, click.Option) and each.name:
            yield each.name, max(each.opts, key=len)
    if isinstance(command, click.Group):
        for subcommand in command.commands.values():
            yield from _options_of(subcommand)


def _help_hint(error: click.ClickException) -> str:
    if not isinstance(error, click.UsageError) or error.ctx is None:
        return ""
    return f" (see {error.ctx.command_path} --help)"
