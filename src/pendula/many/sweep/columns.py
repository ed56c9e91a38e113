"""The columns of a sweep: what a recipe says of each parameter and each component of the start."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula._messages import meant
from pendula._recipe_file import as_toml
from pendula.many.sampling import (
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
from pendula.units import example_of, quantity

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._engine import Component, Form, Parameter
    from pendula._recipe_file import RecipeFile

_RANGED: dict[str, type[Uniform | LogUniform | Normal]] = {
    "uniform": Uniform,
    "log_uniform": LogUniform,
    "normal": Normal,
}
_PAIRS = {"grid": "two ends and a count", "normal": "a mean and a standard deviation"}
_LISTS: dict[str, type[Choice | Listed]] = {"choice": Choice, "list": Listed}
_NAMES = [name for name in KINDS if name != "fixed"]  # a quantity alone is one


class Columns:
    """Reads the tables [system] and [state] of a sweep's recipe."""

    def __init__(self, file: RecipeFile) -> None:
        self._file = file

    def parameters(self, form: Form) -> list[tuple[str, Distribution]]:
        """A column for each parameter of the form, in its order.

        Raises:
            ValueError: for a parameter missing, or one out of range.
        """
        given = self._file.tables.get("system", {})
        made: list[tuple[str, Distribution]] = []
        for row in form.parameters:
            if row.name in given:
                made.append((row.name, self._given("system", row, form.parameters)))
                self._check_positive(row, made[-1][1])
            elif row.needed:
                message = f"system.{row.name} is needed by the form {form.name!r}"
                raise self._file.blame("system", ("form", ""), f"{message}; {_example(row)}")
            elif row.standard is not None:
                made.append((row.name, Fixed(row.standard)))
            else:
                followed = dict(made)[row.same_as]
                column = followed if isinstance(followed, SameAs) else SameAs(row.same_as)
                made.append((row.name, column))
        return made

    def components(self, rows: Sequence[Component]) -> list[tuple[str, Distribution]]:
        """A column for each component of a state; the standard start where none is given."""
        given = self._file.tables.get("state", {})
        return [
            (
                row.name,
                self._given("state", row, rows) if row.name in given else Fixed(row.standard),
            )
            for row in rows
        ]

    def _given(
        self, section: str, row: Parameter | Component, others: Sequence[Parameter | Component]
    ) -> Distribution:
        raw = self._file.tables[section][row.name]
        if isinstance(raw, str):
            return Fixed(self._file.quantity(section, row.name, row.unit, raw))
        if not isinstance(raw, dict):
            rule = "needs a quantity with its unit, in quotes, or a table such as { uniform = … }"
            raise self._wrong(section, row, rule, raw)
        if len(raw) != 1 or next(iter(raw)) not in _NAMES:
            rule = f"must be a table of one key, of {', '.join(_NAMES)}"
            hint = meant(next(iter(raw)), _NAMES) if len(raw) == 1 else ""
            if hint:
                message = f"{section}.{row.name} {rule}, got {as_toml(raw)}; {hint}"
                raise self._file.blame(section, (row.name,), message)
            raise self._wrong(section, row, rule, raw)
        ((kind, value),) = raw.items()
        if kind == "same_as":
            return self._same(section, row, others, value)
        if not isinstance(value, list) or not value:
            rule = f"{section}.{row.name}: {kind} must be a list of one value at least"
            message = f"{rule}, got {as_toml(value)}; name its values, or {_example(row)}"
            raise self._file.blame(section, (row.name,), message)
        with self._file.blaming(section, row.name):
            return self._spread(section, row, kind, value)

    def _spread(
        self, section: str, row: Parameter | Component, kind: str, value: list[Any]
    ) -> Distribution:
        """The distribution of a list; its errors do not name the line."""
        parts = value[:-1] if kind == "grid" else value
        where = f"{section}.{row.name}"
        numbers = [self._number(section, row, kind, part) for part in parts]
        if kind in _LISTS:
            return _LISTS[kind](tuple(numbers))
        if len(numbers) != 2:
            rule = _PAIRS.get(kind, "two ends")
            message = f"{where}: {kind} must be {rule}, got {as_toml(value)}; {_example(row)}"
            raise ValueError(message)
        try:
            if kind == "grid":
                return Grid(numbers[0], numbers[1], value[-1])
            return _RANGED[kind](numbers[0], numbers[1])
        except ValueError as error:
            raise ValueError(f"{where}: {error}") from None

    def _number(self, section: str, row: Parameter | Component, kind: str, part: object) -> float:
        if not isinstance(part, str):
            raise ValueError(
                f"{section}.{row.name}: {kind} needs quantities with their units, in quotes, "
                f"got {as_toml(part)}; {_example(row)}"
            )
        return quantity(part, row.unit, row.name)

    def _same(
        self,
        section: str,
        row: Parameter | Component,
        others: Sequence[Parameter | Component],
        value: object,
    ) -> SameAs:
        """A column that follows another of the table, of the same unit, which itself does not."""
        given = self._file.tables[section]
        likes = [
            each.name
            for each in others
            if each.unit == row.unit
            and each.name != row.name
            and "same_as" not in given.get(each.name, ())
            and (each.name in given or not getattr(each, "same_as", ""))
        ]
        if value not in likes:
            rule = f"same_as must be one of {', '.join(likes)}"
            if not likes:
                rule = "cannot be the same as another: none that could be has the same unit"
            raise self._wrong(section, row, rule, value)
        return SameAs(str(value))

    def _check_positive(self, row: Parameter, column: Distribution) -> None:
        if isinstance(column, SameAs):
            return
        low, positive = column.ends[0], row.range == "positive"
        if row.range != "any" and (low < 0 or (low == 0 and positive)):
            rule = "must be positive" if positive else "must not be negative"
            if isinstance(column, Normal):
                rule += ", 8.3 standard deviations below its mean too"
            raise self._wrong("system", row, rule, self._file.tables["system"][row.name])

    def _wrong(
        self, section: str, row: Parameter | Component, rule: str, raw: object
    ) -> ValueError:
        message = f"{section}.{row.name} {rule}, got {as_toml(raw)}; {_example(row)}"
        return self._file.blame(section, (row.name,), message)


def _example(row: Parameter | Component) -> str:
    return f'write {row.name} = "{example_of(row.unit, " ")}", say'
