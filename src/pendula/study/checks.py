"""The rules that hold between the keys of a recipe."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula._engine import ON_GRID
from pendula.run.exact import exact
from pendula.study.runs import REPETITIONS, double_pendulum
from pendula.systems import DoublePendulum, SimplePendulum

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from pendula.study.schema import Recipe

    Blame = Callable[[str, Iterable[str], str], ValueError]
    """Makes the error: table, keys of which the first in the file is named, message."""

_MOST_STEPS = 10_000_000
_MOST_POINTS = 20_000
_A_PERIOD = 20  # fewest outputs in a period
_RODS = ("l1", "l2", "gravity", "m1", "m2")


def check(recipe: Recipe, blame: Blame) -> None:
    """Check what no key can be checked for alone.

    Raises:
        ValueError: as `blame` makes it.
    """
    _check_spans(recipe, blame)
    _check_order(recipe, blame)
    _check_simple(recipe, blame)
    _check_double(recipe, blame)
    _check_outputs(recipe, blame)


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


def _check_outputs(recipe: Recipe, blame: Blame) -> None:
    """Outputs must show the motion, and the last must be the end, of which the text speaks."""
    simple, convergence = recipe.simple, recipe.convergence
    bob = SimplePendulum(simple.length, simple.gravity, simple.mass)
    rods, _ = double_pendulum(recipe.double)
    longest = max(convergence.steps)
    rows = (
        ("simple", "output", simple.output, simple.t_max, bob, ("length", "gravity")),
        ("double", "output", recipe.double.output, recipe.double.t_max, rods, _RODS),
        ("convergence", "steps", longest, convergence.t_max, None, ()),
    )
    for section, key, every, t_max, system, parameters in rows:
        largest = t_max if system is None else math.tau / system.fastest_frequency / _A_PERIOD
        take = f"take {_nice_part(t_max, min(every, largest)):.12g} s"
        if every > largest:
            if t_max > _MOST_POINTS * largest:
                longest_run = _rounded_down(_MOST_POINTS * largest)
                take = f"take {section}.t_max = {longest_run} s and a {_A_PERIOD}th of the period"
            swings = "small swings" if section == "simple" else "the fastest small swings"
            rule = f"{section}.{key} must be at most a {_A_PERIOD}th of the period of {swings}"
            told = f"{rule}, {_rounded_down(largest)} s, got {every:g} s; {take}"
            raise blame(section, (key, *parameters), told)
        count = t_max / every
        if abs(count - round(count)) > ON_GRID:
            name = f"{section}.{key}" if system else f"the longest of {section}.{key}"
            rule = f"{name} must divide {section}.t_max = {t_max:.12g} s, got {every:.12g} s"
            shorter = f"{section}.t_max = {math.floor(count) * every:.12g} s"
            raise blame(section, (key, "t_max"), f"{rule}; {take}, or {shorter}")


def _nice_part(whole: float, most: float) -> float:
    """The largest half, fifth, tenth, 20th, 50th … of a whole that is not more than that."""
    power = 10.0 ** max(math.floor(math.log10(whole / most)), 0)
    return next(whole / (n * power) for n in (1, 2, 5, 10) if whole <= most * n * power)


def _rounded_down(value: float) -> str:
    """To three digits."""
    last = 10.0 ** (math.floor(math.log10(value)) - 2)
    return f"{math.floor(value / last) * last:.12g}"


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
