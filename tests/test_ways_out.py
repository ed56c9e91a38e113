"""What a message says of a mistake: the rule, what was given, and what there is for it."""

from __future__ import annotations

import copy
import dataclasses
import inspect
import math
import pickle
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast, get_args

import numpy as np
import pytest
import xarray as xr

import pendula
from pendula import (
    DoublePendulum,
    LinearPendulum,
    SimplePendulum,
    ensemble,
    exact,
    load,
    plot,
    poincare_section,
    solve,
)
from pendula._types import MethodName
from pendula.analysis import work_precision
from pendula.events import Event, angle, flip, velocity_zero
from pendula.sweeping import read_sweep
from refusals import told

if TYPE_CHECKING:
    from collections.abc import Callable

    from commands import Call

SIMPLE, RODS = SimplePendulum(), DoublePendulum.rods()
START = (2.0, 2.5, 0.0, 0.0)
RECIPE: dict[str, Any] = {"system": {"kind": "simple"}, "run": {"t_max": "1 s"}}


# ---- events ----


@pytest.mark.parametrize("i", [3, 0, -1, "1", 2.0, True, None, np.array([1, 2])])
@pytest.mark.parametrize("made", [flip, velocity_zero, lambda i: angle(i, 0.5)])
def test_a_rod_that_there_is_none_of(made: Callable[..., Event], i: object) -> None:
    assert told(lambda: made(i)).startswith("i must be 1 or 2, counted from the pivot")


def test_a_rod_may_be_any_whole_number_type() -> None:
    whole: Any = np.int64(2)
    assert flip(whole) == flip(2)


# ---- files ----


@pytest.mark.parametrize(
    ("name", "kind", "way"),
    [
        ("map.zarr", "map", "xarray.open_zarr"),
        ("map.nc", "map", "xarray.open_dataset"),
        ("many.nc", "ensemble", "xarray.open_dataset"),
        ("many.csv", "ensemble", 'pandas.read_csv(…, comment="#")'),
        ("rows.parquet", "sweep", "pandas.read_parquet"),
        ("rows.zarr", "sweep", "xarray.open_zarr"),
        ("found.csv", "events", 'pandas.read_csv(…, comment="#")'),
        ("costs.csv", "comparison", 'pandas.read_csv(…, comment="#")'),
    ],
)
def test_a_file_of_another_kind_is_named_with_what_reads_it(
    name: str, kind: str, way: str, tmp_path: Path, call: Call
) -> None:
    path = tmp_path / name
    if kind == "map":
        call(f"map flip double --size 3 --t-max 0.1s -o {path}")
    elif kind == "comparison":
        call(f"compare simple --t-max 1s --points 2 -o {path}")
    elif kind == "events":
        call(f"solve simple --t-max 9s --event 'velocity-zero 1' --events-file {path}")
    elif kind == "ensemble":
        ensemble(SIMPLE, [(0.1, 0.2)] * 3, 1.0).save(path)
    else:
        pendula.sweep(RECIPE, path)
    held = {"ensemble": "an ensemble", "events": "events"}.get(kind, f"a {kind}")
    said = f"{path} holds {held}, not a trajectory; read it with {way}"
    assert told(lambda: load(path)) == said


# ---- systems ----


@pytest.mark.parametrize(
    "made",
    [
        DoublePendulum,
        lambda: DoublePendulum(1.0, 1.0),  # type: ignore[arg-type]
        lambda: DoublePendulum(m1=1.0, m2=1.0),
        lambda: DoublePendulum("rods", m1=1.0),
        lambda: DoublePendulum((1.0, 1.0, 1.0, 1.0)),  # type: ignore[arg-type]
    ],
)
def test_a_double_pendulum_names_its_makers(made: Callable[[], object]) -> None:
    message = told(made)
    for name in (".rods(…) of two uniform rods", ".bobs(…) of two bobs", ".bodies(…) of two rigid"):
        assert name in message


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, dataclasses.replace, pickle.dumps])
def test_a_double_pendulum_is_a_data_class_still(again: Callable[[Any], Any]) -> None:
    made = again(RODS)
    made = pickle.loads(made) if isinstance(made, bytes) else made
    assert (made, hash(made), repr(made)) == (RODS, hash(RODS), repr(RODS))
    with pytest.raises(dataclasses.FrozenInstanceError):
        made.form = "bobs"


