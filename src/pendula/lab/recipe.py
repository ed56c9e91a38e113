"""The recipe of a run as a link has it: read, checked, run, and written."""

from __future__ import annotations

import math
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

from pendula import _engine
from pendula._checks import finite_array, one_of
from pendula._messages import PYTHON, ArgumentError, Message, Naming, message_of
from pendula._recipe_file import suggestion
from pendula._rules import broken
from pendula.lab.address import (
    check_page,
    entries_of,
    link_of,
    number_of,
    numbers_of,
    rows,
    written,
)
from pendula.run._times import EXACT_INTERVALS, spaced, span_of, times_apart
from pendula.run.options import ROWS, STANDARD_METHOD
from pendula.systems import System, system_from, with_closed_form

if TYPE_CHECKING:
    from collections.abc import Iterator

    from pendula._progress import Progress
    from pendula._types import Array, MethodName
    from pendula.run.trajectory import Trajectory

EXACT = "exact"


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """A run that a link describes.

    Attributes:
        system: the pendulum.
        state: at time t0, (d,) [rad, rad/s].
        t0: time of the state [s].
        t_max: end time [s].
        every: time between outputs; None: the method's own steps, or for the closed form a
            part of the span [s].
        method: "exact", or a method of `solve`.
        options: step, tolerance, max_steps, certify and digits, where they are given.
    """

    system: System
    state: tuple[float, ...]
    t0: float
    t_max: float
    every: float | None
    method: str
    options: dict[str, Any]

    @classmethod
    def of(cls, run: Trajectory) -> Recipe:
        """The recipe of a run, as far as links have one: see `losses`.

        Raises:
            ArgumentError: for several motions in one.
        """
        asked = run.request
        if asked.state.ndim != 1:
            rule = "must be one motion, got {value} of them"
            raise ArgumentError("run", rule, value=asked.state.size // asked.state.shape[-1])
        own_steps = isinstance(asked.t, float)
        t_max = asked.end if own_steps else _farthest(asked.t0, cast("Array", asked.t))
        options = {name: each for name, each in asked.numbers().items() if each is not None}
        return cls(
            system=run.system,
            state=tuple(asked.state.tolist()),
            t0=asked.t0,
            t_max=t_max,
            every=None if own_steps else _spacing(asked.t0, cast("Array", asked.t)),
            method=run.method,
            options=options,
        )

    @property
    def times(self) -> float | Array:
        """The end, for outputs at the method's own steps; or output times, (n,) [s]."""
        every = self.every
        if every is None and self.method == EXACT:
            every = span_of(self.t0, self.t_max) / EXACT_INTERVALS
        return self.t_max if every is None else times_apart(self.t0, self.t_max, every)

    def run(self, progress: Progress = None) -> Trajectory:
        """The motion, with the bits that the laboratory shows.

        Raises:
            ValueError: naming a key whose value the run cannot take.
        """
        from pendula.run.exact import exact
        from pendula.run.solve import solve

        with _blaming_the_link():
            if self.method == EXACT:
                return exact(self.system, self.state, self.times, t0=self.t0)
            method = cast("MethodName", self.method)
            how = {"t0": self.t0, "progress": progress, **self.options}
            return solve(self.system, self.state, self.times, method, **how)

    def link(self) -> str:
        """The part of a link from the # on."""
        system = self.system.description()
        form = _engine.system_entries()[system["name"]]
        rows_of_form = form.forms[form.form_index(system["form"])].parameters
        left_out = {row.name for row in rows_of_form if row.standard == 0.0}
        entries = [("system", system["name"])]
        entries += [("form", system["form"])] if system["form"] else []
        entries += [
            (name, written(value))
            for name, value in system["parameters"].items()
            if written(value) != "0" or name not in left_out
        ]
        entries.append(("state", ",".join(map(written, self.state))))
        entries += [("t0", written(self.t0))] if written(self.t0) != "0" else []
        entries.append(("t_max", written(self.t_max)))
        entries += [("every", written(self.every))] if self.every is not None else []
        entries.append(("method", self.method))
        entries += [(name, written(value)) for name, value in self.options.items()]
        return link_of(entries)


def losses(run: Trajectory) -> list[str]:
    """What of a run its link does not hold: "events", "output times"."""
    import numpy as np

    lost = ["events"] if run.request.events else []
    times = np.atleast_1d(Recipe.of(run).times)
    same = np.array_equal(times, np.atleast_1d(run.request.t))
    return lost if same else [*lost, "output times"]


def read_link(link: str) -> Recipe:
    """The recipe of a link, checked as the run would check it.

    Raises:
        ValueError: in one line, naming a key that is unknown or lacking, or a value out of range.
    """
    with _blaming_the_link():
        entries = entries_of(link)
        name = one_of("system", _taken(entries, "system"), _engine.system_entries())
        form = _form(name, entries)
        known = (*rows("recipe"), *(row.name for row in form.parameters), *ROWS)
        for key, text in entries.items():
            if key in rows("page"):
                check_page(key, text)
            elif key not in known:
                unknown = f"the {name} pendulum's link has no key {{value}}"
                raise ArgumentError("", unknown, suggestion(key, known), value=key)
        recipe = _recipe(name, form, entries)
        _check(recipe)
        return recipe


def _taken(entries: dict[str, str], key: str) -> str:
    """The text of a key that is needed."""
    if key not in entries:
        raise ArgumentError(key, "is needed", f"write {key}=…")
    return entries[key]


def _form(name: str, entries: dict[str, str]) -> _engine.Form:
    """The form that the entries name, or the first."""
    entry = _engine.system_entries()[name]
    given = entries.get("form", entry.forms[0].name)
    if "form" in entries and len(entry.forms) == 1:
        rule = "is not taken by the {system} pendulum, which has one form; got {value}"
        raise ArgumentError("form", rule, "leave it out", system=name, value=given)
    return entry.forms[entry.form_index(one_of("form", given, (each.name for each in entry.forms)))]


def _recipe(name: str, form: _engine.Form, entries: dict[str, str]) -> Recipe:
    """The recipe of entries whose keys are known."""
    parameters = {
        row.name: number_of(row.name, entries[row.name])
        for row in form.parameters
        if row.name in entries
    }
    standard = [row.standard for row in _engine.system_entries()[name].components]
    state = numbers_of("state", entries["state"]) if "state" in entries else standard
    if len(state) != len(standard):
        raise broken("state", "count_of_components", count=len(standard), value=len(state))
    return Recipe(
        system=system_from({"name": name, "form": form.name, "parameters": parameters}),
        state=tuple(state),
        t0=number_of("t0", entries.get("t0", "0")),
        t_max=number_of("t_max", _taken(entries, "t_max")),
        every=number_of("every", entries["every"]) if "every" in entries else None,
        method=entries.get("method", STANDARD_METHOD),
        options={
            row.name: _option(row, entries[row.name])
            for row in ROWS.values()
            if row.name in entries
        },
    )


def _option(row: _engine.OptionRow, text: str) -> float | int:
    """An option's number; of whole ones the core refuses a fraction."""
    found = number_of(row.name, text)
    return int(found) if row.whole and found.is_integer() else found


def _check(recipe: Recipe) -> None:
    """Refuse what the run would refuse, before it begins."""
    from pendula.run.request import checked_name, request_of

    span_of(recipe.t0, recipe.t_max)
    if recipe.method != EXACT:
        names = (EXACT, *(each.name for each in _engine.methods()))
        name = checked_name(one_of("method", recipe.method, names))
        request_of(recipe.system, recipe.state, recipe.times, name, recipe.t0, **recipe.options)
        return
    solvable = with_closed_form(recipe.system)
    solvable.check_start(finite_array("state", recipe.state))
    for option in recipe.options:
        raise ArgumentError(option, "is not taken by the closed form", "leave it out")
    _ = recipe.times


def _farthest(t0: float, times: Array) -> float:
    """The output time that is farthest from t0 [s]."""
    return float(times[abs(times - t0).argmax()])


def _spacing(t0: float, times: Array) -> float | None:
    """What lies between equally spaced output times from t0 on; None: they are not [s]."""
    if times.size < 2 or times[0] != t0:
        return None
    end, whole = float(times[-1]), max(times.size - 2, 1)  # the last gap may be shorter
    mean = abs(float(times[whole]) - t0) / whole  # to a unit in the last place
    near = (mean, float(f"{mean:.12g}"), math.nextafter(mean, 0.0), math.nextafter(mean, math.inf))
    for every in near:
        if 0.0 < every <= abs(end - t0) and spaced(t0, end, every).tobytes() == times.tobytes():
            return every
    return None


class _Keys(Naming):
    """Arguments as the keys of a link."""

    def argument(self, name: str) -> str:
        """The key for an argument."""
        return "t_max" if name == "t" else name

    def given(self, name: str, value: str) -> str:
        """The key with a value."""
        return "every" if name == "t" else PYTHON.given(name, value)


@contextmanager
def _blaming_the_link() -> Iterator[None]:
    """Say of errors raised inside that they are the link's, with its keys."""
    try:
        yield
    except ValueError as error:
        message = message_of(error)
        told = message.named(_Keys()) if isinstance(message, Message) else message
        raise ValueError(f"the link: {told}") from None
