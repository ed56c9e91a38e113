"""Recipes of sweeps: what they may say, what comes of it, and how a mistake is reported."""

from __future__ import annotations

import json
import math
import pickle
from pathlib import Path

import numpy as np
import pytest

from pendula import _engine
from pendula.sampling import Choice, Fixed, Grid, Listed, LogUniform, SameAs, Uniform
from pendula.sweeping import SweepRecipe, read_sweep, sweep_from
from pendula.systems import system_from

RANDOM = """
# a hundred thousand pairs of rods
[system]
kind = "double"
form = "rods"
m1 = "1 kg"
l1 = { log_uniform = ["10 cm", "1 m"] }
l2 = { uniform = ["0.5 m", "1.5 m"] }
[state]
theta1 = { uniform = ["-180 deg", "180 deg"] }
theta2 = "-10 deg"
omega1 = { choice = ["0 rad/s", "1 rad/s"] }
[run]
method = "taylor"
t_max = "30 s"
every = "0.1 s"
tolerance = 1e-10
certify = "1e-6 rad"
draws = 100000
seed = 1
chunk = 500
"""
RUN = '\n[run]\nt_max = "1 s"\n'


def _read(tmp_path: Path, text: str | bytes) -> SweepRecipe:
    path = tmp_path / "mine.toml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return read_sweep(path)


def test_a_random_set(tmp_path: Path) -> None:
    recipe = _read(tmp_path, RANDOM)
    assert (recipe.system, recipe.form, recipe.method) == ("double", "rods", "taylor")
    assert dict(recipe.sampler.columns) == {
        "m1": Fixed(1.0),
        "m2": Fixed(1.0),
        "l1": LogUniform(0.1, 1.0),
        "l2": Uniform(0.5, 1.5),
        "gravity": Fixed(9.80665),
        "theta1": Uniform(-math.pi, math.pi),
        "theta2": Fixed(math.radians(-10)),
        "omega1": Choice((0.0, 1.0)),
        "omega2": Fixed(0.0),
    }
    assert (recipe.sampler.count, recipe.sampler.seed, recipe.chunk) == (100_000, 1, 500)
    options = {"step": None, "tolerance": 1e-10, "max_steps": None, "certify": 1e-6}
    assert recipe.options == {**options, "digits": None, "events": ()}
    assert recipe.times.shape == (301,)
    assert (recipe.times[0], recipe.times[7], recipe.times[-1]) == (0.0, 0.7, 30.0)


def test_rows_are_parameters_and_states_in_the_catalogues_order(tmp_path: Path) -> None:
    recipe = _read(tmp_path, RANDOM)
    parameters, states = recipe.rows(1000, 1003)
    assert recipe.parameters == ("m1", "m2", "l1", "l2", "gravity")
    assert recipe.components == ("theta1", "theta2", "omega1", "omega2")
    assert (parameters.shape, states.shape) == ((3, 5), (3, 4))
    columns = recipe.sampler.rows(1000, 1003)
    np.testing.assert_array_equal(parameters[:, 3], columns["l2"])
    np.testing.assert_array_equal(states[:, 0], columns["theta1"])
    again = recipe.rows(1002, 1003)
    assert (again[0].tolist(), again[1].tolist()) == (parameters[2:].tolist(), states[2:].tolist())
    values = dict(zip(recipe.parameters, parameters[0].tolist(), strict=True))
    assert system_from({"name": "double", "form": "rods", "parameters": values})


def test_the_frozen_first_row(tmp_path: Path) -> None:
    parameters, states = _read(tmp_path, RANDOM).rows(0, 1)
    assert [x.hex() for x in (parameters[0, 2], parameters[0, 3], states[0, 0])] == FIRST_ROW


FIRST_ROW = ["0x1.e2836aa9e006fp-2", "0x1.201aff6584fe5p-1", "0x1.c4402f22672f8p+0"]


