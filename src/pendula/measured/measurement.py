"""A recording of a pendulum: times, what was measured, its unit, and how it was read."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from pendula._checks import positive_number
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula._tables import html_table
from pendula.measured.asked_of_file import window_of
from pendula.measured.circle import Circle
from pendula.measured.outliers import outliers_of
from pendula.measured.positions import angles_about, pivot_circle
from pendula.measured.storable import Storable

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike, NDArray

    from pendula._types import Array

_EVEN = 1e-3  # of a step, by which steps of an even recording may differ
_NAMES = {1: ("theta",), 2: ("theta1", "theta2")}


@with_promised
@dataclass(frozen=True, eq=False)
class Measurement(Storable):
    """What was measured of one motion, in SI units (or pixels).

    Attributes:
        t: times of the samples, rising, as uneven as they are, (n,) [s].
        values: (n, m); NaN: that sample is missing.
        quantity: "angle", "rate", "position" or "acceleration".
        names: of the m columns: theta, or theta1 and theta2; omega, or omega1 and omega2; x and y,
            or x1, y1, x2, y2 (y up); radial.
        unit: of the values: "rad", "rad/s", "m", "px" or "m/s²".
        bodies: 1 or 2, how many angles the pendulum has.
        geometry: what is known of the pendulum, by name: pivot_x and pivot_y of positions [their
            unit]; of angles from positions also length, or l1 and l2 [m] (in pixels length_px, …),
            circle_rms, how far the bob is from its circle, and circle_error, the standard error of
            its radius, for independent errors [the positions' unit].
        source: the file's path; empty: none.
        checksum: SHA-256 of the file.
        reading: what `read` took, by its own arguments' names: reading the file with them gives the
            same measurement. Of an acceleration, linear says that gravity is not in it.
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

    @property
    def sample_rate(self) -> float:
        """Samples a second, by the median of the steps in time [1/s]; NaN: of one sample."""
        import numpy as np

        return float(1.0 / np.median(np.diff(self.t))) if self.t.size > 1 else float("nan")

    @property
    def is_even(self) -> bool:
        """Whether the steps in time are all the same, to a thousandth."""
        import numpy as np

        steps = np.diff(self.t)
        usual = float(np.median(steps)) if steps.size else 1.0
        return bool((np.abs(steps - usual) <= _EVEN * usual).all())

    def window(self, start: float, end: float) -> Measurement:
        """The samples from a time to another, both included.

        Args:
            start: first time [s].
            end: last time [s].

        Raises:
            ValueError: for a start that is not before the end, or a window without two samples.
        """
        first, last = window_of((start, end))
        inside = (self.t >= first) & (self.t <= last)
        if inside.sum() < 2:
            rule = f"must hold two samples of {self.t[0]:g} … {self.t[-1]:g} s, got {{value}}"
            raise ArgumentError("t", rule, value=(first, last))
        before = self.reading.get("t", (first, last))
        kept = (max(first, before[0]), min(last, before[1]))
        note = f"{inside.sum()} of {self.t.size} samples, those from {first:g} to {last:g} s."
        return self._of(inside, note, t=kept)

    def outliers(self, threshold: float = 6.0) -> NDArray[Any]:
        """Which samples do not fit between their neighbours; none of them is left out by this.

        A sample is one that is far from the parabolas and the cubic through its neighbours: farther
        than `threshold` robust standard deviations of such distances around it, than a hundredth of
        the motion, and than some steps of the last digit. `without` leaves them out.

        Args:
            threshold: robust standard deviations.

        Returns:
            A mask, (n,), True at outliers.

        Raises:
            ValueError: for a threshold that is not positive.
        """
        return outliers_of(self.t, self.values, positive_number("threshold", threshold))

    def without(self, mask: ArrayLike) -> Measurement:
        """The samples but these.

        Args:
            mask: True at samples to leave out, (n,).

        Raises:
            ValueError: for a mask of another shape.
        """
        import numpy as np

        out = np.asarray(mask)
        if out.dtype.kind != "b" or out.shape != self.t.shape:
            rule = f"must be {self.t.size} truth values, one a sample, got {{value}}"
            raise ArgumentError("mask", rule, value=mask)
        if not out.any():
            return self
        left = (*self.reading.get("leave_out", ()), *self.t[out].tolist())
        shown = ", ".join(f"{each:g}" for each in self.t[out][:5])
        more = " …" if out.sum() > 5 else ""
        note = f"{out.sum()} samples are left out, at {shown}{more} s."
        return self._of(~out, note, leave_out=left)

    def as_angle(self) -> Measurement:
        """The angles that positions stand for, about the pivot, which a circle through them finds.

        Of two points the first is the joint. The circle's centre is the pivot and its radius the
        length, unless the pivot is in `geometry`; the second length is the mean distance. Angles
        are from the downward vertical, counter-clockwise, unwrapped. Of angles: the same.

        Raises:
            ValueError: for rates and accelerations, or positions on no circle.
        """
        if self.quantity == "angle":
            return self
        if self.quantity != "position":
            rule = f"must be of positions or angles, is of {self.quantity}s"
            raise ArgumentError("measurement", rule, "fit it as it is")
        known = self.geometry
        pivot = (known["pivot_x"], known["pivot_y"]) if "pivot_x" in known else None
        circle = pivot_circle(self.values, pivot)
        if circle is None:
            rule = "must lie on an arc, with the pivot as its centre: these are on a straight line"
            raise ArgumentError("positions", rule, "name others with <x=2> and <y=3>")
        lengths = self._lengths(circle)
        wide = ", ".join(f"{name} {size:.5g}" for name, size in lengths.items())
        note = (
            f"Angles about the pivot ({circle.x:.5g}, {circle.y:.5g}) {self.unit}: {wide}, "
            f"{circle.rms:.2g} {self.unit} rms from the circle, the radius ± "
            f"{circle.radius_error:.1g} for independent errors."
        )
        here = {"pivot_x": circle.x, "pivot_y": circle.y, "circle_rms": circle.rms}
        here["circle_error"] = circle.radius_error
        return replace(
            self,
            values=angles_about(self.values, circle),
            quantity="angle",
            names=_NAMES[self.bodies],
            unit="rad",
            geometry={**known, **here, **lengths},
            reading={**self.reading, "as_angle": True},
            notes=(*self.notes, note),
        )

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, language: str = "en") -> Figure:
            """See `pendula.plot.recorded.plot`."""

    def _lengths(self, circle: Circle) -> dict[str, float]:
        """The length, or both, by their names."""
        import numpy as np

        behind = "" if self.unit == "m" else f"_{self.unit}"
        if self.bodies == 1:
            return {f"length{behind}": circle.radius}
        x1, y1, x2, y2 = self.values.T
        second = float(np.nanmean(np.hypot(x2 - x1, y2 - y1)))
        return {f"l1{behind}": circle.radius, f"l2{behind}": second}

    def _of(self, kept: NDArray[Any], note: str, **reading: Any) -> Measurement:
        """The kept samples, with a note and what was read anew."""
        return replace(
            self,
            t=self.t[kept],
            values=self.values[kept],
            reading={**self.reading, **reading},
            notes=(*self.notes, note),
        )

    def __repr__(self) -> str:
        span = f"t = {self.t[0]:g} … {self.t[-1]:g} s" if self.t.size else "no times"
        names = ", ".join(self.names)
        of = f" of {self.source!r}" if self.source else ""
        return f"<Measurement{of}: {names} [{self.unit}], {self.t.size} samples, {span}>"

    def _repr_html_(self) -> str:
        """What a notebook shows: what was measured, over which times, and how it was read."""
        return html_table(f"Measurement of {self.source or 'no file'}", self.facts())

    def facts(self) -> Iterator[tuple[str, str]]:
        """What was measured and how it was read, name by name."""
        yield "quantity", f"{self.quantity}: {', '.join(self.names)} [{self.unit}]"
        if self.t.size:
            rate = f"{self.sample_rate:.4g} a second"
            yield "samples", f"{self.t.size}, {rate}, t = {self.t[0]:g} … {self.t[-1]:g} s"
        for name, size in self.geometry.items():
            yield name, f"{size:.6g}"
        for i, note in enumerate(self.notes):
            yield "" if i else "notes", note


