"""What precision costs, in the study: its runs, its files and what its text says of them."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pendula import DoublePendulum, SimplePendulum, methods, solve
from pendula.analysis import MethodWork, WorkPrecision, time_scale
from pendula.plot.labels import labels
from pendula.study.data import _work, write_table
from pendula.study.notation import Numbers
from pendula.study.recipe import read_recipe
from pendula.study.work import work, work_facts

SIMPLE, RODS = SimplePendulum(0.5), DoublePendulum.rods(l2=0.8)
START = (2.0, 2.5, 0.0, 0.0)


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict[str, WorkPrecision]:
    recipe = tmp_path_factory.mktemp("work") / "quick.toml"
    recipe.write_text("[work]\nswings = 2\npoints = 6\n")
    return work(read_recipe(recipe), SIMPLE, RODS, START)


def told(found: dict[str, WorkPrecision], language: str) -> dict[str, Any]:
    words = labels(language)
    return work_facts(found, 2, words, Numbers(words))


def test_the_motions_are_the_recipes(found: dict[str, WorkPrecision]) -> None:
    simple, double = found["simple"], found["double"]
    assert simple.state.tolist() == [math.radians(150), 0.0]
    assert double.state.tolist() == list(START)
    assert simple.t[-1] == 2 * time_scale(SIMPLE, (1.0, 0.0))
    assert double.t[-1] == 2 * time_scale(RODS, START)
    assert (simple.reference, double.digits) == ("exact", 15)
    assert all(np.isnan(m.seconds).all() for part in found.values() for m in part.methods)


def test_a_run_comes_again(found: dict[str, WorkPrecision]) -> None:
    double = found["double"]
    rk4 = next(each for each in double.methods if each.method == "rk4")
    run = solve(RODS, START, double.t, "rk4", step=float(rk4.settings[2]))
    apart = np.abs(run.theta - solve(RODS, START, double.t, digits=15).theta)
    assert rk4.errors[2] == apart.max()


def test_the_files_have_every_run_and_no_times(
    found: dict[str, WorkPrecision], tmp_path: Path
) -> None:
    for system, part in found.items():
        write_table(tmp_path / "work.csv", _work(part))
        with (tmp_path / "work.csv").open(encoding="utf-8") as file:
            header, *rows = csv.reader(file)
        assert header == [
            "method", "step [s]", "tolerance [1]", "evaluations [1]",
            "largest angle error at the outputs [rad]", "energy error at the end [1]", "outcome",
        ]  # fmt: skip
        takers = [each for each in methods() if system in each.systems]
        assert list(dict.fromkeys(row[0] for row in rows)) == [each.name for each in takers]
        adaptive = {each.name for each in takers if each.adaptive}
        assert all((row[1] == "") == (row[0] in adaptive) == (row[2] != "") for row in rows)
        errors = np.concatenate([each.errors for each in part.methods]).tolist()
        assert [float(row[4]) for row in rows] == errors


@pytest.mark.parametrize("language", ["en", "es"])
def test_the_text_says_who_is_cheapest(found: dict[str, WorkPrecision], language: str) -> None:
    facts = told(found, language)
    for system, part in found.items():
        said = facts[system]
        costs = {each.method: each.to_reach(1e-9)[0] for each in part.methods}
        reached = {name: cost for name, cost in costs.items() if not math.isnan(cost)}
        words = labels(language)
        assert said["cheapest"]["name"] == words.name(min(reached, key=lambda n: reached[n]))
        assert said["dearest"]["name"] == words.name(max(reached, key=lambda n: reached[n]))
        assert said["never"] == [words.name(n) for n in costs if n not in reached]
        assert "Euler" in said["never"]
    assert [row[0] for row in facts["rows"]] == [labels(language).name(m.name) for m in methods()]
    verlet = next(row for row in facts["rows"] if row[0] == "Verlet")
    assert verlet[4:] == ["—", "—"]  # it takes no double pendulum


def test_methods_that_never_arrive_are_said_to(found: dict[str, WorkPrecision]) -> None:
    part = found["simple"]
    euler: MethodWork = next(each for each in part.methods if each.method == "euler")
    alone = WorkPrecision(**{**part.__dict__, "methods": (euler,)})
    facts = told({"simple": alone, "double": alone}, "en")
    assert facts["simple"]["cheapest"] is None
    assert facts["simple"]["dearest"] is None
    assert facts["simple"]["never"] == ["Euler"]
    assert [row[0] for row in facts["rows"]] == ["Euler"]


def test_a_reference_that_is_not_to_be_had_is_told_with_its_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise ValueError("until must be nearer")

    recipe = tmp_path / "long.toml"
    recipe.write_text("\n[work]\nswings = 20\n")
    monkeypatch.setattr("pendula.study.work.work_precision", refuse)
    with pytest.raises(RuntimeError) as caught:
        work(read_recipe(recipe), SIMPLE, RODS, START)
    assert str(caught.value) == (
        f"{recipe}, line 3: work.swings must be few enough for a certified reference, got 20: "
        "until must be nearer"
    )


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("swings = 0", "work.swings must be between 0 and 21, got 0"),
        ("swings = 21", "work.swings must be between 0 and 21, got 21"),
        ("points = 1", "work.points must be between 1 and 41, got 1"),
        ("points = 2.5", "work.points must be a whole number, without quotes, got 2.5"),
        ("swing = 3", "unknown key 'swing' in [work]; did you mean 'swings'?"),
    ],
)
def test_wrong_keys_are_told(tmp_path: Path, text: str, says: str) -> None:
    recipe = tmp_path / "wrong.toml"
    recipe.write_text(f"[work]\n{text}\n")
    with pytest.raises(ValueError, match=r"wrong\.toml, line 2") as caught:
        read_recipe(recipe)
    assert says in str(caught.value)
