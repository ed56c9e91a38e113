"""The rules that hold between the keys of a recipe."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula.run.exact import exact
from pendula.study.runs import REPETITIONS
from pendula.systems import DoublePendulum, SimplePendulum

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from pendula.study.schema import Recipe

    Blame = Callable[[str, Iterable[str], str], ValueError]
    """Makes the error: table, keys of which the first in the file is named, message."""

_MOST_STEPS = 10_000_000
_MOST_POINTS = 20_000


def check(recipe: Recipe, blame: Blame) -> None:
    """Check what no key can be checked for alone.

    Raises:
        ValueError: as `blame` makes it.
    """
    _check_spans(recipe, blame)
    _check_order(recipe, blame)
    _check_simple(recipe, blame)
    _check_double(recipe, blame)


def _check_spans(recipe: Recipe, blame: Blame) -> None:
    simple, double, convergence = recipe.simple, recipe.double, recipe.convergence
    finest = min(convergence.steps)
    rows = (
        ("simple", "step", simple.step, simple.t_max, _MOST_STEPS),
        ("simple", "output", simple.output, simple.t_max, _MOST_POINTS),
        ("double", "step", double.step, double.t_max, _MOST_STEPS),
        ("double", "reference_step", double.reference_step, double.t_max, _MOST_STEPS),
        ("double", "output", double.output, double.t_max, _MOST_POINTS),
        ("convergence", "steps", max(convergence.steps), convergence.t_max, _MOST_POINTS),
        ("convergence", "steps", finest, convergence.t_max, _MOST_STEPS),
    )
    for section, key, step, t_max, most in rows:
        if step > t_max:
            rule = f"{section}.{key} must not be longer than {section}.t_max = {t_max:g} s"
            raise blame(section, (key, "t_max"), f"{rule}, got {step:g} s")
        if t_max / step > most:
            rule = f"{section}.t_max / {section}.{key} must be at most {most}"
            raise blame(section, (key, "t_max"), f"{rule}, got {t_max / step:.0f}")
    if len(set(convergence.steps)) < 2:
        rule = "convergence.steps must hold two different steps to measure an order"
        raise blame("convergence", ("steps",), f"{rule}, got {finest:g} s alone")


def _check_order(recipe: Recipe, blame: Blame) -> None:
    """Pairs of keys of which the first must not be the larger."""
    simple, double = recipe.simple, recipe.double
    if simple.gentle > simple.large:
        rule = f"simple.gentle must not be larger than simple.large = {simple.large:g} rad"
        got = f"{simple.gentle:g} rad; take a smaller gentle or a larger large"
        raise blame("simple", ("gentle", "large"), f"{rule}, got {got}")
    if double.reference_step > double.step:
        rule = f"double.reference_step must not be longer than double.step = {double.step:g} s"
        got = f"{double.reference_step:g} s; take a tenth of the step, say"
        raise blame("double", ("reference_step", "step"), f"{rule}, got {got}")


def _check_simple(recipe: Recipe, blame: Blame) -> None:
    part = recipe.simple
    values = {"length": part.length, "gravity": part.gravity, "mass": part.mass}
    try:
        pendulum = SimplePendulum(**values)
    except ValueError:
        raise _uncomputable("simple", values, blame) from None
    _check_phase(recipe, pendulum, blame)


def _check_phase(recipe: Recipe, pendulum: SimplePendulum, blame: Blame) -> None:
    """The exact solution knows no phase after too many periods."""
    for section, t_max in (
        ("simple", recipe.simple.t_max),
        ("convergence", recipe.convergence.t_max),
    ):
        try:
            exact(pendulum, (recipe.simple.large, 0.0), t_max)
        except ValueError:
            period = math.tau / pendulum.natural_frequency
            raise blame(
                "simple",
                ("length", "gravity", "t_max"),
                f"{section}.t_max must not hold so many periods of the simple pendulum that "
                f"rounding hides its motion, got {t_max:g} s at {period:.3g} s a period; take a "
                f"shorter {section}.t_max or a longer simple.length",
            ) from None


def _check_double(recipe: Recipe, blame: Blame) -> None:
    """With the masses of each repetition too, of which the recipe's author knows nothing."""
    part = recipe.double
    names = ("m1", "m2", "l1", "l2", "gravity")
    values = {name: float(getattr(part, name)) for name in names}
    try:
        for masses, _ in REPETITIONS:
            heavier = {"m1": part.m1 * masses, "m2": part.m2 * masses}
            DoublePendulum.rods(**(values | heavier))
    except ValueError:
        raise _uncomputable("double", values, blame) from None


def _uncomputable(section: str, values: dict[str, float], blame: Blame) -> ValueError:
    """Blame the key farthest from 1; all are in range, but not what is computed from them."""
    farthest = sorted(values, key=lambda name: -abs(math.log(values[name])))
    first = f"{section}.{farthest[0]}"
    given = ", ".join(f"{name} = {value:g}" for name, value in values.items())
    return blame(
        section,
        farthest,
        f"{first} must not be so far from 1 that the constants of the motion leave the range of "
        f"numbers, got {given}; take values nearer to 1",
    )
