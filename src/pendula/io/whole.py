"""Whether a file is whole: what it holds is compared with the counts and checksums of its recipe.

A size is compared with the recipe's, or with the size of the file, before memory is taken for it.
"""

from __future__ import annotations

import json
import math
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula._engine import ON_GRID
from pendula._messages import one_line
from pendula.io.attributes import NotATrajectoryError
from pendula.io.checksums import of_column, of_recipe
from pendula.io.columns import TIME, states_labels

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from pendula._types import Array
    from pendula.run.trajectory import Trajectory

_NEEDED = ("system", "method", "state", "t", "t0", "outcome", "n_steps", "n_evaluations")
_BEFORE = {  # all that a recipe without a checksum can hold
    *("pendula", *_NEEDED),
    *("step", "tolerance", "max_steps", "certify", "digits", "events"),
    *("reached", "crossings", "trust_horizon", "precision"),
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
    """

    recipe: str
    shapes: Mapping[str, tuple[int, ...]]
    column: Callable[[str], Any]
    size: int


def recipe_of(text: str, source: Path) -> dict[str, Any]:
    """A file's recipe, compared with its checksum; one without has no "checksum" either.

    Raises:
        NotATrajectoryError: where it is damaged, or none.
    """
    try:
        known = json.loads(text)
        checksum = known.pop("checksum", None)
        if checksum is not None:
            sound = of_recipe(known) == checksum
            known["checksum"] = checksum
        else:
            sound = known.keys() <= _BEFORE
    except (AttributeError, RecursionError, ValueError) as error:
        raise NotATrajectoryError(
            f"{source} does not hold a trajectory of pendula: its attributes are no recipe: "
            f"{one_line(error)}"
        ) from None
    lacking = next((name for name in _NEEDED if name not in known), None)
    if lacking is not None:
        raise NotATrajectoryError(
            f"{source} does not hold a trajectory of pendula: its attributes lack {lacking!r}"
        )
    if not sound:
        raise damaged(source, "its recipe does not fit the recipe's checksum")
    return dict(known)


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

    def table(self) -> tuple[Array, Array]:
        """Times (n,) and states (..., n, d).

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
        return times, np.stack(list(columns.values()), axis=-1)

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
            raise damaged(self._source, f"{label} does not fit its checksum")

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


def check_ends(run: Trajectory, source: Path) -> None:
    """Refuse what cannot be all of a run, in a file that has no checksums to tell it.

    Raises:
        NotATrajectoryError: saying what does not fit.
    """
    if run.method == "exact":
        return
    asked, count = run.request, run.t.size
    complete = run.outcome == "reached_end"
    if isinstance(asked.t, float):
        if complete:
            _check_own_steps(run, asked.t, source)
        elif asked.step is not None:
            _check_rows(run, source)
    elif run.t.tolist() != asked.t[:count].tolist() or (complete and count != asked.t.size):
        raise damaged(source, f"its {count} times are not the {asked.t.size} asked for")
    if count and run.t[0] == asked.t0 and run.states[0].tolist() != asked.state.tolist():
        raise damaged(source, "row 1 is not the state at the start")
    if asked.step is not None:
        _check_grid(run, asked.step, source)
    elif not complete:
        _check_stopped(run, source)
    if complete:
        _check_found(run, source)


def _check_own_steps(run: Trajectory, end: float, source: Path) -> None:
    """Of a run that reached its end: the first time, the last, and a row for each step."""
    times: list[float] = run.t.tolist()
    if not times or times[-1] != end:
        last = f"{times[-1]!r} s" if times else "nowhere"
        raise damaged(source, f"it ends at {last}, but the run at {end!r} s")
    if times[0] != run.request.t0:
        raise damaged(source, f"row 1 is at {times[0]!r} s, not at the start")
    if run.request.digits is None:
        _check_rows(run, source)


def _check_rows(run: Trajectory, source: Path) -> None:
    """Of own steps: a row for the start and each step; the one that broke down gave none."""
    if run.t.size != run.n_steps + (run.outcome != "not_finite"):
        raise damaged(source, f"it holds {run.t.size} times of {run.n_steps} steps")


def _check_grid(run: Trajectory, step: float, source: Path) -> None:
    """Of a run of fixed step: that it took the steps to its last output, and not to the next."""
    import numpy as np

    asked = run.request
    own_steps = isinstance(asked.t, float)
    position = abs(np.atleast_1d(asked.t) - asked.t0) / step
    whole = np.round(position)
    # an output off the grid takes one step more, from which the run does not go on
    shortened = abs(position - whole) > ON_GRID + np.spacing(whole)
    counts = np.where(shortened, np.floor(position), whole) + np.cumsum(shortened)
    given = counts[: 0 if own_steps and run.outcome != "reached_end" else run.t.size]
    lacking = counts[given.size :]
    # a run that broke down counts the step at which it did
    too_few = given.size and run.n_steps < given[-1]
    if too_few or (run.n_steps > lacking[0] if lacking.size else run.n_steps != counts[-1]):
        raise damaged(
            source, f"its {run.t.size} times do not fit {run.n_steps} steps of {step!r} s"
        )


def _check_stopped(run: Trajectory, source: Path) -> None:
    """Of a run that chose its steps and stopped: that no output is lacking before it did."""
    asked, last = run.request, float(run.t[-1]) if run.t.size else run.request.t0
    if isinstance(asked.t, float):  # by an event, the first versions ended at the step before
        lacking = run.outcome == "step_limit" and not math.isclose(last, run.reached)
    else:
        lacking = bool((abs(asked.t[run.t.size :] - asked.t0) < abs(run.reached - asked.t0)).any())
    if lacking:
        raise damaged(source, f"it ends at {last!r} s, but the run went to {run.reached!r} s")


def _check_found(run: Trajectory, source: Path) -> None:
    """That what a run found on its way to the end is not beyond."""
    asked = run.request
    found = [time for each in run.events for time in each.times.tolist()]
    if run.trust_horizon is not None and math.isfinite(run.trust_horizon):
        found.append(run.trust_horizon)
    for time in [run.reached, *found]:
        if abs(time - asked.t0) > abs(asked.end - asked.t0):
            raise damaged(source, f"it ends at {asked.end!r} s, but the run went to {time!r} s")


def damaged(source: Path, what: str) -> NotATrajectoryError:
    """The error of a file that does not fit its recipe."""
    return NotATrajectoryError(f"{source} is damaged: {what}")
