"""The options of a run stand once: types, values, the core's rows, signatures and help agree."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import fields
from typing import Any

import numpy as np
import pytest

import pendula
from catalogue import METHODS
from pendula import DoublePendulum, _engine, ensemble, poincare_section, solve
from pendula.events import flip
from pendula.many.tasks import Task
from pendula.run.options import NAMES, Options, RunOptions, options_from
from pendula.run.request import Request

RODS, WILD = DoublePendulum.rods(gravity=9.81), (2.0, 2.5, 0.0, 0.0)
GIVEN: dict[str, Any] = {
    "step": 0.5,
    "tolerance": 1e-6,
    "max_steps": 7,
    "certify": 1e-3,
    "digits": 9,
    "events": flip(1),
}
CALLS: dict[str, tuple[Callable[..., Any], tuple[str, ...]]] = {
    "solve": (lambda **options: solve(RODS, WILD, [1.0], **options), NAMES),
    "ensemble": (lambda **options: ensemble(RODS, [WILD], [1.0], **options), NAMES),
    "poincare_section": (
        lambda **options: poincare_section(RODS, WILD, flip(2), 3, **options),
        ("tolerance", "max_steps"),
    ),
}
every_function = pytest.mark.parametrize("name", CALLS)


def test_types_values_and_rows_name_the_same_options_in_one_order() -> None:
    rows = tuple(row.name for row in _engine.option_rows())
    assert tuple(RunOptions.__annotations__) == NAMES == (*rows, "events")
    assert tuple(each.name for each in fields(Options)) == NAMES
    assert tuple(GIVEN) == NAMES  # this file has a value of each
    for made in (Request, Task):
        assert [each.name for each in fields(made)][: len(NAMES)] == list(NAMES)


def test_types_are_those_that_the_core_takes() -> None:
    for row in _engine.option_rows():
        kind = "int" if row.whole else "float"
        assert RunOptions.__annotations__[row.name].__forward_arg__ == f"{kind} | None"
        assert type(row.example) is float
        assert row.least <= row.example <= row.most


@every_function
def test_the_signature_shows_the_options(name: str) -> None:
    parameters = inspect.signature(getattr(pendula, name)).parameters
    taken = CALLS[name][1]
    assert tuple(each for each in parameters if each in NAMES) == taken
    assert not any(each.kind is each.VAR_KEYWORD for each in parameters.values())
    defaults = {each.name: each.default for each in fields(Options)}
    for option in taken:
        shown = parameters[option]
        assert shown.kind is shown.KEYWORD_ONLY
        assert shown.default == defaults[option]
        assert shown.annotation == RunOptions.__annotations__[option].__forward_arg__


@every_function
def test_the_help_tells_each_option_once_with_its_unit(name: str) -> None:
    help_text = inspect.getdoc(getattr(pendula, name)) or ""
    entries = help_text.partition("Args:\n")[2].partition("\n\n")[0]
    described = [line.split(":")[0].strip() for line in entries.splitlines() if line[4:5].strip()]
    assert described == list(inspect.signature(getattr(pendula, name)).parameters)
    for row in _engine.option_rows():
        if row.name in CALLS[name][1]:
            entry = " ".join(entries.partition(f"    {row.name}: ")[2].split())
            assert entry.startswith(f"{row.meaning}{row.unit and f' [{row.unit}]'}; ")
    assert "**" not in help_text
    raw = getattr(pendula, name).__doc__
    assert max(map(len, raw.splitlines())) <= 100


def test_a_section_tells_its_own_limit_of_steps() -> None:
    text = " ".join((poincare_section.__doc__ or "").split())
    assert "ends there; None: a hundred million." in text


@every_function
@pytest.mark.parametrize("option", ["stp", "Step", "options", "system_"])
def test_an_unknown_option_is_named_with_the_function(name: str, option: str) -> None:
    with pytest.raises(
        TypeError, match=rf"^{name}\(\) got an unexpected keyword .* '{option}'(;|$)"
    ):
        CALLS[name][0](**{option: 1})


@pytest.mark.parametrize(
    "option", [name for name in NAMES if name not in ("tolerance", "max_steps")]
)
def test_a_section_refuses_the_options_it_does_not_take(option: str) -> None:
    with pytest.raises(TypeError, match=rf"^poincare_section\(\) got .* '{option}'(;|$)"):
        CALLS["poincare_section"][0](**{option: GIVEN[option]})


def test_options_come_back_from_their_description() -> None:
    options = Options(**{**GIVEN, "events": (flip(1), flip(2, 1, terminal=3))})
    assert Options(**options_from(options.described())) == options
    assert Options(**options_from({})) == Options()  # of a file that knew none of them
    as_arguments: Any = options.options
    assert Options(**as_arguments) == options


@pytest.mark.parametrize("method", [each for each in METHODS if each.needs != "separable"])
def test_the_options_of_a_run_are_those_that_make_it_again(method: _engine.Method) -> None:
    control: Any = {"tolerance": 1e-6, "events": flip(2)} if method.adaptive else {"step": 0.01}
    run = solve(RODS, WILD, [0.5, 1.0], method.name, max_steps=500, certify=1e-3, **control)
    again = solve(RODS, WILD, run.request.t, method.name, **run.request.options)
    assert again.states.tobytes() == run.states.tobytes()
    assert again.request.options == run.request.options
    assert again.trust_horizon == run.trust_horizon


@pytest.mark.parametrize("option", NAMES)
def test_none_is_an_option_that_is_not_given(option: str) -> None:
    nothing: Any = () if option == "events" else None
    plain = solve(RODS, WILD, [0.5])
    assert solve(RODS, WILD, [0.5], **{option: nothing}).request.options == plain.request.options
    assert np.array_equal(ensemble(RODS, WILD, [0.5], **{option: nothing}).states[0], plain.states)
