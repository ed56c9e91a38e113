"""Recipes: what they may say, and how a mistake is reported."""

from __future__ import annotations

import math
import tomllib
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from pendula.study.recipe import read_recipe
from refusals import refused_at

DEFAULT = resources.files("pendula.study").joinpath("default.toml").read_text("utf-8")


def _written(tmp_path: Path, text: str | bytes) -> Path:
    path = tmp_path / "mine.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def test_default_recipe_is_that_of_the_issue() -> None:
    recipe = read_recipe(None)
    assert recipe.text == DEFAULT
    simple, double = recipe.simple, recipe.double
    assert (simple.length, simple.mass, simple.gravity) == (0.5, 1.0, 9.80665)
    assert (simple.gentle, simple.large) == (math.radians(5), math.radians(150))
    assert (double.m1, double.m2, double.l1, double.l2) == (1.0, 1.0, 1.0, 1.0)
    assert (double.theta1, double.theta2) == pytest.approx(np.radians((120, -10)), rel=3e-16)
    assert (double.omega1, double.omega2) == (0.0, 0.0)


def test_a_recipe_may_name_some_keys_only(tmp_path: Path) -> None:
    text = '[double]\nl2 = "25 cm"\n\n[period]\nterms = [1, 3]\n'
    recipe = read_recipe(_written(tmp_path, text))
    assert recipe.double.l2 == 0.25
    assert recipe.period.terms == (1, 3)
    assert recipe.double.l1 == read_recipe(None).double.l1
    assert recipe.simple == read_recipe(None).simple


def test_the_complete_recipe_gives_the_same_values_again(tmp_path: Path) -> None:
    text = (
        '[simple]\nlength = "0.3333333333333333 m"\nlarge = "2.5 rad"\n'
        '[elliptic]\nerror = 1e-9\namplitudes = ["0.1 rad", "179°"]\n[linear_model]\nswings = [3]\n'
    )
    first = read_recipe(_written(tmp_path, text))
    again = read_recipe(_written(tmp_path, first.text))
    assert again == first
    assert tomllib.loads(first.text).keys() == tomllib.loads(DEFAULT).keys()
    assert first.text.count("#") == DEFAULT.count("#")  # the comments are kept