def test_a_grid_with_draws_at_each_point(tmp_path: Path) -> None:
    text = (
        '[system]\nkind = "simple"\nlength = { list = ["1 m", "2 m", "50 cm"] }\n'
        '[state]\ntheta = { grid = ["-90 deg", "90 deg", 5] }\nomega = { uniform = '
        '["-1 rad/s", "1 rad/s"] }\n[run]\nmethod = "rk4"\nstep = "10 ms"\nt_max = "2 s"\n'
        "draws = 4\n"
    )
    recipe = _read(tmp_path, text)
    assert dict(recipe.sampler.columns)["length"] == Listed((1.0, 2.0, 0.5))
    assert dict(recipe.sampler.columns)["theta"] == Grid(-math.pi / 2, math.pi / 2, 5)
    assert recipe.sampler.count == 3 * 5 * 4
    parameters, states = recipe.rows(0, 60)
    assert parameters[:, 0].tolist() == ([1.0] * 5 + [2.0] * 5 + [0.5] * 5) * 4
    np.testing.assert_array_equal(states[:5, 0], -states[:5, 0][::-1])
    assert len(set(states[:, 1].tolist())) == 60
    assert recipe.times.tolist() == [2.0]  # the end alone
    assert recipe.options["step"] == 0.01
    assert (recipe.form, recipe.chunk) == ("", 10_000)


def test_a_grid_alone_needs_no_draws(tmp_path: Path) -> None:
    text = '[system]\nkind = "linear"\n[state]\ntheta = { grid = ["0 deg", "1 deg", 3] }' + RUN
    assert _read(tmp_path, text).sampler.count == 3


def test_what_is_left_out_is_the_catalogues(tmp_path: Path) -> None:
    for name, entry in _engine.system_entries().items():
        recipe = _read(tmp_path, f'[system]\nkind = "{name}"' + RUN)
        parameters, states = recipe.rows(0, 1)
        assert recipe.form == entry.forms[0].name
        assert parameters[0].tolist() == [row.standard for row in entry.forms[0].parameters]
        assert states[0].tolist() == [row.standard for row in entry.components]


BODIES = (
    '[system]\nkind = "double"\nform = "bodies"\nm1 = "1 kg"\nm2 = "2 kg"\nl1 = "1 m"\n'
    'c1 = "0.5 m"\n'
    'c2 = { uniform = ["0.2 m", "0.4 m"] }\nI1 = "0.1 kg m^2"\nI2 = "0.1 kg m^2"\n'
)
DRAWS = '[run]\nt_max = "1 s"\ndraws = 3\n'


def test_one_parameter_follows_another(tmp_path: Path) -> None:
    recipe = _read(tmp_path, BODIES + DRAWS)
    assert dict(recipe.sampler.columns)["l2"] == SameAs("c2")
    recipe = _read(tmp_path, BODIES.replace('"0.5 m"', '{ same_as = "c2" }') + DRAWS)
    assert dict(recipe.sampler.columns)["c1"] == SameAs("c2")
    parameters = recipe.rows(0, 3)[0]
    assert (parameters[:, 3] == parameters[:, 4]).all()
    chain = BODIES.replace('{ uniform = ["0.2 m", "0.4 m"] }', '{ same_as = "c1" }')
    recipe = _read(tmp_path, chain + RUN)
    assert dict(recipe.sampler.columns)["l2"] == SameAs("c1")


def test_what_may_be_zero_may_be_zero(tmp_path: Path) -> None:
    recipe = _read(tmp_path, BODIES.replace('c1 = "0.5 m"', 'c1 = "0 m"') + DRAWS)
    assert dict(recipe.sampler.columns)["c1"] == Fixed(0.0)


def test_a_recipe_is_known_by_its_numbers(tmp_path: Path) -> None:
    recipe = _read(tmp_path, RANDOM)
    other_words = RANDOM.replace('"0.5 m"', '"50 cm"').replace("# a hundred", "# one hundred")
    assert _read(tmp_path, other_words).resolved == recipe.resolved
    for old, new in (("seed = 1", "seed = 2"), ('"1.5 m"', '"1.6 m"'), ("1e-10", "1e-11")):
        assert _read(tmp_path, RANDOM.replace(old, new)).resolved != recipe.resolved
    again = sweep_from(json.loads(json.dumps(recipe.resolved, allow_nan=False)))
    assert again == recipe
    assert pickle.loads(pickle.dumps(recipe)) == recipe


