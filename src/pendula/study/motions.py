"""The motions replayed on the page: few points, rounded, small; the page draws cubics between."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pendula.plot.style import line

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array
    from pendula.plot.labels import Labels
    from pendula.run.trajectory import Trajectory
    from pendula.study.runs import Results

# s between points. A cubic through both ends' angles and velocities is off by θ⁗h⁴/384 (Hermite):
# 10⁻⁵ rad where a rod turns at 20 rad/s, less than the rounding.
_INTERVAL = 0.02
# Parts that are kept: of a radian, of a radian per second, of the energy at the start.
_ANGLE, _RATE, _ENERGY = 1e4, 1e3, 1e3
_SECTIONS = {"gentle": "linear", "large": "methods", "double": "double"}  # where each is played
_MOST = 1e6  # of what blows up; a million radians are a blur as well


def motions(results: Results, words: Labels, replay: dict[str, str]) -> dict[str, Any]:
    """The runs as the page reads them, by the name of the player.

    Angles are whole multiples of 1e-4 rad, rates of 1e-3 rad/s, kinetic and potential energies of
    1e-3 of the run's energy at the start, each as the difference from the one before.
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
        "motions": {
            name: _motion(*player, words)
            for name, player in players.items()
            if _SECTIONS[name] in recipe.report.sections
        },
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
                "angles": _steps(run.theta[::every], _ANGLE),
                "rates": _steps(run.omega[::every], _RATE),
                "energies": _steps(_energies(run)[::every], _ENERGY),
            }
            for name, run in runs.items()
        ],
    }


def _energies(run: Trajectory) -> Array:
    """Kinetic and potential energy (n, 2) in parts of the energy at the start."""
    start = float(run.system.energy(run.request.state)) or run.system.energy_scale
    with np.errstate(over="ignore", invalid="ignore"):  # of a run that blows up
        parts = np.stack([run.kinetic_energy, run.potential_energy], axis=-1) / start
    return np.nan_to_num(parts, nan=_MOST)


def _steps(values: Array, parts: float) -> list[list[int]]:
    """Of values (n,) or (n, m) m lists of n differences, in these parts of one."""
    # A method that blows up passes any whole number.
    rounded = np.round(np.clip(values, -_MOST, _MOST) * parts).astype(np.int64)
    steps: list[list[int]] = np.diff(np.atleast_2d(rounded.T), prepend=0).tolist()
    return steps
