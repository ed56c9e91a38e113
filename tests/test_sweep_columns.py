"""What a sweep writes on request: positions, derivatives, single precision; whole floats."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pendula import sweep
from pendula.chunks import opened
from pendula.study.recipe import read_recipe
from pendula.sweeping import SweepRecipe, sweep_from
from pendula.systems import system_from
from swept import bits, recipe

HEAD = '[system]\nkind = "{}"\n[state]\n'
RUN = '[run]\nt_max = "2 s"\nevery = "0.5 s"\ndraws = 6\nchunk = 4\n'
STARTS = {
    "linear": 'theta = { uniform = ["-9 deg", "9 deg"] }\n',
    "simple": 'theta = { normal = ["0 deg", "90 deg"] }\n',
    "double": 'theta1 = { normal = ["90 deg", "30 deg"] }\n',
}
NAMES = {
    "linear": ("x", "y", "dtheta_dt", "domega_dt"),
    "simple": ("x", "y", "dtheta_dt", "domega_dt"),
    "double": (
        *("x1", "y1", "x2", "y2"),
        *("dtheta1_dt", "dtheta2_dt", "domega1_dt", "domega2_dt"),
    ),
}


def asked(folder: Path, kind: str, run: str) -> SweepRecipe:
    return recipe(folder, HEAD.format(kind) + STARTS[kind] + RUN + run)


@pytest.mark.parametrize("kind", list(STARTS))
def test_positions_and_derivatives_are_those_of_the_system(tmp_path: Path, kind: str) -> None:
    made = asked(tmp_path, kind, 'columns = ["derivatives", "positions"]\n')
    plain = asked(tmp_path, kind, "")
    found = sweep(made)
    assert [name for name in found.data_vars if name not in sweep(plain)] == list(NAMES[kind])
    assert bits(found, *NAMES[kind]) == bits(sweep(plain))
    for row in range(6):
        values = {name: float(found[name][row]) for name in made.parameters}
        system = system_from({"name": kind, "form": made.form, "parameters": values})
        states = np.stack([found[name].values[row] for name in made.components], axis=-1)
        half = len(NAMES[kind]) // 2
        expected = np.concatenate(
            [system.positions(states).reshape(5, half), system.rhs(states)], axis=1
        )
        for name, column in zip(NAMES[kind], expected.T, strict=True):
            assert found[name].values[row].tobytes() == column.tobytes(), name
    units = ["m"] * half + [found[name].units for name in NAMES[kind][half:]]
    assert [found[name].units for name in NAMES[kind]] == units
    assert {"rad/s", "rad/s^2"} == set(units[half:])


def test_one_group_of_columns_may_stand_alone(tmp_path: Path) -> None:
    assert asked(tmp_path, "simple", 'columns = "positions"\n').columns == ("positions",)
    both = asked(tmp_path, "simple", 'columns = ["derivatives", "positions", "derivatives"]\n')
    assert both.columns == ("positions", "derivatives")
    assert sweep_from(both.resolved) == both


@pytest.mark.parametrize("ending", ["zarr", "parquet"])
def test_single_precision_is_the_double_rounded(tmp_path: Path, ending: str) -> None:
    run = 'columns = ["positions"]\n'
    double = sweep(asked(tmp_path, "double", run))
    made = asked(tmp_path, "double", f'{run}dtype = "float32"\n')
    assert made.dtype == "float32"
    store = tmp_path / f"rods.{ending}"
    sweep(made, store)
    if ending == "zarr":
        found = {name: each.values for name, each in opened(store).data_vars.items()}
    else:
        table = pd.read_parquet(store)
        found = {
            str(name).partition(" [")[0]: np.stack(list(table[name]))
            for name in table
            if name not in ("row", "t [s]")
        }
    for name, each in double.data_vars.items():
        over_time = each.dims == ("row", "t")
        dtype = np.float32 if over_time else each.dtype
        if name != "outcome":
            assert found[str(name)].dtype == dtype, name
            np.testing.assert_array_equal(found[str(name)], each.values.astype(dtype))


def test_a_run_that_breaks_down_has_no_positions_either(tmp_path: Path) -> None:
    text = HEAD.format("simple") + 'theta = { list = ["1e9 rad", "1 rad"] }\n'
    run = '[run]\nt_max = "2 s"\nevery = "0.5 s"\ncolumns = ["positions", "derivatives"]\n'
    found = sweep(recipe(tmp_path, text + run))
    for name in NAMES["simple"]:
        assert np.isnan(found[name].values[0, 1:]).all()
        assert np.isfinite(found[name].values[1]).all()


def test_whole_numbers_may_be_written_as_floats(tmp_path: Path) -> None:
    text = HEAD.format("simple") + 'theta = { grid = ["0 deg", "9 deg", 3e0] }\n'
    text += 'omega = { uniform = ["0 rad/s", "1 rad/s"] }\n'
    run = '[run]\nt_max = "1 s"\ndraws = 1e5\nchunk = 2e4\nseed = 3.0\nmax_steps = 1e6\n'
    found = recipe(tmp_path, text + run)
    plain = run.replace("1e5", "100000").replace("2e4", "20000").replace("3.0", "3")
    whole = recipe(tmp_path, text.replace("3e0", "3") + plain.replace("1e6", "1000000"))
    assert found.resolved == whole.resolved
    kinds = (found.sampler.draws, found.chunk, found.sampler.seed, found.max_steps)
    assert all(type(each) is int for each in kinds)


def test_a_study_takes_them_too(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text("[linear_model]\nswings = [2e0, 10]\n[work]\npoints = 2e1\n")
    found = read_recipe(path)
    assert (found.linear_model.swings, found.work.points) == ((2, 10), 20)
    assert type(found.work.points) is int


def test_chunks_are_large_and_do_not_depend_on_the_draws(tmp_path: Path) -> None:
    made = recipe(tmp_path, HEAD.format("simple") + STARTS["simple"] + RUN.replace("chunk = 4", ""))
    assert made.chunk == 10_000
    long = RUN.replace("chunk = 4", "").replace('"0.5 s"', '"1 ms"')
    text = HEAD.format("simple") + STARTS["simple"] + long
    assert recipe(tmp_path, text).chunk == recipe(tmp_path, text.replace("6", "1e6")).chunk == 499


@pytest.mark.parametrize(
    ("state", "run", "line", "told"),
    [
        ("", 'dtype = "half"', 7, "run.dtype must be one of float64, float32; got 'half'"),
        ("", "dtype = 32", 7, "run.dtype must be one of float64, float32; got 32"),
        ("", 'columns = ["x"]', 7, "run.columns must be one of positions, derivatives; got 'x'"),
        ("", "columns = 3", 7, "run.columns must be one of positions, derivatives; got 3"),
        ("", "draws = 1.5", 7, "run.draws must be a whole number"),
        ("", "chunk = 2.5", 7, "run.chunk must be a whole number"),
        ("", "max_steps = 2.5", 7, "run.max_steps must be a whole number"),
        ('theta = { normal = ["1 rad"] }', "draws = 2", 5, "normal must be a mean and a standard"),
        ('theta = { normal = ["1 rad", "0 rad"] }', "draws = 2", 5, "deviation must be positive"),
        ('theta = { normal = ["1 rad", "1 m"] }', "draws = 2", 5, "must be in rad"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(
    tmp_path: Path, state: str, run: str, line: int, told: str
) -> None:
    text = f'[system]\nkind = "simple"\n[state]\n\n{state}\n[run]\n{run}\nt_max = "1 s"\n'
    with pytest.raises(ValueError, match=f"line {line}: ") as caught:
        recipe(tmp_path, text)
    assert told in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("run", "key", "told"),
    [
        (
            'every = "1 us"\nchunk = 1e3\ndraws = 9e4',
            "chunk",
            "chunk rows must have at most 10000000",
        ),
        (
            "draws = 10000000001",
            "draws",
            "chunk must leave at most 1000000 chunks, got 10000000001",
        ),
    ],
)
def test_chunks_that_are_too_large_or_too_many_are_refused(
    tmp_path: Path, run: str, key: str, told: str
) -> None:
    text = HEAD.format("simple") + STARTS["simple"] + f'[run]\nt_max = "1 s"\n{run}\n'
    line = 1 + [each.startswith(key) for each in text.splitlines()].index(True)
    with pytest.raises(ValueError, match=rf"line {line}: run\.{told}"):
        recipe(tmp_path, text)


def test_a_normal_parameter_stays_positive(tmp_path: Path) -> None:
    text = '[system]\nkind = "simple"\nmass = {{ normal = ["1 kg", "{} kg"] }}\n{}'
    assert recipe(tmp_path, text.format(0.12, RUN)).sampler.count == 6
    told = (
        r"line 3: system\.mass must be positive, 8\.3 standard deviations below its mean too, got"
    )
    with pytest.raises(ValueError, match=told):
        recipe(tmp_path, text.format(0.13, RUN))


def test_a_chunk_more_or_less_changes_no_text(tmp_path: Path) -> None:
    """Texts have a length of their own in a store; a truncated one is made again."""
    made, store = asked(tmp_path, "simple", ""), tmp_path / "swings.zarr"
    sweep(made, store)
    chunk = store / "outcome" / "c.0"
    data = chunk.read_bytes()
    for damaged in (data[:-1], data[:4], b"\0" * 4, b""):
        chunk.write_bytes(damaged)
        assert sweep(made, store)["outcome"].values.tolist() == ["reached_end"] * 6
        assert chunk.read_bytes() == data
    other = replace(made, chunk=6)
    assert sweep(other)["outcome"].values.tolist() == ["reached_end"] * 6
