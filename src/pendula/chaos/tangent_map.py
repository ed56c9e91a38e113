"""The tangent map: how all small changes of a start have grown."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._checks import checked_progress
from pendula._messages import ArgumentError
from pendula._progress import with_bar
from pendula.chaos.datasets import dataset_of
from pendula.chaos.variations import OPTIONS, asked_of
from pendula.run.options import takes_options

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Unpack

    import xarray as xr
    from numpy.typing import ArrayLike

    from pendula._progress import AskedProgress
    from pendula._types import Array
    from pendula.run.options import RunOptions
    from pendula.systems import System


@dataclass(frozen=True, eq=False, repr=False)
class TangentMap:
    """∂(state at t)/∂(state at t0), scaled: the map is matrix · exp(log_scale).

    Attributes:
        system: the pendulum.
        start: the state at t0, (d,), or (n, d) [rad, rad/s].
        t: times (m,) [s].
        t0: time of the start [s].
        states: (m, d), or (n, m, d) [rad, rad/s].
        matrix: of the components' changes, (m, d, d), or (n, m, d, d).
        log_scale: natural logarithm of what was taken off, (m,), or (n, m): 0 until the map has
            grown by 2^300.
        n_steps: taken by the run, (), or (n,).
        recipe: the arguments that it was made with, beside system, start and times.
    """

    system: System
    start: Array
    t: Array
    t0: float
    states: Array
    matrix: Array
    log_scale: Array
    n_steps: Any
    recipe: Mapping[str, Any] = field(default_factory=dict)

    def __repr__(self) -> str:
        end = f"ln of its scale {float(self.log_scale.max()):.4g} at {self.t[-1]:g} s"
        shape = "×".join(map(str, self.matrix.shape))
        return f"<TangentMap of {self.system!r}: {shape}, {end}>"

    def to_xarray(self) -> xr.Dataset:
        """States, matrices and their scales over time (extra: io)."""
        names = self.system.components
        told: dict[str, Any] = {
            "matrix": (("t", "component", "by"), self.matrix, "", "scaled tangent map"),
            "log_scale": (("t",), self.log_scale, "1", "ln of the scale"),
            "state": (("t", "component"), self.states, "", "state"),
            "n_steps": ((), self.n_steps, "1", "steps of the run"),
        }
        made = dataset_of("TangentMap", self.system, self.start, self.t, told, self.recipe)
        return made.assign_coords(component=list(names), by=list(names))

    @property
    def rate(self) -> Array:
        """Largest finite-time exponent: ln of the largest singular value over t − t0 [1/s]."""
        import numpy as np

        largest = np.linalg.norm(self.matrix, 2, axis=(-2, -1))
        rate: Array = (np.log(largest) + self.log_scale) / (self.t - self.t0)
        return rate

    def canonical(self) -> Array:
        """The matrix in canonical variables (θ…, p…), shaped as `matrix`, p in [J s].

        There it is symplectic, of a pendulum without friction, where `log_scale` is 0.

        Raises:
            ValueError: for systems with friction or a drive.
        """
        import numpy as np

        start = canonical_changes(self.system, self.start)
        there = canonical_changes(self.system, self.states)
        if self.start.ndim == 2:
            start = start[:, np.newaxis]
        return there @ self.matrix @ np.linalg.inv(start)


def canonical_changes(system: System, states: Array) -> Array:
    """∂(θ…, p…)/∂(θ…, ω…) at states (..., d): (..., d, d)."""
    import numpy as np

    if not system.can.conservative:
        rule = "must be a pendulum without friction and drive, got {value}"
        raise ArgumentError("system", rule, value=system)
    d = states.shape[-1]
    changes = np.zeros((*states.shape[:-1], d, d))
    if d == 2:
        kinetic = system.kinetic_energy(np.array([0.0, 1.0]))
        changes[..., 0, 0], changes[..., 1, 1] = 1.0, 2.0 * kinetic
        return changes
    of = _engine.constants(system._description())
    turned = of["C"] * np.sin(states[..., 0] - states[..., 1])
    coupling = of["C"] * np.cos(states[..., 0] - states[..., 1])
    changes[..., 0, 0] = changes[..., 1, 1] = 1.0
    changes[..., 2, 2], changes[..., 3, 3] = of["A"], of["B"]
    changes[..., 2, 3] = changes[..., 3, 2] = coupling
    for row, other in ((2, 3), (3, 2)):
        changes[..., row, 0] = -turned * states[..., other]
        changes[..., row, 1] = turned * states[..., other]
    return changes


@with_bar("tangent map")
@takes_options(*OPTIONS)
def tangent_map(
    system: System,
    state: ArrayLike,
    t: ArrayLike,
    *,
    t0: float = 0.0,
    threads: int | None = None,
    progress: AskedProgress = None,
    **options: Unpack[RunOptions],
) -> TangentMap:
    """How all small changes of a start have grown, at any time: scaled, so that none overflows.

    The states have the bits of `solve`.

    Args:
        system: a pendulum.
        state: at t0, (d,), or n of them, (n, d) [rad, rad/s].
        t: a time or times (m,), rising or falling from t0 [s].
        t0: time of the state [s].
        threads: None: one for each processor.
        progress: called with the part that is done, 0 to 1; True: a bar.
        **options: see `RunOptions`.

    Raises:
        ValueError: for an argument out of range.
    """
    import numpy as np

    asked = asked_of(system, state, t, t0, "tangent_map", **options)
    d = len(asked.system.components)
    runs = asked.runs(np.eye(d), "free", threads, checked_progress(progress))
    scale = runs.taken_off.max(axis=-1)
    apart = np.exp2(runs.taken_off - scale[..., np.newaxis])  # columns have one scale
    columns = runs.directions * apart[..., np.newaxis]
    return TangentMap(
        asked.system,
        asked.shaped(asked.starts),
        runs.t,
        asked.t0,
        asked.shaped(runs.states),
        asked.shaped(np.swapaxes(columns, -1, -2)),
        asked.shaped(scale * math.log(2.0)),
        asked.shaped(runs.n_steps),
        {"t0": asked.t0, **{name: asked.options.get(name) for name in OPTIONS}},
    )
