"""The command as a user runs it, and stops it."""

from __future__ import annotations

import csv
import json
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

Call = Callable[..., tuple[int, str, str]]  # exit code, stdout, stderr of a line


def unfolded(printed: str) -> str:
    """What was printed, each paragraph in one line again."""
    return re.sub(r"\n  (?=\S)", " ", printed)


def table_of(path: str) -> tuple[dict[str, Any], dict[str, list[str]]]:
    """What a file says of itself, and its columns."""
    with Path(path).open(encoding="utf-8") as file:
        told = json.loads(file.readline().removeprefix("# pendula: "))
        header, *rows = csv.reader(file)
    return told, {name: [row[i] for row in rows] for i, name in enumerate(header)}


def floats(column: list[str]) -> list[float]:
    """A column of a table as numbers."""
    return [float(each) for each in column]


READY = (
    "import sys; from pendula.cli import main\n"
    "print('ready', flush=True); sys.exit(main(sys.argv[1:]))"
)


def interrupted(
    folder: Path, line: str, when: float | Callable[[], bool], code: str = READY
) -> tuple[int, str, str]:
    """Run the command in a process of its own and press Ctrl-C.

    Args:
        folder: where.
        line: the command's arguments.
        when: so many seconds after the process is ready, or as soon as this is true.
        code: Python that runs the command and prints a line when it is ready.

    Returns:
        Exit code, what was printed after that line, and stderr.
    """
    with subprocess.Popen(
        [sys.executable, "-c", code, *line.split()],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline().strip() in ("ready", "computing")
        if callable(when):
            end = time.monotonic() + 60.0
            while not when() and time.monotonic() < end and process.poll() is None:
                time.sleep(0.01)
        else:
            time.sleep(when)
        process.send_signal(signal.SIGINT)
        printed, told = process.communicate(timeout=20)
    return process.returncode, printed, told
