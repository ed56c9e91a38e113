"""`pendula compare`: its table, its files, and how it ends."""

from __future__ import annotations

import csv
import json
import math
import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from commands import interrupted, unfolded
from pendula import SimplePendulum, exact, methods, solve

if TYPE_CHECKING:
    from commands import Call

QUICK = "compare simple --length 50cm --theta 150deg --t-max 2s --points 4"
DOUBLE = "compare double --theta1 120deg --theta2 -10deg --t-max 1s --points 3"


def test_a_row_for_each_method_that_takes_the_system(call: Call) -> None:
    code, printed, error = call(QUICK)
    assert code == 0
    lines = printed.splitlines()
    names = [each.name for each in methods() if "simple" in each.systems]
    assert re.split(" {2,}", lines[1])[::5] == ["method", "to 1e-12 rad"]
    assert [line.split()[0] for line in lines[2 : len(names) + 2]] == names
    assert lines[len(names) + 2].startswith("Largest error of any angle at 12 times, compared ")
    assert "the exact solution" in lines[len(names) + 2]
    assert [line.split()[1] for line in error.splitlines()] == ["reference", *names, "done"]
    assert max(map(len, lines)) <= 80
    assert list(Path().iterdir()) == []


def test_the_table_tells_what_an_error_costs(call: Call) -> None:
    _, printed, _ = call(f"{QUICK} --methods euler,gauss8")
    euler, gauss8 = (re.split(" {2,}", line) for line in printed.splitlines()[2:4])
    assert euler[3:] == ["not reached"] * 3
    assert float(euler[1]) > float(gauss8[1])
    for cost in gauss8[3:]:
        assert re.fullmatch(r"\d+k?, [\d.]+ (us|ms)", cost)
    costs = [int(cost.partition(",")[0].replace("k", "000")) for cost in gauss8[3:]]
    assert costs == sorted(costs)


def test_the_methods_are_those_named(call: Call) -> None:
    code, printed, error = call(f"{DOUBLE} --methods taylor,rk4,taylor")
    assert code == 0
    assert [line.split()[0] for line in printed.splitlines()[2:4]] == ["taylor", "rk4"]
    assert "a run correct to 15 digits, computed with " in unfolded(printed)
    assert "coefficient" in printed
    assert len(error.splitlines()) == 4


def test_the_files_hold_the_runs(call: Call) -> None:
    code, printed, _ = call(f"{QUICK} --methods rk4,taylor -o work.csv --picture work.svg")
    assert code == 0
    assert printed.splitlines()[-2:] == ["work.csv", "work.svg"]
    assert sorted(path.name for path in Path().iterdir()) == ["work.csv", "work.svg"]
    lines = Path("work.csv").read_text(encoding="utf-8").splitlines()
    asked = json.loads(lines[0].removeprefix("# pendula: "))
    rows = list(csv.DictReader(lines[1:]))
    assert [row["method"] for row in rows] == ["rk4"] * 4 + ["taylor"] * 4
    assert asked["outputs"] == 12
    system, state = SimplePendulum(0.5), asked["state"]
    t = [2.0 * (n + 1) / 12 for n in range(12)]
    run = solve(system, state, t, "rk4", step=float(rows[2]["step [s]"]))
    error = abs(run.theta - exact(system, state, t).theta).max()
    said = float(rows[2]["largest angle error at the outputs [rad]"])
    assert said == pytest.approx(error, rel=1e-6)
    assert int(rows[2]["evaluations [1]"]) == run.n_evaluations
    assert float(rows[2]["processor time [s]"]) > 0


@pytest.mark.parametrize("language", ["en", "es"])
def test_the_picture_has_its_language(call: Call, language: str) -> None:
    code, _, _ = call(f"{DOUBLE} --methods midpoint --picture work.pdf --lang {language}")
    assert code == 0
    assert Path("work.pdf").read_bytes().startswith(b"%PDF-")


def test_force_replaces_both_files(call: Call) -> None:
    for name in ("work.json", "work.png"):
        Path(name).write_text("old")
    files = "--methods rk4 -o work.json --picture work.png"
    assert call(f"{QUICK} {files}")[0] == 2
    assert Path("work.json").read_text() == Path("work.png").read_text() == "old"
    assert call(f"{QUICK} {files} --force")[0] == 0
    assert json.loads(Path("work.json").read_text())["rows"][0]["method"] == "rk4"
    assert Path("work.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("compare", "name a system: linear, simple, double"),
        ("compare triple", "no system 'triple'"),
        ("compare simple", "Missing option '--t-max'"),
        (f"{QUICK} --methods rk5", "--methods must be one of euler"),
        (f"{DOUBLE} --methods verlet", "--methods 'verlet' needs a system"),
        (f"{QUICK} --methods ,", "--methods must be one of"),
        (f"{QUICK} --points 1", "--points must be at least 2, got 1"),
        (f"{QUICK} --points 1000", "--points must be a whole number from 1 to 100"),
        (f"{QUICK} --points x", "'x' is not a valid integer"),
        (f"{QUICK} --t0 2s", "--t-max must differ from --t0"),
        ("compare simple --t-max 1e9s", "--t-max must differ from --t0, by at most 100000 of"),
        (f"{QUICK} -o work.xls", "the file name must end in .csv or .json, got 'work.xls'"),
        (f"{QUICK} --picture work.gif", "--picture must end in one of .png, .svg, .pdf"),
        (f"{QUICK} -o no/work.csv", "cannot write no/work.csv"),
        (f"{QUICK} --picture no/work.png", "cannot write no/work.png"),
        ("compare simple --length 0,5m --t-max 1s", "write 0.5m"),
    ],
)
def test_wrong_use_is_one_line(call: Call, line: str, message: str) -> None:
    code, printed, error = call(line)
    assert (code, printed) == (2, "")
    assert error.count("\n") == 1
    assert error.startswith("pendula: ")
    assert message in error
    assert list(Path().iterdir()) == []


def test_methods_that_all_break_down_are_told(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pendula.analysis.method_work.MethodWork.best", math.inf)
    code, printed, error = call(f"{QUICK} --methods rk4 -o x.csv")
    assert (code, printed) == (1, "")
    assert error.splitlines()[-1].startswith("pendula: no method reached the end time with any")


def test_a_disk_that_is_full_leaves_nothing(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pendula.io.rows.csv.writer", full)
    code, printed, error = call(f"{QUICK} --methods rk4 -o work.csv")
    assert (code, printed) == (1, "")
    assert error.splitlines()[-1] == "pendula: No space left on device"
    assert list(Path().iterdir()) == []


@pytest.mark.parametrize("line", ["compare double --t-max 2000s", "compare simple --t-max 90000s"])
def test_ctrl_c_ends_it_without_a_file(line: str, tmp_path: Path) -> None:
    code, printed, error = interrupted(tmp_path, f"{line} -o x.csv --points 100", when=1.5)
    assert (code, printed) == (130, "")
    assert error.splitlines()[-1] == "pendula: interrupted"
    assert list(tmp_path.iterdir()) == []
