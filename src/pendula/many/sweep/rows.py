"""The rows of a sweep: the variables of the result, and what computes a chunk of them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula import _engine
from pendula._attributes import KEY
from pendula._checks import checked_threads
from pendula._progress import part
from pendula._version import __version__
from pendula.many.chunks import Axis, Variable, Work
from pendula.many.tasks import run_task
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
MISSING = ""  # the outcome of a row that has not been computed
_FORMAT = (
    2  # in 1 outcomes were numbers, and the draws of a point of the grids followed one another
)
_TEXT = f"<U{max(map(len, _engine.OUTCOMES))}"
_RUNS = 0.9  # of the work; the rest are energies and the like


def work_of(recipe: SweepRecipe) -> Work:
    """The sweep as work in chunks of rows."""
    times, count = recipe.times, recipe.sampler.count
    attributes = {"units": "s", "long_name": "time"}
    return Work(
        inputs={"format": _FORMAT, KEY: __version__, "sweep": recipe.resolved},
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
        growing=("sweep", "sampler", "draws"),
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
            "n_steps": runs.n_steps,
            "reached": runs.reached,
            "outcome": runs.outcomes.astype(_TEXT),
        }
        over_time = {
            **dict(zip(recipe.components, np.moveaxis(runs.states, -1, 0), strict=True)),
            **self._following(parameters, runs.states),
        }
        with np.errstate(over="ignore"):  # beyond float32 a number is infinite
            made |= {name: values.astype(recipe.dtype) for name, values in over_time.items()}
        if runs.trust_horizon is not None:
            made["trust_horizon"] = runs.trust_horizon
        return made

    def _following(self, parameters: Array, states: Array) -> dict[str, Array]:
        """What follows from the states (n, m, d), each row of a system of its own, (n, m) each."""
        import numpy as np

        recipe = self.recipe
        directions = _engine.within_range_of_sine(states)
        periodic = _engine.system_entries()[recipe.system].can.periodic
        moving = directions if periodic else states
        found = {name: np.empty(states.shape[:-1]) for name in ("energy", *_more(recipe))}
        places, rates = _positions(recipe), _derivatives(recipe)
        with np.errstate(over="ignore", invalid="ignore"):  # of runs that are about to break down
            for i, row in enumerate(parameters.tolist()):
                system = _engine.describe(recipe.system, recipe.form, tuple(row))
                np.add(*energies(system, moving[i]), out=found["energy"][i])
                if places:
                    where = _engine.positions(system, directions[i]).reshape(len(states[i]), -1)
                    for name, values in zip(places, where.T, strict=True):
                        found[name][i] = values
                if rates:
                    rate = _engine.rhs(system, moving[i], 0.0)
                    for name, values in zip(rates, rate.T, strict=True):
                        found[name][i] = values
        return found


def _positions(recipe: SweepRecipe) -> dict[str, str]:
    """Names of the coordinates of the bob or the rods' ends, with what they mean, if wanted."""
    if "positions" not in recipe.columns:
        return {}
    count = _engine.system_entries()[recipe.system].can.degrees_of_freedom
    ends = [("", "the bob")] if count == 1 else [(i, f"the end of rod {i}") for i in (1, 2)]
    directions = {"x": "to the right", "y": "upward"}
    return {
        f"{axis}{i}": f"position of {end}, {direction} from the pivot"
        for i, end in ends
        for axis, direction in directions.items()
    }


def _derivatives(recipe: SweepRecipe) -> dict[str, tuple[str, str]]:
    """Names of the components' rates of change, with unit and meaning, if wanted."""
    if "derivatives" not in recipe.columns:
        return {}
    units = {"rad": "rad/s", "rad/s": "rad/s^2"}
    return {
        f"d{each.name}_dt": (units[each.unit], f"rate of change of {each.name}")
        for each in _engine.system_entries()[recipe.system].components
    }


def _more(recipe: SweepRecipe) -> dict[str, tuple[str, str]]:
    """Name → (unit, meaning) of the columns that are written on request."""
    places = {name: ("m", meaning) for name, meaning in _positions(recipe).items()}
    return {**places, **_derivatives(recipe)}


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
        yield _number(each.name, all_times, each.unit, each.meaning, recipe.dtype)
    zero = "total energy, zero at rest at the lowest point"
    yield _number("energy", all_times, "J", zero, recipe.dtype)
    for name, (unit, meaning) in _more(recipe).items():
        yield _number(name, all_times, unit, meaning, recipe.dtype)
    if recipe.certify is not None:
        meaning = f"until when every angle is accurate to {recipe.certify:g} rad; inf: throughout"
        yield _number("trust_horizon", one, "s", meaning)
    yield _number("reached", one, "s", "until when the run was made")
    attributes = {"units": "1", "long_name": "steps of the run"}
    yield Variable("n_steps", one, "int64", -1, attributes)
    yield Variable("outcome", one, _TEXT, MISSING, {"long_name": "how the run ended"})


def _number(
    name: str, dims: tuple[str, ...], unit: str, meaning: str, dtype: str = "float64"
) -> Variable:
    return Variable(name, dims, dtype, math.nan, {"units": unit, "long_name": meaning})
