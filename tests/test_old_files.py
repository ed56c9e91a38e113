"""Files that earlier versions wrote: they load, with a word, and run again to the same bits."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any
from zipfile import ZipFile

import numpy as np
import pytest

import pendula
from alike import same
from pendula import _engine, solve
from pendula._types import MethodName
from pendula.events import flip
from pendula.io import UncheckedFileWarning
from pendula.io.attributes import attributes
from pendula.io.columns import labelled
from pendula.io.files import FORMATS
from pendula.io.whole import Stored, Whole
from pendula.run.options import NAMES as OPTIONS

if TYPE_CHECKING:
    from collections.abc import Callable

    from pendula import Trajectory

DATA = Path(__file__).parent / "data"
VERSIONS = [path.stem for path in DATA.glob("*.zip")]


def names(version: str) -> list[str]:
    """Of the files, and of the folders that are stores."""
    with ZipFile(DATA / f"{version}.zip") as archive:
        return sorted({name.partition("/")[0] for name in archive.namelist()})


def loaded(path: Path, read: Callable[[Path], Trajectory] = pendula.load) -> Trajectory:
    """The trajectory of a file; what says that it has no checksums is one line with its name."""
    with pytest.warns(UncheckedFileWarning, match=f"{path.name} is of a version.*save it") as told:
        found = read(path)
    assert len(told) == 1
    assert told[0].filename == __file__
    assert "\n" not in str(told[0].message)
    return found


ALL = [(version, name) for version in VERSIONS for name in names(version)]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the files are, those of each version in a folder of its name."""
    made = tmp_path_factory.mktemp("old")
    for version in VERSIONS:
        with ZipFile(DATA / f"{version}.zip") as archive:
            archive.extractall(made / version)
    return made


@pytest.mark.parametrize(("version", "name"), ALL)
def test_a_file_of_an_earlier_version_loads_and_runs_again(
    version: str, name: str, folder: Path
) -> None:
    old = loaded(folder / version / name)
    again = loaded(folder / version / name, pendula.rerun)
    if old.outcome == "step_limit" and not old.request.step:  # it does not say what it reached
        assert old.t[-1] == old.reached < again.reached
        old = replace(old, reached=again.reached)
    same(old, again)


@pytest.mark.parametrize(("version", "name"), ALL)
def test_a_file_of_an_earlier_version_can_be_saved_again(
    version: str, name: str, folder: Path, tmp_path: Path
) -> None:
    old = loaded(folder / version / name)
    old.save(tmp_path / name)
    same(pendula.load(tmp_path / name), old)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", ["fixed", "adaptive", "digits_of_steps"])
@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda rows: rows[:-1], "is damaged: it ends at"),
        (lambda rows: [*rows[:-1], "7" + rows[-1]], "is damaged: it ends at"),
        (lambda rows: rows[1:], "is damaged"),
        (lambda rows: rows[::-1], "is damaged: row"),
        (lambda rows: ["nan" + rows[0][rows[0].index(",") :], *rows[1:]], r"t \[s\] is no finite"),
    ],
)
def test_what_shows_without_a_checksum_is_refused(
    version: str, name: str, change: Callable[[list[str]], list[str]], message: str, folder: Path,
    tmp_path: Path,
) -> None:  # fmt: skip
    """Of runs by their own steps up to an end, whose last time, first state and steps are known."""
    lines = (folder / version / f"{name}.csv").read_text(encoding="utf-8").splitlines()
    rows = change(lines[2:])
    (tmp_path / "run.csv").write_text("\n".join([*lines[:2], *rows, ""]), encoding="utf-8")
    with pytest.raises(ValueError, match=f"run.csv .*({message})"):
        pendula.load(tmp_path / "run.csv")


