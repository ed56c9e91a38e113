"""g from periods that stand in arrays rather than in a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula._checks import finite_array, numbers_array
from pendula._messages import ArgumentError
from pendula.measured.measurement import PeriodTable
from pendula.measured.periods import PeriodFit, fit_periods

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def g_from_periods(
    lengths: ArrayLike | None = None,
    periods: ArrayLike | None = None,
    *,
    amplitudes: ArrayLike | None = None,
    **options: Any,
) -> PeriodFit:
    """The fit of `fit_periods` to arrays: g from periods at several lengths, or amplitudes.

    Args:
        lengths: from the pivot to the bob's centre, (n,) [m].
        periods: of one full swing, (n,), or several of each row, (n, k), NaN where there is none
            [s]; times of ten swings divided by ten.
        amplitudes: of the swings, (n,) [rad]; without lengths g needs <length=…> among the options.
        **options: of `fit_periods`: apparatus, corrections, length, timing_error, length_error,
            amplitude_error.

    Raises:
        ValueError: as for `fit_periods`, or for arrays of different lengths.
    """
    import numpy as np

    if periods is None:
        way_out = "give the period of each length or amplitude [s]"
        raise ArgumentError("periods", "is needed", way_out)
    found = numbers_array("periods", periods, "s")
    columns = {
        name: None if given is None else finite_array(name, given, unit)
        for name, given, unit in (("lengths", lengths, "m"), ("amplitudes", amplitudes, "rad"))
    }
    for name, column in columns.items():
        if column is not None and (column.ndim != 1 or column.size != len(found)):
            rule = "must hold one value for each of the {other}, got {value}"
            raise ArgumentError(name, rule, other=f"{len(found)} periods", value=column.shape)
    several = found.ndim == 2
    table = PeriodTable(
        np.nanmean(found, axis=1) if several else found,
        columns["lengths"],
        columns["amplitudes"],
        found if several else None,
    )
    return fit_periods(table, **options)
