"""What a machine lacks is said in one line."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


def check(python: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run the check that `make` begins with."""
    return subprocess.run(
        ["sh", "scripts/check-machine", python],
        cwd=ROOT,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )


def test_this_machine_lacks_nothing() -> None:
    done = check(sys.executable)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (None, "is missing; install Python 3.11 or newer"),
        ("echo Python 3.9.2; exit 1", "is Python 3.9.2; 3.11 or newer is needed"),
        ('case "$*" in *ensurepip*) exit 1;; esac', "Python's venv module is missing"),
        ('case "$*" in *Python.h*) exit 1;; esac', "Python's headers are missing"),
    ],
)
def test_what_python_lacks(body: str | None, message: str, tmp_path: Path) -> None:
    python = tmp_path / "python"
    if body is not None:
        python.write_text(f"#!/bin/sh\n{body}\n", encoding="utf-8")
        python.chmod(0o755)
    done = check(str(python))
    assert done.returncode == 1
    assert message in done.stderr
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("compiler", "message"),
    [("no-such-compiler", "is missing; install g++ 12"), ("false", "does not compile C++20")],
)
def test_what_the_compiler_lacks(compiler: str, message: str) -> None:
    done = check(sys.executable, CXX=compiler)
    assert done.returncode == 1
    assert message in done.stderr
    assert done.stderr.count("\n") == 1
