"""What the report says of a run does not hang on how often its points are kept."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pendula import DoublePendulum, LinearPendulum, SimplePendulum, solve
from pendula.analysis import angle_difference, parting_time
from pendula.plot.labels import labels
from pendula.run.request import checked_name
from pendula.study.facts import facts
from pendula.study.notation import Numbers
from pendula.study.recipe import read_recipe
from pendula.study.runs import compute
from refusals import refused_at

SMALL = """
[linear_model]
amplitudes = ["5 deg"]
[elliptic]
largest_terms = 2000
[convergence]
steps = ["10 ms", "5 ms"]
[work]
swings = 1
points = 2
"""
RODS, START = DoublePendulum.rods(), (math.radians(120), math.radians(-10), 0.0, 0.0)


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "mine.toml"
    path.write_text(text)
    return path


def told(tmp_path: Path, text: str, language: str = "en") -> dict[str, Any]:
    words = labels(language)
    recipe = read_recipe(written(tmp_path, SMALL + text))
    with np.errstate(over="ignore", invalid="ignore"):  # as in `run_study`
        return facts(compute(recipe), words, Numbers(words), "0")


@pytest.mark.parametrize(
    ("text", "line", "says"),
    [
        (
            '[simple]\noutput = "3 s"',
            2,
            "simple.output must be at most a 20th of the period of small swings, 0.0709 s, "
            "got 3 s; take 0.05 s",
        ),
        (
            '[double]\noutput = "7 s"',
            2,
            "double.output must be at most a 20th of the period of the fastest small swings, "
            "0.0437 s, got 7 s; take 0.025 s",
        ),
        ('[double]\nl1 = "1 cm"\nl2 = "1 cm"', 2, "double.output must be at most a 20th"),
        (
            '[simple]\nt_max = "2000 s"\noutput = "1 s"',
            3,
            "0.0709 s, got 1 s; take simple.t_max = 1410 s and a 20th of the period",
        ),
        ('[simple]\nlength = "1 mm"', 2, "0.00317 s, got 0.01 s; take 0.002 s"),
        (
            '[simple]\noutput = "30 ms"',
            2,
            "simple.output must divide simple.t_max = 10 s, got 0.03 s; take 0.02 s, or "
            "simple.t_max = 9.99 s",
        ),
        (
            '[double]\nt_max = "25.005 s"',
            2,
            "double.output must divide double.t_max = 25.005 s, got 0.01 s; take 0.005001 s, or "
            "double.t_max = 25 s",
        ),
        ('[simple]\nuntil = "9.999 s"', 2, "or simple.t_max = 9.99 s"),
        (
            '[convergence]\nsteps = ["0.3 s", "0.1 s"]',
            2,
            "the longest of convergence.steps must divide convergence.t_max = 1 s, got 0.3 s; take "
            "0.2 s, or convergence.t_max = 0.9 s",
        ),
        ('[convergence]\nt_max = "1.005 s"', 2, "or convergence.t_max = 1 s"),
    ],
)
def test_outputs_that_miss_the_end_or_the_motion_are_refused(
    tmp_path: Path, text: str, line: int, says: str
) -> None:
    path = written(tmp_path, text)
    refused_at(lambda: read_recipe(path), path, line, says)


@pytest.mark.parametrize(
    ("name", "key", "way_out"),
    [
        ("simple", "output", "0.05 s"),
        ("simple", "output", "0.02 s"),
        ("double", "output", "0.025 s"),
        ("double", "output", "1.25 s/30"),
        ("simple", "output", "10 s/142"),
    ],
)
def test_outputs_that_divide_the_time_but_for_rounding_are_taken(
    tmp_path: Path, name: str, key: str, way_out: str
) -> None:
    value, _, parts = way_out.partition(" s/")
    seconds = float(value.removesuffix(" s")) / float(parts or 1)
    results = read_recipe(written(tmp_path, f'[{name}]\n{key} = "{seconds!r} s"'))
    part = getattr(results, name)
    assert part.output == seconds
    if name == "simple":
        found = compute(
            read_recipe(written(tmp_path, SMALL + f'[{name}]\n{key} = "{seconds!r} s"'))
        )
        for run in (*found.simple.runs.values(), *found.linear.runs.values()):
            assert run.t[-1] == part.t_max == 10.0


@pytest.mark.parametrize(
    ("simple", "double", "language"),
    [("10 ms", "10 ms", "en"), ("50 ms", "40 ms", "es"), ("2 ms", "0.5 ms", "en")],
)
def test_moments_are_those_of_the_steps(
    tmp_path: Path, simple: str, double: str, language: str
) -> None:
    text = f'[simple]\noutput = "{simple}"\n[double]\nt_max = "10 s"\noutput = "{double}"\n'
    if double == "0.5 ms":
        text += 'step = "1 ms"\nreference_step = "0.5 ms"\n'
    said = told(tmp_path, text, language)
    numbers = Numbers(labels(language))
    swung = solve(SimplePendulum(0.5), (math.radians(150), 0.0), 10.0, "euler", step=0.01)
    over = np.flatnonzero(np.abs(swung.theta) > math.pi)[0]
    euler = said["methods"][0]
    assert euler["over_top"] == numbers.plain(float(swung.t[over]))
    assert euler["simple_energy"] == numbers.plain(float(swung.energy_error[-1]))
    finest = 0.5e-3 if double == "0.5 ms" else 1e-3
    t = np.linspace(0.0, 10.0, round(10.0 / finest) + 1)
    reference = solve(RODS, START, t, "rk4", step=1e-4 if finest == 1e-3 else 0.5e-3)
    for row, name in zip(said["double"]["rows"], ("euler", "heun", "rk4"), strict=True):
        method = checked_name(name)
        run = solve(RODS, START, t, method, step=1e-3)
        parted = parting_time(t, angle_difference(run, reference), math.radians(1))
        own = solve(RODS, START, 10.0, method, step=1e-3)
        error = np.abs(own.energy_error)
        assert row["time"] == (numbers.plain(parted) if math.isfinite(parted) else None)
        assert row["energy_before"] == numbers.plain(float(error[own.t <= parted].max()))
        assert row["energy_largest"] == numbers.plain(float(error.max()))


@pytest.mark.parametrize("outputs", range(1, 12))
def test_the_agreement_is_told_once_at_each_time(tmp_path: Path, outputs: int) -> None:
    said = told(
        tmp_path,
        f'[double]\nt_max = "{outputs * 10} ms"\noutput = "10 ms"\npath_until = "10 ms"\n',
    )["double"]["agreement"]
    times = [float(row["time"]) for row in said]
    assert len(said) == min(outputs, 5)
    assert all(a < b for a, b in itertools.pairwise([0.0, *times]))
    assert times[-1] == pytest.approx(outputs * 0.01)


def test_a_run_that_diverged_is_told_to_the_step(tmp_path: Path) -> None:
    """And its energy after a time that it has not reached is not told."""
    said = told(tmp_path, '[simple]\nstep = "1 s"\noutput = "50 ms"\nt_max = "400 s"\n')["methods"]
    plain, start = Numbers(labels("en")).plain, (math.radians(5), 0.0)
    runs = [solve(LinearPendulum(0.5), start, 400.0, m, step=1.0) for m in ("euler", "heun", "rk4")]
    assert [run.outcome for run in runs] == ["reached_end", "not_finite", "not_finite"]
    assert said[0]["broke_down"] == [None, None]
    for row, run in zip(said[1:], runs[1:], strict=True):
        assert row["broke_down"] == [
            plain(float(run.t[-1]) + 0.05),
            None,
        ]  # without the next output
        assert row["linear_energy"] == row["linear_energy_theory"] == "—"
