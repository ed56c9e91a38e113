"""Results of measures as datasets: one motion or series, or several along a first axis."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY
from pendula._checks import extra
from pendula._version import __version__

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr

    from pendula._types import Array
    from pendula.systems import System

    Told = tuple[tuple[str, ...], Any, str, str]  # dims of one motion, values, unit, meaning

_MOTION = "motion"
_SERIES = "series"


def dataset_of(
    measure: str,
    system: System,
    start: Array,
    t: Array,
    told: Mapping[str, Told],
    recipe: Mapping[str, Any],
) -> xr.Dataset:
    """A dataset over t, and over motion where `start` is (n, d) (extra: io).

    Args:
        measure: what was measured, named in the attributes.
        system: the pendulum.
        start: of the motion, (d,), or of n, (n, d).
        t: times (m,) [s].
        told: further variables by name.
        recipe: the arguments that it was made with.
    """
    several = (_MOTION,) if start.ndim == 2 else ()
    data: dict[str, Any] = {
        name: ((*several, *dims), values, {"units": unit, "long_name": meaning})
        for name, (dims, values, unit, meaning) in told.items()
    }
    for i, (name, unit) in enumerate(system.component_units.items()):
        attrs = {"units": unit, "long_name": f"{name} at the start"}
        data[f"{name}_start"] = (several, start[..., i], attrs)
    described = {KEY: __version__, "chaos": measure, "system": system.description()}
    described["recipe"] = dict(recipe)
    made: xr.Dataset = extra("xarray", "io").Dataset(
        data,
        coords={"t": ("t", t, {"units": "s", "long_name": "time"})},
        attrs={KEY: json.dumps(described)},
    )
    return made


def told_of_series(
    measure: str, told: Mapping[str, Any], recipe: Mapping[str, Any], *, several: bool
) -> tuple[tuple[str, ...], dict[str, Any], dict[str, Any]]:
    """The first dims of what is told of series, and facts as variables and as attributes.

    Args:
        measure: what was measured, named in the attributes.
        told: facts by name, a number or word of one series, (k,) of several.
        recipe: the arguments that it was made with.
        several: whether they are of several series: then variables over the series.
    """
    described = {KEY: json.dumps({KEY: __version__, "chaos": measure, "recipe": dict(recipe)})}
    if not several:
        return (), {}, {**told, **described}
    return (_SERIES,), {name: (_SERIES, each) for name, each in told.items()}, described
