"""Frequencies of a motion to many digits: lines of a windowed spectrum, fitted together."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula._checks import extra, finite_array, whole_number
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula.chaos.datasets import told_of_series
from pendula.chaos.lines import BINS_APART, Lines, fitted_lines

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr
    from numpy.typing import ArrayLike, NDArray

    from pendula._types import Array

_LEAST, _MOST = 32, 10**7  # samples
_MOST_LINES = 200
_UNEVEN = 1e-6  # of a step, by which times may be off the grid: those of a long run are rounded
_OF_EACH = "frequencies", "amplitudes", "uncertainties", "residual", "fitted", "limit"
_ROUNDED = 1e-12  # of the series or of the largest frequency: less is the samples' own rounding


@with_promised
@dataclass(frozen=True, eq=False, repr=False)
class Frequencies:
    """The strongest lines of one series, or of k series (then with a first axis k), by strength.

    x(t) ≈ Σ Re a exp(iωt) of a real series, Σ a exp(iωt) of a complex one.

    Attributes:
        frequencies: ω, (n,) [rad/s]; not negative for a real series.
        amplitudes: a, (n,) complex, in the unit of the series, phases at t = 0.
        uncertainties: of the frequencies, by what is left beside each line, (n,) [rad/s].
        residual: root mean square of what all fitted lines leave, over that of the series; of
            noise it can exceed 1, as the lines are fitted under the window.
        fitted: how many lines were fitted, those of `frequencies` among them.
        limit: what limits the frequencies, in words.
        recipe: the arguments that they were made with, but for the series.
    """

    frequencies: Array
    amplitudes: NDArray[Any]
    uncertainties: Array
    residual: Any
    fitted: Any
    limit: Any
    recipe: Mapping[str, Any] = field(default_factory=dict)

    def __repr__(self) -> str:
        if self.frequencies.ndim == 2:
            count, lines = self.frequencies.shape
            left = f"residual up to {self.residual.max():.1e}"
            return f"<Frequencies of {count} series, {lines} of each, {left}>"
        first = ", ".join(f"{each:.12g}" for each in self.frequencies[:3])
        more = ", …" if self.frequencies.size > 3 else ""
        return f"<Frequencies {first}{more} rad/s, residual {self.residual:.1e}>"

    def to_xarray(self) -> xr.Dataset:
        """A dataset over the lines (extra: io)."""
        told = {"residual": self.residual, "limit": self.limit}
        several, data, attrs = told_of_series(
            "Frequencies", told, self.recipe, several=self.frequencies.ndim == 2
        )
        dims = (*several, "line")
        lines = {
            "frequency": (dims, self.frequencies, {"units": "rad/s"}),
            "uncertainty": (dims, self.uncertainties, {"units": "rad/s"}),
            "amplitude": (dims, abs(self.amplitudes)),
            "phase": (dims, _phases(self.amplitudes), {"units": "rad"}),
        }
        made: xr.Dataset = extra("xarray", "io").Dataset(lines | data, attrs=attrs)
        return made

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, ax: Any = None, language: str = "en") -> Any:
            """See `pendula.plot.spectrum`."""


def _phases(amplitudes: NDArray[Any]) -> Array:
    import numpy as np

    return np.asarray(np.angle(amplitudes))


def frequencies(t: ArrayLike, x: ArrayLike, n: int) -> Frequencies:
    """The n strongest frequencies of evenly sampled quasi-periodic series.

    Numerical analysis of fundamental frequencies (Laskar 1990, Icarus 88, 266; Laskar 1999, in
    Simó (ed.), Hamiltonian Systems with Three or More Degrees of Freedom, p. 134): maxima of the
    spectrum under the window (1 + cos πs)^3, one after another. Then, unlike there, all lines are
    fitted together by least squares under the same window, and more of them than are asked for,
    so that no line is shifted by its neighbours.

    Args:
        t: times, rising, evenly spaced, (m,) [s].
        x: the series at those times, real or complex, (m,), or k of them, (k, m); each has the
            bits that it has alone. An angle that turns over has to be taken without its mean
            rotation, or as exp(iθ).
        n: how many lines, of each series.

    Returns:
        Frequencies, complex amplitudes, what is left, and what limits them. Lines beyond half the
        sampling frequency appear folded below it.

    Raises:
        ValueError: for times that are not even, too few samples, or fewer lines than asked for.
    """
    import numpy as np

    times = _checked_times(t)
    series = _checked_series(x, times.size)
    count = whole_number("n", n, _MOST_LINES)
    if series.ndim == 1:
        return _strongest(times, series, count, "here")
    each = [_strongest(times, row, count, f"in x[{i}]") for i, row in enumerate(series)]
    told: dict[str, Any] = {
        name: np.array([getattr(one, name) for one in each]) for name in _OF_EACH
    }
    return Frequencies(**told, recipe=each[0].recipe)


def _strongest(times: Array, series: NDArray[Any], count: int, place: str) -> Frequencies:
    """The strongest lines of one series (m,); `place` is where an error says that they are."""
    import numpy as np

    step = (times[-1] - times[0]) / (times.size - 1)
    found = fitted_lines(series, count)
    if found.frequencies.size < count:
        raise ArgumentError(
            "n",
            "must not exceed the lines that stand out of the rounding, {most} {place}; got {value}",
            "ask for fewer, or take a longer series",
            most=found.frequencies.size,
            place=place,
            value=count,
        )
    order = np.argsort(-abs(found.amplitudes), kind="stable")[:count]
    middle = times[0] + step * (times.size - 1) / 2
    rates = found.frequencies[order] / step
    return Frequencies(
        rates,
        found.amplitudes[order] * np.exp(-1j * rates * middle),
        found.uncertainties[order] / step,
        found.residual,
        found.frequencies.size,
        _limit(found, order, times.size * step),
        {"n": count, "samples": times.size, "step": step},
    )


def _limit(found: Lines, order: NDArray[Any], span: float) -> str:
    """What limits the frequencies that were asked for, in words."""
    largest = abs(found.frequencies[order]).max()
    if min(found.residual, found.uncertainties[order].max() / largest) <= _ROUNDED:
        return "rounding of the samples"
    apart = BINS_APART * math.tau / span
    return (
        f"{found.residual:.1e} of the series is left beside {found.frequencies.size} lines: noise, "
        f"a spectrum without lines, or lines closer than {apart:.3g} rad/s"
    )


def _checked_times(t: ArrayLike) -> Array:
    """Times (m,), rising and even."""
    import numpy as np

    times = finite_array("t", t, "s")
    if times.ndim != 1 or not _LEAST <= times.size <= _MOST:
        rule = f"must hold from {_LEAST} to {_MOST} times, got shape {{value}}"
        raise ArgumentError("t", rule, value=times.shape)
    step = (times[-1] - times[0]) / (times.size - 1)
    grid = times[0] + step * np.arange(times.size)
    worst = int(abs(times - grid).argmax())
    if step <= 0 or abs(times - grid)[worst] > _UNEVEN * step:
        raise ArgumentError(
            "t",
            "must rise in even steps: {place} is {value} s, and an even grid has {other} s there",
            "sample the motion at numpy.linspace(…)",
            place=f"t[{worst}]",
            value=float(times[worst]),
            other=f"{grid[worst]:.12g}",
        )
    return times


def _checked_series(x: ArrayLike, count: int) -> NDArray[Any]:
    """The series (m,) or (k, m), real or complex, finite, and none zero throughout."""
    import numpy as np

    given = np.asarray(x)
    if given.dtype.kind == "c":
        parts = finite_array("x", np.stack([given.real, given.imag], axis=-1))
        series: NDArray[Any] = parts[..., 0] + 1j * parts[..., 1]
    else:
        series = finite_array("x", x)
    if series.ndim not in (1, 2) or not series.size or series.shape[-1] != count:
        rule = "must hold one number for each of the {other} times, got shape {value}"
        way_out = "give several series as rows"
        raise ArgumentError("x", rule, way_out, other=str(count), value=series.shape)
    none = np.flatnonzero(~np.atleast_2d(series).any(axis=-1))
    if none.size:
        name = "x" if series.ndim == 1 else f"x[{none[0]}]"
        raise ArgumentError(name, "must not be zero throughout")
    return series
