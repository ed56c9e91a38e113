"""A recording of a pendulum: times, what was measured, its unit, and how it was read."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array


@dataclass(frozen=True, eq=False)
class Measurement:
    """What was measured of one motion, in SI units (or pixels).

    Attributes:
        t: times of the samples, rising, as uneven as they are, (n,) [s].
        values: (n, m); NaN: that sample is missing.
        quantity: "angle", "rate", "position" or "acceleration".
        names: of the m columns: theta, or theta1 and theta2; omega; x and y, or x1, y1, x2, y2 (y
            up); radial.
        unit: of the values: "rad", "rad/s", "m", "px" or "m/s²".
        bodies: 1 or 2, how many angles the pendulum has.
        geometry: what is known of the pendulum, by name: length [m] ...
        source: the file's path; empty: none.
        checksum: SHA-256 of the file.
        reading: what `read` took, by its own arguments' names: reading the file with them gives the
            same measurement.
        notes: a sentence for each thing that was understood or changed on the way: columns, units,
            times made again, samples left out.
    """

    t: Array
    values: Array
    quantity: str
    names: tuple[str, ...]
    unit: str
    bodies: int = 1
    geometry: Mapping[str, float] = field(default_factory=dict)
    source: str = ""
    checksum: str = ""
    reading: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class PeriodTable:
    """Periods measured at several lengths, or at several amplitudes.

    Attributes:
        period: of one full swing, (n,) [s].
        length: from the pivot to the bob's centre, (n,) [m]; None: not varied, not told.
        amplitude: of the swing, (n,) [rad]; None: not told.
        repeats: times each row was measured, (n, k) periods [s]; NaN: none there; None: once.
        source: the file's path; empty: none.
        checksum: SHA-256 of the file.
        reading: as for `Measurement`.
        notes: as for `Measurement`.
    """

    period: Array
    length: Array | None = None
    amplitude: Array | None = None
    repeats: Array | None = None
    source: str = ""
    checksum: str = ""
    reading: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
