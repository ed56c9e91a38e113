"""The double pendulum as a model of two measured angles, by what a motion can tell of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from pendula import _engine
from pendula.measured.model import MOST_STEPS, ROUGH_TOLERANCE, TOLERANCE, Row

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from pendula._types import Array
    from pendula.systems import System

JOINTS = ("viscous1", "viscous2", "coulomb1", "coulomb2")
SHAPE = ("B_over_A", "C_over_A", "D_over_A", "E_over_A")
OFFSETS = ("angle_offset1", "angle_offset2")
STATE = ("theta1", "theta2", "omega1", "omega2")
_SECOND = 0.5  # mass of the second body that stands for it; whatever it is, the motion is the same


@dataclass(frozen=True)
class DoubleModel:
    """Two angles of T = ½ ω1² + ½ B ω2² + C ω1 ω2 cos(θ1−θ2), V = −D cos θ1 − E cos θ2.

    Everything is over A, the inertia about the pivot with the second body's mass at the joint: a
    motion tells no masses. E/C = g/l1, whatever the bodies are.
    """

    quantity: str = "angle"
    tolerance: float = TOLERANCE

    @property
    def bodies(self) -> int:
        """How many angles it has."""
        return 2

    @property
    def components(self) -> tuple[str, ...]:
        """Names of its state."""
        return STATE

    @property
    def shape(self) -> dict[str, float]:
        """What is known of its shape beforehand: nothing."""
        return {}

    @property
    def rows(self) -> tuple[Row, ...]:
        """Its parameters."""
        return (
            *(Row(name, "rad" if name.startswith("t") else "rad/s") for name in STATE),
            *(Row(name, "", "", 0.1, 1e-9) for name in SHAPE[:2]),
            *(Row(name, "1/s²", "", 1.0, 1e-9) for name in SHAPE[2:]),
            *(
                Row(name, "1/s" if name.startswith("v") else "1/s²", "", 0.0, 0.0)
                for name in JOINTS
            ),
            Row("angle_offset1", "rad"),
            Row("angle_offset2", "rad"),
        )

    def states(self, t: Array, values: Mapping[str, float]) -> Array:
        """See `SingleModel.states`; (n, 4)."""
        import numpy as np

        request, start, parameters = _run(t, values, self.tolerance)
        result = _engine.ensemble(request, start, parameters, [], 1, None)
        return np.asarray(result.states(len(t), 4)[0])

    def seen(self, states: Array, values: Mapping[str, float]) -> Array:
        """The two angles with their offsets, (n, 2)."""
        import numpy as np

        offsets = [values["angle_offset1"], values["angle_offset2"]]
        return np.asarray(states[:, :2] + np.array(offsets))

    def slopes(
        self, t: Array, states: Array, values: Mapping[str, float], columns: Sequence[str]
    ) -> Array:
        """See `SingleModel.slopes`; (n, 2, k)."""
        return self.state_slopes(t, values, columns)[:, :2] + _by_offsets(columns)

    def state_slopes(self, t: Array, values: Mapping[str, float], columns: Sequence[str]) -> Array:
        """Derivatives of the states by some of the parameters, (n, 4, k)."""
        import numpy as np

        request, start, parameters = _run(t, values, self.tolerance)
        names = _core_names()
        chain = _chain(values)
        needed = sorted({4 + names.index(n) for c in columns for n in chain.get(c, {})})
        needed = [*range(4), *needed]
        result = _engine.ensemble(request, start, parameters, needed, 1, None)
        run = result.derivatives(len(t), 4, len(needed))[0]
        found = np.zeros((len(t), 4, len(columns)))
        for place, column in enumerate(columns):
            if column in STATE:
                found[..., place] = run[..., STATE.index(column)]
            for name, factor in chain.get(column, {}).items():
                found[..., place] += factor * run[..., needed.index(4 + names.index(name))]
        return found

    def roughly(self) -> DoubleModel:
        """The same, computed with fewer digits."""
        return replace(self, tolerance=ROUGH_TOLERANCE)

    def system(self, values: Mapping[str, float]) -> System | None:
        """A pendulum with A = 1 and l1 = 1 that moves so; None: no two bodies do."""
        from pendula.systems import DampedDoublePendulum

        b, c, d, e = (values[name] for name in SHAPE)
        second, gravity = c * c / b, e / c  # all of the second body in one point
        moment, rest = d / gravity - second, 1.0 - second
        if rest <= 0.0 or moment < 0.0 or min(values[name] for name in JOINTS) < 0.0:
            return None
        first = max(moment**2 / rest, 1e-9)
        centre = moment / first
        return DampedDoublePendulum.bodies(
            first,
            second,
            1.0,
            centre,
            b / c,
            max(rest - first * centre**2, 0.0),
            0.0,
            gravity,
            viscous=(values["viscous1"], values["viscous2"]),
            coulomb=(values["coulomb1"], values["coulomb2"]),
        )


def shape_of(system: System) -> dict[str, float]:
    """B, C, D, E and the frictions of a double pendulum, over its A."""
    constants = _engine.constants(system._description())
    a = constants["A"]
    found = {f"{name}_over_A": constants[name] / a for name in "BCDE"}
    return found | {name: system.parameters.get(name, 0.0) / a for name in JOINTS}


def _core_names() -> list[str]:
    entry = _engine.system_entries()["damped-double"]
    return [row.name for row in entry.forms[entry.form_index("bodies")].parameters]


def _bodies(values: Mapping[str, float]) -> dict[str, float]:
    """Bodies with l1 = 1 and A = 1 that move so.

    Their moments of inertia may come out negative: the core computes with A to E alone.
    """
    b, c, d, e = (values[name] for name in SHAPE)
    centre = d * c / e - _SECOND
    return {
        "m1": 1.0,
        "m2": _SECOND,
        "l1": 1.0,
        "c1": centre,
        "c2": c / _SECOND,
        "I1": 1.0 - _SECOND - centre**2,
        "I2": b - c * c / _SECOND,
        "gravity": e / c,
        "l2": 1.0,
        **{name: values[name] for name in JOINTS},
    }


def _chain(values: Mapping[str, float]) -> dict[str, dict[str, float]]:
    """Derivatives of the bodies' parameters by ours, those that are not zero."""
    _, c, d, e = (values[name] for name in SHAPE)
    centre = d * c / e - _SECOND
    found = {name: {name: 1.0} for name in JOINTS}
    found["B_over_A"] = {"I2": 1.0}
    by_c = {"c2": 1.0 / _SECOND, "I2": -2.0 * c / _SECOND, "gravity": -e / c**2}
    found["C_over_A"] = {**by_c, "c1": d / e, "I1": -2.0 * centre * d / e}
    found["D_over_A"] = {"c1": c / e, "I1": -2.0 * centre * c / e}
    by_e = -d * c / e**2
    found["E_over_A"] = {"gravity": 1.0 / c, "c1": by_e, "I1": -2.0 * centre * by_e}
    return found


def _run(
    t: Array, values: Mapping[str, float], tolerance: float
) -> tuple[_engine.Request, Array, Array]:
    """The run of the core, its start (1, 4) and its parameters (1, p)."""
    import numpy as np

    bodies, names = _bodies(values), _core_names()
    form = _engine.system_entries()["damped-double"].form_index("bodies")
    sound = [1.0 if name not in JOINTS else 0.0 for name in names]
    start = np.array([[values[name] for name in STATE]])
    request = _engine.Request(
        _engine.Description("damped-double", form, sound),
        "taylor",
        start[0],
        float(t[0]),
        t,
        tolerance=tolerance,
        max_steps=MOST_STEPS,
    )
    return request, start, np.array([[bodies[name] for name in names]])


def _by_offsets(columns: Sequence[str]) -> Array:
    """Derivatives of the angles by their offsets, (2, k)."""
    import numpy as np

    found = np.zeros((2, len(columns)))
    for i in (0, 1):
        if f"angle_offset{i + 1}" in columns:
            found[i, columns.index(f"angle_offset{i + 1}")] = 1.0
    return found
