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


# ---- progress of what takes long ----


def with_progress(folder: Path, command: str) -> subprocess.CompletedProcess[str]:
    script = ROOT / "scripts" / "with-progress"
    return subprocess.run(
        ["sh", script, "compiling", folder / "log" / "install.log", "sh", "-c", command],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


def test_what_takes_long_shows_how_far_it_is(tmp_path: Path) -> None:
    work = 'for i in 1 2; do echo "DEBUG [$i/2] Building CXX object"; sleep 1.5; done'
    done = with_progress(tmp_path, work)
    assert (done.returncode, done.stderr) == (0, "")
    first, *rest = done.stdout.splitlines()
    assert first == f"compiling; what it prints is in {tmp_path}/log/install.log"
    assert rest == ["compiling [1/2]", "compiling [2/2]"]
    assert [path.name for path in (tmp_path / "log").iterdir()] == ["install.log"]


def test_what_fails_shows_its_last_lines(tmp_path: Path) -> None:
    done = with_progress(tmp_path, "echo no such header >&2; exit 3")
    assert done.returncode == 3
    *lines, last = done.stderr.splitlines()
    assert lines == ["no such header"]
    assert last == f"pendula: compiling failed; all of it is in {tmp_path}/log/install.log"


def test_make_shows_the_progress_of_compiling_and_how_to_find_the_command() -> None:
    """What `make -n` would do; nothing is run."""
    command = ["make", "--no-print-directory", "-n", "-B", "study"]  # `make test` is a make, too
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert 'scripts/with-progress "compiling the core" build/install.log' in done.stdout
    assert done.stdout.splitlines()[-1].endswith('source .venv/bin/activate"')
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    lines = [line for line in readme.splitlines() if line.startswith("$ ")]
    assert lines[0].startswith("$ make study ")
    assert lines[1].startswith("$ source .venv/bin/activate ")
