"""g from a table of periods, with every correction that is asked for, and what each changes."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field, replace
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula._checks import extra, positive_number
from pendula._late_methods import with_promised
from pendula.measured.fitted import Quantity
from pendula.measured.period_checks import checked_corrections, checked_table, refuse_unknowable
from pendula.measured.period_corrections import Apparatus
from pendula.measured.period_lines import Line, Table, by_amplitude, by_length
from pendula.measured.period_scatter import Scatter, scatter_of
from pendula.measured.storable import Storable

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from os import PathLike
    from pathlib import Path

    from pendula._types import Array
    from pendula.measured.measurement import PeriodTable
    from pendula.measured.period_checks import CheckedTable

LAW = 1.0 / 16.0  # T/T0 = 1 + θ0²/16 + … (Nelson & Olsson 1986, finite amplitude)
_TWO_SIGMA = 0.9544997361036416  # what ± 2 σ of a normal distribution hold
_DIFFERENT = 0.05  # scatter about the law that chance makes less often is no chance
_REJECTED = 0.01  # the law is rejected where chance alone is less likely than that


class AppliedCorrection(NamedTuple):
    """A correction, and what it does to the result.

    Attributes:
        name: of `CORRECTIONS`, or "offset".
        change: of g by it, relative to g without it; without a length that of 1/T0².
    """

    name: str
    change: float


@with_promised
@dataclass(frozen=True, eq=False)
class PeriodFit(Storable):
    """What a table of periods says.

    Attributes:
        table: as it was given.
        law: "length" (T² against L) or "amplitude" (T against θ0²).
        names: what was fitted: "gravity" and, if asked for, "length_offset"; or "period", of
            small swings, and "amplitude_coefficient", a of T/T0 = 1 + a θ0² + …, with "gravity"
            where the length is known.
        values: (k,) [units].
        units: SI.
        standard_errors: (k,); twice as much to either side holds the true value with a probability
            of 95 % however few the rows are: the plain ones times Student's factor.
        plain_standard_errors: from the scatter alone, (k,).
        degrees_of_freedom: of the scatter; infinite where the errors were given.
        birge_ratio: √(χ²/ν) of the rows about the law (Birge, Phys. Rev. 40 (1932) 207); where they
            scatter more than their errors say by more than chance, the errors are multiplied by
            it; NaN: there is nothing to compare.
        fitted: periods, (n,) [s].
        residuals: measured less fitted, (n,) [s].
        errors: of the measured periods beside the law, (n,) [s]; as large as they scatter.
        corrections: those that were made, in the order of `CORRECTIONS`.
        recipe: the arguments of `fit_periods` but for the table, as JSON has them.
    """

    table: PeriodTable
    law: str
    names: tuple[str, ...]
    values: Array
    units: tuple[str, ...]
    standard_errors: Array
    plain_standard_errors: Array
    degrees_of_freedom: float
    birge_ratio: float
    fitted: Array
    residuals: Array
    errors: Array
    corrections: tuple[AppliedCorrection, ...]
    recipe: Mapping[str, Any] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Quantity:
        """A parameter by its name."""
        i = self.names.index(name)
        return Quantity(float(self.values[i]), float(self.standard_errors[i]), self.units[i])

    @property
    def chance(self) -> float:
        """How likely an amplitude coefficient so far from 1/16 is if the law holds; NaN: no fit."""
        if "amplitude_coefficient" not in self.names:
            return math.nan
        i = self.names.index("amplitude_coefficient")
        away = abs(float(self.values[i]) - LAW) / float(self.plain_standard_errors[i])
        return 2.0 * _student_below(-away, self.degrees_of_freedom)

    @property
    def rejects_the_law(self) -> bool:
        """Whether the table contradicts T = 4 K(k)/ω0, at 1 %."""
        return self.chance < _REJECTED

    if TYPE_CHECKING:  # attached by the module that defines it

        def report(
            self,
            path: str | PathLike[str],
            lang: str = "en",
            *,
            title: str = "",
            author: str = "",
            overwrite: bool = False,
        ) -> Path:
            """See `pendula.study.measured.report.report`."""


def fit_periods(
    table: PeriodTable,
    *,
    apparatus: Apparatus | None = None,
    corrections: Iterable[str] | None = None,
    length: float | None = None,
    timing_error: float | None = None,
    length_error: float = 0.0,
    amplitude_error: float = 0.0,
) -> PeriodFit:
    """Fit the pendulum's law to measured periods.

    Of several lengths T² = F (4π²/g) L gives g; of several amplitudes at one length T = T0 (1 + 16
    a (2 K/π − 1)) gives T0, the coefficient a, which the law has at 1/16, and g where the length is
    known. F is the product of the corrections.

    Args:
        table: periods of one full swing.
        apparatus: what is known of the ball, the string and the air; None: nothing.
        corrections: names of `CORRECTIONS`, and "offset": all lengths are short by the same, which
            is fitted. None: all that can be made of what is known, without the offset.
        length: of the pendulum [m], where the table does not tell it.
        timing_error: standard deviation of one timing of a period [s]: that of the person at the
            stopwatch over the number of swings; None: what the repeats or the rows say.
        length_error: standard deviation of each length [m]; of the only one, if there is one.
        amplitude_error: standard deviation of each amplitude [rad].

    Raises:
        ValueError: for a table that cannot tell what is asked of it, a correction that is unknown
            or lacks what it needs, or an error that is negative.
    """
    known = (apparatus or Apparatus()).known
    checked = checked_table(table, length, known)
    names = checked_corrections(corrections, checked.known)
    timing = None if timing_error is None else positive_number("timing_error", timing_error, "s")
    ruler = positive_number("length_error", length_error, "m", zero=True)
    protractor = positive_number("amplitude_error", amplitude_error, "rad", zero=True)
    law = by_length if checked.law == "length" else by_amplitude

    def line(chosen: Iterable[str], scatter: Scatter) -> Line:
        told = scatter.degrees_of_freedom > 0  # otherwise the rows' scatter holds all errors
        errors = (ruler if checked.one_length is None else 0.0, protractor) if told else (0.0, 0.0)
        rows = Table(checked.period, checked.known, scatter.errors, *errors)
        return law(rows, set(chosen))

    scatter = scatter_of(table, checked.period, timing)
    refuse_unknowable(checked, names, errors_known=scatter.degrees_of_freedom > 0)
    scatter = scatter_of(table, line(names, scatter).fitted, timing)
    found = line(names, scatter)
    judged = _judged(found, scatter)
    changes = tuple(
        AppliedCorrection(each, _change(checked.law, found, line(set(names) - {each}, scatter)))
        for each in names
    )
    errors = {"timing_error": timing, "length_error": ruler, "amplitude_error": protractor}
    recipe = {**_recipe(apparatus, names, length), **errors}
    return replace(_told(table, checked, found, judged, changes, ruler), recipe=recipe)


def _recipe(
    apparatus: Apparatus | None, corrections: Iterable[str], length: float | None
) -> dict[str, Any]:
    """Arguments of `fit_periods`, without its errors."""
    return {
        "apparatus": None if apparatus is None else asdict(apparatus),
        "corrections": tuple(corrections),
        "length": None if length is None else positive_number("length", length, "m"),
    }


class _Judged(NamedTuple):
    """What multiplies the errors of the table, with what it is known by."""

    factor: float
    freedom: float
    ratio: float


def _judged(line: Line, scatter: Scatter) -> _Judged:
    """The rows' own errors and their scatter about the law, together, or the scatter alone.

    It alone counts where it is larger than chance makes it, or than errors that were given.
    """
    known, rows = scatter.degrees_of_freedom, float(line.freedom)
    if rows == 0:
        return _Judged(1.0, known, math.nan)
    away = (line.measured - line.fitted) / line.errors
    square = float((away**2).sum()) / rows
    ratio = math.sqrt(square)
    if known == 0:
        return _Judged(ratio, rows, math.nan)
    if math.isinf(known):
        return _Judged(1.0, known, ratio) if ratio <= 1.0 else _Judged(ratio, rows, ratio)
    if extra("scipy.special", "fit").fdtrc(rows, known, square) < _DIFFERENT:
        return _Judged(ratio, rows, ratio)
    pooled = (known + rows * square) / (known + rows)  # both are of one variance
    return _Judged(math.sqrt(pooled), known + rows, ratio)


def _change(law: str, found: Line, without: Line) -> float:
    """What a correction changes, relative: g, or where there is no length 1/T0²."""
    ratio = float(found.values[0] / without.values[0])
    return ratio - 1.0 if law == "length" else ratio**-2 - 1.0


def _told(
    table: PeriodTable,
    checked: CheckedTable,
    line: Line,
    judged: _Judged,
    changes: tuple[AppliedCorrection, ...],
    ruler: float,
) -> PeriodFit:
    """The result in its own words."""
    import numpy as np

    names, units, values, plain = _values(checked, line, judged, ruler)
    return PeriodFit(
        table=table,
        law=checked.law,
        names=tuple(names),
        values=np.array(values),
        units=tuple(units),
        standard_errors=np.array(plain) * _student_factor(judged.freedom),
        plain_standard_errors=np.array(plain),
        degrees_of_freedom=judged.freedom,
        birge_ratio=judged.ratio,
        fitted=line.fitted,
        residuals=line.measured - line.fitted,
        errors=line.errors * judged.factor,
        corrections=changes,
    )


def _values(
    checked: CheckedTable, line: Line, judged: _Judged, ruler: float
) -> tuple[list[str], list[str], list[float], list[float]]:
    """Names, units, values and errors of what was fitted and what follows."""
    import numpy as np

    values, plain = list(line.values), list(judged.factor * np.sqrt(np.diag(line.covariance)))
    if checked.law == "length":
        names, units = ["gravity", "length_offset"], ["m/s²", "m"]
    else:
        names, units = ["period", "amplitude_coefficient"], ["s", "1/rad²"]
    names, units = names[: len(values)], units[: len(values)]
    length = checked.one_length
    if checked.law == "amplitude" and length is not None:
        values.append(4.0 * math.pi**2 * length / values[0] ** 2)  # of T0 = 2π √(L/g)
        plain.append(2.0 * plain[0] / values[0] * values[-1])
        names.append("gravity")
        units.append("m/s²")
    if length is not None and names[-1] == "gravity":
        # the error of the one length is that of all rows, however many they are
        plain[-1] = math.hypot(plain[-1], values[-1] * ruler / length)
    return names, units, values, plain


def _student_factor(freedom: float) -> float:
    """What makes twice an error hold as much as that of a normal distribution (JCGM 100, G.3)."""
    if math.isinf(freedom):
        return 1.0
    special = extra("scipy.special", "fit")
    return float(special.stdtrit(freedom, 0.5 + _TWO_SIGMA / 2.0)) / 2.0


def _student_below(value: float, freedom: float) -> float:
    special = extra("scipy.special", "fit")
    return float(special.ndtr(value) if math.isinf(freedom) else special.stdtr(freedom, value))
