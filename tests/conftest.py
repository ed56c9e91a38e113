"""What many tests share. Property tests: the same examples in every run, and none of them timed."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import settings

from pendula.cli import main

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import xarray as xr

    from commands import Call
    from pendula.sweeping import SweepRecipe

settings.register_profile("pendula", deadline=None, derandomize=True)
settings.load_profile("pendula")


@pytest.fixture
def call(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> Call:
    """Run the command in an empty folder: exit code, stdout, stderr."""
    monkeypatch.chdir(tmp_path)

    def run(line: str) -> tuple[int, str, str]:
        code = main(shlex.split(line))
        printed = capsys.readouterr()
        return code, printed.out, printed.err

    return run


@pytest.fixture
def lines_of(call: Call) -> Callable[[str], list[str]]:
    """Run the command successfully: the lines it prints."""

    def run(line: str) -> list[str]:
        code, out, err = call(line)
        assert (code, err) == (0, "")
        return out.splitlines()

    return run


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    """Of a scheduler with two worker processes."""
    from clusters import workers

    with workers() as client:
        yield client


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A store that was written in one go."""
    from chunked import waves
    from pendula.chunks import run

    store = tmp_path_factory.mktemp("undisturbed") / "waves.zarr"
    run(waves(), store)
    return store


@pytest.fixture
def counted(tmp_path: Path) -> Path:
    """Where chunks tell that they are computed."""
    return tmp_path / "log"


@pytest.fixture(scope="module")
def rods(tmp_path_factory: pytest.TempPathFactory) -> SweepRecipe:
    """The recipe of a small sweep."""
    from swept import RODS, recipe

    return recipe(tmp_path_factory.mktemp("rods"), RODS)


@pytest.fixture(scope="module")
def in_memory(rods: SweepRecipe) -> xr.Dataset:
    """What comes of it."""
    from pendula import sweep

    return sweep(rods)


@pytest.fixture
def starts_beyond_the_sine(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let `solve` run what it refuses, to be compared with one among others."""
    monkeypatch.setattr("pendula.run.request.check_angles", lambda *_: None)
