"""What a table of periods can tell, and what is made of it: refused in one line otherwise."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula._checks import one_of, positive_number
from pendula._messages import ArgumentError
from pendula.measured.period_corrections import CORRECTIONS

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Mapping

    from pendula._types import Array
    from pendula.measured.measurement import PeriodTable

_SAME = 1e-9  # relative: lengths that differ by less are one length


class CheckedTable(NamedTuple):
    """A table that can be fitted.

    Attributes:
        law: "length" or "amplitude": what is varied.
        period: (n,) [s].
        known: of the apparatus and the swings by name; see `Correction`.
    """

    law: str
    period: Array
    known: dict[str, Any]

    @property
    def one_length(self) -> float | None:
        """The length of all rows [m]; None: they differ, or are not known."""
        length = self.known.get("length")
        return None if length is None or _differ(length) else float(length[0])


def checked_table(
    table: PeriodTable, length: object, apparatus: Mapping[str, float]
) -> CheckedTable:
    """A table with what is known besides.

    Raises:
        ValueError: for numbers that no pendulum has, or a table of neither lengths nor amplitudes.
    """
    import numpy as np

    known: dict[str, Any] = dict(apparatus)
    period = _column("period", table.period, len(table.period), "s")
    if table.amplitude is not None:
        known["amplitude"] = _column("amplitude", table.amplitude, len(period), "rad")
        if (known["amplitude"] >= math.pi).any():
            largest = float(known["amplitude"].max())
            raise ArgumentError(
                "table.amplitude", "must be below pi [rad], got {value}", value=largest
            )
    if table.length is not None and length is not None:
        rule = "goes with a table without lengths, got {value} m"
        raise ArgumentError("length", rule, "leave it out", value=length)
    if table.length is not None:
        known["length"] = _column("length", table.length, len(period), "m")
    elif length is not None:
        known["length"] = np.full_like(period, positive_number("length", length, "m"))
    if "length" in known and known.get("bob_radius", 0.0) >= known["length"].min():
        rule = "must be below the shortest length of {shortest} m, got {value} m"
        shortest = float(known["length"].min())
        raise ArgumentError("bob_radius", rule, value=known["bob_radius"], shortest=shortest)
    return CheckedTable(_law(table, known), period, known)


def checked_corrections(names: Iterable[str] | None, known: Mapping[str, Any]) -> tuple[str, ...]:
    """The corrections that are made, in the order of `CORRECTIONS`, "offset" behind them.

    Raises:
        ValueError: for a name that is unknown, or one that lacks what it needs.
    """
    if names is None:
        return tuple(name for name, each in CORRECTIONS.items() if set(each.needs) <= set(known))
    order = (*CORRECTIONS, "offset")
    given = [names] if isinstance(names, str) else list(names)
    chosen = {one_of("corrections", each, order) for each in given}
    for name in chosen - {"offset"}:
        missing = [each for each in CORRECTIONS[name].needs if each not in known]
        if missing:
            raise ArgumentError(
                "corrections",
                "must leave out what cannot be computed, got {value}",
                f"give {' and '.join(f'<{each}>' for each in missing)}",
                value=name,
            )
    return tuple(each for each in order if each in chosen)


def refuse_unknowable(table: CheckedTable, names: Collection[str], *, errors_known: bool) -> None:
    """Refuse a table with fewer rows than the law has parameters, or than its scatter needs.

    Raises:
        ValueError: says how many are needed, or that an offset needs several lengths.
    """
    if "offset" in names and (table.law == "amplitude" or table.one_length is not None):
        rule = 'must leave out "offset": of one length it cannot be told from g'
        raise ArgumentError("corrections", rule, "measure at several lengths")
    second = "offset" if table.law == "length" else "amplitude"
    rows, parameters = len(table.period), 1 + (second in names)
    if rows >= parameters + (not errors_known):
        return
    rule, way_out = "must have at least {least} rows for {text}, got {value}", "measure more"
    if rows >= parameters:
        rule, way_out = f"{rule} and no error of them", "give <timing_error=0.02>, or repeats"
    text = "one value" if parameters == 1 else f"two values, that of the {second} among them"
    least = parameters + (not errors_known)
    raise ArgumentError("table", rule, way_out, least=least, text=text, value=rows)


def _law(table: PeriodTable, known: Mapping[str, Any]) -> str:
    import numpy as np

    length = known.get("length")
    if length is not None and _differ(length):
        return "length"
    if table.amplitude is not None and np.ptp(known["amplitude"]) > 0.0:
        return "amplitude"
    if length is not None:
        return "length"
    rule = "must have lengths, or amplitudes that differ"
    raise ArgumentError("table", rule, "give <length=0.5> if all periods have one length")


def _differ(lengths: Array) -> bool:
    import numpy as np

    return bool(np.ptp(lengths) > _SAME * lengths.max())


def _column(name: str, values: Array, rows: int, unit: str) -> Array:
    import numpy as np

    found: Array = np.asarray(values, dtype=float)
    if found.shape != (rows,) or not rows:
        rule = "must have one number in each row, got shape {value}"
        raise ArgumentError(f"table.{name}", rule, value=found.shape)
    bad = ~(np.isfinite(found) & (found > 0.0))
    if bad.any():
        row = int(bad.argmax())
        rule = "must be positive and finite in each row{in_unit}, got {value} in row {row}"
        way_out = "leave the row out"
        raise ArgumentError(
            f"table.{name}", rule, way_out, value=float(found[row]), row=row + 1, unit=unit
        )
    return found
