"""The 0–1 test for chaos: whether a translation driven by a series stays bounded or diffuses."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula._checks import checked_threads, extra, finite_array, whole_number
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula.chaos.datasets import told_of_series
from pendula.chaos.verdict import VERDICTS

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
_BLOCK = 2**16  # samples of several series worked on at a time


@with_promised
@dataclass(frozen=True, eq=False, repr=False)
class ZeroOne:
    """What the 0–1 test says of one series, or of k series (then with a first axis k).

    Attributes:
        value: K, the median over c: near 0 regular, near 1 chaotic.
        c: the frequencies of the test, the same for all series, (m,) [rad per sample].
        values: K_c, the correlation of the displacement with time at each c, (m,).
        first_zero: the sample at which the autocorrelation first falls below zero.
        oversampled: whether that lies beyond 10 samples; K is then near 0 for chaos, too.
        verdict: "chaotic", "regular" or "undecided"; an oversampled series is always undecided.
        recipe: the arguments that it was made with, but for the series.
    """

    value: Any
    c: Array
    values: Array
    first_zero: Any
    oversampled: Any
    verdict: Any
    recipe: Mapping[str, Any] = field(default_factory=dict)

    def to_xarray(self) -> xr.Dataset:
        """K at each frequency of the test (extra: io)."""
        told = {"K": self.value, "verdict": self.verdict, "first_zero": self.first_zero}
        several, data, attrs = told_of_series(
            "ZeroOne", told, self.recipe, several=self.values.ndim == 2
        )
        meaning = {"long_name": "correlation of the displacement with time"}
        made: xr.Dataset = extra("xarray", "io").Dataset(
            {"K_c": ((*several, "c"), self.values, meaning), **data},
            coords={"c": ("c", self.c, {"units": "rad", "long_name": "frequency, per sample"})},
            attrs=attrs,
        )
        return made

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, ax: Any = None, language: str = "en") -> Any:
            """See `pendula.plot.spectrum`."""

    def __repr__(self) -> str:
        if self.values.ndim == 2:
            counts = {each: int((self.verdict == each).sum()) for each in VERDICTS}
            told = ", ".join(f"{count} {each}" for each, count in counts.items() if count)
            often = f"; {self.oversampled.sum()} oversampled" if self.oversampled.any() else ""
            return f"<ZeroOne of {len(self.values)} series: {told}{often}>"
        told = f", oversampled: first zero at {self.first_zero}" if self.oversampled else ""
        return f"<ZeroOne K = {self.value:.4f}, {self.verdict}{told}>"


def zero_one(
    series: ArrayLike,
    c: ArrayLike | int | None = None,
    seed: int = 0,
    *,
    threads: int | None = None,
) -> ZeroOne:
    """The 0–1 test for chaos of evenly sampled series (Gottwald & Melbourne 2009).

    The series φ_j drives p and q by φ_j cos jc and φ_j sin jc; K_c is the correlation with n of
    their mean square displacement M_c(n), without its oscillating part ⟨φ⟩² (1 − cos nc)/(1 − cos
    c) (their eqs. 2.1–2.6), for n up to a tenth of the length; K is the median over c.

    Args:
        series: samples of one quantity, such as successive crossings of a section, (n,), or of k
            quantities or motions, (k, n); each has the bits that it has alone.
        c: frequencies, (m,) [rad per sample]; None: c_i = π/5 + (3π/5)(i + ½)/100, i = 0 … 99; a
            whole number: so many drawn from π/5 to 4π/5.
        seed: of that draw, by PCG64; nothing else is random.
        threads: that test several series, each in some 200 bytes a sample. None: one for each
            processor.

    Returns:
        K, the value at each c, whether the series is oversampled, and the verdict.

    Raises:
        ValueError: for a series that is too short or constant, or a c next to a multiple of 2π.
    """
    import numpy as np

    samples, single = _checked_series(series)
    frequencies = _checked_c(c, seed)
    values, first_zero = _tested(samples, frequencies, checked_threads(threads))
    value = np.median(values, axis=-1)
    oversampled = first_zero > _SHORTEST_ZERO
    verdict = np.where(value < _REGULAR, "regular", "undecided")
    verdict = np.where(value > _CHAOTIC, "chaotic", verdict)
    verdict = np.where(oversampled, "undecided", verdict)
    recipe = {"c": c if c is None or isinstance(c, int) else frequencies.tolist(), "seed": seed}

    def shaped(each: Any) -> Any:
        return each[0].item() if single else each

    return ZeroOne(
        shaped(value),
        frequencies,
        values[0] if single else values,
        shaped(first_zero),
        shaped(oversampled),
        shaped(verdict),
        recipe,
    )


def _checked_series(series: ArrayLike) -> tuple[Array, bool]:
    """The samples of all series, (k, n), enough of them, that vary; whether one was given, (n,)."""
    samples = finite_array("series", series)
    single = samples.ndim == 1
    rows = samples[None] if single else samples
    if rows.ndim != 2 or not len(rows) or not _LEAST <= rows.shape[1] <= _MOST:
        raise ArgumentError(
            "series",
            f"must hold from {_LEAST} to {_MOST} samples of one quantity, got shape {{value}}",
            "give several quantities as rows",
            value=samples.shape,
        )
    for i, row in enumerate(rows):
        if row.min() == row.max():
            raise ArgumentError(
                "series" if single else f"series[{i}]",
                "must vary, got {value} in every sample",
                "take a quantity that the motion changes",
                value=float(row[0]),
            )
    return rows, single


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


def _tested(samples: Array, frequencies: Array, threads: int) -> tuple[Array, Array]:
    """K_c (k, m) and the first zeros (k,) of series (k, n), in blocks of them through threads."""
    import numpy as np

    count, length = samples.shape
    size = max(1, min(_BLOCK // length, math.ceil(count / threads)))
    blocks = [samples[first : first + size] for first in range(0, count, size)]

    def tested(block: Array) -> tuple[Array, Array]:
        return _correlations(block, frequencies), _first_zeros(block)

    if len(blocks) == 1 or threads == 1:
        found = [tested(block) for block in blocks]
    else:
        from concurrent.futures import ThreadPoolExecutor

        with ThreadPoolExecutor(min(threads, len(blocks))) as pool:
            found = list(pool.map(tested, blocks))
    values, first_zeros = zip(*found, strict=True)
    return np.concatenate(values), np.concatenate(first_zeros)


def _correlations(samples: Array, frequencies: Array) -> Array:
    """K_c of series (k, n) at each c, (k, m)."""
    import numpy as np

    count = samples.shape[1]
    most = count // 10
    lags, places = np.arange(1, most + 1), np.arange(1, count + 1)
    squared_means = np.array([[row.mean() ** 2] for row in samples])
    values = np.empty((len(samples), frequencies.size))
    for i, c in enumerate(frequencies):
        paths = np.cumsum(samples * np.exp(1j * c * places), axis=-1)  # p + iq
        displacements = _displacements(paths, most)
        displacements -= squared_means * (1 - np.cos(lags * c)) / (1 - np.cos(c))
        values[:, i] = [_correlation(lags, each) for each in displacements]
    return values


def _displacements(paths: Any, most: int) -> Array:
    """M_c(n) = mean over j = 1 … N − most of |z_(j+n) − z_j|², n = 1 … most, by one convolution.

    Args:
        paths: z of each series, (k, N).
        most: n goes up to.
    """
    import numpy as np

    paths = paths - paths.mean(axis=-1, keepdims=True)  # the same displacement, with more digits
    count = paths.shape[-1]
    heads = paths[:, : count - most]
    length = heads.shape[-1]
    size = 1 << (count + length - 1).bit_length()
    spectra = np.fft.fft(paths, size) * np.conj(np.fft.fft(heads, size))
    products = np.fft.ifft(spectra)[:, 1 : most + 1].real
    squares = np.zeros((len(paths), count + 1))
    np.cumsum(abs(paths) ** 2, axis=-1, out=squares[:, 1:])
    moved = squares[:, 1 + length :] - squares[:, 1 : most + 1]
    return np.asarray((moved + squares[:, [length]] - 2 * products) / length)


def _correlation(lags: Any, values: Array) -> float:
    """The correlation coefficient; 0 where the values do not vary.

    Sums of products, whose bits do not depend on threads as those of `@` do.
    """
    import numpy as np

    x, y = lags - lags.mean(), values - values.mean()
    size = math.sqrt(float((x * x).sum()) * float((y * y).sum()))
    return float(np.clip((x * y).sum() / size, -1.0, 1.0)) if size else 0.0


def _first_zeros(samples: Array) -> Any:
    """The first lag at which each autocorrelation is negative, (k,); there is one: its sum is 0."""
    import numpy as np

    centred = samples - samples.mean(axis=-1, keepdims=True)
    count = samples.shape[-1]
    size = 1 << (2 * count - 1).bit_length()
    spectra = np.fft.rfft(centred, size)
    found = np.fft.irfft(abs(spectra) ** 2, size)[:, :count]
    return (found < 0).argmax(axis=-1)
