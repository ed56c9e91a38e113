"""Lines of a spectrum: found one after another, fitted together. Times count samples here."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pendula._types import Array

_POWER = 3  # of the window (1 + cos πs)^p: a line n bins away leaks as n^-(2p + 1)
BINS_APART = 2.0  # of two lines that are told apart
_WIDE_BINS = 2.0 * (_POWER + 1)  # within which the window mixes two lines
_PADDING = 4  # of the transform in which lines are looked for
# Samples worked on at a time: products of larger matrices would be shared among the threads of a
# library, whose number then changes the last bits, and take five times as long.
_BLOCK = 64
_MORE_LINES = 16  # than are asked for are fitted
_FAINTEST = 1e-14  # of the series' size: fainter lines are rounding
_FITS = 12  # steps of least squares, at most
_SETTLED = 1e-15  # bins times amplitude, of the strongest line's: a smaller change is rounding
_BESIDE = 6  # bins on either side of a line: how much of the rest the window lets through there


class Lines(NamedTuple):
    """Lines of a series, in no order.

    Attributes:
        frequencies: (m,) [rad per sample].
        amplitudes: complex, phases in the middle of the series, (m,).
        uncertainties: of the frequencies, by what is left beside them, (m,).
        residual: root mean square of what is left over that of the series.
    """

    frequencies: Array
    amplitudes: NDArray[Any]
    uncertainties: Array
    residual: float


@dataclass(frozen=True, eq=False)
class _Windowed:
    """A series under the window.

    Attributes:
        series: (m,), real or complex.
        places: of the samples from the middle, (m,).
        window: weights of the samples, their sum 1, (m,).
    """

    series: NDArray[Any]
    places: Array
    window: Array

    @property
    def real(self) -> bool:
        return self.series.dtype.kind != "c"

    @property
    def bin(self) -> float:
        """Frequency of one oscillation over the whole series [rad per sample]."""
        return math.tau / self.series.size

    def of(self, frequencies: Array, amplitudes: NDArray[Any]) -> NDArray[Any]:
        """The sum of lines, (m,)."""
        import numpy as np

        total: NDArray[Any] = np.zeros_like(self.series)
        for w, a in zip(frequencies, amplitudes, strict=True):
            line = a * np.exp(1j * w * self.places)
            total += line.real if self.real else line
        return total


def fitted_lines(series: NDArray[Any], count: int) -> Lines:
    """The strongest lines, at least so many where there are; more are fitted to free these of them.

    Args:
        series: (m,), real or complex.
        count: how many are of interest.
    """
    import numpy as np

    places = np.arange(series.size, dtype=np.float64) - (series.size - 1) / 2
    window: Array = (1.0 + np.cos(2.0 * np.pi * places / series.size)) ** _POWER
    window /= window.sum()
    given = _Windowed(series, places, window)
    size = float(np.sqrt(np.mean(abs(series) ** 2)))
    ws, amplitudes = np.empty(0), np.empty(0, complex)
    left, joint = series, 1
    most = min(count + _MORE_LINES, series.size // 6)
    while ws.size < most:
        w, a = _strongest(given, left)
        apart = abs(ws - w).min() / given.bin if ws.size else np.inf
        if abs(a) < _FAINTEST * size or apart < BINS_APART:
            break
        w1, a1 = _fitted(_Windowed(left, places, given.window), np.array([w]), np.array([a]), 2)
        ws, amplitudes = np.append(ws, w1), np.append(amplitudes, a1)
        if apart < _WIDE_BINS or ws.size == joint:
            ws, amplitudes = _fitted(given, ws, amplitudes, 2)
            joint = 2 * ws.size
        left = series - given.of(ws, amplitudes)
    ws, amplitudes = _fitted(given, ws, amplitudes, _FITS)
    left = series - given.of(ws, amplitudes)
    noise = float(np.sqrt(np.mean(abs(left) ** 2)))
    return Lines(ws, amplitudes, _uncertainties(given, ws, amplitudes, left), noise / size)


def _strongest(given: _Windowed, left: NDArray[Any]) -> tuple[float, complex]:
    """Frequency and amplitude of the highest maximum of the windowed spectrum."""
    import numpy as np

    length = _PADDING << (left.size - 1).bit_length()
    spectrum = np.fft.rfft if given.real else np.fft.fft
    heights: Array = np.abs(spectrum(left * given.window, length))
    top = int(heights.argmax())
    w = _between(heights, top, not given.real) * 2.0 * np.pi / length
    w = w - 2.0 * np.pi if w > np.pi else w
    if given.real and w < given.bin:
        w = 0.0  # a mean, which has no second line beside it
    amplitude = np.sum(left * given.window * np.exp(-1j * w * given.places))
    return float(w), complex(amplitude * (2.0 if given.real and w else 1.0))


def _between(heights: Array, top: int, around: bool) -> float:
    """The place of the maximum, by a parabola through the logarithms: the window's is nearly one.

    Args:
        heights: of the spectrum.
        top: the highest.
        around: whether the last is next to the first.
    """
    import numpy as np

    if not around and not 0 < top < heights.size - 1:
        return float(top)
    below, at, above = np.log(heights[[top - 1, top, (top + 1) % heights.size]] + 1e-300)
    curvature = below - 2.0 * at + above
    return top + (0.5 * float((below - above) / curvature) if curvature else 0.0)


def _fitted(
    given: _Windowed, ws: Array, amplitudes: NDArray[Any], steps: int
) -> tuple[Array, NDArray[Any]]:
    """Lines after steps of Gauss and Newton for the least weighted squares."""
    import numpy as np

    moving = (ws != 0.0) | (not given.real)
    free = np.concatenate([np.full(ws.size, True), moving, moving])  # a mean has no phase
    for _ in range(steps):
        matrix, slope = _normal_equations(given, ws, amplitudes)
        scale = np.sqrt(matrix.diagonal()[free])
        inner = matrix[np.ix_(free, free)] / np.outer(scale, scale)
        found = np.zeros(free.size)
        found[free] = np.linalg.lstsq(inner, slope[free] / scale, rcond=1e-11)[0] / scale
        change = found.reshape(3, -1)
        turn = np.clip(change[2] / given.bin, -0.5, 0.5)
        ws = ws + turn * given.bin
        amplitudes = amplitudes + change[0] + 1j * change[1]
        sizes = abs(amplitudes)
        if (abs(turn) * sizes).max(initial=0.0) <= _SETTLED * sizes.max(initial=0.0):
            break
    return ws, amplitudes


def _normal_equations(given: _Windowed, ws: Array, amplitudes: NDArray[Any]) -> tuple[Array, Array]:
    """Matrix (3m, 3m) and right side (3m,) by real parts, imaginary parts and frequencies."""
    import numpy as np

    matrix, slope = np.zeros((3 * ws.size, 3 * ws.size)), np.zeros(3 * ws.size)
    for first in range(0, given.series.size, _BLOCK):
        part = slice(first, first + _BLOCK)
        waves = np.exp(1j * np.outer(given.places[part], ws))
        turned = 1j * waves
        moved = given.places[part, np.newaxis] * (turned * amplitudes)
        columns = np.concatenate([waves, turned, moved], axis=1)
        left = given.series[part] - (
            (waves @ amplitudes).real if given.real else waves @ amplitudes
        )
        for each, rest in _parts(columns, left, given.real):
            weighted = each * given.window[part, np.newaxis]
            matrix += weighted.T @ each
            slope += weighted.T @ rest
    return matrix, slope


def _parts(columns: NDArray[Any], left: NDArray[Any], real: bool) -> list[tuple[Array, Array]]:
    """The equations as real ones: the real part, and of a complex series the imaginary part."""
    if real:
        return [(columns.real, left)]
    return [(columns.real, left.real), (columns.imag, left.imag)]


def _uncertainties(
    given: _Windowed, ws: Array, amplitudes: NDArray[Any], left: NDArray[Any]
) -> Array:
    """Errors of frequencies by what the window lets through of the rest beside each line.

    A height h there moves a line of height a by h / (a times the window's root mean square width).
    """
    import numpy as np

    length = _PADDING << (left.size - 1).bit_length()
    heights = abs(np.fft.fft(left * given.window, length))
    beside = np.arange(-_BESIDE, _BESIDE + 1) * given.bin
    places = np.rint((ws[:, np.newaxis] + beside) * (length / math.tau)).astype(int) % length
    reached = heights[places].max(axis=1) * (2.0 if given.real else 1.0)
    width = math.sqrt(float(np.sum(given.window * given.places**2)))
    sizes = np.maximum(abs(amplitudes), 1e-300)
    return np.asarray(np.hypot(reached / (sizes * width), abs(ws) * np.finfo(float).eps))
