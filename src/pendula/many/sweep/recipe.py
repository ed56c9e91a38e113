"""What a sweep's numbers follow from."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula import _engine
from pendula.many.sampling import Sampler, sampler_from
from pendula.many.tasks import Task
from pendula.run._times import spaced
from pendula.run.options import NAMES as OPTIONS
from pendula.run.options import Options, options_from

if TYPE_CHECKING:
    from pendula._types import Array, MethodName


DTYPES = ("float64", "float32")
COLUMNS = ("positions", "derivatives")


@dataclass(frozen=True, kw_only=True)
class SweepRecipe(Options):
    """A checked recipe; `read_sweep` makes it from a file, `sweep_from` from `resolved`.

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