@pytest.mark.parametrize("version", VERSIONS)
def test_the_files_of_a_version_are_of_all_that_a_run_can_be(version: str, folder: Path) -> None:
    runs = [loaded(path) for path in (folder / version).glob("*.csv")]
    stems = {Path(name).stem for name in names(version)}
    assert set(names(version)) == {stem + ending for stem in stems for ending in FORMATS}
    assert {run.outcome for run in runs} == set(_engine.OUTCOMES)
    assert {run.system.name for run in runs} == {"linear", "simple", "double"}
    for option in OPTIONS:
        assert any(getattr(run.request, option) for run in runs), option
    assert any(run.method == "exact" for run in runs)
    assert any(run.request.end < run.request.t0 for run in runs)
    kinds = {event.kind for run in runs for event in run.request.events}
    assert kinds == set(_engine.EVENT_KINDS)


UNCHECKED = {"n_times", "columns", "checksum"}  # what earlier versions did not write
OLDEST = {*UNCHECKED, "reached"}


def unchecked(run: Trajectory, path: Path, rows: slice, without: set[str]) -> None:
    """Save some rows of a run, as an earlier version would have with all of them."""
    path.unlink(missing_ok=True)
    run.save(path)
    first, header, *lines = path.read_text("utf-8").splitlines()
    mark, recipe = first[: first.index("{")], json.loads(first[first.index("{") :])
    kept = {name: each for name, each in recipe.items() if name not in without}
    text = "\n".join([mark + json.dumps(kept), header, *lines[rows], ""])
    path.write_text(text, encoding="utf-8")


SYSTEMS = {
    "linear": (pendula.LinearPendulum(), (1.0, 0.0)),
    "simple": (pendula.SimplePendulum(), (1.0, 0.0)),
    "double": (pendula.DoublePendulum.rods(), (2.0, 2.5, 0.0, 0.0)),
}
GRIDS = {
    "on the grid": np.linspace(0.0, 1.0, 3),
    "each step": np.linspace(0.0, 1.0, 21),
    "between steps": np.linspace(0.0, 1.0, 31),
    "one": np.array([1.0]),
    "off the end": np.array([0.0, 0.3, 0.731]),
}


