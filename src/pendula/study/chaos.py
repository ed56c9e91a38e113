"""How chaotic the double pendulum of the study is: its exponent, and a section at its energy."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula.chaos import lyapunov, megno, section

if TYPE_CHECKING:
    from collections.abc import Iterable

    from pendula._types import Array
    from pendula.chaos import Lyapunov, Section
    from pendula.plot.labels import Labels
    from pendula.study.notation import Numbers
    from pendula.systems import DoublePendulum

    Columns = dict[str, Iterable[float | int | str]]

# In periods of the slow small swing: of the exponent's run, and of the runs that tell the section's
# motions apart.
_LONG, _SHORT = 400, 100
_STARTS, _CROSSINGS = 80, 120
_ROUNDING = 2.0**-53  # of a number near 1: the first difference of two repetitions
_SURE = 3.0  # standard errors that an exponent lies above 0


@dataclass(frozen=True)
class Chaos:
    """The exponent of the study's own motion, and the section at its energy."""

    exponent: Lyapunov
    energy: float
    """Of the motion [J]."""
    section: Section | None
    """Of many motions of that energy; None: it is 0."""
    indicator: Array | None
    """Mean MEGNO of each of them, (n,)."""

    @property
    def chaotic(self) -> bool:
        """Whether the motion is, by its mean MEGNO and by its exponent."""
        value, error = self.exponent.exponents[0], self.exponent.standard_error[0]
        return bool(
            self.exponent.verdict == "chaotic" and not value <= _SURE * np.nan_to_num(error)
        )


def chaos(system: DoublePendulum, state: tuple[float, float, float, float]) -> Chaos:
    """The exponent of a motion and the section at its energy."""
    period = math.tau / system.slowest_frequency
    found = lyapunov(system, state, _LONG * period)
    energy = float(system.energy(np.array(state)))
    if not energy > 0.0:
        return Chaos(found, energy, None, None)
    points = section(system, energy=energy, starts=_STARTS, crossings=_CROSSINGS)
    mean = megno(system, points.starts, [_SHORT * period]).mean[:, -1]
    return Chaos(found, energy, points, mean)


def chaos_facts(found: Chaos, tolerance: float, words: Labels, numbers: Numbers) -> dict[str, Any]:
    """What the text says of it in numbers."""
    run = found.exponent
    value, error = float(run.exponents[0]), float(run.standard_error[0])
    growth = math.log(tolerance / _ROUNDING)
    return {
        "exponent": numbers.plain(value),
        "error": None if math.isnan(error) else numbers.plain(error, 2),
        "megno": numbers.plain(float(run.mean_megno)),
        "verdict": words.curve[run.verdict],
        "chaotic": found.chaotic,
        "time": numbers.plain(1.0 / value) if found.chaotic else None,
        "tenfold": numbers.plain(math.log(10.0) / value) if found.chaotic else None,
        "reach": numbers.plain(growth / value, 2) if found.chaotic else None,
        "until": numbers.plain(float(run.t[-1])),
        "energy": numbers.plain(found.energy, 4),
        "drawn": found.section is not None,
        "motions": _STARTS,
        "crossings": _CROSSINGS,
    }


def chaos_tables(found: Chaos) -> dict[str, Columns]:
    """The running estimate, and the section's points with the MEGNO of their motion."""
    run = found.exponent
    tables: dict[str, Columns] = {
        "double_exponent": {
            "t [s]": run.t.tolist(),
            "exponent [1/s]": run.running[:, 0].tolist(),
        }
    }
    if found.section is not None and found.indicator is not None:
        n, m = found.section.times.shape
        points = found.section.points.reshape(-1, 2)
        tables["double_section"] = {
            "motion [1]": np.repeat(np.arange(1, n + 1), m).tolist(),
            "theta2 [rad]": points[:, 0].tolist(),
            "p2 [J s]": points[:, 1].tolist(),
            "mean MEGNO of the motion [1]": np.repeat(found.indicator, m).tolist(),
        }
    return tables