@pytest.mark.parametrize("kind", [SimplePendulum, DoublePendulum])
def test_a_class_is_no_system(kind: Any) -> None:
    message = told(lambda: solve(kind, START, 1.0))
    assert message.endswith("; make one of the class, with its parameters in brackets")


def test_a_form_that_is_mistyped() -> None:
    assert told(lambda: DoublePendulum("rod", (1.0,))).endswith("got 'rod'; did you mean 'rods'?")


# ---- one state, many states, large ones ----


def test_many_states_are_an_ensemble() -> None:
    assert "for many use ensemble(system, states" in told(lambda: solve(SIMPLE, [(1, 0)] * 3, 1.0))
    section = told(lambda: poincare_section(SIMPLE, [(1, 0)] * 3, flip(1), 2))
    assert section.endswith("; call poincare_section for each")


@pytest.mark.parametrize(
    ("system", "state"),
    [
        (SIMPLE, (1e9, 0.0)),
        (SIMPLE, (-(2.0**26), 3.0)),
        (RODS, (0.0, -1e9, 0.0, 0.0)),
        (RODS, (1e300, 1.0, 0.0, 0.0)),
    ],
)
def test_an_angle_beyond_the_sine_is_refused_at_once(system: Any, state: Any) -> None:
    calls: list[Callable[[], object]] = [
        lambda: solve(system, state, 10.0),
        lambda: solve(system, state, -10.0),
        lambda: solve(system, state, 10.0, "rk4", step=0.1),
        lambda: solve(system, state, [1.0, 2.0], "dop853"),
        lambda: poincare_section(system, state, flip(1), 3),
    ]
    for call in calls:
        message = told(call)
        assert message.startswith("state must have angles below 2^26 rad = 67108864 rad, got ")
        assert message.endswith("; take whole turns off: the motion is the same")


def test_a_linear_pendulum_has_no_sine_and_digits_have_a_range_of_their_own() -> None:
    assert solve(LinearPendulum(), (1e9, 0.0), 1.0).outcome == "reached_end"
    assert solve(SIMPLE, (1e9, 0.0), [0.1], digits=9).outcome == "reached_end"
    assert ensemble(SIMPLE, [(1e9, 0.0), (1.0, 0.0)], 1.0).outcomes[0] == "not_finite"


# ---- names ----


def test_the_type_of_a_method_is_the_catalogue() -> None:
    names = [each.name for each in pendula.methods()]
    assert list(get_args(MethodName)) == names
    for function in (solve, ensemble):
        assert inspect.signature(function).parameters["method"].annotation == "MethodName"


@pytest.mark.parametrize("method", ["RK4", "rk4", "Rk4", np.str_("RK4")])
def test_a_method_in_any_case_is_the_method(method: Any) -> None:
    run = solve(SIMPLE, (1, 0), 1.0, method, step=0.1)
    assert (run.method, type(run.method)) == ("rk4", str)
    many = ensemble(SIMPLE, [(1, 0)], 1.0, method, step=0.1)
    assert (many.method, type(many.method)) == ("rk4", str)
    recipe = RECIPE | {"run": {"t_max": "1 s", "method": str(method), "step": "0.1 s"}}
    assert read_sweep(recipe).method == "rk4"
    found = work_precision(SIMPLE, (1, 0), 1.0, [method, "rk4"], points=2, timed=False)
    assert [each.method for each in found.methods] == ["rk4"]


@pytest.mark.parametrize(
    "method",
    [
        np.array(["rk4", "taylor"]),
        np.array([1, 2]),
        np.array("rk4"),
        None,
        4,
        ["rk4"],
        b"rk4",
        RODS,
    ],
)
def test_a_method_that_is_no_name(method: Any) -> None:
    for call in (solve, ensemble):
        assert told(lambda c=call: c(SIMPLE, (1, 0), 1.0, method)).startswith(
            "method must be one of"
        )
    with pytest.raises(ValueError, match="methods must be one of"):
        work_precision(SIMPLE, (1, 0), 1.0, [method])