@pytest.mark.parametrize("without", [UNCHECKED, OLDEST], ids=["earlier", "oldest"])
@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("grid", GRIDS)
@pytest.mark.parametrize("system", SYSTEMS)
def test_rows_of_a_fixed_step_run_are_missed(
    system: str, grid: str, way: float, without: set[str], tmp_path: Path
) -> None:
    """Of output times, which an old file holds as its rows only: the steps tell where it ended."""
    pendulum, start = SYSTEMS[system]
    path, t = tmp_path / "run.csv", 0.5 + way * GRIDS[grid]
    run = solve(pendulum, start, t, "rk4", step=0.05, t0=0.5)
    unchecked(run, path, slice(None), without)
    same(loaded(path), run)
    for kept in {0, 1, t.size // 2, t.size - 1} - {t.size}:
        unchecked(run, path, slice(kept), without)
        what = f"its {kept} times do not fit {run.n_steps} steps of 0.05 s" if kept else "no times"
        with pytest.raises(ValueError, match=f"run.csv is damaged: .*{what}$"):
            pendula.load(path)


@pytest.mark.parametrize("without", [UNCHECKED, OLDEST], ids=["earlier", "oldest"])
@pytest.mark.parametrize("grid", GRIDS)
@pytest.mark.parametrize("ending", [{"max_steps": 13}, {"step": 0.5}, {"step": 0.7}])
@pytest.mark.parametrize("t_max", [1.0, 1000.0])
def test_rows_of_a_fixed_step_run_that_stopped_are_missed(
    t_max: float, ending: dict[str, Any], grid: str, without: set[str], tmp_path: Path
) -> None:
    path, t = tmp_path / "run.csv", t_max * GRIDS[grid]
    run = solve(pendula.LinearPendulum(0.1), (1.0, 0.0), t, "rk4", **{"step": 0.05} | ending)
    unchecked(run, path, slice(None), without)
    again = loaded(path)
    assert (again.outcome, again.t.tolist()) == (run.outcome, run.t.tolist())
    if run.outcome == "reached_end":
        return
    steps = (t[: run.t.size] - t[0]) / run.request.step
    for kept in range(run.t.size):
        unchecked(run, path, slice(kept), without)
        if run.n_steps - steps[kept] > run.t.size + 1:  # else it may have broken down right there
            with pytest.raises(ValueError, match=r"run.csv is damaged: .*its \d+ times do not fit"):
                pendula.load(path)


@pytest.mark.parametrize("ending", FORMATS)
def test_a_file_that_lost_all_its_rows_says_so(ending: str, tmp_path: Path) -> None:
    run = solve(pendula.SimplePendulum(), (1.0, 0.0), [0.0, 0.5, 1.0])
    known = json.loads(attributes(run))
    recipe = {name: each for name, each in known.items() if name not in UNCHECKED}
    empty = Stored(json.dumps(recipe), dict.fromkeys(labelled(run), (0,)), np.zeros, 900)
    with pytest.raises(ValueError, match=f"run{ending} is damaged: it holds no times$"):
        Whole(recipe, empty, tmp_path / f"run{ending}").table()


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_rows_of_an_adaptive_run_are_missed_where_it_says_what_it_reached(
    way: float, tmp_path: Path
) -> None:
    path, t = tmp_path / "run.csv", 0.5 + way * np.linspace(0.0, 9.0, 4)
    rods, start = pendula.DoublePendulum.rods(), (2.0, 2.5, 0.0, 0.0)
    for options in ({}, {"events": flip(2)}, {"certify": 1e-9}, {"digits": 8}):
        run = solve(rods, start, t, t0=0.5, **options)
        unchecked(run, path, slice(None), UNCHECKED)
        same(loaded(path), run)
        for kept in range(1, 4):
            unchecked(run, path, slice(kept), UNCHECKED)
            with pytest.raises(ValueError, match="run.csv is damaged: it ends at .* went to"):
                pendula.load(path)
    run = solve(rods, start, t, t0=0.5, events=flip(2))
    unchecked(run, path, slice(2), OLDEST)
    with pytest.raises(ValueError, match="run.csv is damaged: it ends at .* went to"):
        pendula.load(path)


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("ending", [{"max_steps": 13, "step": 0.05}, {"step": 0.7}])
def test_the_last_row_of_own_steps_that_stopped_is_missed(
    ending: dict[str, Any], way: float, tmp_path: Path
) -> None:
    path = tmp_path / "run.csv"
    run = solve(pendula.LinearPendulum(0.1), (1.0, 0.0), way * 1000.0, "rk4", **ending)
    unchecked(run, path, slice(None), OLDEST)
    assert loaded(path).outcome == run.outcome != "reached_end"
    unchecked(run, path, slice(-1), OLDEST)
    with pytest.raises(ValueError, match=r"run.csv is damaged: it holds \d+ times of \d+ steps$"):
        pendula.load(path)


@pytest.mark.parametrize("method", ["taylor", "dop853"])
@pytest.mark.parametrize("ending", [{"max_steps": 9}, {"events": flip(2, terminal=True)}])
@pytest.mark.parametrize("t_max", [9.0, -9.0])
def test_rows_of_an_adaptive_run_that_stopped_are_missed(
    t_max: float, ending: dict[str, Any], method: MethodName, tmp_path: Path
) -> None:
    path, rods = tmp_path / "run.csv", pendula.DoublePendulum.rods()
    for t in (t_max, t_max * np.linspace(0.001, 1.0, 1000)):
        run = solve(rods, (2.0, 2.5, 0.0, 0.0), t, method, **ending)
        unchecked(run, path, slice(None), UNCHECKED)
        assert loaded(path).outcome == run.outcome != "reached_end"
        if isinstance(t, float) and run.outcome == "event":
            continue  # the first versions ended at the step before
        for rows in (slice(-1), slice(1)):
            unchecked(run, path, rows, UNCHECKED)
            with pytest.raises(ValueError, match=r"run.csv is damaged: it ends at .* went to"):
                pendula.load(path)
