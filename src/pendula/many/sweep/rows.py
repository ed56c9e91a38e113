"""The rows of a sweep: the variables of the result, and what computes a chunk of them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula import _engine
from pendula._attributes import KEY
from pendula._progress import part
from pendula._version import __version__
from pendula.many.chunks import Axis, Variable, Work
from pendula.many.tasks import checked_threads, run_task
from pendula.systems.energies import energies

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy as np
    from numpy.typing import NDArray

    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.many.chunks import Chunk
    from pendula.many.sweep.recipe import SweepRecipe


ROW, TIME = "row", "t"
ENDS = _engine.OUTCOMES  # by number
MISSING = 255  # the outcome of a row that has not been computed
_RUNS = 0.9  # of the work; the rest are energies


def work_of(recipe: SweepRecipe) -> Work:
    """The sweep as work in chunks of rows."""
    times, count = recipe.times, recipe.sampler.count
    attributes = {"units": "s", "long_name": "time"}
    return Work(
        inputs={KEY: __version__, "sweep": recipe.resolved},
        axes=(
            Axis(ROW, count, chunk=recipe.chunk),
            Axis(TIME, len(times), None, times, attributes),
        ),
        variables=tuple(_variables(recipe)),
        compute=SweepRows(recipe),
        attrs={
            "title": f"Sweep of the {recipe.system} pendulum, {count} trajectories",
            "method": recipe.method,
        },
    )


@dataclass(frozen=True)
class SweepRows:
    """What computes the rows of a chunk."""

    recipe: SweepRecipe

    def __call__(
        self, chunk: Chunk, threads: int | None, progress: Progress
    ) -> dict[str, NDArray[np.generic]]:
        """The variables of the rows of a chunk."""
        import numpy as np

        recipe = self.recipe
        parameters, starts = recipe.rows(*chunk.spans[ROW])
        how = checked_threads(threads), part(progress, 0.0, _RUNS)
        runs = run_task(recipe.task, parameters, starts, *how)
        made: dict[str, NDArray[np.generic]] = {
            **dict(zip(recipe.parameters, parameters.T, strict=True)),
            **dict(zip(map(start_name, recipe.components), starts.T, strict=True)),
            **dict(zip(recipe.components, np.moveaxis(runs.states, -1, 0), strict=True)),
            "energy": self._energies(parameters, runs.states),
            "n_steps": runs.n_steps,
            "reached": runs.reached,
            "outcome": (runs.outcomes[:, np.newaxis] == np.array(ENDS))
            .argmax(axis=1)
            .astype(np.uint8),
        }
        if runs.trust_horizon is not None:
            made["trust_horizon"] = runs.trust_horizon
        return made

    def _energies(self, parameters: Array, states: Array) -> Array:
        """Total energies (n, m) of the states (n, m, d), each row of a system of its own [J]."""
        import numpy as np

        recipe = self.recipe
        if _engine.system_entries()[recipe.system].can.periodic:
            states = _engine.within_range_of_sine(states)
        found = np.empty(states.shape[:-1])
        with np.errstate(over="ignore", invalid="ignore"):  # of runs that are about to break down
            for i, row in enumerate(parameters.tolist()):
                system = _engine.describe(recipe.system, recipe.form, tuple(row))
                np.add(*energies(system, states[i]), out=found[i])
        return found


def start_name(component: str) -> str:
    """What a component of the start is called, beside that of the trajectory."""
    return f"{component}_start"


def _variables(recipe: SweepRecipe) -> Iterator[Variable]:
    """What the result holds. The outcome is written last: a row that has one is complete."""
    entry = _engine.system_entries()[recipe.system]
    one, all_times = (ROW,), (ROW, TIME)
    for row in entry.forms[entry.form_index(recipe.form)].parameters:
        yield _number(row.name, one, row.unit, row.meaning)
    for each in entry.components:
        yield _number(start_name(each.name), one, each.unit, f"{each.meaning}, at the start")
    for each in entry.components:
        yield _number(each.name, all_times, each.unit, each.meaning)
    yield _number("energy", all_times, "J", "total energy, zero at rest at the lowest point")
    if recipe.certify is not None:
        meaning = f"until when every angle is right to {recipe.certify:g} rad; inf: throughout"
        yield _number("trust_horizon", one, "s", meaning)
    yield _number("reached", one, "s", "until when the run was made")
    attributes = {"units": "1", "long_name": "steps of the run"}
    yield Variable("n_steps", one, "int64", -1, attributes)
    flags = {"flag_values": list(range(len(ENDS))), "flag_meanings": " ".join(ENDS)}
    yield Variable("outcome", one, "uint8", MISSING, {"long_name": "how the run ended", **flags})


def _number(name: str, dims: tuple[str, ...], unit: str, meaning: str) -> Variable:
    return Variable(name, dims, "float64", math.nan, {"units": unit, "long_name": meaning})
