"""The page in the wheel: a build that git ignores is taken along, none is no hindrance."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from lab_pages import FILES, write_page
from test_readme import ROOT

BUILD = (
    "import sys; from scikit_build_core.build import build_sdist, build_wheel\n"
    "without_core = {'wheel.cmake': 'false'}\n"  # a minute's compilation that no file depends on
    "build = {'sdist': build_sdist, 'wheel': build_wheel}[sys.argv[1]]\n"
    "print(build(sys.argv[2], without_core))"
)


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """What a build needs of the project, as in a clone."""
    folder = tmp_path / "clone"
    shutil.copytree(
        ROOT / "src",
        folder / "src",
        ignore=shutil.ignore_patterns("static", "__pycache__", "*.so"),
    )
    for name in ("pyproject.toml", ".gitignore", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, folder / name)
    return folder


def built(clone: Path, kind: str) -> Path:
    line = [sys.executable, "-c", BUILD, kind, str(clone / "dist")]
    done = subprocess.run(line, cwd=clone, capture_output=True, text=True, check=True)
    return clone / "dist" / done.stdout.splitlines()[-1]


def of_the_page(names: list[str]) -> list[str]:
    found = (name.partition("pendula/lab/static/")[2] for name in names)
    return sorted(filter(None, found))


def test_a_wheel_carries_the_page(clone: Path) -> None:
    write_page(clone / "src/pendula/lab/static")
    with zipfile.ZipFile(built(clone, "wheel")) as wheel:
        assert of_the_page(wheel.namelist()) == sorted(FILES)
        assert wheel.read("pendula/lab/static/lab.html") == FILES["lab.html"]
        assert "pendula/lab/address.json" in wheel.namelist()


def test_a_source_archive_carries_it_on(clone: Path) -> None:
    write_page(clone / "src/pendula/lab/static")
    with tarfile.open(built(clone, "sdist")) as archive:
        assert of_the_page(archive.getnames()) == sorted(FILES)


def test_without_a_page_there_is_a_wheel_all_the_same(clone: Path) -> None:
    with zipfile.ZipFile(built(clone, "wheel")) as wheel:
        assert of_the_page(wheel.namelist()) == []
        assert "pendula/lab/server.py" in wheel.namelist()
