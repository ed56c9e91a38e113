"""What the command shows of a run and leaves out, and where it says so."""

from __future__ import annotations

import json
import math
import re
import shlex
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import pendula
from commands import unfolded
from pendula import _engine
from pendula.cli import main

if TYPE_CHECKING:
    from collections.abc import Callable

    Lines = Callable[[str], list[str]]

START = [row.standard for row in _engine.system_entries()["double"].components]


def test_every_event_is_printed_or_it_is_said_how_many_are_not(lines_of: Lines) -> None:
    some = lines_of("solve simple --t-max 100s --every 100s --event 'velocity-zero 1'")
    title, _, _, *rows = some[some.index("") + 1 :]
    assert title == "velocity-zero 1: 97 times"
    assert [int(row.split()[0]) for row in rows] == list(range(1, 98))  # half a period is 1.0207 s
    many = lines_of(
        "solve simple --t-max 400s --every 400s --event 'velocity-zero 1' --event 'flip 1'"
    )
    title, _, _, *rows, more, none = many[many.index("") + 1 :]
    assert title == "velocity-zero 1: 391 times"
    assert [int(row.split()[0]) for row in rows] == list(range(1, 101))
    assert more == "100 of 391 shown; --events-file FILE writes all"
    assert none == "flip 1: none"


@pytest.mark.parametrize("ending", ["csv", "json"])
def test_all_events_go_into_a_file(ending: str, lines_of: Lines, tmp_path: Path) -> None:
    line = (
        "solve double --t-max 9s --event 'flip 2' --event 'tip-height 5m' --event 'flip 2 rising'"
    )
    lines = lines_of(f"{line} -o run.csv --events-file found.{ending}")
    run = pendula.load("run.csv")
    asked = ("flip 2", "tip-height 5m", "flip 2 rising")
    truth = [
        [name, n, t, *state]
        for name, found in zip(asked, run.events, strict=True)
        for n, (t, state) in enumerate(zip(*(each.tolist() for each in found), strict=True), 1)
    ]
    assert len(truth) > 5
    assert lines[-1] == f"found.{ending}: {len(truth)} events"
    header = ["event", "n", "t [s]", "theta1 [rad]", "theta2 [rad]"]
    text = (tmp_path / f"found.{ending}").read_text(encoding="utf-8")
    if ending == "json":
        data = json.loads(text)
        rows = [list(row.values()) for row in data["rows"]]
        names = list(data["rows"][0])
    else:
        mark, first, *rest = text.splitlines()
        data, names = json.loads(mark.partition(":")[2]), first.split(",")
        cells = [line.split(",") for line in rest]
        rows = [[row[0], int(row[1]), *map(float, row[2:])] for row in cells]
    assert rows == truth
    assert names[:5] == header
    assert data["system"] == run.system.description()
    assert (data["method"], data["state"]) == ("taylor", START)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ("--events-file found.csv", "--events-file needs events to write"),
        ("--event 'flip 1' --events-file found.txt", "must end in .csv or .json"),
        ("--event 'flip 1' --events-file run.csv -o run.csv", "must differ from --output"),
        ("--event 'flip 1' --events-file there.csv", "there.csv exists"),
    ],
)
def test_a_file_of_events_that_cannot_be_written_is_refused_first(
    options: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    (tmp_path / "there.csv").touch()
    assert main(shlex.split(f"solve simple --t-max 1s {options}")) == 2
    captured = capsys.readouterr()
    assert message in captured.err
    assert captured.err.count("\n") == 1
    assert not captured.out
    assert [each.name for each in tmp_path.iterdir()] == ["there.csv"]


@pytest.mark.parametrize(
    ("line", "count"),
    [
        ("solve simple --method rk4 --step 1ms --t-max 1s", 1001),
        ("exact simple --t-max 1s", 501),
        ("solve simple --t-max -2s --every 100ms", 21),
    ],
)
def test_a_shortened_table_says_so(line: str, count: int, lines_of: Lines) -> None:
    lines = lines_of(line)
    assert lines[12] == f"11 of {count} times shown; -o FILE writes all"
    assert not any("shown" in each for each in lines_of(f"{line} -o run.csv"))
    assert not any(
        "shown" in each for each in lines_of(line.replace("100ms", "500ms")) if "every" in line
    )


@pytest.mark.parametrize(
    ("line", "place"),
    [
        ("solve simple --method rk4 --step 10ms --t-max 1s", ""),
        ("solve simple --t-max -1s", ""),
        ("solve double --t-max 1s -o run.csv", ""),
        ("solve simple --method rk4 --step 10ms --t-max 1s --every 500ms", " at the outputs"),
        ("solve simple --method rk4 --step 10us --t-max 1s", " at the outputs"),  # thinned
        ("solve simple --t-max 1s --digits 12 --every 1s", " at the outputs"),
        ("exact linear --at 1s,2s", " at the outputs"),
    ],
)
def test_the_largest_energy_error_is_of_the_steps_or_says_of_what(
    line: str, place: str, lines_of: Lines
) -> None:
    printed = unfolded("\n".join(lines_of(line)))
    assert re.search(rf"largest relative energy error{place} [\d.e-]+$", printed, re.MULTILINE)


@pytest.mark.parametrize("every", ["10s", "300s", "999s", "700ms", "30ms"])
@pytest.mark.parametrize("t_max", [1000, -1000])
def test_a_run_that_blows_up_says_when_whatever_its_outputs(
    every: str, t_max: int, capsys: pytest.CaptureFixture[str]
) -> None:
    """Not when its last output was: to a step, whether whole or shortened to an output."""
    line = "solve linear --theta 5deg --length 50cm --method euler --step 1s --t-max"
    start = (math.radians(5), 0.0)
    run = pendula.solve(pendula.LinearPendulum(0.5), start, float(t_max), "euler", step=1.0)
    assert main([*line.split(), f"{t_max}s", "--every", every]) == 1
    printed = capsys.readouterr().err
    found = re.search(rf"euler stopped at t = (\S+) s of {t_max} s with step 1 s", printed)
    assert found
    last, stopped = abs(float(run.t[-1])), abs(float(found[1]))
    assert last <= stopped <= abs(run.reached) + {"700ms": 0.7, "30ms": 0.03}.get(every, 0.0)
