"""Reading the recipe of a sweep: a TOML file with the tables [system], [state] and [run]."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pendula import _engine
from pendula._checks import LARGEST_COUNT, counted, one_of
from pendula._recipe_file import RecipeFile, as_toml
from pendula._rules import refuse
from pendula.many.sampling import LARGEST_SEED, Distribution, SameAs, Sampler
from pendula.many.sweep.columns import Columns
from pendula.many.sweep.recipe import COLUMNS, DTYPES, SweepRecipe, systems_at_ends
from pendula.run.options import ROWS, STANDARD_METHOD, checked_types
from pendula.run.request import Request, checked_name
from pendula.run.stiffness import warn_of_stiffness

if TYPE_CHECKING:
    from pendula._engine import Form, OptionRow, SystemEntry
    from pendula._recipe_file import RecipeSource
    from pendula.systems import System

MOST_CHUNKS = 10**6
MOST_OUTPUTS = 10**7  # states of a chunk: 320 MB for the double pendulum
_CHUNK = 10**4  # rows at most, if none are named
_CHUNK_OUTPUTS = 10**6  # … and outputs of each variable: 8 MB
_OPTIONS = ("step", "tolerance", "max_steps", "certify")  # of each run
_RUN = ("method", "t_max", "every", *_OPTIONS, "draws", "seed", "chunk", "dtype", "columns")


def read_sweep(recipe: RecipeSource) -> SweepRecipe:
    """The recipe in a file, or in a dict of its tables.

    A parameter or a component of the start is a quantity, or a table of one key: `uniform` or
    `log_uniform` of two ends, `normal` of a mean and a standard deviation, `choice` of a list, all
    random; `grid` of two ends and a count or `list` of values, of which all are taken with all of
    the others; `same_as` another. Each point of the grids is run with as many random draws as
    `run.draws` says. What [system] and [state]
    leave out is as `pendula solve` takes it.

    Args:
        recipe: a TOML file with tables [system], [state] and [run]; or a dict of them, as `tomllib`
            reads it: {"system": {"kind": "simple"}, "run": {"t_max": "10 s"}}.

    Raises:
        ValueError: for a broken recipe: one line naming file, line, key, rule and value.
        OSError: if the file cannot be read.
    """
    file = RecipeFile.read(recipe)
    file.check_tables(("system", "state", "run"))
    entry, form = _kind(file)
    parameters = [row.name for row in form.parameters]
    components = [row.name for row in entry.components]
    known = {"system": ["kind", "form", *parameters], "state": components, "run": _RUN}
    file.check_keys(known)
    columns = Columns(file)
    first = columns.parameters(form)
    run = _Run(file, _systems(file, entry, form, first))
    sampler = run.sampler((*first, *columns.components(entry.components)))
    options = run.options()
    made = SweepRecipe(
        system=entry.name, form=form.name, sampler=sampler, **options, **run.written(**options)
    )
    _check_size(file, made)
    return made


def _kind(file: RecipeFile) -> tuple[SystemEntry, Form]:
    """The system and its form; the first one if none is named."""
    given, entries = file.tables.get("system", {}), _engine.system_entries()
    if "kind" not in given:
        rule = f"system.kind is needed, one of {', '.join(entries)}"
        raise file.blame("system", ("",), f'{rule}; write kind = "double", say')
    with file.blaming("system", "kind", ""):
        entry = entries[one_of("kind", given.get("kind"), entries)]
    forms = {form.name: form for form in entry.forms}
    if "form" in given and len(forms) == 1:
        message = f"system.form is not taken by the {entry.name} pendulum; leave it out"
        raise file.blame("system", ("form",), message)
    with file.blaming("system", "form"):
        return entry, forms[one_of("form", given.get("form", entry.forms[0].name), forms)]


def _systems(
    file: RecipeFile, entry: SystemEntry, form: Form, columns: list[tuple[str, Distribution]]
) -> list[System]:
    """The systems at the ends of all ranges: parameters can be too large or too small together."""
    free = {name for name, each in columns if not isinstance(each, SameAs)}
    with file.blaming("system", *(name for name in file.tables["system"] if name in free), ""):
        return systems_at_ends(entry.name, form.name, dict(columns))


class _Run:
    """The table [run]."""

    def __init__(self, file: RecipeFile, systems: list[System]) -> None:
        self._file, self._systems = file, systems
        self._given: dict[str, Any] = file.tables.get("run", {})

    def sampler(self, columns: tuple[tuple[str, Distribution], ...]) -> Sampler:
        """The columns with the draws and the seed."""
        draws, seed = self._whole("draws", LARGEST_COUNT), self._given.get("seed", 0)
        if isinstance(seed, float) and seed.is_integer():
            seed = int(seed)
        if draws is None and Sampler(columns).random:
            message = "run.draws is needed where anything is random; write draws = 1000, say"
            raise self._file.blame("run", ("",), message)
        if not isinstance(seed, int) or isinstance(seed, bool) or not 0 <= seed <= LARGEST_SEED:
            rule = "run.seed must be a whole number from 0 to 2^64 - 1"
            raise self._file.blame("run", ("seed",), f"{rule}, got {as_toml(seed)}")
        with self._file.blaming("run", "draws", ""):
            return Sampler(columns, draws or 1, seed)

    def options(self) -> dict[str, Any]:
        """Method, times and what the method takes, checked as `solve` does."""
        file, given = self._file, self._given
        t_max, every = self._time("t_max"), self._time("every")
        if t_max is None:
            message = 'run.t_max is needed, the end of each run; write t_max = "30 s", say'
            raise file.blame("run", ("",), message)
        if every is not None and every > t_max:
            rule = f"run.every must not exceed run.t_max = {t_max:g} s"
            raise file.blame("run", ("every", "t_max"), f"{rule}, got {every:g} s")
        fields = {row.name: self._option(row) for row in ROWS.values() if row.name in _OPTIONS}
        with file.blaming("run", "method", ""):
            options = checked_types(fields, "sweep")
            method = checked_name(given.get("method", STANDARD_METHOD))
            for system in self._systems:
                asked = Request(
                    state=np.zeros(len(system.components)), t=np.array([t_max]), **options
                )
                refuse(_engine.check(asked.for_core(system, method)), digits=False, t="t_max")
        warn_of_stiffness(self._systems, t_max)
        return {"method": method, "t_max": t_max, "every": every, **options}

    def written(self, t_max: float, every: float | None, **_: Any) -> dict[str, Any]:
        """What is written and in which portions: never a matter of how many draws there are."""
        given = self._given.get("columns", [])
        columns = [given] if isinstance(given, str) else given
        with self._file.blaming("run", "dtype"):
            dtype = one_of("dtype", self._given.get("dtype", DTYPES[0]), DTYPES)
        with self._file.blaming("run", "columns"):
            if not isinstance(columns, list):
                one_of("columns", columns, COLUMNS)
            for each in columns:
                one_of("columns", each, COLUMNS)
        times = 1.0 if every is None else t_max / every + 1
        most = max(1, min(_CHUNK, int(_CHUNK_OUTPUTS / times)))
        return {
            "chunk": self._whole("chunk", LARGEST_COUNT) or most,
            "dtype": dtype,
            "columns": tuple(each for each in COLUMNS if each in columns),
        }

    def _option(self, row: OptionRow) -> Any:
        """An option: a quantity in quotes where it has a unit, else a number."""
        raw = self._given.get(row.name)
        if row.unit == "s":
            return self._time(row.name)
        if raw is not None and row.unit:
            return self._quantity(row.name, row.unit, raw)
        return int(raw) if row.whole and isinstance(raw, float) and raw.is_integer() else raw

    def _time(self, key: str) -> float | None:
        raw = self._given.get(key)
        if raw is None:
            return None
        value = self._quantity(key, "s", raw)
        if value <= 0:
            message = f"run.{key} must be positive, got {as_toml(raw)}"
            raise self._file.blame("run", (key,), message)
        return value

    def _quantity(self, key: str, unit: str, raw: object) -> float:
        if not isinstance(raw, str):
            rule = f"run.{key} needs a quantity with its unit, in quotes"
            example = "0.1 s" if unit == "s" else f"1e-9 {unit}"
            message = f'{rule}, got {as_toml(raw)}; write {key} = "{example}", say'
            raise self._file.blame("run", (key,), message)
        return self._file.quantity("run", key, unit, raw)

    def _whole(self, key: str, most: int) -> int | None:
        raw = self._given.get(key)
        if raw is None:
            return None
        with self._file.blaming("run", key):
            return counted(key, raw, most)


def _check_size(file: RecipeFile, recipe: SweepRecipe) -> None:
    """Refuse chunks that memory has no room for, and too many of them."""
    rows = recipe.sampler.count
    if rows > MOST_CHUNKS * recipe.chunk:
        rule = f"run.chunk must leave at most {MOST_CHUNKS} chunks, got {rows} rows in chunks of"
        message = f"{rule} {recipe.chunk}; take more rows a chunk, or fewer draws"
        raise file.blame("run", ("chunk", "draws", ""), message)
    times = 1.0 if recipe.every is None else recipe.t_max / recipe.every + 1
    rows = min(recipe.chunk, recipe.sampler.count)
    if rows * times > MOST_OUTPUTS:
        rule = f"run.chunk rows must have at most {MOST_OUTPUTS} outputs together"
        got = f"{rows} rows of {times:.0f} each"
        fewer = "fewer rows a chunk, or " if rows > 1 else ""
        message = f"{rule}, got {got}; take {fewer}more time between outputs"
        raise file.blame("run", ("chunk", "every", ""), message)