def test_one_name_is_a_list_of_one() -> None:
    found = work_precision(SIMPLE, (1, 0), 1.0, "rk4", points=2, timed=False)
    assert [each.method for each in found.methods] == ["rk4"]
    assert "methods must be one of" in told(lambda: work_precision(SIMPLE, (1, 0), 1.0, 3))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("call", "meant"),
    [
        (lambda: solve(SIMPLE, (1, 0), 1.0, "rk5", step=0.1), "rk4"),  # type: ignore[arg-type]
        (lambda: solve(SIMPLE, (1, 0), 1.0, "tailor"), "taylor"),  # type: ignore[arg-type]
        (lambda: ensemble(SIMPLE, [(1, 0)], 1.0, "simplectic-euler"), "symplectic-euler"),  # type: ignore[arg-type]
        (lambda: plot.flip_map(xr.Dataset(), ticks="degree"), "degrees"),
    ],
)
def test_a_name_that_is_mistyped(call: Callable[[], object], meant: str) -> None:
    assert told(call).endswith(f"; did you mean {meant!r}?")


def test_an_option_that_is_mistyped() -> None:
    message = told(lambda: solve(SIMPLE, (1, 0), 1.0, "rk4", stepp=0.1), TypeError)  # type: ignore[call-arg]
    assert message.endswith("unexpected keyword argument 'stepp'; did you mean 'step'?")


# ---- pictures ----


@pytest.mark.parametrize("draw", [plot.flip_map, plot.divergence_map])
def test_what_is_no_map(draw: Callable[[Any], object]) -> None:
    run = solve(SIMPLE, (1, 0), 1.0)
    assert told(lambda: draw(run)).endswith("; draw a run with its own plot()")
    for path in ("flips.zarr", Path("flips.zarr")):
        assert "open the file first, with xarray" in told(lambda p=path: draw(p))
    others: tuple[Any, ...] = (None, 3, {}, [run])
    for other in others:
        assert told(lambda o=other: draw(o)).endswith("_map returned")
    assert "must hold" in told(lambda: draw(xr.Dataset()))


def test_what_is_no_run() -> None:
    many = ensemble(SIMPLE, [(1, 0)], 1.0)
    others: tuple[Any, ...] = (None, {}, many, "run.csv")
    for other in others:
        assert "must be what solve or exact returned" in told(lambda o=other: plot.trajectory(o))
    assert "plot.flip_map" in told(lambda: plot.trajectory(cast("Any", xr.Dataset())))
    assert told(lambda: exact(SIMPLE, [(1, 0)] * 3, 1.0).plot()).endswith("; draw them one by one")
    assert "pendula.analysis.work_precision" in told(lambda: plot.work_precision([many]))  # type: ignore[list-item]


@pytest.mark.parametrize("system", [SIMPLE, RODS])
def test_a_run_without_outputs_is_not_drawn(system: Any) -> None:
    state = np.zeros(len(system.components)) + 1.0
    empty = solve(system, state, [10.0], "rk4", step=1.0, max_steps=1)
    assert empty.t.size == 0
    assert "has no outputs to draw: the run ended as 'step_limit'" in told(empty.plot)
    solve(system, state, [1.0], "rk4", step=1.0).plot()  # of one it is drawn


# ---- several exact solutions ----


@pytest.mark.parametrize("shape", [(3,), (3, 4), (2, 3, 4), (1, 1), (0, 2)])
@pytest.mark.parametrize("ending", ["nc", "zarr"])
def test_a_grid_of_exact_solutions_is_a_dataset_and_a_file(
    shape: tuple[int, ...], ending: str, tmp_path: Path
) -> None:
    states = np.random.default_rng(1).normal(size=(*shape, 2))
    run = exact(SIMPLE, states, [1.0, 2.0, 3.0])
    data = run.to_xarray()
    names = ["trajectory"] if len(shape) == 1 else [f"trajectory{i + 1}" for i in range(len(shape))]
    assert data["theta"].dims == (*names, "t")
    np.testing.assert_array_equal(data["theta"], run.theta)
    if math.prod(shape):
        run.save(tmp_path / f"grid.{ending}")
        again = load(tmp_path / f"grid.{ending}")
        np.testing.assert_array_equal(again.states, run.states)
        np.testing.assert_array_equal(again.request.state, states)
    if len(shape) > 1:
        assert f"takes one motion, got {math.prod(shape)}" in told(run.to_pandas)
