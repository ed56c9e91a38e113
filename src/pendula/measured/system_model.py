"""A pendulum of the catalogue, by its own parameters, as a model of what was measured."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from pendula import _engine
from pendula.measured.double_model import OFFSETS, shape_of
from pendula.measured.model import MOST_STEPS, READING, ROUGH_TOLERANCE, SMALLEST, TOLERANCE, Row
from pendula.run.derivatives import names_derived_by

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from pendula._types import Array
    from pendula.systems import System

TIME_OFFSET = "time_offset"
_LOWER = {"positive": SMALLEST, "not_negative": 0.0, "any": -math.inf}
_CLOCKS = {"drive_phase": "drive_frequency", "pivot_phase": "pivot_frequency"}
_POWERS = str.maketrans("", "", "^") | {ord("2"): "²", ord("3"): "³"}


@dataclass(frozen=True)
class SystemModel:
    """A system seen as its angles, its rate or the radial acceleration of a point of it.

    What is measured at a time t is scale·θ(t − time_offset) + angle_offset, the motion having its
    start at the time of the first sample; rates likewise. Acceleration is R ω² + s g cos θ +
    offset, s = 1 for a sensor that feels gravity, 0 for one that has taken it off.

    Attributes:
        known: the system whose values those parameters have that are not fitted.
        quantity: "angle", "rate" or "acceleration"; of a double pendulum "angle".
        tolerance: of its runs.
    """

    known: System
    quantity: str
    tolerance: float = TOLERANCE

    @cached_property
    def rows(self) -> tuple[Row, ...]:
        """Its parameters: the start, the system's own, and those of what is seen."""
        start = [Row(name, unit) for name, unit in self.known.component_units.items()]
        values = self.known.parameters
        own = [
            Row(each.name, shown_unit(each.unit), each.name, values[each.name], _LOWER[each.range])
            for each in self.known._rows()
        ]
        if self.bodies == 2:
            seen = tuple(Row(name, "rad") for name in OFFSETS)
        else:
            seen = tuple(row for row in READING[self.quantity] if row.name != "tilt")
        return (*start, *own, *seen, Row(TIME_OFFSET, "s"))

    @property
    def bodies(self) -> int:
        """How many angles it has."""
        return self.known.can.degrees_of_freedom

    @property
    def offsets(self) -> tuple[str, ...]:
        """Names of the offsets of what is measured."""
        return OFFSETS if self.bodies == 2 else (READING[self.quantity][0].name,)

    @property
    def shape(self) -> dict[str, float]:
        """What is known of a double pendulum's shape, over its A."""
        return shape_of(self.known)

    def roughly(self) -> SystemModel:
        """The same, computed less exactly: for steps on the way to an optimum."""
        return replace(self, tolerance=ROUGH_TOLERANCE)

    def states(self, t: Array, values: Mapping[str, float]) -> Array:
        """See `SingleModel.states`; (n, d)."""
        return self._run(t, values, ())

    def seen(self, states: Array, values: Mapping[str, float]) -> Array:
        """What is measured of states (n, d), (n, 1) or (n, 2)."""
        import numpy as np

        offsets = np.array([values[name] for name in self.offsets])
        if self.bodies == 2:
            return np.asarray(states[:, :2] + offsets)
        theta, omega = states[:, :1], states[:, 1:]
        if self.quantity == "acceleration":
            felt = values["gravity_seen"] * values["gravity"] * np.cos(theta)
            return np.asarray(values["sensor_radius"] * omega**2 + felt + offsets)
        return np.asarray(
            values["scale"] * (theta if self.quantity == "angle" else omega) + offsets
        )

    def slopes(
        self, t: Array, states: Array, values: Mapping[str, float], columns: Sequence[str]
    ) -> Array:
        """See `SingleModel.slopes`; (n, m, k)."""
        import numpy as np

        derived = self.state_slopes(t, values, columns, states)
        by_state, own = self._seen_by(states, values)
        found = np.einsum("nmd,ndk->nmk", by_state, derived)
        for place, name in enumerate(columns):
            if name in own:
                found[..., place] += own[name]
        return np.asarray(found)

    @property
    def components(self) -> tuple[str, ...]:
        """Names of its state."""
        return tuple(self.known.components)

    def state_slopes(
        self,
        t: Array,
        values: Mapping[str, float],
        columns: Sequence[str],
        states: Array | None = None,
    ) -> Array:
        """Derivatives of the states by some of the parameters, (n, d, k)."""
        import numpy as np

        everything = names_derived_by(self.known.name, self.known.form)
        inner = [name for name in columns if name in everything]
        derived = np.zeros((len(t), len(self.components), len(columns)))
        if inner:
            places = [everything.index(name) for name in inner]
            derived[..., [columns.index(name) for name in inner]] = self._run(t, values, places)
        if TIME_OFFSET in columns:
            moved = self.states(t, values) if states is None else states
            derived[..., columns.index(TIME_OFFSET)] = -self._rates(t, moved, values)
        return derived

    def system(self, values: Mapping[str, float]) -> System | None:
        """The system with these values, by the recording's clock; None: one is unphysical."""
        own = {name: values[name] for name in self.known.parameters}
        for phase, frequency in _CLOCKS.items():
            if phase in own:
                own[phase] -= own[frequency] * values[TIME_OFFSET]
        try:
            return type(self.known).of_form(self.known.form, own)
        except ValueError:
            return None

    def _seen_by(
        self, states: Array, values: Mapping[str, float]
    ) -> tuple[Array, dict[str, Array]]:
        """Derivatives of what is seen by the state (n, m, d), and by what only the sensor has."""
        import numpy as np

        n, d = states.shape
        if self.bodies == 2:
            own = {name: np.eye(2)[i] for i, name in enumerate(self.offsets)}
            return np.broadcast_to(np.eye(2, d), (n, 2, d)), own
        theta, omega = states[:, :1], states[:, 1:]
        own = {self.offsets[0]: np.ones((n, 1))}
        by_state = np.zeros((n, 1, d))
        if self.quantity == "acceleration":
            radius, felt, g = (values[n] for n in ("sensor_radius", "gravity_seen", "gravity"))
            by_state[:, 0] = np.concatenate(
                [-felt * g * np.sin(theta), 2.0 * radius * omega], axis=1
            )
            return by_state, own | {"sensor_radius": omega**2, "gravity": felt * np.cos(theta)}
        i = 0 if self.quantity == "angle" else 1
        by_state[:, 0, i] = values["scale"]
        return by_state, own | {"scale": states[:, i : i + 1]}

    def _rates(self, t: Array, states: Array, values: Mapping[str, float]) -> Array:
        """Time derivatives of the states, (n, d)."""
        import numpy as np

        own = [values[name] for name in self.known.parameters]
        entry = _engine.system_entries()[self.known.name]
        form = entry.form_index(self.known.form)
        described = _engine.Description(self.known.name, form, own)
        if self.known.can.autonomous:
            return _engine.rhs(described, states, 0.0)
        clock = (t - values[TIME_OFFSET]).tolist()
        return np.concatenate(
            [_engine.rhs(described, states[i : i + 1], at) for i, at in enumerate(clock)]
        )

    def _run(self, t: Array, values: Mapping[str, float], columns: Sequence[int]) -> Array:
        """The states (n, d), or their derivatives (n, d, k), from the start forward and backward.

        NaN where a run is not finite, or is backward with dry friction.

        `solve` refuses negative friction; the runs of an ensemble have their parameters unchecked.
        """
        import numpy as np

        begin, times = float(t[0]), t - values[TIME_OFFSET]
        later = times >= begin
        state = np.array([[values[name] for name in self.known.components]])
        parameters = np.array([[values[name] for name in self.known.parameters]])
        d, k = state.shape[1], len(columns)
        found = np.empty((len(t), d, k) if k else (len(t), d))
        for part, order in ((later, slice(None)), (~later, slice(None, None, -1))):
            outputs = np.ascontiguousarray(times[part][order])
            if not outputs.size:
                continue
            request = _engine.Request(
                self.known._description(),
                "taylor",
                state[0],
                begin,
                outputs,
                tolerance=self.tolerance,
                max_steps=MOST_STEPS,
            )
            result = _engine.ensemble(request, state, parameters, columns, 1, None)
            made = result.derivatives(outputs.size, d, k) if k else result.states(outputs.size, d)
            found[part] = np.nan if result.refused else made[0][order]
        return found


def shown_unit(unit: str) -> str:
    """A unit of the core as fits show it: m/s² for m/s^2."""
    bare, _, power = unit.partition("^")
    return bare + power.translate(_POWERS) if power else unit


def inertia_and_pull(values: Mapping[str, float]) -> tuple[float, float]:
    """I and m g c of one pendulum by its parameters, ω0² = m g c / I [kg m², N m]."""
    if "inertia" in values:
        return values["inertia"], values["mass"] * values["gravity"] * values["centre"]
    if "length" in values:
        mass, length = values["mass"], values["length"]
        return mass * length**2, mass * values["gravity"] * length
    return 1.0, 1.0  # scaled
