"""The command as a process: what it loads, Ctrl-C, closed pipes and full disks."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from commands import interrupted

COMMAND = (sys.executable, "-m", "pendula")
HEAVY = ("numpy", "matplotlib", "rich", "pint", "xarray", "pandas")


@pytest.mark.parametrize(
    "line",
    [
        "",
        "solve double --help",
        "compare simple --help",
        "study --help",
        "sweep --help",
        "--version",
    ],
)
def test_help_loads_nothing_heavy(line: str) -> None:
    code = (
        "import sys; before = set(sys.modules)\n"
        "from pendula.cli import main\n"
        f"assert main({line.split()!r}) == 0\n"
        f"loaded = (set(sys.modules) - before) & set({HEAVY!r})\n"
        "assert not loaded, loaded\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.DEVNULL)


def test_methods_and_errors_load_no_numpy() -> None:
    code = (
        "import sys; from pendula.cli import main\n"
        "assert main(['methods']) == 0\n"
        "assert main(['solve', 'simple', '--lenght', '1']) == 2\n"
        "assert 'numpy' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)


@pytest.mark.parametrize(
    "line",
    [
        "solve double --method rk4 --step 1e-8 --t-max 1000s --every 1s -o x.csv",
        "solve double --t-max 1e12s --every 1e11s -o x.csv",
        "solve simple --t-max 1e6s --every 1e6s --certify 1rad -o x.csv",
        "solve double --t-max 500s --every 500s --digits 12 -o x.csv",
    ],
)
def test_ctrl_c_ends_a_long_run_without_a_file(line: str, tmp_path: Path) -> None:
    # by then it is in the loop, which would take a minute or an hour
    ended = interrupted(tmp_path, line, when=0.7)
    assert ended == (130, "", "pendula: interrupted\n")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("line", ["methods", "--help", "exact simple --t-max 1s"])
def test_a_closed_pipe_is_no_error(line: str) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    process = subprocess.run(
        [*COMMAND, *line.split()], stdout=writing, stderr=subprocess.PIPE, text=True, check=False
    )
    os.close(writing)
    assert (process.returncode, process.stderr) == (0, "")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
def test_a_full_disk_below_stdout_is_told_in_one_line() -> None:
    with Path("/dev/full").open("w") as full:
        process = subprocess.run(
            [*COMMAND, "methods"], stdout=full, stderr=subprocess.PIPE, text=True, check=False
        )
    assert (process.returncode, process.stderr) == (1, "pendula: No space left on device\n")


@pytest.mark.parametrize(("encoding", "drawn"), [("utf-8", True), ("latin-1", False)])
def test_a_curve_is_drawn_where_it_can_be_printed(encoding: str, drawn: bool) -> None:
    process = subprocess.run(
        [*COMMAND, *["exact", "simple", "--t-max", "1s"]],
        env={**os.environ, "PYTHONIOENCODING": encoding},
        capture_output=True,
        check=True,
    )
    assert ("│" in process.stdout.decode(encoding)) is drawn
    assert b"\x1b" not in process.stdout


@pytest.mark.skipif(os.name != "posix", reason="no shell here")
@pytest.mark.parametrize(
    ("line", "closed", "code"),
    [
        ("solve simple --t-max 1s --event 'flip 1'", ">&-", 0),
        ("--help", ">&-", 0),
        ("solve simple --lenght 1", ">&- 2>&-", 2),
        ("solve simple --lenght 1", "2>&-", 2),
        ("solve simple --t-max 1s --step 1ms --method rk4 -o x.csv", ">&- 2>&-", 0),
        ("solve simple --t-max 12s --step 1us --every 1s --method rk4 -o x.csv", "2>&-", 0),
        ("solve simple --t-max 12s --every 1s --certify 1e-9rad -o x.csv", "2>&-", 0),
    ],
)
def test_a_closed_stream_is_no_error(line: str, closed: str, code: int, tmp_path: Path) -> None:
    shell = ["sh", "-c", f'"$0" -m pendula {line} {closed}', sys.executable]
    process = subprocess.run(shell, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert process.returncode == code
    assert "Traceback" not in process.stderr
    assert process.stdout.startswith("x.csv: 13 times" if "12s" in line else "")
    assert code == 0 or process.stdout == ""


@pytest.mark.parametrize(("columns", "width"), [("40", 40), ("200", 79), ("5", 30)])
def test_curves_fit_the_terminal(columns: str, width: int) -> None:
    process = subprocess.run(
        [*COMMAND, *["exact", "simple", "--t-max", "1s"]],
        env={**os.environ, "COLUMNS": columns, "PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        check=True,
    )
    lines = process.stdout.decode().splitlines()
    assert {len(line) for line in lines if "│" in line} == {width}


def test_numbers_beyond_all_bounds_bring_no_warnings() -> None:
    line = "solve linear --theta 1e300rad --t-max 1s --step 1ms --method rk4"
    process = subprocess.run([*COMMAND, *line.split()], capture_output=True, check=True)
    assert process.stderr == b""
