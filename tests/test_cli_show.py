"""`pendula show`: every kind of file that a command or a method writes, with plots and pictures."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING
from zipfile import ZipFile

import numpy as np
import pytest

import pendula
from pendula import DoublePendulum, SimplePendulum, ensemble, exact, sweep
from pendula.cli.plots import shades
from pendula.events import flip

if TYPE_CHECKING:
    from commands import Call

SWEEP = """
[system]
kind = "double"
l1 = { normal = ["1 m", "5 cm"] }
[state]
theta1 = { grid = ["-180 deg", "180 deg", 3] }
[run]
t_max = "3 s"
every = "0.1 s"
draws = 4
"""
OLD = Path(__file__).parent / "data" / "sweeps" / "8f2f035.zip"


def quiet(call: Call, line: str) -> str:
    code, printed, error = call(line)
    assert (code, error) == (0, "")
    return printed


@pytest.mark.parametrize("ending", ["csv", "nc", "parquet", "zarr"])
def test_a_trajectory_is_shown_as_when_it_was_made(call: Call, ending: str) -> None:
    made = quiet(call, "solve double --t-max 5s")
    quiet(call, f"solve double --t-max 5s -o run.{ending}")
    shown = quiet(call, f"show run.{ending} --picture run.png")
    assert shown.startswith("trajectory of DoublePendulum.rods(m1=1.0")
    assert "at t = 0 s: theta1 = 2.0944 rad" in shown
    assert made.replace("shown; -o FILE writes all", "shown; --all prints all") in shown
    assert shown.endswith("\nrun.png\n")
    assert Path("run.png").read_bytes().startswith(b"\x89PNG")


def test_events_backward_runs_and_exact_ones_are_shown(call: Call) -> None:
    pendula.solve(DoublePendulum.rods(), (2.0, 2.5, 0, 0), -6.0, events=flip(2)).save("a.csv")
    assert "flip 2: 4 times" in quiet(call, "show a.csv")
    exact(SimplePendulum(), [(0.1, 0.0), (1.0, 0.0)], [0.0, 1.0]).save("b.nc")
    assert quiet(call, "show b.nc").startswith("2 exact solutions of SimplePendulum(")
    exact(SimplePendulum(), np.full((2, 3, 2), 0.1), [0.0, 1.0]).save("c.nc")
    assert quiet(call, "show c.nc").startswith("6 exact solutions of SimplePendulum(")
    code, _, told = call("show b.nc --picture b.png")
    assert (code, "--picture draws trajectories, maps and sweeps" in told) == (2, True)


@pytest.mark.parametrize(("kind", "ending"), [("flip", "zarr"), ("divergence", "nc")])
def test_a_map_is_shown_and_drawn_without_computing(call: Call, kind: str, ending: str) -> None:
    line = f"map {kind} double --t-max 3s --size 12x8 -o m.{ending} --picture made.png"
    summary = quiet(call, line).split("\n")[0].partition(": ")[2]
    shown = quiet(call, f"show m.{ending} --picture shown.png --lang en")
    assert shown.startswith(f"{kind} map of DoublePendulum.rods(")
    assert "theta1: 12 cells, centres -2.87979 to 2.87979 rad" in shown
    assert summary in shown
    assert Path("shown.png").read_bytes() == Path("made.png").read_bytes()
    lines = shown.split("\n\n")[1].split("\n")
    assert {len(each) for each in lines[:-1]} == {60}
    assert set("".join(lines[:-1])) <= set("█▓▒░ ")


def test_shades_are_dark_where_values_are_low() -> None:
    values = np.arange(8.0)[:, np.newaxis] + np.zeros(4)
    values[:, 3] = np.nan
    assert shades(values, width=8).split("\n") == ["        ", "██▓▓▒▒░░"]
    assert shades(np.full((3, 3), np.nan), width=4) == "    \n    "


@pytest.mark.parametrize("ending", ["zarr", "parquet"])
def test_a_sweep_is_shown_with_one_of_its_rows(call: Call, ending: str) -> None:
    Path("rods.toml").write_text(SWEEP, encoding="utf-8")
    found = sweep("rods.toml")
    quiet(call, f"sweep rods.toml -o rods.{ending}")
    shown = quiet(call, f"show rods.{ending} --row 7 --picture row.svg")
    assert shown.startswith("sweep of the double pendulum rods by taylor\n")
    assert "l1       normal  1, 0.05\n" in shown
    assert "12 rows (grid 3, draws 4), until 3 s every 0.1 s, float64, chunks of 10000" in shown
    assert "outcomes: 12 reached_end" in shown
    assert f"row 7: DoublePendulum.rods(m1=1.0, m2=1.0, l1={float(found['l1'][7])!r}" in shown
    assert f"{float(found['theta1'][7, -1]):.7g}"[:7] in shown
    assert "row 0: " in quiet(call, f"show rods.{ending}")
    code, _, told = call(f"show rods.{ending} --row 12")
    assert (code, told) == (2, "pendula: --row must be from 0 to 11, got 12\n")


def test_an_unfinished_sweep_says_so(call: Call) -> None:
    Path("rods.toml").write_text(SWEEP.replace("draws = 4", "draws = 4\nchunk = 5"), "utf-8")

    def stop(share: float) -> None:
        if share > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep("rods.toml", "rods.zarr", progress=stop)
    shown = quiet(call, "show rods.zarr")
    assert "unfinished: 7 of 12 rows are missing\noutcomes: 5 reached_end\n" in shown


def test_recipes_are_shown(call: Call) -> None:
    Path("rods.toml").write_text(SWEEP, encoding="utf-8")
    shown = quiet(call, "show rods.toml")
    assert shown.startswith("sweep of the double pendulum rods by taylor\n")
    assert "row 0" not in shown
    assert "row 2: " in quiet(call, "show rods.toml --row 2 --picture row.pdf")
    Path("mine.toml").write_text('[double]\nl2 = "25 cm"\n', encoding="utf-8")
    shown = quiet(call, "show mine.toml")
    assert shown.startswith("recipe of a study; run it with: pendula study mine.toml\n")
    assert 'l2 = "25 cm"' in shown


def test_a_store_of_an_earlier_version_is_shown(call: Call) -> None:
    with ZipFile(OLD) as archive:
        archive.extractall()
    for name in ("swings.zarr", "swings.parquet"):
        shown = quiet(call, f"show {name}")
        assert "outcomes: 10 reached_end\nthe recipe is of an earlier version" in shown
        code, _, told = call(f"show {name} --row 1")
        assert (code, told.count("\n"), "earlier version" in told) == (2, 1, True)


@pytest.mark.parametrize("ending", ["csv", "nc", "parquet", "zarr"])
def test_an_ensemble_is_shown(call: Call, ending: str) -> None:
    many = ensemble(SimplePendulum(), [(1.0, 0.0), (3.0, 9.0)], [1.0, 2.0], events=flip(1))
    many.save(f"many.{ending}")
    shown = quiet(call, f"show many.{ending}")
    assert shown.startswith("ensemble of 2 trajectories of SimplePendulum(length=1.0")
    if ending in ("nc", "zarr"):
        assert f"2 times; 2 reached_end\nevent 1: {len(many.events[0].times)} crossings" in shown


@pytest.mark.parametrize("ending", ["csv", "json"])
def test_a_comparison_is_shown(call: Call, ending: str) -> None:
    call(f"compare simple --t-max 1s --methods rk4,taylor --points 2 -o work.{ending}")
    shown = quiet(call, f"show work.{ending}")
    assert shown.startswith("comparison of methods\n")
    assert "reference: exact" in shown
    assert "\nrk4 " in shown


@pytest.mark.parametrize("ending", ["csv", "json"])
def test_events_are_shown(call: Call, ending: str) -> None:
    call(f"solve double --t-max 9s --event 'velocity-zero 1' --events-file found.{ending}")
    shown = quiet(call, f"show found.{ending}")
    assert shown.startswith("events of a run\n")
    assert "method: taylor" in shown
    assert "\nvelocity-zero 1  " in shown
    assert max(map(len, shown.splitlines())) <= 80


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("", "Missing argument 'FILE|LINK'"),
        ("none.csv", "no such file: none.csv"),
        ("run.txt", "the file name must end in .csv, .json, .nc, .parquet, .zarr, .toml"),
        ("other.csv", "other.csv was not written by pendula"),
        ("other.json", "other.json was not written by pendula"),
        ("other.nc", "other.nc cannot be read as a file of pendula"),
        ("other.parquet", "other.parquet cannot be read as a file of pendula"),
        ("other.zarr", "other.zarr"),
        ("other.toml", "other.toml, line 1"),
        ("run.csv --row 1", "--row goes with a sweep, not with a trajectory"),
        ("run.csv --picture run.gif", "--picture must end in one of .png, .svg, .pdf"),
        ("run.csv --picture old.png", "old.png exists; choose another name, or pass --force"),
        ("damaged.csv", "damaged.csv is damaged"),
    ],
)
def test_wrong_use_is_one_line(call: Call, line: str, told: str) -> None:
    call("solve simple --t-max 1s -o run.csv")
    text = Path("run.csv").read_text()
    Path("damaged.csv").write_text("\n".join(text.splitlines()[:-1]) + "\n")
    for ending in ("csv", "nc", "parquet"):
        Path(f"other.{ending}").write_text("a,b\n1,2\n")
    Path("other.json").write_text("[1]")
    Path("other.toml").write_text("a = [")
    Path("other.zarr").mkdir()
    Path("old.png").write_text("old")
    code, printed, error = call(f"show {line}")
    assert (code, printed) == (2, "")
    assert error.count("\n") == 1
    assert error.startswith("pendula: ")
    assert told in error
    shutil.rmtree("other.zarr")
