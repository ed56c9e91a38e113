"""Where the values of a column come from."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pendula._checks import LARGEST_COUNT, counted, finite_number, positive_number
from pendula._given import plain
from pendula._messages import ArgumentError
from pendula.many.sampling.bits import exp2, log2_ratio, units
from pendula.many.sampling.normal import FARTHEST, normals

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pendula._types import Array

    Whole = NDArray[np.int64]


@dataclass(frozen=True)
class Fixed:
    """The same value in every row."""

    value: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "value", finite_number("value", self.value))

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest value."""
        return self.value, self.value


@dataclass(frozen=True)
class Uniform:
    """Uniformly distributed from `low` to `high`: low + (high − low) u, with u in [0, 1)."""

    low: float
    high: float

    def __post_init__(self) -> None:
        _check_range(self, self.low, self.high)

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest value."""
        return self.low, self.high

    def drawn(self, words: NDArray[np.uint64]) -> Array:
        """The values (n,) of random words (n,)."""
        values: Array = self.low + (self.high - self.low) * units(words)
        return np.minimum(values, self.high)


@dataclass(frozen=True)
class LogUniform:
    """Uniformly distributed in the logarithm: low (high / low)^u, with u in [0, 1)."""

    low: float
    high: float

    def __post_init__(self) -> None:
        _check_range(self, self.low, self.high)
        if self.low <= 0:
            raise ValueError(f"log_uniform must begin above zero, got {self.low!r}")
        if not math.isfinite(self.high / self.low):
            raise ValueError(
                f"log_uniform must not be wider than numbers go, got {self.low!r} to {self.high!r}"
            )

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest value."""
        return self.low, self.high

    def drawn(self, words: NDArray[np.uint64]) -> Array:
        """The values (n,) of random words (n,)."""
        values = self.low * exp2(units(words) * log2_ratio(self.low, self.high))
        return np.clip(values, self.low, self.high)


@dataclass(frozen=True)
class Normal:
    """Normally distributed; no value is farther than 8.3 standard deviations from the mean."""

    mean: float
    deviation: float

    def __post_init__(self) -> None:
        mean = finite_number("mean", self.mean)
        deviation = positive_number("the standard deviation", self.deviation)
        if not math.isfinite(abs(mean) + FARTHEST * deviation):
            rule = "a normal must not be wider than numbers go"
            raise ValueError(f"{rule}, got mean {mean!r} and standard deviation {deviation!r}")
        object.__setattr__(self, "mean", mean)
        object.__setattr__(self, "deviation", deviation)

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest value."""
        reach = FARTHEST * self.deviation
        return self.mean - reach, self.mean + reach

    def drawn(self, words: NDArray[np.uint64]) -> Array:
        """The values (n,) of random words (n,)."""
        values: Array = self.mean + self.deviation * normals(words)
        return values


@dataclass(frozen=True)
class Choice:
    """One of some values, each equally likely."""

    values: tuple[float, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", _checked("choice", self.values))

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest value."""
        return min(self.values), max(self.values)

    def drawn(self, words: NDArray[np.uint64]) -> Array:
        """The values (n,) of random words (n,)."""
        count = len(self.values)
        places = np.minimum((units(words) * count).astype(np.int64), count - 1)
        return np.array(self.values)[places]


@dataclass(frozen=True)
class Grid:
    """`count` values from `low` to `high`, both among them; −x with x where low = −high."""

    low: float
    high: float
    count: int

    def __post_init__(self) -> None:
        _check_range(self, self.low, self.high)
        count = counted("the count of a grid", self.count, LARGEST_COUNT)
        if count < 2:
            raise ValueError("a grid must have at least 2 values, got 1; name the one value alone")
        if not math.isfinite(max(-self.low, self.high) * count):
            raise ValueError(f"a grid must end before {self.high!r}, where numbers do")
        object.__setattr__(self, "count", count)

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest value."""
        return self.low, self.high

    def at(self, places: Whole) -> Array:
        """The values (n,) at places (n,) from 0 on."""
        last = self.count - 1
        # From both ends alike, so that opposites are exact.
        inner = (self.low * (last - places) + self.high * places) / last
        return np.where(places == 0, self.low, np.where(places == last, self.high, inner))


@dataclass(frozen=True)
class Listed:
    """A grid of these values."""

    values: tuple[float, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", _checked("list", self.values))

    @property
    def count(self) -> int:
        """How many there are."""
        return len(self.values)

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest value."""
        return min(self.values), max(self.values)

    def at(self, places: Whole) -> Array:
        """The values (n,) at places (n,) from 0 on."""
        return np.array(self.values)[places]


@dataclass(frozen=True)
class SameAs:
    """Whatever another column has in that row."""

    column: str


Distribution = Fixed | Uniform | LogUniform | Normal | Choice | Grid | Listed | SameAs
KINDS: dict[str, Callable[..., Distribution]] = {
    "fixed": Fixed,
    "uniform": Uniform,
    "log_uniform": LogUniform,
    "normal": Normal,
    "choice": Choice,
    "grid": Grid,
    "list": Listed,
    "same_as": SameAs,
}


def _check_range(each: Uniform | LogUniform | Grid, low: object, high: object) -> None:
    ends = finite_number("low", low), finite_number("high", high)
    if not ends[0] < ends[1]:
        raise ValueError(f"a range must rise, got {ends[0]!r} to {ends[1]!r}")
    if not math.isfinite(ends[1] - ends[0]):
        raise ValueError(
            f"a range must not be wider than numbers go, got {ends[0]!r} to {ends[1]!r}"
        )
    object.__setattr__(each, "low", ends[0])
    object.__setattr__(each, "high", ends[1])


def _checked(what: str, values: object) -> tuple[float, ...]:
    name = f"the values of a {what}"
    try:
        given = plain(name, values, "")
        if isinstance(given, str | bytes | Mapping):
            raise TypeError
        entries = given.tolist() if hasattr(given, "tolist") else given
        found = tuple(finite_number(f"each value of a {what}", each) for each in entries)
    except TypeError:
        raise ArgumentError(name, "must be a list of numbers, got {value}", value=values) from None
    if not found:
        raise ValueError(f"a {what} must have at least one value")
    return found
