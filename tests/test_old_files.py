"""Files that earlier versions wrote: they load, with a word, and run again to the same bits."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING
from zipfile import ZipFile

import pytest

import pendula
from alike import same
from pendula import _engine
from pendula.io import UncheckedFileWarning
from pendula.io.files import FORMATS
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
