"""Rows of named values: points of grids, with random draws at each."""

from __future__ import annotations

import math
import operator
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._checks import LARGEST_COUNT, counted, one_of
from pendula._given import plain
from pendula._messages import ArgumentError
from pendula.many.sampling.bits import words
from pendula.many.sampling.distributions import (
    KINDS,
    Choice,
    Distribution,
    Fixed,
    Grid,
    Listed,
    LogUniform,
    Normal,
    SameAs,
    Uniform,
)

if TYPE_CHECKING:
    from pendula._types import Array


LARGEST_SEED = 2**64 - 1


@dataclass(frozen=True)
class Sampler:
    """Rows of named values: every point of the grids, each with as many random draws as asked for.

    One pass through all points follows another, a pass for each draw, so that more draws leave the
    rows that there are as they are. Within a pass the first grid changes slowest.

    Args:
        columns: names and where their values come from; grids and draws in any mixture.
        draws: at each point of the grid; 1 where nothing is random.
        seed: of the random streams, 0 to 2^64 − 1.

    Raises:
        ValueError: for a name given twice, draws without anything random, or more than 2^53 rows.
    """

    columns: tuple[tuple[str, Distribution], ...]
    draws: int = 1
    seed: int = 0

    def __post_init__(self) -> None:
        object.__setattr__(self, "columns", _checked_columns(self.columns))
        names = [name for name, _ in self.columns]
        if len(set(names)) < len(names):
            rule = "must have different names, got {choices}"
            raise ArgumentError("columns", rule, choices=names)
        known = {name: each for name, each in self.columns if not isinstance(each, SameAs)}
        for name, each in self.columns:
            if isinstance(each, SameAs):
                one_of(f"{name}: same_as", each.column, known)
        object.__setattr__(self, "draws", counted("draws", self.draws, LARGEST_COUNT))
        if self.draws > 1 and not self.random:
            rule = "must be 1 where nothing is random, got {value}"
            raise ArgumentError("draws", rule, value=self.draws)
        object.__setattr__(self, "seed", _checked_seed(self.seed))
        if self.count > LARGEST_COUNT:
            raise ValueError(f"there must be at most 2^53 rows, got {self.count}")

    @property
    def random(self) -> bool:
        """Whether any column is random."""
        return any(
            isinstance(each, Uniform | LogUniform | Normal | Choice) for _, each in self.columns
        )

    @property
    def count(self) -> int:
        """How many rows there are."""
        return self.draws * math.prod(self.shape)

    @property
    def shape(self) -> tuple[int, ...]:
        """How many values each grid has."""
        return tuple(each.count for _, each in self.columns if isinstance(each, Grid | Listed))

    def rows(self, start: int, stop: int) -> dict[str, Array]:
        """The columns (stop − start,) of these rows, counted from 0.

        Raises:
            IndexError: unless 0 ≤ start ≤ stop ≤ count.
        """
        if not 0 <= start <= stop <= self.count:
            raise IndexError(f"there are rows 0 to {self.count}, not {start} to {stop}")
        made: dict[str, Array] = {}
        slower = math.prod(self.shape)
        point = np.arange(start, stop, dtype=np.int64) % slower
        for name, each in self.columns:
            if isinstance(each, Grid | Listed):
                slower //= each.count
                made[name] = each.at(point // slower % each.count)
            elif isinstance(each, Fixed):
                made[name] = np.full(stop - start, each.value)
            elif not isinstance(each, SameAs):
                made[name] = each.drawn(words(self.seed, name, start, stop))
        return {
            name: made[each.column if isinstance(each, SameAs) else name]
            for name, each in self.columns
        }

    def description(self) -> dict[str, Any]:
        """The sampler as data that JSON can hold; `sampler_from` takes it back."""
        columns = [[name, *_described(each)] for name, each in self.columns]
        return {"columns": columns, "draws": self.draws, "seed": self.seed}


def _checked_seed(seed: object) -> int:
    try:
        found = operator.index(plain("seed", seed, ""))
    except TypeError:
        found = -1
    if not 0 <= found <= LARGEST_SEED:
        rule = "must be a whole number from 0 to 2^64 - 1, got {value}"
        raise ArgumentError("seed", rule, value=seed)
    return found


def _checked_columns(columns: object) -> tuple[tuple[str, Distribution], ...]:
    pairs = tuple(columns) if isinstance(columns, list | tuple) else (columns,)
    for each in pairs:
        known = isinstance(each, list | tuple) and len(each) == 2 and isinstance(each[0], str)
        if not known or type(each[1]) not in KINDS.values():
            rule = "must be pairs of a name and where its values come from, got {value}"
            raise ArgumentError("columns", rule, 'give (("theta", Fixed(0.5)),), say', value=each)
    return tuple((name, each) for name, each in pairs)


def sampler_from(description: dict[str, Any]) -> Sampler:
    """The sampler that `Sampler.description` described."""
    columns = tuple(
        (str(name), KINDS[kind](*(tuple(v) if isinstance(v, list) else v for v in values)))
        for name, kind, *values in description["columns"]
    )
    return Sampler(columns, description["draws"], description["seed"])


def _described(each: Distribution) -> list[Any]:
    kind = next(name for name, kind in KINDS.items() if kind is type(each))
    values = (getattr(each, field.name) for field in fields(each))
    return [kind, *(list(value) if isinstance(value, tuple) else value for value in values)]
