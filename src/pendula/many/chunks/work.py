"""Chunked work: what it computes, how its result is laid out, and one chunk of it."""

from __future__ import annotations

import itertools
import json
import math
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol

from pendula._attributes import KEY

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from numpy.typing import NDArray

    from pendula._progress import Progress

    Arrays = Mapping[str, NDArray[Any]]
    Index = tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Axis:
    """A dimension of the result.

    Attributes:
        name: of the dimension, and of its coordinate.
        size: number of values.
        chunk: values in a chunk; None: the axis is not cut.
        values: the coordinate, (size,); None: there is none.
        attrs: of the coordinate: units and the like.
    """

    name: str
    size: int
    chunk: int | None = None
    values: NDArray[Any] | None = None
    attrs: Mapping[str, Any] = field(default_factory=dict)

    @property
    def step(self) -> int:
        """Values in a chunk, of an axis that is not cut too."""
        return min(self.chunk or self.size, self.size)

    @property
    def count(self) -> int:
        """Number of chunks along the axis."""
        return -(-self.size // self.step)


@dataclass(frozen=True)
class Variable:
    """An array of the result; every chunk holds a part of it.

    Attributes:
        name: of the variable.
        dims: names of its axes, all the cut ones among them.
        dtype: numpy's name of the type: "float64", "uint8", "bool", or "<U11" of texts …
        fill: what stands where no chunk has been written.
        attrs: units and the like.
    """

    name: str
    dims: tuple[str, ...]
    dtype: str
    fill: float | bool | str
    attrs: Mapping[str, Any] = field(default_factory=dict)

    @property
    def is_text(self) -> bool:
        """Whether it holds texts, whose length in a store is their own."""
        return self.dtype.startswith("<U")


@dataclass(frozen=True)
class Chunk:
    """A part of the result: a box of the cut axes.

    Attributes:
        index: place in the grid of chunks.
        spans: (start, stop) by name of each cut axis.
    """

    index: Index
    spans: Mapping[str, tuple[int, int]]

    def __getitem__(self, axis: str) -> slice:
        """What the chunk takes of an axis; all of one that is not cut."""
        return slice(*self.spans.get(axis, (None,)))

    @property
    def shape(self) -> tuple[int, ...]:
        """Its size along the cut axes."""
        return tuple(stop - start for start, stop in self.spans.values())


class Compute(Protocol):
    """One chunk: a function, or a frozen dataclass, that can be pickled."""

    def __call__(self, chunk: Chunk, threads: int | None, progress: Progress) -> Arrays:
        """The chunk's part of every variable, from the chunk alone.

        Args:
            chunk: which part.
            threads: to compute with; None: as many as there are cores. No bit depends on it.
            progress: called with the part of the chunk that is done, 0 to 1; None on a cluster.
        """


@dataclass(frozen=True, eq=False)
class Work:
    """A chunked computation.

    Attributes:
        inputs: what the result follows from: system, arguments, version; as JSON. The same inputs
            give the same bytes.
        axes: the dimensions; one at least is cut.
        variables: the arrays.
        compute: gives one chunk.
        attrs: of the whole, besides the inputs.
        mirrored: the result is the same when all cut axes are turned round, bit for bit: of each
            pair of chunks one is computed. Chunks then have to divide their axes.
        growing: keys of a whole number in the inputs that the size of the one cut axis is a
            multiple of; a larger number leaves what there is as it is. Empty: there is none.
    """

    inputs: Mapping[str, Any]
    axes: tuple[Axis, ...]
    variables: tuple[Variable, ...]
    compute: Compute
    attrs: Mapping[str, Any] = field(default_factory=dict)
    mirrored: bool = False
    growing: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        sizes = {axis.name: axis.size for axis in self.axes}
        cut = {axis.name for axis in self.cut}
        names = Counter([*sizes, *(each.name for each in self.variables)])
        if not cut or not self.variables or max(names.values()) > 1:
            raise ValueError(f"a work needs a cut axis and variables of different names: {names}")
        for axis in self.axes:
            if axis.size < 1 or (axis.chunk is not None and axis.chunk < 1):
                raise ValueError(f"axis {axis.name} must have a size and a chunk of at least 1")
            if axis.values is not None and axis.values.shape != (axis.size,):
                raise ValueError(f"axis {axis.name} must have values of shape ({axis.size},)")
            if self.mirrored and axis.size % axis.step:
                raise ValueError(f"axis {axis.name}: mirrored chunks must divide its size")
        for each in self.variables:
            if not cut <= set(each.dims) <= set(sizes):
                raise ValueError(f"variable {each.name} must have the cut axes {sorted(cut)}")

    @property
    def cut(self) -> tuple[Axis, ...]:
        """The axes that are cut into chunks."""
        return tuple(axis for axis in self.axes if axis.chunk is not None)

    @property
    def n_chunks(self) -> int:
        """Number of chunks."""
        return math.prod(axis.count for axis in self.cut)

    @property
    def identity(self) -> str:
        """The inputs and the chunks as one line of JSON: what identifies a store."""
        chunks = {axis.name: axis.step for axis in self.cut}
        return json.dumps({**self.inputs, "chunks": chunks}, allow_nan=False)

    @property
    def attributes(self) -> dict[str, Any]:
        """Those of the result as a whole."""
        return {KEY: self.identity, **self.attrs}

    def indices(self) -> Iterator[Index]:
        """Places of all chunks, the last axis fastest."""
        return itertools.product(*(range(axis.count) for axis in self.cut))

    def chunk(self, index: Index) -> Chunk:
        """The chunk at a place."""
        spans = {
            axis.name: (i * axis.step, min((i + 1) * axis.step, axis.size))
            for axis, i in zip(self.cut, index, strict=True)
        }
        return Chunk(index, spans)

    def mirror(self, index: Index) -> Index:
        """The index of the mirror image; the same index where the work is not mirrored."""
        if not self.mirrored:
            return index
        return tuple(axis.count - 1 - i for axis, i in zip(self.cut, index, strict=True))

    def shape(self, variable: Variable, chunk: Chunk | None = None) -> tuple[int, ...]:
        """Of a variable, or of a chunk's part of it."""
        sizes = {axis.name: axis.size for axis in self.axes}
        if chunk is not None:
            sizes |= dict(zip(chunk.spans, chunk.shape, strict=True))
        return tuple(sizes[dim] for dim in variable.dims)

    def checked(self, chunk: Chunk, arrays: Arrays) -> dict[str, NDArray[Any]]:
        """What `compute` gave, checked against the variables' types and shapes.

        Raises:
            ValueError: for another variable, type or shape.
        """
        import numpy as np

        found = {name: (np.dtype(a.dtype).name, a.shape) for name, a in arrays.items()}
        expected = {
            each.name: (np.dtype(each.dtype).name, self.shape(each, chunk))
            for each in self.variables
        }
        if found != expected:
            raise ValueError(f"chunk {chunk.index} must be {expected}, got {found}")
        return {each.name: arrays[each.name] for each in self.variables}

    def reflected(self, arrays: Arrays) -> dict[str, NDArray[Any]]:
        """A chunk's arrays as those of its mirror image."""
        cut = {axis.name for axis in self.cut}
        ways = {
            each.name: tuple(slice(None, None, -1 if dim in cut else 1) for dim in each.dims)
            for each in self.variables
        }
        return {name: array[ways[name]] for name, array in arrays.items()}
