"""The Python API's errors in the command's words: its arguments are options here."""

from __future__ import annotations

import re

import click

from pendula import _engine

_OTHER_NAMES = {
    "t": "the time",
    "state": "the start",
    "i": "the rod of an --event",
    "method": "--methods",
    "store": "--output",
    "shape": "--size",
    "t_max": "--until",
    **{
        name: f"--{name}"
        for name in (
            "step",
            "tolerance",
            "certify",
            "digits",
            "amplitude",
            "until",
            "points",
            "scheduler",
            "threads",
            "which",
            "separation",
        )
    },
}
_CALLS = {  # what Python would be told to write
    "give step=0.001 [s], say": "give --step 1ms, say",
    "take digits=12, say": "take --digits 12, say",
    "give state=(theta0, omega0)": "give --theta and --omega",
    "use solve": "use pendula solve",
    "overwrite=True": "--force",
    "resume=True": "--resume",
    "resolve=False": "--no-resolve",
    "run the same call again": "run the same command again with --resume",
    "run the call that made the store again": "run the command that made the store with --resume",
    "another folder or overwrite it": "another folder or pass --force",
}


def one_line(error: Exception) -> str:
    """The message of an error, in one line."""
    if isinstance(error, click.ClickException):
        return _joined(_as_command(error.format_message())) + _help_hint(error)
    if isinstance(error, MemoryError):
        return "not enough memory; ask for fewer outputs with a larger --every"
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    message = str(error) if isinstance(error, OSError) else _with_option_names(str(error))
    return _joined(_as_command(message))


def _as_command(message: str) -> str:
    """What Python would be told to write, as options."""
    for call, words in _CALLS.items():
        message = message.replace(call, words)
    return message


def _with_option_names(message: str) -> str:
    """`length must be …` is told as `--length must be …`."""
    name, rest = re.fullmatch(r"(\w*)(.*)", message, re.DOTALL).groups()  # type: ignore[union-attr]
    if rest.startswith((" must ", " is ", " = ", " needs ")):
        option = f"--{name}" if name in _option_names() else name
        message = _OTHER_NAMES.get(name, option) + rest
    return message


def _option_names() -> set[str]:
    entries = _engine.system_entries().values()
    parameters = {row.name for entry in entries for form in entry.forms for row in form.parameters}
    return parameters | {row.name for entry in entries for row in entry.components}


def _help_hint(error: click.ClickException) -> str:
    if not isinstance(error, click.UsageError) or error.ctx is None:
        return ""
    quotes = "a value with spaces needs quotes: '50 cm'; "
    spaces = quotes if "unexpected extra argument" in error.message else ""
    return f" ({spaces}see {error.ctx.command_path} --help)"


def _joined(message: str) -> str:
    return " ".join(message.split())
