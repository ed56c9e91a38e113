"""What a sweep's recipe and columns are made of in Python: taken with its unit, or one line."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pint
import pytest

import pendula
from pendula import degrees
from pendula.events import angle
from pendula.sampling import (
    Choice,
    Distribution,
    Fixed,
    Grid,
    Listed,
    LogUniform,
    SameAs,
    Sampler,
    Uniform,
)
from pendula.sweeping import SweepRecipe, sweep_from

REGISTRY: Any = pint.UnitRegistry()
Q: Any = REGISTRY.Quantity
MADE: Any = np.ma
MASKED: Any = MADE.array([0.5, 0.7], mask=[False, True])
LISTS: list[Any] = [Listed, Choice]
DOUBLE = ("m1", "m2", "l1", "l2", "theta1", "theta2", "omega1", "omega2")


def columns(**given: Distribution) -> tuple[tuple[str, Distribution], ...]:
    names = ("length", "gravity", "mass", "theta", "omega")
    return tuple((name, given.get(name, Fixed(0.5))) for name in names)


def made(**given: Any) -> SweepRecipe:
    plain: dict[str, Any] = {
        "system": "simple",
        "form": "",
        "sampler": Sampler(columns()),
        "method": "taylor",
        "t_max": 1.0,
        "every": None,
        "chunk": 10,
    }
    return SweepRecipe(**{**plain, **given})


@pytest.mark.parametrize(
    ("given", "name", "value"),
    [
        ({"t_max": Q(1, "min")}, "t_max", 60.0),
        ({"t_max": Q(1, "min"), "every": Q(100, "ms")}, "every", 0.1),
        ({"chunk": Q(10, "")}, "chunk", 10),
        ({"chunk": np.int64(3)}, "chunk", 3),
        ({"tolerance": Q(1e-9, "")}, "tolerance", 1e-9),
        ({"step": Q(10, "ms"), "method": "rk4"}, "step", 0.01),
        ({"certify": Q(1, "deg")}, "certify", degrees(1)),
        ({"max_steps": Q(3, "")}, "max_steps", 3),
        ({}, "tolerance", 2.0**-52),
    ],
)
def test_a_recipe_takes_units(given: dict[str, Any], name: str, value: Any) -> None:
    recipe = made(**given)
    found = getattr(recipe, name)
    assert (found, type(found)) == (value, type(value))
    assert sweep_from(recipe.resolved) == recipe
    assert pendula.sweep(recipe).sizes["row"] == 1


REFUSED: list[tuple[dict[str, Any], str]] = [
    (
        {"system": "triple"},
        "linear, simple, double, driven-linear, driven, damped-double; got 'triple'",
    ),
    ({"form": None}, "form must be '', this system has one alone, got None"),
    ({"system": "double", "form": "rod"}, "form must be one of rods, bobs, bodies; got 'rod'"),
    ({"sampler": 3}, "sampler must be a Sampler, got 3"),
    ({"sampler": Sampler((("l", Fixed(1.0)),))}, "sampler must have the columns length, gravity"),
    ({"method": 3}, "method must be one of euler"),
    ({"method": "rk5"}, "got 'rk5'"),
    ({"method": "rk4"}, "step is needed"),
    ({"t_max": True}, "t_max must be a number [s], got True"),
    ({"t_max": "1"}, "t_max must be a number [s], got '1'"),
    ({"t_max": Q(1, "m")}, "t_max must be in s or a unit of the same kind, got the unit 'meter'"),
    ({"t_max": np.nan}, "t_max must be a finite number [s], got nan"),
    ({"t_max": -1}, "t_max must be positive [s], got -1.0"),
    ({"t_max": MASKED[1]}, "t_max must have no masked elements"),
    ({"every": 2.0}, "every must not exceed t_max = 1 s, got 2.0"),
    ({"every": 0}, "every must be positive [s], got 0.0"),
    ({"chunk": Q(10, "m")}, "chunk must be a number without a unit, got the unit 'meter'"),
    ({"chunk": 2.5}, "chunk must be a whole number of at least 1, got 2.5"),
    ({"chunk": True}, "chunk must be"),
    ({"chunk": 0}, "chunk must be a whole number from 1"),
    ({"tolerance": Q(1, "percent")}, "tolerance has the unknown unit 'percent'"),
    ({"tolerance": 1.0}, "tolerance must lie between"),
    ({"tolerance": "x"}, "tolerance must be a number, got 'x'"),
    ({"step": Q(10, "ms")}, "step is not taken by the adaptive method 'taylor', got 0.01"),
    ({"step": Q(10, "m"), "method": "rk4"}, "step must be in s"),
    ({"certify": Q(1, "s")}, "certify must be in rad"),
    ({"max_steps": 0}, "max_steps must be a whole number from 1"),
    ({"events": 3}, "events must be made by pendula.events"),
    ({"sampler": Sampler(columns(length=Uniform(-1.0, 1.0)))}, "length must be positive"),
    ({"sampler": Sampler(columns(mass=Listed((1.0, 0.0))))}, "mass must be positive"),
]


@pytest.mark.parametrize(("given", "told"), REFUSED)
def test_a_recipe_is_checked(given: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match=r"\w") as error:
        made(**given)
    assert told in str(error.value)
    assert "\n" not in str(error.value)


LOOK_LIKE_DEGREES = [
    Fixed(30.0),
    Uniform(-30.0, 30.0),
    Grid(0.0, 90.0, 3),
    Listed((0.0, 45.0, 1.0)),
    Choice((0.0, -45.0)),
    LogUniform(1.0, 60.0),
]


@pytest.mark.parametrize("column", LOOK_LIKE_DEGREES)
def test_angles_that_look_like_degrees_are_told(column: Distribution) -> None:
    draws = 1 if isinstance(column, Fixed | Grid | Listed) else 2
    with pytest.warns(pendula.DegreesWarning, match="theta: ") as told:
        made(sampler=Sampler(columns(theta=column), draws))
    assert [each.filename for each in told] == [__file__]


def test_other_columns_and_radians_are_not_told() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        recipe = made(
            sampler=Sampler(columns(theta=Fixed(degrees(400)), omega=Fixed(30.0), mass=Fixed(45.0)))
        )
        with pytest.warns(pendula.DegreesWarning):
            other = made(sampler=Sampler(columns(theta=Fixed(30.0))))
        sweep_from(other.resolved)
        pendula.sweep(recipe)


def test_both_angles_of_the_double_pendulum_are_told() -> None:
    given: dict[str, Distribution] = {"theta1": Fixed(120.0), "theta2": SameAs("theta1")}
    sampler = Sampler(tuple((name, given.get(name, Fixed(1.0))) for name in DOUBLE) + GRAVITY)
    with pytest.warns(pendula.DegreesWarning, match="theta1: 120 rad") as told:
        made(system="double", form="rods", sampler=sampler)
    assert len(told) == 1


GRAVITY = (("gravity", Fixed(9.8)),)


@pytest.mark.parametrize("kind", LISTS)
@pytest.mark.parametrize(
    "values", [np.array([1, 2]), [1.0, np.float64(2)], Q([1, 2], ""), MADE.array([1.0, 2.0])]
)
def test_lists_take_arrays(kind: Callable[[Any], Any], values: Any) -> None:
    assert kind(values).values == (1.0, 2.0)


@pytest.mark.parametrize("kind", LISTS)
@pytest.mark.parametrize(
    ("values", "told"),
    [
        (MASKED, "must have no masked elements, got one at"),
        (Q([1, 2], "deg"), "must be a number without a unit, got the unit 'degree'"),
        ([Q(1, "m")], "must be a number without a unit, got the unit 'meter'"),
        (np.array([[1.0, 2.0]]), "must be a number, got [1.0, 2.0]"),
        (np.array(3.0), "must be a list of numbers, got array(3.)"),
        (3, "must be a list of numbers, got 3"),
        ("12", "must be a list of numbers, got '12'"),
        (np.array([True]), "must be a list of numbers, got array([ True])"),
        ([True], "must be a list of numbers, got [True]"),
        ({1.0: 2}, "must be a list of numbers"),
        (np.array([]), "must have at least one value"),
        (np.array([1.0, np.nan]), "must be a finite number, got nan"),
        (np.array([1j]), "must be a number, got 1j"),
    ],
)
def test_lists_are_checked(kind: Callable[[Any], Any], values: Any, told: str) -> None:
    with pytest.raises(ValueError, match="of a (list|choice)|a (list|choice) must") as error:
        kind(values)
    assert told in str(error.value)


ONE = (("x", Uniform(0.0, 1.0)),)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"seed": Q(2, "m")}, "seed must be a number without a unit, got the unit 'meter'"),
        ({"seed": np.array([1, 2])}, "seed must be a whole number from 0 to 2^64 - 1, got array("),
        ({"seed": 2.0}, "seed must be a whole number from 0 to 2^64 - 1, got 2.0"),
        ({"seed": "2"}, "seed must be a whole number from 0 to 2^64 - 1, got '2'"),
        ({"seed": None}, "seed must be a whole number from 0 to 2^64 - 1, got None"),
        ({"seed": MASKED[1]}, "seed must have no masked elements"),
        ({"draws": Q(3, "m")}, "draws must be a number without a unit"),
        ({"columns": {"x": Fixed(1.0)}}, "columns must be pairs of a name and where"),
        ({"columns": 3}, "columns must be pairs of a name and where its values come from, got 3"),
        ({"columns": (("x", 3.0),)}, "columns must be pairs of a name and where"),
        ({"columns": ((1, Fixed(3.0)),)}, "columns must be pairs of a name and where"),
    ],
)
def test_a_sampler_is_checked(given: dict[str, Any], told: str) -> None:
    with pytest.raises(ValueError, match="must") as error:
        Sampler(**{"columns": ONE, **given})
    assert told in str(error.value)


def test_whole_numbers_of_a_sampler_are_plain_ones() -> None:
    sampler = Sampler(ONE, draws=Q(3, ""), seed=Q(2, ""))
    assert type(sampler.draws) is type(sampler.seed) is int
    assert sampler == Sampler(ONE, 3, 2)


def test_a_parameter_can_be_the_same_as_a_component() -> None:
    given: dict[str, Distribution] = {"length": SameAs("theta"), "theta": Uniform(0.5, 1.0)}
    assert made(sampler=Sampler(columns(**given), 2)).sampler.count == 2
    with pytest.raises(ValueError, match="length must be positive"):
        made(sampler=Sampler(columns(**given | {"theta": Uniform(-0.5, 1.0)}), 2))


def test_a_recipe_with_events_is_described() -> None:
    recipe = made(events=angle(1, 0.1))
    assert sweep_from(recipe.resolved) == recipe
