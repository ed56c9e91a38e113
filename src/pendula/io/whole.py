"""Whether a file is whole: what it holds is compared with the counts and checksums of its recipe.

A size is compared with the recipe's, or with the size of the file, before memory is taken for it.
"""

from __future__ import annotations

import json
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula._attributes import kind_of
from pendula._messages import one_line
from pendula.io.attributes import NotATrajectoryError
from pendula.io.checksums import of_column, of_recipe
from pendula.io.columns import TIME, states_labels
from pendula.run.derivatives import derivative_name

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from pendula._types import Array

_NEEDED = ("system", "method", "state", "t", "t0", "outcome", "n_steps", "n_evaluations")
_BEFORE = {  # all that a recipe without a checksum can hold
    *("pendula", *_NEEDED),
    *("step", "tolerance", "max_steps", "certify", "digits", "events"),
    *("reached", "crossings", "trust_horizon", "precision"),
}
_READERS = {  # of files that hold something else, by ending
    ".csv": 'pandas.read_csv(…, comment="#")',
    ".nc": "xarray.open_dataset",
    ".parquet": "pandas.read_parquet",
    ".zarr": "xarray.open_zarr",
}
_DENSEST = 1000  # times that a format packs different doubles into one's room, and far from that


class UncheckedFileWarning(UserWarning):
    """A file of a version that wrote no checksums: damage to its numbers may go unnoticed."""


@dataclass(frozen=True)
class Stored:
    """What an open file holds; columns have not been read yet, so their shapes are only claims.

    Attributes:
        recipe: a line of JSON.
        shapes: of the columns, by label: "theta [rad]".
        column: reads one of them.
        size: of the file, or of all files of a folder [bytes].
        hint: why numbers may not fit their checksums, to be added to the error; empty: unknown.
    """

    recipe: str
    shapes: Mapping[str, tuple[int, ...]]
    column: Callable[[str], Any]
    size: int
    hint: Callable[[], str] = str


def recipe_of(stored: Stored, source: Path) -> dict[str, Any]:
    """A file's recipe, compared with its checksum; one without has no "checksum" either.

    Raises:
        NotATrajectoryError: where it is damaged, or none.
    """
    try:
        known = json.loads(stored.recipe)
        checksum = known.pop("checksum", None)
        if checksum is not None:
            if of_recipe(known) != checksum:
                known = _with_doubles(known)  # a spreadsheet makes 0 of 0.0
            sound = of_recipe(known) == checksum
            known["checksum"] = checksum
        else:
            sound = known.keys() <= _BEFORE
    except (AttributeError, RecursionError, ValueError) as error:
        raise NotATrajectoryError(
            f"{source} does not hold a trajectory of pendula: its attributes are no recipe: "
            f"{one_line(error)}"
        ) from None
    kind = kind_of(known)
    if kind is not None and kind != "trajectory":
        what = {"ensemble": "an ensemble", "events": "events"}.get(kind, f"a {kind}")
        raise NotATrajectoryError(
            f"{source} holds {what}, not a trajectory; "
            f"read it with {_READERS[source.suffix.lower()]}"
        )
    lacking = next((name for name in _NEEDED if name not in known), None)
    if lacking is not None:
        raise NotATrajectoryError(
            f"{source} does not hold a trajectory of pendula: its attributes lack {lacking!r}"
        )
    if not sound:
        what = "its recipe does not fit the recipe's checksum"
        raise damaged(source, what + stored.hint())
    return dict(known)


def _with_doubles(known: Any) -> Any:
    """A recipe's data with doubles in all lists of numbers, as it was written."""
    if isinstance(known, dict):
        return {name: _with_doubles(each) for name, each in known.items()}
    if isinstance(known, list):
        return [float(each) if type(each) is int else _with_doubles(each) for each in known]
    return known


def warn_unchecked(known: Mapping[str, Any], source: Path) -> None:
    """Say that a file has no checksums; for functions that the user calls."""
    if "checksum" not in known:
        message = (
            f"{source} is of a version that wrote no checksums: damage to it may go unnoticed; "
            "load it and save it again"
        )
        warnings.warn(message, UncheckedFileWarning, stacklevel=3)


