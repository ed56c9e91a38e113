"""What a terminal of 80 columns shows, and what a shell is told of the words that can follow."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click
import pytest

from commands import unfolded
from pendula import DoublePendulum, SimplePendulum, ensemble, exact, flip_map, solve
from pendula.cli import animate, app
from pendula.cli.tables import paragraph, table

if TYPE_CHECKING:
    from collections.abc import Iterator

    from commands import Call

COMMAND = [sys.executable, "-m", "pendula"]


def paths(command: click.Command, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """The words of each command and subcommand."""
    yield path
    if isinstance(command, click.Group):
        for name, each in command.commands.items():
            yield from paths(each, (*path, name))


EVERY = list(paths(app._pendula))
BODIES = DoublePendulum.bodies(1.2, 0.7, 1 / 3, 1 / 7, 1 / 3, 1 / 70, 1 / 60)
WRITTEN = {
    "run.nc": lambda: solve(BODIES, (1 / 3, -1 / 7, -1e-9, 1 / 70), 2.0).save("run.nc"),
    "many.nc": lambda: ensemble(BODIES, [(0.1, 0.2, 0.0, 0.0)] * 3, 1.0).save("many.nc"),
    "grid.nc": lambda: exact(SimplePendulum(1 / 3, 1 / 7, 1 / 70), [(0.1, 0.2)] * 3, 1.0).save(
        "grid.nc"
    ),
    "map.nc": lambda: flip_map(BODIES, (0, 1 / 3), (0, 1 / 7), (3, 3), 1 / 3).to_netcdf(
        "map.nc", engine="h5netcdf"
    ),
}


@pytest.mark.parametrize("path", EVERY, ids=" ".join)
def test_help_fits_and_is_not_cut(path: tuple[str, ...], call: Call) -> None:
    short, long = (call(" ".join((*path, option))) for option in ("-h", "--help"))
    assert short == long
    assert (short[0], short[2]) == (0, "")
    assert max(map(len, short[1].splitlines())) <= 80
    assert "..." not in short[1]


@pytest.mark.parametrize(
    "line",
    [
        "methods",
        "solve double --t-max 40s --certify 1e-9rad --theta1 -0.001rad --theta2 -1e-9rad",
        "solve double --t-max 9s --every 9s --event 'angle 1 -0.00123456789rad every-turn rising'",
        "solve linear --t-max 9s --event 'angle 1 0rad' --event 'tip-height 7m' --theta 1e-9rad",
        "solve double --t-max 2s --every 1s --digits 12",
        "solve double --t-max 4s --method gauss8 --step 0.00123s -o a-rather-long-name.csv",
        "exact simple --theta -1e-9rad --omega -1e-9rad/s --t-max -1000s",
        "period simple --amplitude 0.0001deg",
        "period simple --theta 0.0001deg --omega -0.0001rad/s",
        "compare double --t-max 1s --points 2",
        "compare simple --t-max 1s --points 2 --theta 179.999deg",
        "map flip double --size 3 --t-max 0.1s",
        "map divergence double --size 3 --t-max 0.1s",
        "sweep rows.toml -o rows.parquet",
        "show run.nc",
        "show many.nc",
        "show grid.nc",
        "show map.nc",
        "show rows.toml --row 0",
    ],
)
def test_80_columns_hold_what_is_printed(line: str, call: Call) -> None:
    recipe = '[system]\nkind = "simple"\n[state]\ntheta = {list = ["1 rad", "1e9 rad"]}\n'
    Path("rows.toml").write_text(f'{recipe}[run]\nt_max = "1 s"\n')
    for name in re.findall(r"\w+\.nc", line):
        WRITTEN[name]()
    code, printed, _ = call(line)
    assert code == 0
    assert max(map(len, printed.splitlines())) <= 80


def test_a_paragraph_is_cut_at_words_and_keeps_names_whole() -> None:
    name = "a" * 100 + ".csv"
    text = f"{name}: 10 times; rk4, step 0.001 s: {'many words ' * 12}\nand another"
    folded = paragraph(text)
    assert name in folded.splitlines()[0]
    assert max(map(len, folded.splitlines()[1:])) <= 79
    assert " ".join(unfolded(folded).split()) == " ".join(text.split())


def test_a_header_of_two_lines_stands_above_its_column() -> None:
    assert table(["n", "a\nb"], [["1", "2.5"]]) == "     a\nn    b\n1  2.5"


# ---- upper and lower case ----


@pytest.mark.parametrize(
    ("given", "same"),
    [
        ("solve simple --method RK4 --step 10ms", "solve simple --method rk4 --step 10ms"),
        ("SOLVE Simple --method Taylor", "solve simple --method taylor"),
        ("Solve DOUBLE --method DOP853", "solve double --method dop853"),
    ],
)
def test_names_are_taken_in_any_case(given: str, same: str, call: Call) -> None:
    assert call(f"{given} --t-max 1s") == call(f"{same} --t-max 1s")


def test_compare_takes_methods_in_any_case(call: Call) -> None:
    code, printed, _ = call("compare simple --t-max 1s --points 2 --methods RK4,Gauss8,rk4")
    assert code == 0
    assert [line.split()[0] for line in printed.splitlines()[2:4]] == ["rk4", "gauss8"]


# ---- completion ----


def completed(words: str, **environment: str) -> list[str]:
    """The words that bash is offered after these."""
    given = words.split(" ")
    done = subprocess.run(
        COMMAND,
        env={
            **os.environ,
            "_PENDULA_COMPLETE": "bash_complete",
            "COMP_WORDS": words,
            "COMP_CWORD": str(len(given) - 1),
            **environment,
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return [line.partition(",")[2] for line in done.stdout.split()]


@pytest.mark.parametrize(
    ("words", "offered"),
    [
        ("pendula ", list(app._pendula.commands)),
        ("pendula so", ["solve"]),
        ("pendula solve ", ["linear", "simple", "double", "driven", "damped-double"]),
        ("pendula exact d", []),
        ("pendula animate ", list(animate.command.commands)),
        ("pendula animate do", ["double"]),
        ("pendula animate run", ["run"]),
        ("pendula animate run.csv --sp", ["--speed"]),
        ("pendula solve simple --t-m", ["--t-max"]),
        ("pendula solve double --method gau", ["gauss4", "gauss6", "gauss8"]),
        ("pendula map flip double --theta", ["--theta1", "--theta2"]),
        ("pendula study --lang e", ["en", "es"]),
    ],
)
def test_a_shell_is_offered_what_can_follow(words: str, offered: list[str]) -> None:
    assert completed(words) == offered


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_shell_is_given_its_script(shell: str) -> None:
    done = subprocess.run(
        COMMAND,
        env={**os.environ, "_PENDULA_COMPLETE": f"{shell}_source"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert f"_PENDULA_COMPLETE={shell}_complete" in done.stdout
    assert "Usage" not in done.stdout
    if shutil.which(shell):
        subprocess.run([shell, "-n"], input=done.stdout, text=True, check=True)