def test_the_old_name_of_the_end_is_read(tmp_path: Path) -> None:
    old = RANDOM.replace("t_max", "until")
    assert _read(tmp_path, old) == _read(tmp_path, RANDOM)
    with pytest.raises(ValueError, match=r"line 15: run\.t_max must be positive"):
        _read(tmp_path, old.replace('"30 s"', '"-30 s"'))
    with pytest.raises(ValueError, match="unknown key 'until'"):
        _read(tmp_path, RANDOM.replace("[run]", '[run]\nuntil = "1 s"'))


def test_an_angle_to_be_certain_of_may_have_a_unit(tmp_path: Path) -> None:
    recipe = _read(tmp_path, RANDOM.replace('certify = "1e-6 rad"', 'certify = "1 mrad"'))
    assert recipe.certify == 1e-3


def test_a_column_may_be_a_table_of_its_own(tmp_path: Path) -> None:
    text = '[system]\nkind = "simple"\n[system.length]\ngrid = ["1 m", "2 m", 2]' + RUN
    assert _read(tmp_path, text).sampler.count == 2


def _double(system: str = "", state: str = "", run: str = 't_max = "1 s"') -> str:
    return f'[system]\nkind = "double"\n{system}\n[state]\n{state}\n[run]\n{run}\n'


