"""Sensors that move with the pendulum: gyroscopes, and accelerometers of phones."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

from pendula._messages import ArgumentError
from pendula._unit_names import PI
from pendula.measured.angles import unit_factor
from pendula.measured.columns import shown
from pendula.units import scaled

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._types import Array
    from pendula.measured.asked_of_file import Asked, Log
    from pendula.measured.tables import Column, Table

_G = 9.80665  # m/s², that of the standard
_SIZE_OF_G = (6.0, 20.0)  # m/s², within which the mean of an acceleration with gravity lies
_CLEAR = 1.7  # times the next axis' steadiness: the axis of the pivot is told apart


def rates_of(columns: Sequence[Column], t: Array, asked: Asked, log: Log) -> Array:
    """Angular rates [rad/s], (n, m); of three axes those about the axis of the swing, (n, 1)."""
    import numpy as np

    factor = unit_factor(columns, asked, log, "rad/s", "deg/s")
    values = np.column_stack([each.values for each in columns])
    if factor is None:
        in_degrees = _widest(values, t) > math.pi
        log.took["unit"] = "deg/s" if in_degrees else "rad/s"
        factor = PI / 180 if in_degrees else Fraction(1)
        log.note(
            "No unit is told: degrees by second, as in radians it would turn over."
            if in_degrees
            else "No unit is told: radians by second; name another with unit."
        )
    values = np.column_stack([scaled(column, factor) for column in values.T])
    return _about_swing(values, log) if len(columns) == 3 else values


def _widest(rates: Array, t: Array) -> float:
    """The amplitude of a swing that has these rates, if it were small [the rates' own angle]."""
    import numpy as np

    column = rates[:, int(np.argmax(np.nanstd(rates, axis=0)))]
    there = np.isfinite(column)
    kept, times = column[there] - np.median(column[there]), t[there]
    size = float(np.quantile(np.abs(kept), 0.95))
    beyond = np.abs(kept) > 0.3 * size  # noise about zero crosses it too often
    crossings = int((np.diff(np.sign(kept[beyond])) != 0).sum())
    omega = math.pi * max(crossings, 1) / float(times[-1] - times[0])
    return size / omega


def _about_swing(rates: Array, log: Log) -> Array:
    """The rates about the direction in which three axes vary most: that of the swing's axis."""
    import numpy as np

    there = np.isfinite(rates).all(axis=1)
    centred = rates[there] - rates[there].mean(axis=0)
    _, sizes, directions = np.linalg.svd(centred, full_matrices=False)
    axis = directions[0] * np.sign(directions[0][np.argmax(np.abs(directions[0]))])
    share = float(sizes[0] ** 2 / (sizes**2).sum())
    way = ", ".join(f"{each:.3f}" for each in axis)
    log.note(
        f"Three axes of a gyroscope: the rate about the direction in which they vary most, "
        f"({way}), which has {100 * share:.1f} % of the variance; one axis is named with rate."
    )
    return np.asarray(rates @ axis)[:, np.newaxis]


def radial_of(
    columns: Sequence[Column], table: Table, t: Array, asked: Asked, log: Log
) -> tuple[Array, Column]:
    """The acceleration along the string [m/s²], positive towards the pivot, (n, 1), and its column.

    With gravity it is L ω² + g cos θ, whose mean is about g; without, L ω², never below zero. The
    acceleration across the string has no mean in either case.

    Args:
        columns: axes of the sensor, or the one that is named.
        table: they are in.
        t: times, (n,).
        asked: for unit and whether gravity is in it.
        log: takes what was understood.

    Raises:
        ArgumentError: where no axis is that of the string clearly.
    """
    import numpy as np

    factor = unit_factor(columns, asked, log, "m/s²", "m/s^2")
    if factor is None:
        means = [abs(float(np.nanmean(each.values))) for each in columns]
        in_g = _SIZE_OF_G[0] / _G < max(means) < _SIZE_OF_G[1] / _G and not asked.linear
        log.took["unit"] = "g" if in_g else "m/s^2"
        factor = Fraction(str(_G)) if in_g else Fraction(1)
        log.note("No unit is told: " + ("g, as the mean is about 1." if in_g else "m/s²."))
    values = [scaled(each.values, factor) for each in columns]
    steady = [_steadiness(column) for column in values]
    i = int(np.argmax(steady))
    if len(columns) > 1 and steady[i] < _CLEAR * sorted(steady)[-2]:
        rule = "is not told: no axis has a steady mean, as the one towards the pivot has"
        raise ArgumentError("radial", rule, f"name its column: {shown(columns, table)}")
    column = values[i]
    mean = float(np.nanmean(column))
    column = column if mean > 0 else -column
    linear = asked.linear
    if linear is None:
        linear = columns[i].heading.linear or not _SIZE_OF_G[0] < abs(mean) < _SIZE_OF_G[1]
    log.took["linear"] = linear
    sort = "without gravity: L ω²" if linear else "with gravity: L ω² + g cos θ"
    turned = "" if mean > 0 else ", with its sign turned"
    log.note(f"Acceleration towards the pivot from {columns[i]}{turned}, {sort}.")
    return column[:, np.newaxis], columns[i]


def _steadiness(column: Array) -> float:
    """Size of the mean over its scatter from one tenth of the record to the next."""
    import numpy as np

    kept = column[np.isfinite(column)]
    means = [float(each.mean()) for each in np.array_split(kept, 10) if each.size]
    scatter = float(np.std(means)) + 1e-3 * float(np.std(kept)) + 1e-300
    return abs(float(np.median(means))) / scatter


def of_force(column: Column, asked: Asked, log: Log) -> Array:
    """Force along the string over the mass, (n, 1) [m/s²]: L ω² + g cos θ.

    Raises:
        ArgumentError: without a mass.
    """
    import numpy as np

    if asked.mass is None:
        rule = "is needed: {text} is a force"
        raise ArgumentError("mass", rule, "give the bob's with <mass=0.1>", text=str(column))
    factor = unit_factor([column], asked, log, "N", "N")
    values = scaled(column.values, Fraction(1) if factor is None else factor)
    values = values if np.nanmean(values) > 0 else -values
    log.took |= {"mass": asked.mass, "linear": False}
    log.note(f"Force in {column} over the mass {asked.mass:g} kg: L ω² + g cos θ.")
    return np.asarray(values / asked.mass)[:, np.newaxis]
