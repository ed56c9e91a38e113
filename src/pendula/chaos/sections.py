"""Poincaré sections of many starts of one energy, and stroboscopic ones of driven pendulums."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula._angles import warn_of_degrees
from pendula._checks import (
    check_threads,
    checked_progress,
    extra,
    one_of,
    positive_number,
    states_array,
    whole_number,
)
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula._progress import part, with_bar
from pendula.chaos.drive import drive_period, is_driven
from pendula.chaos.energy_surface import check_double
from pendula.chaos.flow import crossings_of_many, processors, strobes_of_many
from pendula.chaos.indicators import INDICATORS, indicator_of
from pendula.chaos.section_plane import momentum2, section_grid
from pendula.run.events import Event, angle
from pendula.run.options import checked_types, takes_options
from pendula.run.reach import check_reachable
from pendula.systems import System, check_system

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Unpack

    import numpy as np
    import xarray as xr
    from numpy.typing import ArrayLike, NDArray

    from pendula._progress import AskedProgress
    from pendula._types import Array
    from pendula.run.options import RunOptions

_MOST_CROSSINGS, _MOST_STARTS = 10**7, 10**6
_MOST_STEPS = 10**8
_OPTIONS = "tolerance", "max_steps"
SURFACE = angle(1, 0.0, direction=1, every_turn=True)  # θ1 = 0, ω1 > 0


@with_promised
@dataclass(frozen=True, eq=False, repr=False)
class Section:
    """Where motions cross a surface, or are at each period of the drive.

    Attributes:
        system: the pendulum.
        starts: of the motions, (n, d) [rad, rad/s].
        times: of the crossings, (n, m) [s]; NaN after the end of a run that ended early.
        states: at the crossings, angles not wrapped, (n, m, d) [rad, rad/s].
        outcomes: how each run ended, (n,): "event" (all crossings), "reached_end" (all periods),
            "step_limit" or "not_finite".
        n_steps: of each run, (n,).
        recipe: the arguments that it was made with.
        values: of the indicator that was asked for, one of each motion, (n,); None: none was.
    """

    system: System
    starts: Array
    times: Array
    states: Array
    outcomes: NDArray[np.str_]
    n_steps: NDArray[np.int64]
    recipe: Mapping[str, Any] = field(default_factory=dict)
    values: Array | None = None

    @property
    def points(self) -> Array:
        """What is drawn: (θ2, p2) of a double pendulum, (θ, ω) of one bob, (n, m, 2).

        Angles from −π to π, p2 = ∂T/∂ω2 [kg m²/s].
        """
        import numpy as np

        if self.states.shape[-1] == 2:
            angles, others = self.states[..., 0], self.states[..., 1]
        else:
            angles, others = self.states[..., 1], momentum2(self.system, self.states)
        return np.stack([wrapped(angles), others], axis=-1)

    def __repr__(self) -> str:
        n, m = self.times.shape
        return f"<Section of {self.system!r}: {n} motions, {m} crossings each>"

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, ax: Any = None, language: str = "en") -> Any:
            """See `pendula.plot.section`."""

    def to_xarray(self) -> xr.Dataset:
        """Times, states and p2 over start and crossing (extra: io)."""
        both = ("start", "crossing")
        data: dict[str, Any] = {"t": (both, self.times, {"units": "s"})}
        for i, (name, unit) in enumerate(self.system.component_units.items()):
            data[name] = (both, self.states[..., i], {"units": unit})
        if self.states.shape[-1] == 4:
            data["p2"] = (both, self.points[..., 1], {"units": "kg m²/s"})
        data["outcome"] = ("start", self.outcomes)
        data["n_steps"] = ("start", self.n_steps)
        if self.values is not None:
            name = self.recipe["indicator"]
            units, meaning = INDICATORS[name]
            data[name] = ("start", self.values, {"units": units, "long_name": meaning})
        made: xr.Dataset = extra("xarray", "io").Dataset(data)
        return made


@with_bar("section")
@takes_options(*_OPTIONS, max_steps="a hundred million")
def section(
    system: System,
    states: ArrayLike | None = None,
    *,
    energy: float | None = None,
    starts: int = 24,
    crossings: int = 500,
    event: Event | None = None,
    indicator: str | None = None,
    t_max: float = 400.0,
    threads: int | None = None,
    progress: AskedProgress = None,
    **options: Unpack[RunOptions],
) -> Section:
    """Poincaré sections of many motions, through lanes and threads.

    Args:
        system: a pendulum. A driven one is looked at once in each period of its drive, at
            t = T, 2T, …, unless there is an event; another where its motion crosses a surface.
        states: starts, (n, d) or (d,) [rad, rad/s].
        energy: in place of states, for a double pendulum: starts of that energy on the surface
            θ1 = 0, ω1 > 0, evenly over the whole of it [J].
        starts: how many, with `energy`.
        crossings: of each motion.
        event: the surface, such as angle(2, 0.0, direction=1, every_turn=True); None: the drive's
            period, or θ1 = 0, ω1 > 0, whole turns away too.
        indicator: of chaos, which tells the motions apart and colours the picture: "megno" (its
            mean), "lyapunov" (the finite-time exponent) or "sali"; None: none.
        t_max: the length of the runs for the indicator [s].
        threads: None: one for each processor; the bits do not depend on it.
        progress: called with the part of the motions that is done, 0 to 1; True: a bar.
        **options: see `RunOptions`.

    Returns:
        Times and states of the crossings, in the order of the starts.

    Raises:
        ValueError: for an argument out of range.
    """
    check_system(system)
    report = checked_progress(progress)
    given = _checked_starts(system, states, energy, starts)
    count = whole_number("crossings", crossings, _MOST_CROSSINGS)
    threaded = check_threads(threads) or processors()
    chosen = checked_types({"max_steps": _MOST_STEPS, **options}, "section", _OPTIONS)
    recipe: dict[str, Any] = {"energy": energy, "starts": len(given), "crossings": count}
    if indicator is not None:
        recipe["indicator"] = name = one_of("indicator", indicator, INDICATORS)
        recipe["t_max"] = length = positive_number("t_max", t_max, "s")
    of_runs = part(report, 0.0, 1.0 if indicator is None else 0.5)
    if event is None and is_driven(system):
        recipe["period"] = period = drive_period(system)
        found = strobes_of_many(system, given, period, count, chosen, threaded, of_runs)
    else:
        surface = _reachable(system, given, event, count)
        found = crossings_of_many(system, given, surface, count, chosen, threaded, of_runs)
    values = None
    if indicator is not None:
        rest = part(report, 0.5, 1.0)
        values = indicator_of(system, given, name, length, chosen, threaded, rest)
    return Section(
        system, given, found.times, found.states, found.outcomes, found.n_steps, recipe, values
    )


def wrapped(angles: Array) -> Array:
    """Angles from −π to π, whole turns left out."""
    import numpy as np

    return angles - math.tau * np.round(angles / math.tau)


def _checked_starts(
    system: System, states: ArrayLike | None, energy: float | None, starts: int
) -> Array:
    """Starts (n, d), as given or of an energy."""
    if (states is None) == (energy is None):
        raise ArgumentError("states", "must be given, or <energy>: one of them, not both")
    if energy is not None:
        double = check_double(system)
        count = whole_number("starts", starts, _MOST_STARTS)
        return section_grid(double, positive_number("energy", energy, "J"), count)
    assert states is not None
    given = states_array(states, system.component_units, name="states").reshape(
        -1, len(system.components)
    )
    if not 1 <= len(given) <= _MOST_STARTS:
        rule = f"must hold from 1 to {_MOST_STARTS} starts, got {{value}}"
        raise ArgumentError("states", rule, value=len(given))
    warn_of_degrees("states", states, given[:, : system.can.degrees_of_freedom])
    return given


def _reachable(system: System, starts: Array, event: Event | None, count: int) -> Event:
    """The surface, which each start has to be able to cross so often."""
    if event is not None and not isinstance(event, Event):
        rule = "must be made by pendula.events: angle, velocity_zero or tip_height; got {value}"
        raise ArgumentError("event", rule, value=event)
    surface = SURFACE if event is None else event
    for start in starts:
        check_reachable(system, start, surface, count)
    return surface