class Whole:
    """Reads a file that is whole, as far as its recipe tells.

    Args:
        known: its recipe, from `recipe_of`.
        stored: what it holds.
        source: its path, for errors.
    """

    def __init__(self, known: Mapping[str, Any], stored: Stored, source: Path) -> None:
        self._known, self._stored, self._source = known, stored, source
        self._checksums: Mapping[str, str] = known.get("columns", {})

    def table(self) -> tuple[Array, Array, Array | None]:
        """Times (n,), states (..., n, d), and derivatives (..., n, d, k) where there are any.

        Raises:
            NotATrajectoryError: naming the column, and the row where it can be told.
        """
        import numpy as np

        for label in self._checksums:
            if label not in self._stored.shapes:
                raise damaged(self._source, f"the column {label} is missing")
        names = states_labels(self._stored.shapes)
        if TIME not in self._stored.shapes or not names:
            raise NotATrajectoryError(f"{self._source} lacks the columns of a pendulum's states")
        count = self._count()
        shape = (*np.shape(self._known["state"])[:-1], count)
        times = self._column(TIME, (count,))
        self._check_times(times)
        self._check_sum(TIME, times)
        columns = {name: self._column(name, shape) for name in names}
        for name, values in columns.items():
            self._check_finite(name, values)
            self._check_sum(name, values)
        for label in self._checksums.keys() - {TIME, *names}:
            self._check_sum(label, self._column(label, shape))
        return times, np.stack(list(columns.values()), axis=-1), self._derivatives(names, shape)

    def _derivatives(self, names: Sequence[str], shape: tuple[int, ...]) -> Array | None:
        """Of the states by what the recipe says, (..., n, d, k); None: it says nothing."""
        import numpy as np

        by = self._known.get("derived_by")
        if not by:
            return None
        labels = {label.partition(" [")[0]: label for label in self._stored.shapes}
        wanted = [
            [derivative_name(name.partition(" [")[0], str(each)) for each in by] for name in names
        ]
        for name in (each for row in wanted for each in row):
            if name not in labels:
                raise damaged(self._source, f"the column {name} is missing")
        found = [[self._column(labels[name], shape) for name in row] for row in wanted]
        return np.stack([np.stack(row, axis=-1) for row in found], axis=-2)

    def _count(self) -> int:
        """The number of times, before memory is taken for them."""
        (count,), known = self._stored.shapes[TIME], self._known
        wanted = known.get("n_times", count)
        if count != wanted:
            rest = self._missing(count) if count < wanted else ""
            raise damaged(self._source, f"it holds {count} of {wanted} times{rest}")
        if count == 0 and known["t"] is None and known["method"] != "exact":
            raise damaged(self._source, "it holds no times")
        if count * 8 > _DENSEST * self._stored.size:
            raise damaged(
                self._source, f"it cannot hold {count} times in {self._stored.size} bytes"
            )
        return int(count)

    def _missing(self, count: int) -> str:
        """Where rows are missing: in the one gap of times evenly spaced, or at the end."""
        import numpy as np

        times = self._column(TIME, (count,))
        if count > 2:
            steps = abs(np.diff(times))
            usual = np.median(steps)
            wide = np.flatnonzero(steps > 1.5 * usual)
            if wide.size == 1 and np.allclose(np.delete(steps, wide), usual):
                return f"; those after row {wide[0] + 1} are missing"
        return f"; the last is {float(times[-1])!r} s" if count else ""

    def _column(self, label: str, shape: tuple[int, ...]) -> Array:
        """A column of that shape; a larger one is not read."""
        import numpy as np

        if self._stored.shapes[label] == shape:
            values = np.asarray(self._stored.column(label), dtype=np.float64)
            if values.shape == shape:
                return values
        raise damaged(self._source, f"the column {label} is not of the length of the others")

    def _check_sum(self, label: str, values: Array) -> None:
        if label in self._checksums and of_column(values) != self._checksums[label]:
            what = f"{label} does not fit its checksum"
            raise damaged(self._source, what + self._stored.hint())

    def _check_finite(self, label: str, values: Array) -> None:
        import numpy as np

        bad = ~np.isfinite(values)
        if bad.any():
            row = int(bad.any(axis=tuple(range(values.ndim - 1))).argmax())
            raise damaged(self._source, f"{label} is no finite number in row {row + 1}")

    def _check_times(self, times: Array) -> None:
        """Refuse times that are no numbers or, of a run step by step, do not go one way from t0."""
        import numpy as np

        self._check_finite(TIME, times)
        if self._known["method"] == "exact" or not times.size:
            return
        since = times - self._known["t0"]
        direction = -1.0 if since[abs(since).argmax()] < 0 else 1.0
        if since[0] * direction < 0:
            raise damaged(self._source, f"row 1, at {float(times[0])!r} s, is before the start")
        back = np.flatnonzero(np.diff(times) * direction <= 0)
        if back.size:
            row = int(back[0]) + 1
            before, after = times[row - 1 : row + 1].tolist()
            raise damaged(
                self._source, f"row {row + 1}, at {after!r} s, does not follow {before!r} s"
            )


def damaged(source: Path, what: str) -> NotATrajectoryError:
    """The error of a file that does not fit its recipe."""
    return NotATrajectoryError(f"{source} is damaged: {what}")
