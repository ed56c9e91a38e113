"""What figures are given: taken with its unit, or refused in one line, before anything is drawn."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pint
import pytest

import pendula
from pendula import DoublePendulum, SimplePendulum, degrees, plot
from pendula.analysis import convergence_order

REGISTRY: Any = pint.UnitRegistry()
Q: Any = REGISTRY.Quantity
MADE: Any = np.ma
SIMPLE: Any = SimplePendulum()
RODS: Any = DoublePendulum.rods()
MASKED: Any = MADE.array([0.5, 0.7], mask=[False, True])
TWO, STEPS = np.array([0.5, 0.7]), np.array([0.1, 0.05])
FIT = convergence_order(STEPS, STEPS**4)


def linear_error(
    amplitudes: Any = TWO, errors: Any = TWO, limits: Any = None, key: Any = 10
) -> Any:
    wanted = {10: {0.01: 0.6}} if limits is None else limits
    return plot.linear_error(amplitudes, {key: errors}, wanted)


def periods(amplitudes: Any = TWO, exact: Any = TWO, series: Any = TWO) -> Any:
    return plot.periods(amplitudes, exact, {1: series})


def portrait(releases: Any = TWO, system: Any = SIMPLE) -> Any:
    return plot.phase_portrait(system, releases)


def cost(kc: Any = TWO, terms: Any = TWO, iterations: Any = TWO) -> Any:
    return plot.elliptic_cost(kc, terms, iterations)


def series(t: Any = TWO, values: Any = TWO, quantity: str = "difference") -> Any:
    return plot.series([(t, {"rk4": values})], quantity)


def parting(t: Any = TWO, values: Any = TWO, moment: Any = 0.6, tolerance: Any = 0.1) -> Any:
    return plot.parting(t, {"rk4": values}, {"rk4": moment}, tolerance)


def convergence(steps: Any = STEPS, errors: Any = STEPS**4) -> Any:
    return plot.convergence(steps, [{"rk4": (errors, FIT)}], ["a"])


SAME: list[tuple[Callable[[], Any], Callable[[], Any]]] = [
    (lambda: linear_error(Q([30, 60], "deg")), lambda: linear_error(degrees([30, 60]))),
    (
        lambda: linear_error(limits={10: {0.01: Q(30, "deg")}}),
        lambda: linear_error(limits={10: {0.01: degrees(30)}}),
    ),
    (lambda: periods(Q([30, 60], "deg")), lambda: periods(degrees([30, 60]))),
    (lambda: periods(exact=Q(TWO, ""), series=Q(TWO, "")), periods),
    (lambda: portrait(Q([30, 60], "deg")), lambda: portrait(degrees([30, 60]))),
    (lambda: portrait([Q(30, "deg"), 0.5]), lambda: portrait((degrees(30), 0.5))),
    (lambda: portrait(MADE.array(TWO)), portrait),
    (lambda: cost([0.5, 0.7], Q(TWO, ""), (0.5, 0.7)), cost),
    (
        lambda: series(Q([1, 2], "min"), Q([1, 2], "arcmin")),
        lambda: series([60, 120], [1 / 60, 2 / 60]),
    ),
    (lambda: parting(Q([1, 2], "min")), lambda: parting([60, 120])),
    (
        lambda: parting(
            values=Q([np.pi / 2, np.pi], "rad"), moment=Q(600, "ms"), tolerance=Q(6, "arcmin")
        ),
        lambda: parting(values=[90.0, 180.0]),
    ),
    (lambda: convergence(Q([100, 50], "ms")), convergence),
    (lambda: convergence(errors=Q(STEPS**4, "rad")), convergence),
]


@pytest.mark.parametrize(("made", "same"), SAME)
def test_units_are_taken(made: Callable[[], Any], same: Callable[[], Any]) -> None:
    assert plot.svg(made()) == plot.svg(same())


REFUSED: list[tuple[Callable[[], Any], str]] = [
    (lambda: linear_error(MASKED), "amplitudes must have no masked elements, got one at"),
    (lambda: linear_error(errors=MASKED), "errors[10] must have no masked elements"),
    (lambda: linear_error(limits={}), "limits must have the keys of errors: 10; got none"),
    (lambda: linear_error(limits=3), "limits must be a dict, got 3"),
    (lambda: linear_error(limits={10: {0.1: Q(1, "m")}}), "limits[10][0.1] must be in rad"),
    (lambda: periods(Q([1, 2], "m")), "amplitudes must be in rad or a unit of the same kind"),
    (lambda: periods(exact=Q([1, 2], "s")), "exact must be a number without a unit"),
    (lambda: periods(exact=[1.0]), "exact must have shape (2,), got shape (1,)"),
    (lambda: periods(series=Q([1, 2], "s")), "series[1] must be a number without a unit"),
    (lambda: periods([0.1, np.nan]), "amplitudes must"),
    (lambda: periods(["a", "b"]), "amplitudes must hold numbers [rad], got ['a', 'b']"),
    (lambda: periods([True, False]), "amplitudes must hold numbers [rad], got [True, False]"),
    (lambda: plot.periods(TWO, TWO, MADE.array([1])), "series must be a dict"),
    (lambda: portrait(MASKED), "releases must have no masked elements, got one at releases[1]"),
    (lambda: portrait([]), "releases must have shape (n,), got shape (0,)"),
    (lambda: portrait(0.5), "releases must have shape (n,), got shape ()"),
    (lambda: portrait(Q([1, 2], "m")), "releases must be in rad"),
    (lambda: portrait(system=RODS), "system must be a SimplePendulum, got DoublePendulum"),
    (lambda: cost(MASKED), "kc must have no masked elements"),
    (lambda: cost(terms=MASKED), "terms must have no masked elements"),
    (lambda: cost(iterations=MASKED), "iterations must have no masked elements"),
    (lambda: cost([0.5, 1.5]), "kc must lie within [0, 1]"),
    (lambda: cost(Q([1, 2], "m")), "kc must be a number without a unit"),
    (lambda: series(MASKED), "t must have no masked elements"),
    (lambda: series(values=MASKED), "cases['rk4'] must have no masked elements"),
    (lambda: series(values=Q(TWO, "rad"), quantity="energy_error"), "cases['rk4'] must be a num"),
    (lambda: series(quantity="errors"), "quantity must be one of difference, energy_error"),
    (lambda: parting(Q([1, 2], "m")), "t must be in s or a unit of the same kind"),
    (lambda: parting(values=Q([1, 2], "m")), "differences['rk4'] must be in deg"),
    (lambda: parting(values=MASKED), "differences['rk4'] must have no masked elements"),
    (lambda: parting(moment=Q(1, "m")), "times['rk4'] must be in s"),
    (lambda: parting(moment="1"), "times['rk4'] must be a number [s], got '1'"),
    (lambda: parting(tolerance=Q(1, "s")), "tolerance must be in deg"),
    (lambda: parting(tolerance=0), "tolerance must be positive [deg], got 0.0"),
    (lambda: convergence(Q([1, 2], "m")), "steps must be in s"),
    (lambda: convergence(errors=MASKED), "cases['rk4'] must have no masked elements"),
    (lambda: convergence(errors=[1.0, 2.0, 3.0]), "cases['rk4'] must have shape (2,)"),
]


@pytest.mark.parametrize(("made", "told"), REFUSED)
def test_what_cannot_be_drawn_is_told_in_one_line(made: Callable[[], Any], told: str) -> None:
    with pytest.raises(ValueError, match="must") as error:
        made()
    assert told in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("drawn", [linear_error, periods, portrait])
def test_amplitudes_that_look_like_degrees_are_told(drawn: Callable[[Any], Any]) -> None:
    with pytest.warns(pendula.DegreesWarning, match="30 rad is 1719 degrees") as told:
        drawn([30.0, 60.0])
    assert [each.filename for each in told] == [__file__]
