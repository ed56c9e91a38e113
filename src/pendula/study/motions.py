"""The motions replayed on the page: few points, rounded, small."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pendula.plot.style import line

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula.plot.labels import Labels
    from pendula.run.trajectory import Trajectory
    from pendula.study.runs import Results

_INTERVAL = 0.02  # s between points; the page draws straight on from one to the next
_ROUNDED = 1e4  # parts of a radian that are kept


def motions(results: Results, words: Labels, replay: dict[str, str]) -> dict[str, Any]:
    """The runs as the page reads them, by the name of the player.

    Angles are whole multiples of 1e-4 rad, each as the difference from the one before.
    """
    recipe = results.recipe
    lengths = [recipe.simple.length]
    gentle, large = ({"exact": exact} for exact, _ in results.models.values())
    linear, simple, double = results.linear, results.simple, results.double
    players = {
        "gentle": (lengths, {**gentle, "linear": linear.reference, **linear.runs}),
        "large": (lengths, {**large, "linear": results.models["large"][1], **simple.runs}),
        "double": (
            [recipe.double.l1, recipe.double.l2],
            {"reference": double.reference, **double.runs},
        ),
    }
    return {
        "words": replay,
        "decimal": words.decimal,
        "motions": {name: _motion(*player, words) for name, player in players.items()},
    }


def _motion(lengths: list[float], runs: Mapping[str, Trajectory], words: Labels) -> dict[str, Any]:
    t = next(iter(runs.values())).t
    # The grid of the run, thinned: no point may lie between two that were computed.
    every = max(1, round(_INTERVAL / float(t[1] - t[0])))
    return {
        "lengths": lengths,
        "interval": float(t[1] - t[0]) * every,
        "runs": [
            {
                "name": words.name(name),
                "colour": line(name)["color"],
                "angles": [_steps(angle[::every]) for angle in np.atleast_2d(run.theta.T)],
            }
            for name, run in runs.items()
        ],
    }


def _steps(angle: np.ndarray[Any, np.dtype[np.float64]]) -> list[int]:
    # A method that blows up passes any whole number; a million radians are a blur as well.
    rounded = np.round(np.clip(angle, -1e6, 1e6) * _ROUNDED).astype(np.int64)
    steps: list[int] = np.diff(rounded, prepend=0).tolist()
    return steps
