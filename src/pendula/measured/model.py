"""One pendulum as a model of what was measured: predictions, and their exact derivatives."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

from pendula import _engine
from pendula.measured import accelerometer

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from pendula._types import Array
    from pendula.systems import System

FRICTIONS = ("viscous", "coulomb", "quadratic", "cubic")
DRIVE = ("torque", "drive_frequency", "drive_phase")
TOLERANCE = 1e-10  # of the runs: far below what any encoder resolves
ROUGH_TOLERANCE = 1e-6  # of those on the way to an optimum
MOST_STEPS = 20_000  # of a run: beyond, the parameters are none that a pendulum has
SMALLEST = 1e-9  # of ω0² [1/s²]


class Row(NamedTuple):
    """A parameter of a model.

    Attributes:
        name: for users.
        unit: SI; empty: none.
        core: the core's name of it; empty: the core does not know it.
        standard: its value where it is not fitted.
        lower: the least value that it can physically have.
    """

    name: str
    unit: str
    core: str = ""
    standard: float = 0.0
    lower: float = -math.inf


# θ̈ = −ω0² sin θ − b ω − c sgn ω − q |ω| ω − r ω³ + a cos(Ω t + φ): everything over the inertia
_MOTION = (
    Row("theta", "rad", "theta"),
    Row("omega", "rad/s", "omega"),
    Row("omega0_squared", "1/s²", "gravity", 1.0, SMALLEST),
    Row("viscous", "1/s", "viscous", 0.0, 0.0),
    Row("coulomb", "1/s²", "coulomb", 0.0, 0.0),
    Row("quadratic", "", "quadratic", 0.0, 0.0),
    Row("cubic", "s", "cubic", 0.0, 0.0),
    Row("torque", "1/s²", "torque"),
    Row("drive_frequency", "rad/s", "drive_frequency", 0.0, 0.0),
    Row("drive_phase", "rad", "drive_phase"),
)
READING = {
    "angle": (Row("angle_offset", "rad"), Row("scale", "", "", 1.0)),
    "rate": (Row("rate_offset", "rad/s"), Row("scale", "", "", 1.0)),
    "acceleration": (
        Row("acceleration_offset", "m/s²"),
        Row("sensor_radius", "m", "", 1.0, SMALLEST),
        Row("gravity_seen", "", "", 0.0),  # 1 or 0, never fitted
        Row("tilt", "rad"),
    ),
}


@dataclass(frozen=True)
class SingleModel:
    """One pendulum, seen as its angle, its rate or the radial acceleration of a point of it.

    angle: scale·θ + offset; rate: scale·ω + offset; acceleration: R (ω² + s ω0² cos θ) + offset,
    s = 1 for a sensor that feels gravity, 0 for one that has taken it off, along the string or, by
    the tilt, an axis off it.

    Attributes:
        quantity: "angle", "rate" or "acceleration".
        linear: −ω0² θ in place of −ω0² sin θ; it has viscous friction alone.
        tolerance: of its runs.
    """

    quantity: str
    linear: bool = False
    tolerance: float = TOLERANCE

    @property
    def rows(self) -> tuple[Row, ...]:
        """Its parameters."""
        motion: tuple[Row, ...] = _MOTION
        if self.linear:
            motion = tuple(each for each in _MOTION if each.name not in FRICTIONS[1:])
        return (*motion, *READING[self.quantity])

    @property
    def offset(self) -> str:
        """Name of the offset of what is measured."""
        return READING[self.quantity][0].name

    def states(self, t: Array, values: Mapping[str, float]) -> Array:
        """Of the motion at the times, (n, 2) [rad, rad/s]; NaN where it is not finite.

        Args:
            t: rising, the first that of the start, (n,) [s].
            values: of all parameters, by name.
        """
        return _Motion.of(t, self, values).states()

    @property
    def components(self) -> tuple[str, ...]:
        """Names of its state."""
        return ("theta", "omega")

    def seen(self, states: Array, values: Mapping[str, float]) -> Array:
        """What is measured of states (n, 2), (n, 1)."""
        import numpy as np

        theta, omega = states.T
        if self.quantity == "acceleration":
            shown = accelerometer.shown(states, values)
        else:
            shown = values["scale"] * (theta if self.quantity == "angle" else omega)
        return np.asarray((shown + values[self.offset])[:, np.newaxis])

    def slopes(
        self, t: Array, states: Array, values: Mapping[str, float], columns: Sequence[str]
    ) -> Array:
        """Derivatives of what is measured by some of the parameters, (n, 1, k).

        Args:
            t: as for `states`.
            states: those at the times, (n, 2).
            values: of all parameters, by name.
            columns: names of those to derive by, (k,).
        """
        import numpy as np

        derived = self.state_slopes(t, values, columns)
        own: dict[str, Array] = {self.offset: np.ones(len(t))}
        if self.quantity == "acceleration":
            by_state, others = accelerometer.derived(states, values)
            found = np.einsum("nd,ndk->nk", by_state, derived)
            own |= others
        else:
            i = 0 if self.quantity == "angle" else 1
            found = values["scale"] * derived[:, i]
            own["scale"] = states[:, i]
        for place, name in enumerate(columns):
            found[:, place] += own.get(name, 0.0)
        return np.asarray(found[:, np.newaxis])

    def state_slopes(self, t: Array, values: Mapping[str, float], columns: Sequence[str]) -> Array:
        """Derivatives of the states by some of the parameters, (n, 2, k)."""
        import numpy as np

        motion = _Motion.of(t, self, values)
        inner = [name for name in columns if name in motion.columns]
        derived = np.zeros((len(t), 2, len(columns)))
        if inner:
            derived[:, :, [columns.index(name) for name in inner]] = motion.derivatives(inner)
        return derived

    def roughly(self) -> SingleModel:
        """The same, computed with fewer digits."""
        return replace(self, tolerance=ROUGH_TOLERANCE)

    def system(self, values: Mapping[str, float]) -> System | None:
        """The pendulum with these values, of inertia 1; None: one of them is unphysical."""
        from pendula.systems import DrivenPendulum, LinearPendulum

        if any(values.get(name, 0.0) < 0.0 for name in FRICTIONS):
            return None
        real = {name: values[name] for name in (*FRICTIONS, *DRIVE) if name in values}
        gravity = values["omega0_squared"]
        if self.linear:
            return LinearPendulum(1.0, gravity, 1.0, **real)
        return DrivenPendulum.body(1.0, 1.0, 1.0, gravity, **real)


@dataclass(frozen=True)
class _Motion:
    """A run of the core, that may have friction of either sign.

    `solve` refuses negative friction; the runs of an ensemble have their parameters unchecked.
    """

    request: _engine.Request
    state: Array
    parameters: Array
    columns: dict[str, int]
    n: int

    @classmethod
    def of(cls, t: Array, model: SingleModel, values: Mapping[str, float]) -> _Motion:
        """The run of a model from its start at the first of the times."""
        import numpy as np

        name, form = ("driven-linear", "") if model.linear else ("driven", "body")
        entry = _engine.system_entries()[name]
        rows = entry.forms[entry.form_index(form)].parameters
        ours = {each.core: each.name for each in _MOTION}
        given = {"mass": 1.0, "centre": 1.0, "inertia": 1.0, "length": 1.0}
        given |= {row.name: values[ours[row.name]] for row in rows if row.name in ours}
        parameters = np.array([[given.get(row.name, row.standard or 0.0) for row in rows]])
        sound = tuple(np.maximum(parameters[0], 0.0).tolist())
        state = np.array([[values["theta"], values["omega"]]])
        request = _engine.Request(
            _engine.describe(name, form, sound),
            "taylor",
            state[0],
            float(t[0]),
            t,
            tolerance=model.tolerance,
            max_steps=MOST_STEPS,
        )
        columns = {"theta": 0, "omega": 1}
        columns |= {ours[row.name]: 2 + i for i, row in enumerate(rows) if row.name in ours}
        return cls(request, state, parameters, columns, len(t))

    def states(self) -> Array:
        """At the times, (n, 2)."""
        import numpy as np

        result = _engine.ensemble(self.request, self.state, self.parameters, [], 1, None)
        return np.asarray(result.states(self.n, 2)[0])

    def derivatives(self, names: Sequence[str]) -> Array:
        """Of the states at the times, (n, 2, k)."""
        import numpy as np

        columns = [self.columns[name] for name in names]
        found = _engine.ensemble(self.request, self.state, self.parameters, columns, 1, None)
        return np.asarray(found.derivatives(self.n, 2, len(columns))[0])