@pytest.mark.parametrize(
    ("text", "line", "says"),
    [
        ("[system]\nkind = double", 2, "not TOML"),
        (b"[system]\n# \xe9\n", 2, "not UTF-8 text"),
        ('[sistem]\nkind = "double"', 1, "unknown table 'sistem'; did you mean 'system'?"),
        ('kind = "double"', 1, "unknown key 'kind'; there are system, state, run"),
        (
            "[system]\n",
            1,
            "driven, damped-double; write kind =",
        ),
        (
            '[system]\nkind = "triple"',
            2,
            "driven-linear, driven, damped-double; got 'triple'",
        ),
        ('[system]\nkind = "double"\nform = "rod"', 3, "one of rods, bobs, bodies; got 'rod'"),
        ('[system]\nkind = "simple"\nform = "rods"', 3, "not taken by the simple pendulum"),
        (_double('\nlenght = "1 m"'), 4, "unknown key 'lenght' in [system]"),
        (
            _double(state='theta = "1 rad"'),
            5,
            "unknown key 'theta' in [state]; did you mean 'theta",
        ),
        (_double(run='t_mex = "1 s"'), 7, "unknown key 't_mex' in [run]; did you mean 't_max'?"),
        (_double('form = "bobs"\nc1 = "1 m"'), 4, "unknown key 'c1' in [system]"),
        (_double('form = "bodies"'), 3, "system.m1 is needed by the form 'bodies'; write m1 = "),
        (_double("l1 = 1"), 3, "system.l1 needs a quantity with its unit, in quotes, or a table"),
        (_double('l1 = "1 kg"'), 3, "system.l1 must be in m or a unit of the same kind"),
        (_double('l1 = "-1 m"'), 3, 'system.l1 must be positive, got "-1 m"; write l1 = "50 cm"'),
        (_double('l1 = { uniform = ["0 m", "1 m"] }'), 3, "system.l1 must be positive, got { unif"),
        (BODIES.replace('"0.5 m"', '"-1 m"') + RUN, 7, "system.c1 must not be negative"),
        (
            '[system]\nkind = "simple"\n[system.length]\ngrid = []' + RUN,
            3,
            "system.length: grid must be a list of one value at least, got []; name its values",
        ),
        (
            _double("l1 = { }"),
            3,
            "must be a table of one key, of uniform, log_uniform, normal, choice",
        ),
        (_double("l1 = { gaus = [1] }"), 3, "must be a table of one key"),
        (_double('l1 = { uniform = ["1 m"] }'), 3, 'uniform must be two ends, got ["1 m"]'),
        (_double("l1 = { uniform = [1, 2] }"), 3, "uniform needs quantities with their units"),
        (_double('l1 = { uniform = "1 m" }'), 3, "system.l1: uniform must be a list of one value"),
        (_double('l1 = { uniform = ["2 m", "1 m"] }'), 3, "system.l1: a range must rise, got 2.0"),
        (_double('l1.uniform = ["2 m", "1 m"]'), 3, "system.l1: a range must rise"),
        (_double('l1 = { uniform = ["1 m", "2 kg"] }'), 3, "system.l1 must be in m"),
        (
            _double(state='omega1 = { log_uniform = ["0 rad/s", "1 rad/s"] }'),
            5,
            "state.omega1: log_uniform must begin above zero",
        ),
        (_double('l1 = { grid = ["1 m", "2 m"] }'), 3, "grid must be two ends and a count"),
        (_double('l1 = { grid = ["1 m", "2 m", 1] }'), 3, "a grid must have at least 2 values"),
        (_double('l1 = { grid = ["1 m", "2 m", 2.5] }'), 3, "the count of a grid must be a whole"),
        (_double("l1 = { list = [] }"), 3, "system.l1: list must be a list of one value at least"),
        (_double('l1 = { same_as = "m1" }'), 3, "same_as must be one of l2, got"),
        (
            _double('l1 = { same_as = "l2" }\nl2 = { same_as = "l1" }'),
            3,
            "system.l1 cannot be the same as another",
        ),
        (_double('l1 = "1e300 m"'), 3, "parameters cannot be computed with: their constant A is"),
        (_double('l1 = { grid = ["1 m", "1e300 m", 2] }'), 3, "computed with: their constant A"),
        (_double(run=""), 6, 'run.t_max is needed, the end of each run; write t_max = "30 s"'),
        (_double(run="t_max = 1"), 7, "run.t_max needs a quantity with its unit, in quotes, got 1"),
        (_double(run='t_max = "-1 s"'), 7, 'run.t_max must be positive, got "-1 s"'),
        (_double(run='t_max = "1 s"\nevery = "2 s"'), 8, "run.every must not exceed run.t_max = 1"),
        (_double(run='method = "rk5"\nt_max = "1 s"'), 7, "method must be one of euler, heun"),
        (_double(run='method = "verlet"\nt_max = "1 s"'), 7, "method 'verlet' needs a system"),
        (
            _double(run='t_max = "1 s"\nmethod = "rk4"'),
            8,
            "run.step is needed by the fixed-step method 'rk4'; give step = \"0.001 s\", say",
        ),
        (
            _double(run='t_max = "1 s"\nmethod = "rk4"\nstep = "1 ms"\ntolerance = 1e-9'),
            10,
            "tolerance is not taken by the fixed-step method 'rk4'",
        ),
        (_double(run='t_max = "1 s"\nstep = "1 ms"'), 8, "step is not taken by the adaptive"),
        (_double(run='t_max = "1 s"\ntolerance = 1.0'), 8, "tolerance must lie between"),
        (_double(run='t_max = "1 s"\ntolerance = "tight"'), 8, "tolerance must be a number"),
        (_double(run='t_max = "1e300 s"'), 7, "run.t_max must be small enough to tell times apart"),
        (_double(run='t_max = "1 s"\ncertify = "2 rad"'), 8, "certify must be an angle of at most"),
        (_double(run='t_max = "1 s"\ncertify = "1 s"'), 8, "run.certify must be in rad"),
        (_double(run='t_max = "1 s"\nmax_steps = 0'), 8, "run.max_steps must be a whole number"),
        (_double(run='t_max = "1 s"\nchunk = 0'), 8, "run.chunk must be a whole number from 1"),
        (_double(run='t_max = "1 s"\nseed = -1'), 8, "run.seed must be a whole number from 0"),
        (_double(run='t_max = "1 s"\nseed = 1.5'), 8, "run.seed must be a whole number from 0"),
        (_double(run='t_max = "1 s"\ndraws = 5'), 8, "draws must be 1 where nothing is random"),
        (
            _double('l1 = { uniform = ["1 m", "2 m"] }'),
            6,
            "run.draws is needed where anything is random",
        ),
    ],
)
def test_a_broken_recipe_is_told_in_one_line(
    tmp_path: Path, text: str | bytes, line: int, says: str
) -> None:
    with pytest.raises(ValueError, match=r"mine\.toml") as caught:
        _read(tmp_path, text)
    message = str(caught.value)
    assert message.startswith(f"{tmp_path / 'mine.toml'}, line {line}: ")
    assert says in message
    assert "\n" not in message


def test_a_missing_recipe_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"none\.toml"):
        read_sweep(tmp_path / "none.toml")
