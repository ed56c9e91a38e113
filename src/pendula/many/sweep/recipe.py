"""What a sweep's numbers follow from."""

from __future__ import annotations

from dataclasses import dataclass, fields
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula import _engine
from pendula._angles import warn_of_degrees
from pendula._checks import LARGEST_COUNT, one_of, positive_number, whole_number
from pendula._messages import ArgumentError
from pendula._rules import refuse
from pendula.many.sampling import Distribution, SameAs, Sampler, sampler_from
from pendula.many.tasks import Task
from pendula.run._times import spaced
from pendula.run.options import BEST_TOLERANCE, Options, checked_types, options_from
from pendula.run.options import NAMES as OPTIONS
from pendula.run.request import Request, checked_name
from pendula.systems import System, system_from

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from pendula._types import Array, MethodName


DTYPES = ("float64", "float32")
COLUMNS = ("positions", "derivatives")


@dataclass(frozen=True, kw_only=True)
class SweepRecipe(Options):
    """A checked recipe; `read_sweep` makes it from a file, `sweep_from` from `resolved`.

    Angles that look like degrees are taken as radians with a `pendula.DegreesWarning`.

    Attributes:
        system: name in the catalogue.
        form: of the system's description.
        sampler: a column for each of the form's parameters and of the state's components, in the
            catalogue's order.
        method: name in the catalogue.
        t_max: end of each run, which begins at 0 [s].
        every: time between outputs; None: the end alone [s].
        chunk: rows worked on and written together.
        dtype: of what stands over rows and times: "float64" or "float32".
        columns: what is written over rows and times besides states and energies: of `COLUMNS`.

    Raises:
        ValueError: for what is not so: one line naming the argument, the rule and the value.
    """

    system: str
    form: str
    sampler: Sampler
    method: MethodName
    t_max: float
    every: float | None
    chunk: int
    dtype: str = "float64"
    columns: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        entries = _engine.system_entries()
        self._set(system=one_of("system", self.system, entries))
        entry = entries[self.system]
        _check_form(self.form, [form.name for form in entry.forms])
        _check_columns(self.sampler, (*self.parameters, *self.components))
        options = checked_types({name: getattr(self, name) for name in OPTIONS}, "SweepRecipe")
        self._set(
            method=checked_name(self.method),
            t_max=positive_number("t_max", self.t_max, "s"),
            chunk=whole_number("chunk", self.chunk, LARGEST_COUNT),
            dtype=one_of("dtype", self.dtype, DTYPES),
            columns=tuple(one_of("columns", each, COLUMNS) for each in self.columns),
            **options,
        )
        if self.every is not None:
            self._set(every=positive_number("every", self.every, "s"))
            if self.every > self.t_max:
                rule = "must not exceed t_max = {t_max} s, got {value}"
                raise ArgumentError("every", rule, t_max=self.t_max, value=self.every)
        ends = systems_at_ends(self.system, self.form, self._columns(self.parameters))
        self._check_options(ends, options)
        if self.tolerance is None and _engine.method_named(self.method).adaptive:
            self._set(tolerance=BEST_TOLERANCE)
        for row in entry.components:
            column = dict(self.sampler.columns)[row.name]
            if row.unit == "rad" and not isinstance(column, SameAs):
                angles = getattr(column, "values", column.ends)
                warn_of_degrees(row.name, angles, angles, deeper=1)

    def _check_options(self, systems: list[System], options: dict[str, Any]) -> None:
        asked = Request(state=np.zeros(len(self.components)), t=np.array([self.t_max]), **options)
        for system in systems:
            refuse(_engine.check(asked.for_core(system, self.method)), digits=False, t="t_max")

    def _columns(self, names: Sequence[str]) -> dict[str, Distribution]:
        """These columns; that of another name where one is the same as it."""
        known = dict(self.sampler.columns)
        chosen = {name: known[name] for name in names}
        return {
            name: known[each.column]
            if isinstance(each, SameAs) and each.column not in names
            else each
            for name, each in chosen.items()
        }

    def _set(self, **values: Any) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the system's parameters."""
        entry = _engine.system_entries()[self.system]
        return tuple(row.name for row in entry.forms[entry.form_index(self.form)].parameters)

    @property
    def components(self) -> tuple[str, ...]:
        """Names of a state's components."""
        return tuple(row.name for row in _engine.system_entries()[self.system].components)

    @property
    def times(self) -> Array:
        """Times of the outputs, (m,) [s]."""
        if self.every is None:
            return np.array([self.t_max])
        return spaced(0.0, self.t_max, self.every)

    @property
    def task(self) -> Task:
        """What all rows have in common."""
        options = {name: getattr(self, name) for name in OPTIONS}
        name, form = self.system, self.form
        return Task(system=name, form=form, method=self.method, t=self.times, **options)

    def rows(self, start: int, stop: int) -> tuple[Array, Array]:
        """Parameters (n, p) and states (n, d) of rows start to stop, in SI units."""
        columns = self.sampler.rows(start, stop)
        return (
            np.stack([columns[name] for name in self.parameters], axis=1),
            np.stack([columns[name] for name in self.components], axis=1),
        )

    @property
    def resolved(self) -> dict[str, Any]:
        """The recipe as data that JSON can hold, in SI units; the same for the same numbers."""
        known = {field.name: getattr(self, field.name) for field in fields(self)}
        written = {"sampler": self.sampler.description(), "columns": list(self.columns)}
        return {**known, **written, **self.described()}


def systems_at_ends(system: str, form: str, columns: Mapping[str, Distribution]) -> list[System]:
    """The systems at the ends of all ranges: parameters can be too large or too small together.

    Raises:
        ValueError: for one that there is not.
    """
    free = {name: each.ends for name, each in columns.items() if not isinstance(each, SameAs)}
    systems = []
    for corner in product(*(dict.fromkeys(pair) for pair in free.values())):
        values = dict(zip(free, corner, strict=True))
        for name, each in columns.items():
            if isinstance(each, SameAs):
                values[name] = values[each.column]
        systems.append(system_from({"name": system, "form": form, "parameters": values}))
    return systems


def _check_form(form: object, names: list[str]) -> None:
    if names == [""] and form != "":
        raise ArgumentError(
            "form", "must be '', this system has one alone, got {value}", value=form
        )
    one_of("form", form, names)


def _check_columns(sampler: object, names: tuple[str, ...]) -> None:
    if not isinstance(sampler, Sampler):
        raise ArgumentError("sampler", "must be a Sampler, got {value}", value=sampler)
    given = [name for name, _ in sampler.columns]
    if sorted(given) != sorted(names):
        rule = "must have the columns {choices}, got {text}"
        raise ArgumentError("sampler", rule, choices=names, text=", ".join(given) or "none")


def sweep_from(resolved: dict[str, Any]) -> SweepRecipe:
    """The recipe that `SweepRecipe.resolved` described.

    Raises:
        ValueError: for one of an earlier version whose rows were in another order.
    """
    sampler = sampler_from(resolved["sampler"])
    if "dtype" not in resolved and sampler.draws > 1 and sampler.shape:
        raise ValueError(
            "the recipe is of an earlier version, where the draws of a point of the grids followed "
            "one another; read its rows from its file, or run its TOML file again"
        )
    known = {
        each.name: resolved[each.name]
        for each in fields(SweepRecipe)
        if each.name not in OPTIONS and each.name in resolved
    }
    written = {"sampler": sampler, "columns": tuple(resolved.get("columns", ()))}
    return SweepRecipe(**{**known, **written, **options_from(resolved)})
