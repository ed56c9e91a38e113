"""Recipes as files and dicts, and what is said of a mistake in one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
import xarray as xr

from pendula import (
    DoublePendulum,
    SimplePendulum,
    sweep,
)
from pendula.study import run_study
from pendula.sweeping import read_sweep
from refusals import told

if TYPE_CHECKING:
    from collections.abc import Callable


SIMPLE, RODS = SimplePendulum(), DoublePendulum.rods()
START = (2.0, 2.5, 0.0, 0.0)
RECIPE: dict[str, Any] = {"system": {"kind": "simple"}, "run": {"t_max": "1 s"}}


def test_a_dict_is_a_recipe(tmp_path: Path) -> None:
    text = '[system]\nkind = "double"\n[state]\ntheta1 = {grid = ["-1 rad", "1 rad", 3]}\n'
    text += 'theta2 = {list = ["0 rad", "1 rad"]}\n[run]\nt_max = "1 s"\n'
    text += 'method = "rk4"\nstep = "10 ms"\n'
    path = tmp_path / "mine.toml"
    path.write_text(text)
    tables = {
        "system": {"kind": "double"},
        "state": {
            "theta1": {"grid": ("-1 rad", "1 rad", np.int64(3))},
            "theta2": {"list": np.array(["0 rad", "1 rad"])},
        },
        "run": {"t_max": "1 s", "method": "rk4", "step": "10 ms"},
    }
    xr.testing.assert_identical(sweep(tables), sweep(path))
    xr.testing.assert_identical(sweep(tables), sweep(str(path)))
    assert isinstance(tables["state"]["theta1"]["grid"], tuple)  # type: ignore[index]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"system": {}}, "recipe: system.kind is needed"),
        ({"run": {}}, "recipe: run.t_max is needed"),
        ({"runs": {}}, "recipe: unknown table 'runs'; did you mean 'run'?"),
        ({"run": {"T_MAX": "1 s"}}, "recipe: unknown key 'T_MAX' in [run]; did you mean 't_max'?"),
        ({"run": {"t_max": 1.0}}, "recipe: run.t_max needs a quantity with its unit, in quotes"),
        ({"run": 3}, "recipe: run must be a table; write [run]"),
        ({"system": {"kind": "duble"}}, "did you mean 'double'?"),
        ({"system": {"kind": "double", "form": "rod"}}, "did you mean 'rods'?"),
        ({"run": {"t_max": "1 s", "method": "tailor"}}, "did you mean 'taylor'?"),
        ({"state": {"theta": {"unifrom": ["0 rad", "1 rad"]}}}, "; did you mean 'uniform'?"),
        ({"state": {"thta": "1 rad"}}, "unknown key 'thta' in [state]; did you mean 'theta'?"),
    ],
)
def test_a_mistake_in_a_dict(change: dict[str, Any], message: str) -> None:
    for call in (sweep, read_sweep):
        assert message in told(lambda c=call: c({**RECIPE, **change}))


def test_a_dict_within_itself_is_refused() -> None:
    endless: dict[str, Any] = {}
    endless["run"] = endless
    assert "at most 50 within one another" in told(lambda: sweep(endless))


@pytest.mark.parametrize("wrong", [None, 3, 1.5, [RECIPE], RODS, b"x.toml"])
def test_what_is_no_recipe(wrong: Any) -> None:
    for call in (sweep, read_sweep):
        message = told(lambda c=call: c(wrong))
        assert message.startswith("recipe must be the path of a TOML file, or a dict of its tables")


@pytest.mark.parametrize("call", [sweep, read_sweep, lambda path: run_study(path, "x")])
def test_a_recipe_that_is_not_there(call: Callable[[Any], object]) -> None:
    for path in ("nofile.toml", Path("nofile.toml")):
        message = told(lambda p=path: call(p), FileNotFoundError)
        assert message == "there is no file nofile.toml; give the path of a recipe in TOML"


def test_the_studys_recipe_may_be_a_dict() -> None:
    assert "did you mean 'length'?" in told(lambda: run_study({"simple": {"lenght": "1 m"}}, "x"))


@pytest.mark.parametrize(
    ("text", "line", "way_out"),
    [
        ("[run", 1, "write a table's name in brackets, on a line of its own: [run]"),
        ("[run]\nt_max = 1 s\n", 2, 'write text and quantities in quotes, as in length = "50 cm"'),
        ('[run]\nt_max = "1 s\n', 2, 'close the quotes, as in length = "50 cm"'),
        ("[run]\nt_max = “1 s”\n", 2, 'use straight quotes, as in length = "50 cm"'),
        ("[run]\nt_max\n", 2, 'write each line as key = "value"'),
        ('[run]\nt_max = "1 s"\nt_max = "2 s"\n', 3, "name each table and each key once"),
        ("[run]\n[run]\n", 2, "name each table and each key once"),
        ("[[run]\n", 1, "write a table's name in brackets, on a line of its own: [run]"),
        ('[run] t_max = "1 s"\n', 1, "in brackets, on a line of its own"),
    ],
)
def test_what_is_not_toml_is_told_with_the_way_out(
    text: str, line: int, way_out: str, tmp_path: Path
) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(text, encoding="utf-8")
    for call in (read_sweep, lambda p: run_study(p, tmp_path / "x")):
        message = told(lambda c=call: c(path))
        assert f"mine.toml, line {line}: not TOML: " in message
        assert way_out in message