@dataclass(frozen=True, eq=False)
class PeriodTable(Storable):
    """Periods measured at several lengths, or at several amplitudes.

    Attributes:
        period: of one full swing, (n,) [s].
        length: from the pivot to the bob's centre, (n,) [m]; None: not varied, not told.
        amplitude: of the swing, (n,) [rad]; None: not told.
        repeats: what each row was measured, several times, (n, k) periods [s], NaN where there is
            none; None: once.
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

    def __repr__(self) -> str:
        of = f" of {self.source!r}" if self.source else ""
        span = f"{self.period.min():g} … {self.period.max():g} s" if self.period.size else "none"
        return f"<PeriodTable{of}: {self.period.size} periods, {span}>"

    def _repr_html_(self) -> str:
        """What a notebook shows: how many periods, against what, and how they were read."""
        return html_table(f"Periods of {self.source or 'no file'}", self.facts())

    def facts(self) -> Iterator[tuple[str, str]]:
        """What was measured and how it was read, name by name."""
        for name, values, unit in (
            ("periods", self.period, "s"),
            ("lengths", self.length, "m"),
            ("amplitudes", self.amplitude, "rad"),
        ):
            if values is not None and values.size:
                yield name, f"{values.size}, {values.min():g} … {values.max():g} {unit}"
        if self.repeats is not None:
            yield "repeats", f"{self.repeats.shape[1]} each"
        for i, note in enumerate(self.notes):
            yield "" if i else "notes", note
