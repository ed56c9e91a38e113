"""What all maps share: their arguments, their inputs and the runs of their cells."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, ClassVar

from pendula import _engine
from pendula._attributes import KEY
from pendula._checks import checked_threads, number, positive_number
from pendula._messages import ArgumentError
from pendula._rules import refuse
from pendula._version import __version__
from pendula.many.chunks import Variable, Work, run
from pendula.many.maps.cells import Cells, checked_cells
from pendula.many.tasks import Runs, Task, run_task
from pendula.run.options import BEST_TOLERANCE
from pendula.run.request import Request
from pendula.run.stiffness import warn_of_stiffness
from pendula.systems import System, check_system, class_names_that

if TYPE_CHECKING:
    import numpy as np
    import xarray as xr
    from numpy.typing import NDArray

    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.many.chunks import Chunk


@dataclass(frozen=True)
class Map:
    """What computes the cells of a chunk; each kind of map adds what it takes, and its `kind`.

    Attributes:
        system: the pendulum.
        cells: the starts, at rest.
        t_max: the end of each run [s].
    """

    kind: ClassVar[str]
    title: ClassVar[str]

    system: System
    cells: Cells
    t_max: float

    @property
    def inputs(self) -> dict[str, Any]:
        """Everything that the numbers follow from."""
        own = {each.name: getattr(self, each.name) for each in fields(self)}
        own |= {"system": self.system.description()}
        del own["cells"]
        return {KEY: __version__, "map": self.kind, **own, **self.cells.description()}

    @property
    def variables(self) -> tuple[Variable, ...]:
        """The arrays of the map."""
        raise NotImplementedError

    def __call__(
        self, chunk: Chunk, threads: int | None, progress: Progress
    ) -> dict[str, NDArray[np.generic]]:
        """The variables at the cells of a chunk."""
        raise NotImplementedError

    def runs(self, starts: Array, threads: int | None, progress: Progress, **how: Any) -> Runs:
        """The runs from these starts until t_max by the Taylor method; `how`: fields of a Task."""
        import numpy as np

        end = np.array([self.t_max])
        name, form = self.system.name, self.system.form
        task = Task(system=name, form=form, method="taylor", t=end, **how)
        parameters = np.array([list(self.system.parameters.values())])
        return run_task(task, parameters, starts, checked_threads(threads), progress)

    def dataset(self, store: Any, **how: Any) -> xr.Dataset:
        """The whole map; `how`: what `pendula.chunks.run` takes."""
        work = Work(
            inputs=self.inputs,
            axes=self.cells.axes(),
            variables=self.variables,
            compute=self,
            attrs={"title": self.title, "t_max": self.t_max},
            mirrored=self.cells.mirrored,
        )
        return run(work, store, **how)


def checked_map(
    system: object, theta1: object, theta2: object, shape: object, t_max: object
) -> tuple[System, Cells, float]:
    """The arguments that every map takes.

    Raises:
        ValueError: naming the argument.
    """
    one = check_system(system)
    if not one.can.mapped:
        names = class_names_that(lambda can: can.mapped)
        raise ArgumentError("system", "must be a {any_of}, got {value}", any_of=names, value=system)
    cells = checked_cells(theta1, theta2, shape)
    end = positive_number("t_max", t_max, "s")
    checked_tolerance(one, end, None)
    warn_of_stiffness([one], end)
    return one, cells, end


def checked_tolerance(system: System, t_max: float, tolerance: object) -> float:
    """The tolerance of a map's runs, or the best one, with which they can be made until t_max.

    Raises:
        ValueError: naming the argument.
    """
    import numpy as np

    value = BEST_TOLERANCE if tolerance is None else number("tolerance", tolerance)
    rest = np.zeros(len(system.components))
    asked = Request(state=rest, t=np.array([t_max]), tolerance=value)
    refuse(_engine.check_options(asked.for_core(system, "taylor")), digits=False, t="t_max")
    return value
