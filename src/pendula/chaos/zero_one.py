"""The 0–1 test for chaos: whether a translation driven by a series stays bounded or diffuses."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY
from pendula._checks import extra, finite_array, whole_number
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula._version import __version__

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr
    from numpy.typing import ArrayLike

    from pendula._types import Array

_FREQUENCIES = 100  # c_i = π/5 + (3π/5)(i + ½)/100: away from the resonances at 0 and π
_LEAST, _MOST = 100, 10**7  # samples
_MOST_FREQUENCIES = 10**4
_SHORTEST_ZERO = 10  # samples: a first zero of the autocorrelation beyond is oversampling
_CHAOTIC, _REGULAR = 0.9, 0.1


@with_promised
@dataclass(frozen=True, eq=False, repr=False)
class ZeroOne:
    """What the 0–1 test says of a series.

    Attributes:
        value: K, the median over c: near 0 regular, near 1 chaotic.
        c: the frequencies of the test, (m,) [rad per sample].
        values: K_c, the correlation of the displacement with time at each c, (m,).
        first_zero: the sample at which the autocorrelation first falls below zero.
        oversampled: whether that lies beyond 10 samples; K is then near 0 for chaos, too.
        verdict: "chaotic", "regular" or "undecided"; an oversampled series is always undecided.
        recipe: the arguments that it was made with, but for the series.
    """

    value: float
    c: Array
    values: Array
    first_zero: int
    oversampled: bool
    verdict: str
    recipe: Mapping[str, Any] = field(default_factory=dict)

    def to_xarray(self) -> xr.Dataset:
        """K at each frequency of the test (extra: io)."""
        told = {"K": self.value, "verdict": self.verdict, "first_zero": self.first_zero}
        described = {KEY: json.dumps({KEY: __version__, "chaos": "ZeroOne", "recipe": self.recipe})}
        made: xr.Dataset = extra("xarray", "io").Dataset(
            {"K_c": ("c", self.values, {"long_name": "correlation of the displacement with time"})},
            coords={"c": ("c", self.c, {"units": "rad", "long_name": "frequency, per sample"})},
            attrs=told | described,
        )
        return made

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, ax: Any = None, language: str = "en") -> Any:
            """See `pendula.plot.spectrum`."""

    def __repr__(self) -> str:
        told = f", oversampled: first zero at {self.first_zero}" if self.oversampled else ""
        return f"<ZeroOne K = {self.value:.4f}, {self.verdict}{told}>"


def zero_one(series: ArrayLike, c: ArrayLike | int | None = None, seed: int = 0) -> ZeroOne:
    """The 0–1 test for chaos of an evenly sampled series (Gottwald & Melbourne 2009).

    The series φ_j drives p and q by φ_j cos jc and φ_j sin jc; K_c is the correlation with n of
    their mean square displacement M_c(n), without its oscillating part ⟨φ⟩² (1 − cos nc)/(1 − cos
    c) (their eqs. 2.1–2.6), for n up to a tenth of the length; K is the median over c.

    Args:
        series: samples of one quantity, such as successive crossings of a section, (n,).
        c: frequencies, (m,) [rad per sample]; None: c_i = π/5 + (3π/5)(i + ½)/100, i = 0 … 99; a
            whole number: so many drawn from π/5 to 4π/5.
        seed: of that draw, by PCG64; nothing else is random.

    Returns:
        K, the value at each c, whether the series is oversampled, and the verdict.

    Raises:
        ValueError: for a series that is too short or constant, or a c next to a multiple of 2π.
    """
    import numpy as np

    samples = _checked_series(series)
    frequencies = _checked_c(c, seed)
    values = _correlations(samples, frequencies)
    value = float(np.median(values))
    first_zero = _first_zero(samples)
    oversampled = first_zero > _SHORTEST_ZERO
    verdict = "chaotic" if value > _CHAOTIC else "regular" if value < _REGULAR else "undecided"
    recipe = {"c": c if c is None or isinstance(c, int) else frequencies.tolist(), "seed": seed}
    return ZeroOne(
        value,
        frequencies,
        values,
        first_zero,
        oversampled,
        "undecided" if oversampled else verdict,
        recipe,
    )


def _checked_series(series: ArrayLike) -> Array:
    """The samples, (n,), enough of them, that vary."""
    samples = finite_array("series", series)
    if samples.ndim != 1 or not _LEAST <= samples.size <= _MOST:
        raise ArgumentError(
            "series",
            f"must hold from {_LEAST} to {_MOST} samples of one quantity, got shape {{value}}",
            "test each quantity by itself",
            value=samples.shape,
        )
    if samples.min() == samples.max():
        raise ArgumentError(
            "series",
            "must vary, got {value} in every sample",
            "take a quantity that the motion changes",
            value=float(samples[0]),
        )
    return samples


def _checked_c(c: ArrayLike | int | None, seed: int) -> Array:
    """The frequencies (m,) of the test."""
    import numpy as np

    if c is None:
        steps = (np.arange(_FREQUENCIES) + 0.5) / _FREQUENCIES
        return np.asarray(math.pi / 5 + 3 * math.pi / 5 * steps)
    if isinstance(c, int):
        count = whole_number("c", c, _MOST_FREQUENCIES)
        generator = np.random.Generator(np.random.PCG64(seed))
        return generator.uniform(math.pi / 5, 4 * math.pi / 5, count)
    frequencies = finite_array("c", c, "rad").reshape(-1)
    if not 1 <= frequencies.size <= _MOST_FREQUENCIES:
        rule = f"must hold from 1 to {_MOST_FREQUENCIES} frequencies, got {{value}} of them"
        raise ArgumentError("c", rule, value=frequencies.size)
    resonant = abs(np.sin(frequencies / 2)) < 1e-6
    if resonant.any():
        raise ArgumentError(
            "c",
            "must not be a multiple of 2 pi, where the mean alone drives the test; got {value}",
            "take values from pi/5 to 4 pi/5",
            value=float(frequencies[resonant.argmax()]),
        )
    return frequencies


def _correlations(samples: Array, frequencies: Array) -> Array:
    """K_c at each c, (m,)."""
    import numpy as np

    count = samples.size
    most = count // 10
    lags, places = np.arange(1, most + 1), np.arange(1, count + 1)
    squared_mean = samples.mean() ** 2
    values = np.empty(frequencies.size)
    for i, c in enumerate(frequencies):
        path = np.cumsum(samples * np.exp(1j * c * places))  # p + iq
        displacement = _displacement(path, most)
        displacement -= squared_mean * (1 - np.cos(lags * c)) / (1 - np.cos(c))
        values[i] = _correlation(lags, displacement)
    return values


def _displacement(path: Any, most: int) -> Array:
    """M_c(n) = mean over j = 1 … N − most of |z_(j+n) − z_j|², n = 1 … most, by one convolution."""
    import numpy as np

    path = path - path.mean()  # the displacement is the same, with more digits
    head = path[: path.size - most]
    size = 1 << (path.size + head.size - 1).bit_length()
    spectrum = np.fft.fft(path, size) * np.conj(np.fft.fft(head, size))
    products = np.fft.ifft(spectrum)[1 : most + 1].real
    squares = np.concatenate([[0.0], np.cumsum(abs(path) ** 2)])
    ends = np.arange(1, most + 1)
    moved = squares[ends + head.size] - squares[ends]
    return np.asarray((moved + squares[head.size] - 2 * products) / head.size)


def _correlation(lags: Any, values: Array) -> float:
    """The correlation coefficient; 0 where the values do not vary."""
    import numpy as np

    x, y = lags - lags.mean(), values - values.mean()
    size = math.sqrt(float(x @ x) * float(y @ y))
    return float(np.clip(x @ y / size, -1.0, 1.0)) if size else 0.0


def _first_zero(samples: Array) -> int:
    """The first lag at which the autocorrelation is negative; there is one, as its sum is 0."""
    import numpy as np

    centred = samples - samples.mean()
    size = 1 << (2 * samples.size - 1).bit_length()
    spectrum = np.fft.rfft(centred, size)
    found = np.fft.irfft(abs(spectrum) ** 2, size)[: samples.size]
    return int((found < 0).argmax())
