"""Numbers that carry a unit or a mask: converted, or refused in one line, wherever they go."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr

import pendula
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, degrees, elliptic
from pendula.analysis import parting_time, work_precision
from pendula.events import angle, tip_height

OURS: Any = pint.UnitRegistry()
OTHER: Any = pint.UnitRegistry()
Q: Any = OTHER.Quantity
SIMPLE, RODS = SimplePendulum(), DoublePendulum.rods()
START = (1.0, 0.0)
MADE: Any = np.ma  # whose types are as loose as what users give
NUMPY: Any = np
THETA, OMEGA = Q(57, "deg"), Q(30, "deg/s")
MASKED: Any = MADE.array([0.5, 1.0], mask=[False, True])
OPEN: Any = MADE.array([0.5, 1.0], mask=[False, False])


def labelled(values: Any, unit: Any = None) -> Any:
    return xr.DataArray(values, attrs={} if unit is None else {"units": unit})


class WithUnit(np.ndarray[Any, Any]):
    """An array that numpy strips of its unit without a word, as those of astropy and unyt are."""

    unit: str


def with_unit(values: Any, unit: str) -> WithUnit:
    made = np.asarray(values, dtype=np.float64).view(WithUnit)
    made.unit = unit
    return made


def first(state: Any, system: Any = SIMPLE, t: Any = 0.1) -> list[float]:
    found: list[float] = pendula.solve(system, state, t).states[0].tolist()
    return found


# ---- taken ----


@pytest.mark.parametrize(
    ("state", "want"),
    [
        ((THETA, OMEGA), [degrees(57), degrees(30)]),
        ((THETA, 0.5), [degrees(57), 0.5]),
        ([OURS.Quantity(0.5, "turn"), OTHER.Quantity(1, "turn/min")], [np.pi, 2 * np.pi / 60]),
        (np.array([1.0, 2.0]), [1.0, 2.0]),
        ((labelled(57.0, "degrees"), labelled(1.5, "rad s-1")), [degrees(57), 1.5]),
        ((labelled(0.5, "radians"), labelled(Q(np.array(3.0), "rad/s"))), [0.5, 3.0]),
        (labelled([0.5, 1.5]), [0.5, 1.5]),
        (labelled([0.5, 1.5], ""), [0.5, 1.5]),
        ((with_unit(57, "deg"), with_unit(2, "rad / s")), [degrees(57), 2.0]),
        ((Q(0.5, ""), 1.0), [0.5, 1.0]),
        (OPEN, [0.5, 1.0]),
        (pd.Series([0.5, 1.5]), [0.5, 1.5]),
    ],
)
def test_units_of_a_state_are_taken(state: Any, want: list[float]) -> None:
    assert first(state) == pytest.approx(want, rel=3e-16)
    assert pendula.exact(SIMPLE, state, 0.0).states[0].tolist() == first(state)


def test_states_of_other_shapes_and_systems() -> None:
    four = (Q(120, "deg"), Q(-10, "deg"), Q(0, "deg/s"), OMEGA)
    assert first(four, RODS) == [degrees(120), degrees(-10), 0.0, degrees(30)]
    assert first((THETA, OMEGA), LinearPendulum()) == [degrees(57), degrees(30)]
    many = pendula.ensemble(SIMPLE, [(THETA, OMEGA), (Q(1, "deg"), 0)], Q(1, "min"))
    assert many.states.shape == (2, 1, 2)
    assert many.t.tolist() == [60.0]
    rows = SIMPLE.energy([(THETA, OMEGA), (Q(1, "deg"), 0)])
    assert rows.tolist() == SIMPLE.energy([(degrees(57), degrees(30)), (degrees(1), 0)]).tolist()
    back = pendula.solve(SIMPLE, (THETA, 0), Q(-2, "s"), t0=Q(1, "min"))
    assert (back.t[0], back.t[-1]) == (60.0, -2.0)


TAKEN: list[tuple[Callable[[], Any], Any]] = [
    (lambda: SimplePendulum(Q(50, "cm"), Q(1, "g_0"), Q(500, "g")), SimplePendulum(0.5, mass=0.5)),
    (lambda: DoublePendulum.bobs(l1=labelled(50.0, "cm")), DoublePendulum.bobs(l1=0.5)),
    (lambda: DoublePendulum.rods(m2=MADE.array(2.0)), DoublePendulum.rods(m2=2.0)),
    (lambda: list(pendula.solve(SIMPLE, START, Q([1, 2], "min")).t), [60.0, 120.0]),
    (lambda: list(pendula.solve(SIMPLE, START, [Q(1, "s"), Q(1, "min")]).t), [1.0, 60.0]),
    (lambda: pendula.solve(SIMPLE, START, labelled([1.0, 2.0], "minutes")).t[-1], 120.0),
    (lambda: list(pendula.solve(SIMPLE, START, OPEN).t), [0.5, 1.0]),
    (lambda: pendula.solve(SIMPLE, START, 1, "rk4", step=Q(10, "ms")).request.step, 0.01),
    (lambda: pendula.solve(SIMPLE, START, 1, certify=Q(1, "deg")).request.certify, degrees(1)),
    (lambda: pendula.solve(SIMPLE, START, 1, tolerance=Q(1e-9, "")).request.tolerance, 1e-9),
    (lambda: pendula.solve(SIMPLE, START, 1.0).at(Q([100, 200], "ms")).shape, (2, 2)),
    (lambda: SIMPLE.period(Q([30, 60], "deg")).tolist(), SIMPLE.period(degrees([30, 60])).tolist()),
    (lambda: SIMPLE.period(state=(THETA, OMEGA)), SIMPLE.period(state=(degrees(57), degrees(30)))),
    (
        lambda: pendula.time_at(SIMPLE, START, Q(10, "deg")),
        pendula.time_at(SIMPLE, START, degrees(10)),
    ),
    (lambda: pendula.action(SIMPLE, (THETA, 0)), pendula.action(SIMPLE, (degrees(57), 0))),
    (lambda: angle(1, Q(30, "deg")), angle(1, degrees(30))),
    (lambda: tip_height(Q(30, "cm")), tip_height(0.3)),
    (lambda: elliptic.F(Q(30, "deg"), 0.5), elliptic.F(degrees(30), 0.5)),
    (lambda: elliptic.K(Q(0.5, "")), elliptic.K(0.5)),
    (lambda: SIMPLE.rhs(START, Q(1, "min")).tolist(), SIMPLE.rhs(START).tolist()),
    (lambda: parting_time(Q([0, 1], "min"), Q([0, 2], "deg"), Q(1, "deg")), 30.0),
]


@pytest.mark.parametrize(("made", "want"), TAKEN)
def test_units_are_taken(made: Callable[[], Any], want: Any) -> None:
    assert made() == want


def test_units_of_a_map_are_taken() -> None:
    asked = RODS, Q([-90, 90], "deg"), (Q(-1, "turn"), labelled(1.0, "rad")), (2, 2), Q(100, "ms")
    times = pendula.flip_map(*asked)
    growth = pendula.divergence_map(*asked, separation=Q(1, "arcsec"))
    assert (
        times.theta1.values.tolist() == [-degrees(45), degrees(45)] == growth.theta1.values.tolist()
    )
    assert times.attrs["t_max"] == 0.1


def test_conversions_are_rounded_once() -> None:
    values = np.random.default_rng(3).uniform(-300, 300, 500)
    states = [(each, 0.0) for each in Q(values, "deg")]
    got = SIMPLE.positions(states)
    assert got.tolist() == SIMPLE.positions(np.stack([degrees(values), 0 * values], -1)).tolist()
    assert SimplePendulum(Q(3.3, "cm")).length == 3.3 / 100


# ---- refused ----


def flips() -> Any:
    return pendula.flip_map(RODS, (-3, 3), (-3, 3), (4, 4), 2)


def apart() -> Any:
    return pendula.divergence_map(RODS, (-3, 3), (-3, 3), (2, 2), 1)


REFUSED: list[tuple[Callable[[], Any], str]] = [
    (lambda: first(Q([57, 0], "deg")), "state must have omega in rad/s"),
    (lambda: first(labelled([57.0, 0.0], "deg")), "state must have omega in rad/s"),
    (lambda: first(labelled([57.0, 0.0], "rad")), "state must have omega in rad/s"),
    (lambda: first(with_unit([57.0, 0.0], "deg")), "state must have omega in rad/s"),
    (lambda: first((THETA, THETA)), "state must have omega in rad/s"),
    (lambda: first((OMEGA, THETA)), "state must have theta in rad"),
    (lambda: first((THETA, Q(1, "Hz"))), "state must have omega in rad/s"),
    (lambda: first((Q(1, "m"), 0)), "state must have theta in rad or a unit of the same kind"),
    (lambda: first((labelled(1.0, "degrees_north"), 0)), "state has the unknown unit"),
    (lambda: first((labelled(1.0, "Grad"), 0)), "state must have theta in deg or gon"),
    (lambda: first((1.0, labelled(1.0, 7))), "state must have omega"),
    (lambda: RODS.energy(Q([1, 2, 3, 4], "deg")), "state must have omega1"),
    (lambda: pendula.ensemble(SIMPLE, Q([[1, 2]], "deg"), 1), "states must have omega in rad/s"),
    (lambda: SimplePendulum(Q(50, "deg")), "length must be in m or a unit of the same kind, got"),
    (lambda: SimplePendulum(Q(50, "")), "length must be in m"),
    (lambda: SimplePendulum(gravity=Q(9.81, "m/s")), "gravity must be in m/s^2"),
    (lambda: SimplePendulum(mass=Q(20, "degC")), "mass must be in kg"),
    (lambda: SimplePendulum(Q([1, 2], "m")), "length must be a number [m]"),
    (lambda: SimplePendulum(MADE.masked), "length must have no masked elements"),
    (lambda: SimplePendulum(NUMPY.array([1.0])), "length must be a number [m]"),
    (lambda: SimplePendulum(NUMPY.True_), "length must be a number [m]"),
    (lambda: SimplePendulum(NUMPY.complex128(1 + 1j)), "length must be a number [m]"),
    (lambda: first(START, t=Q(1, "m")), "t must be in s"),
    (lambda: first(START, t=Q(MADE.array([1.0, 2.0], mask=[0, 1]), "s")), "t must have no masked"),
    (lambda: first(START, t=MASKED), "t must have no masked elements, got one at t[1]; fill or"),
    (lambda: first(START, t=labelled([1.0], "seconds since 2000-01-01")), "t has the unknown unit"),
    (lambda: first(START, t=np.timedelta64(60, "s")), "t must hold numbers [s]"),
    (lambda: first(START, t=labelled(np.array([1], "m8[s]"))), "t must hold numbers [s]"),
    (lambda: first(MASKED), "state must have no masked elements, got one at state[1]"),
    (lambda: first((1.0, MADE.masked)), "state must have no masked elements"),
    (lambda: first((True, 0.0)), "state must hold numbers"),
    (lambda: pendula.exact(SIMPLE, START, MASKED), "t must have no masked"),
    (lambda: pendula.exact(SIMPLE, START, 1, t0=Q(1, "m")), "t0 must be in s"),
    (lambda: pendula.solve(SIMPLE, START, 1, "rk4", step=Q(1, "m")), "step must be in s"),
    (lambda: pendula.solve(SIMPLE, START, 1, tolerance=Q(1, "m")), "tolerance must be a number"),
    (lambda: pendula.solve(SIMPLE, START, 1, max_steps=Q(9, "s")), "max_steps must be a number"),
    (
        lambda: pendula.solve(SIMPLE, START, 1, max_steps=MADE.masked),
        "max_steps must have no mask",
    ),
    (lambda: SIMPLE.period(Q(1, "s")), "amplitude must be in rad"),
    (lambda: SIMPLE.period(MASKED), "amplitude must have no masked"),
    (lambda: LinearPendulum().period(MASKED), "amplitude must have no masked"),
    (lambda: SIMPLE.rhs(START, Q(1, "m")), "t must be in s"),
    (lambda: pendula.time_at(SIMPLE, START, MASKED), "theta must have no masked"),
    (
        lambda: pendula.time_at(SIMPLE, [START] * 3, [1, 2]),
        "state must have a shape that goes with",
    ),
    (lambda: angle(1, Q(30, "cm")), "value must be in rad"),
    (lambda: tip_height(Q(30, "deg")), "y must be in m"),
    (lambda: pendula.flip_map(RODS, MASKED, (-1, 1), (2, 2), 1), "theta1 must have no masked"),
    (lambda: pendula.flip_map(RODS, (-1, 1), Q([1, 2], "m"), (2, 2), 1), "theta2 must be in rad"),
    (lambda: pendula.flip_map(RODS, (-1, 1), (-1, 1), (2, 2), Q(1, "m")), "t_max must be in s"),
    (lambda: pendula.flip_map(RODS, Q(5, "deg"), (-1, 1), (2, 2), 1), "theta1 must be a range (lo"),
    (
        lambda: pendula.flip_map(RODS, NUMPY.array(5.0), (-1, 1), (2, 2), 1),
        "theta1 must be a range",
    ),
    (lambda: pendula.flip_map(RODS, (-1, 1), (-1, 1), NUMPY.array(2), 1), "shape must be two numb"),
    (lambda: pendula.flip_map(RODS, (-1, 1), (-1, 1), Q([2, 2], "m"), 1), "shape must be a number"),
    (lambda: first(xr.Dataset({"theta": 1.0})), "state must hold numbers, got"),
    (lambda: first((xr.Dataset({"theta": 1.0}), 0.0)), "state must hold numbers, got"),
    (lambda: pendula.plot.flip_map(flips(), limits=Q([1, 2], "m")), "limits must be in s"),
    (lambda: pendula.plot.flip_map(flips(), limits=Q(1, "s")), "limits must be two times"),
    (lambda: pendula.plot.divergence_map(apart(), limits=(MADE.masked, 1)), "limits must have no"),
    (lambda: pendula.sampling.Uniform(Q(1, "m"), 2), "low must be a number without a unit"),
    (lambda: work_precision(SIMPLE, START, Q(1, "m")), "t_max must be in s"),
    (lambda: pendula.analysis.linear_model_error(MASKED), "amplitude must have no masked"),
    (lambda: pendula.analysis.period_limit(Q(1, "m")), "tolerance must be a number without"),
]


@pytest.mark.parametrize(("made", "told"), REFUSED)
def test_other_units_and_masks_are_refused_in_one_line(made: Callable[[], Any], told: str) -> None:
    with pytest.raises(ValueError, match=r"^\w") as error:
        made()
    assert str(error.value).startswith(told)
    assert "\n" not in str(error.value)


# ---- elliptic functions ----

FUNCTIONS: dict[str, Callable[..., Any]] = {
    "K": elliptic.K,
    "E": elliptic.E,
    "K_series": lambda k, **how: elliptic.K_series(k, 9, **how),
    "F": lambda k, **how: elliptic.F(0.3, k, **how),
    "am": lambda k, **how: elliptic.am(0.3, k, **how),
    "sncndn": lambda k, **how: elliptic.sncndn(0.3, k, **how),
}
BAD: list[Any] = [
    *(
        2 + 1j,
        np.complex128(0.5 + 1j),
        np.array([0.5 + 0j]),
        "0.5",
        ["0.5"],
        True,
        [True],
        np.True_,
    ),
    *(object(), {}, [[1], [1, 2]], [None], MASKED, MADE.masked, Q(0.5, "m"), Q(30, "deg")),
    *(labelled([0.5], "rad"), pd.Series(["a"] * 90), np.datetime64("2000-01-01")),
]


@pytest.mark.parametrize("bad", BAD, ids=lambda value: repr(value).partition(" object at ")[0])
@pytest.mark.parametrize("name", FUNCTIONS)
def test_elliptic_functions_take_numbers_only(name: str, bad: Any) -> None:
    for how in (partial(FUNCTIONS[name], bad), partial(FUNCTIONS[name], None, kc=bad)):
        with pytest.raises(ValueError, match="^kc? must ") as error:
            how()
        assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "bad",
    [each for each in BAD if not isinstance(each, pint.Quantity)],
    ids=lambda value: repr(value).partition(" object at ")[0],
)
def test_their_arguments_are_numbers_too(bad: Any) -> None:
    with pytest.raises(ValueError, match="^u must "):
        elliptic.sncndn(bad, 0.5)
    with pytest.raises(ValueError, match="^u must "):
        elliptic.am(bad, kc=0.5)
    if not isinstance(bad, xr.DataArray):  # of radians
        with pytest.raises(ValueError, match="^phi must "):
            elliptic.F(bad, 0.5)


def test_shapes_that_do_not_go_together_are_told() -> None:
    with pytest.raises(ValueError, match=r"^phi must have a shape that goes with that of k, got"):
        elliptic.F([1.0, 2.0], [0.1, 0.2, 0.3])
    with pytest.raises(ValueError, match=r"^u must have a shape .* got u \(2,\), kc \(3,\)"):
        elliptic.sncndn([1.0, 2.0], kc=[0.1, 0.2, 0.3])
    assert elliptic.F(np.zeros((2, 1)), [0.1, 0.2, 0.3]).shape == (2, 3)
    assert np.isnan(elliptic.K([np.nan, 0.5])).tolist() == [True, False]
