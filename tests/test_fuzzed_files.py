"""Files and recipes changed at random: each is refused in one line, or is what it was."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from damage import Saved, damages, one_line_about, read
from pendula.io.files import FORMATS
from pendula.sweeping import read_sweep

HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def saved(tmp_path_factory: pytest.TempPathFactory) -> Saved:
    return Saved(tmp_path_factory.mktemp("saved"))


@pytest.mark.parametrize("ending", FORMATS)
def test_whatever_is_damaged_is_refused_or_the_same(ending: str, saved: Saved) -> None:
    """In a process of its own: a library in C may hang, or end it."""
    code = "import sys, pathlib, damage\ndamage.read_all(pathlib.Path(sys.argv[1]), sys.argv[2])"
    command = [sys.executable, "-W", "error", "-c", code, str(saved.folder), ending]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=HERE)
    assert done.returncode == 0, done.stderr[-3000:]


RECIPE = b"""[system]
kind = "double"
m1 = { uniform = ["0.5 kg", "1.5 kg"] }
l1 = { grid = ["50 cm", "1 m", 3] }
l2 = { same_as = "l1" }

[state]
theta1 = { list = ["10deg", "100deg"] }

[run]
t_max = "3 s"
every = "0.1 s"
method = "rk4"
step = "1 ms"
draws = 10
"""


def test_whatever_is_damaged_in_a_recipe_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "whole.toml").write_bytes(RECIPE)
    target = tmp_path / "damaged.toml"
    for number in damages(tmp_path / "whole.toml", target, 450, 1):
        _, told = read(target, read_sweep)
        assert told is None or one_line_about(target, told), (number, told)


@pytest.mark.parametrize(
    "text", ["a = " + "[" * 5000, "[run]\nstep" + ".a" * 3000 + " = 1", 'a = "' + "x" * 10]
)
def test_a_recipe_of_endless_tables_is_one_line(text: str, tmp_path: Path) -> None:
    (tmp_path / "deep.toml").write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=r"deep\.toml.*(at most 50 within|not TOML)") as error:
        read_sweep(tmp_path / "deep.toml")
    assert "\n" not in str(error.value)