@pytest.mark.parametrize(
    ("text", "line", "says"),
    [
        ("[simple]\nlength = 50 cm", 2, "not TOML"),
        ('[simple]\nlength = "50 cm', 2, "not TOML"),
        ("[simple]\na = [1,\n", 2, "not TOML"),
        ('[simple]\nmass = "1 kg"\nmass = "2 kg"', 3, "not TOML"),
        (
            '[simple]\nlenght = "5 cm"',
            2,
            "unknown key 'lenght' in [simple]; did you mean 'length'?",
        ),
        ('[simpel]\nlength = "5 cm"', 1, "unknown table 'simpel'; did you mean 'simple'?"),
        ("x = 1", 1, "unknown key 'x'; there are report, simple"),
        ("simple = 3", 1, "simple must be a table; write [simple]"),
        (
            "[simple]\nlength = 5",
            2,
            "simple.length needs a quantity with its unit, in quotes, got 5",
        ),
        ("[simple]\nlength = true", 2, "got true"),
        ("[simple]\nlength = 1979-05-27", 2, 'got "1979-05-27"'),
        ('[simple]\n\n# so short\nlength = "-5 cm"', 4, 'must be more than 0 m, got "-5 cm"'),
        ('simple.length = "0 m"', 1, "must be more than 0 m"),
        ('simple = {length = "0 m"}', 1, "must be more than 0 m"),
        ('[ "simple" ]\nlength = "0 m"', 2, "must be more than 0 m"),
        ('[simple]\nlength = "5 kg"', 2, "simple.length"),
        ('[simple]\nlength = "long"', 2, "simple.length"),
        ('[simple]\nlength = "0,5 m"', 2, "simple.length"),
        ('[simple]\nlength = "nan m"', 2, "simple.length"),
        ('[simple]\ngentle = "200 deg"', 2, 'between 0 and 180 deg, got "200 deg"'),
        ('[simple]\nstep = "0 s"', 2, "simple.step must be more than 0 s"),
        ('[simple]\nstep = "20 s"', 2, "must not be longer than simple.t_max = 10 s, got 20 s"),
        ('[simple]\nuntil = "1 ms"', 2, "must not be longer than simple.t_max = 0.001 s"),
        ('[simple]\nstep = "1e-9 s"', 2, "must be at most 10000000"),
        ('[double]\noutput = "1 us"', 2, "must be at most 20000"),
        ('[double]\nreference_step = "1 min"', 2, "double.reference_step must not be longer"),
        ('[double]\ntheta1 = "1e10 deg"', 2, 'between -360 and 360 turns, got "1e10 deg"'),
        ('[double]\nomega1 = "1e200 rad/s"', 2, 'between -10000 and 10000 rad/s, got "1e200'),
        ('simple.length = "1e-320 m"', 1, "simple.length must not be so far from 1"),
        ('[double]\nl2 = "2 m"\nm1 = "1e300 kg"', 3, "got m1 = 1e+300, m2 = 1, l1 = 1, l2 = 2"),
        # Its repetition with masses seven times as large is what fails.
        ('double.m1 = "1e308 kg"', 1, "got m1 = 1e+308, m2 = 1"),
        ('[simple]\nlength = "1e-300 m"', 2, "must not hold so many periods"),
        (
            '[double]\nreference_step = "2 ms"',
            2,
            "must not be longer than double.step = 0.001 s, got 0.002 s",
        ),
        ('[double]\nstep = "0.05 ms"', 2, "must not be longer than double.step = 5e-05 s"),
        ('[simple]\ngentle = "160 deg"', 2, "must not be larger than simple.large = 2.61799 rad"),
        ('[simple]\nlarge = "1 deg"', 2, "simple.gentle must not be larger than simple.large"),
        ("[linear_model]\nswings = [1.5]", 2, "must be a whole number, without quotes, got 1.5"),
        ("[linear_model]\nswings = []", 2, "must be a list of at least one value, got []"),
        ("[linear_model]\nswings = 1", 2, "must be a list of at least one value, got 1"),
        ('[linear_model]\namplitudes = [\n  "1 deg",\n  2,\n]', 2, "needs a quantity"),
        ("[linear_model]\nerrors = [1]", 2, "must be between 0 and 1, got 1"),
        ("[period]\nterms = [0]", 2, "must be between 0 and 1001, got 0"),
        ("[elliptic]\nerror = nan", 2, "must be between 1e-15 and 1, got nan"),
        ('[elliptic]\nerror = "1e-9"', 2, "must be a number, without quotes"),
        ('[convergence]\nsteps = ["1 ms", "0.001 s"]', 2, "two different steps"),
        (b"[simple]\n# \xe9\n", 2, "not UTF-8 text"),
        ("[report]\ntitle = 3", 2, 'report.title must be text, in quotes, got 3; write title = "'),
        ('[report]\nauthor = ["Ada"]', 2, 'report.author must be text, in quotes, got ["Ada"]'),
        ('[report]\n\ntitle = "a\\nb"', 3, "report.title must be one line, without control"),
        ('[report]\nsections = "work"', 2, 'sections must be a list of at least one value, got "w'),
        ("[report]\nsections = []", 2, "report.sections must be a list of at least one value"),
        (
            "[report]\nsections = [3]",
            2,
            "report.sections must be text, in quotes, got 3; there are",
        ),
        (
            '[report]\nsections = ["work", "lineal"]',
            2,
            "report.sections must be known names, got \"lineal\"; did you mean 'linear'?",
        ),
        ('[report]\nsections = ["x1"]', 2, 'got "x1"; there are equations, linear, elliptic, '),
        ('[report]\ntitel = "x"', 2, "unknown key 'titel' in [report]; did you mean 'title'?"),
    ],
)
def test_a_broken_recipe_is_told_in_one_line(
    tmp_path: Path, text: str | bytes, line: int, says: str
) -> None:
    path = _written(tmp_path, text)
    refused_at(lambda: read_recipe(path), path, line, says)


def test_a_recipe_is_ones_own_once_it_differs(tmp_path: Path) -> None:
    assert not read_recipe(None).own
    assert not read_recipe(_written(tmp_path, DEFAULT)).own
    for text in ('[report]\ntitle = "Mine # \\"really\\""', '[double]\nl2 = "25 cm"'):
        mine = read_recipe(_written(tmp_path, text))
        again = read_recipe(_written(tmp_path, mine.text))
        assert mine.own
        assert again == mine


def test_a_missing_recipe_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"none\.toml"):
        read_recipe(tmp_path / "none.toml")


def test_a_byte_order_mark_is_no_mistake(tmp_path: Path) -> None:
    recipe = read_recipe(_written(tmp_path, b'\xef\xbb\xbf[simple]\nlength = "2 m"\n'))
    assert recipe.simple.length == 2.0
