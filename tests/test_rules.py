"""What the core finds wrong, as data: each of its rules, and the sentences made of it."""

from __future__ import annotations

import ast
import copy
import math
import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pendula
from catalogue import METHODS, REFUSED, at_rest, control, label
from pendula import (
    DoublePendulum,
    DrivenPendulum,
    SimplePendulum,
    _checks,
    _core,
    _engine,
    ensemble,
    solve,
)
from pendula._messages import ArgumentError, Message, Naming, message_of
from pendula._rules import refuse
from pendula.events import flip
from pendula.run._times import span_of, times_apart
from pendula.run.trust import DigitsError

RODS, SIMPLE = DoublePendulum.rods(gravity=9.81), SimplePendulum(0.5, 9.81)
DRY = DrivenPendulum.bob(coulomb=0.1)._description()
ROWS = _engine.rule_rows()


def asked(**change: Any) -> _engine.Request:
    """A sound request of the simple pendulum, but for what is named."""
    given: dict[str, Any] = {
        "system": SIMPLE._description(),
        "method": "taylor",
        "state": np.array([1.0, 0.0]),
        "t0": 0.0,
        "times": np.array([0.5, 1.0]),
        "own_steps": False,
        "events": [],
    }
    return _engine.Request(**{**given, **change})


def fixed(**change: Any) -> _engine.Request:
    return asked(**{"method": "rk4", "step": 0.1, **change})


def of_form(system: str, form: int, *parameters: float) -> _engine.Request:
    return asked(system=_engine.Description(system, form, list(parameters)))


# A request that breaks each rule, and the argument that is named.
BROKEN: dict[str, tuple[str, _engine.Request]] = {
    "unknown_name": ("method", asked(method="rk5")),
    "finite": ("t0", asked(t0=math.nan)),
    "all_finite": ("state", asked(state=np.array([0.0, math.inf]))),
    "positive": ("mass", of_form("simple", 0, 1.0, 9.81, 0.0)),
    "not_negative": ("I1", of_form("double", 2, 1, 1, 1, 1, 1, -1e-3, 1, 9.81, 1)),
    "count_of_parameters": ("parameters", of_form("double", 1, 1.0, 2.0)),
    "constants": ("parameters", of_form("double", 0, 1e-300, 1.0, 1e-300, 1.0, 9.81)),
    "count_of_components": ("state", asked(state=np.zeros(4))),
    "needs_separable": (
        "method",
        asked(system=RODS._description(), state=np.zeros(4), method="verlet", step=0.1),
    ),
    "needs_conservative": ("method", asked(system=DRY, method="gauss4", step=0.1)),
    "backward_of_dry_friction": ("t", asked(system=DRY, times=np.array([-1.0]))),
    "differs_from_start": ("t", asked(times=np.array([0.0]), own_steps=True)),
    "one_end": ("t", asked(own_steps=True)),
    "monotonic": ("t", asked(times=np.array([0.1, 0.2, 0.3, 0.4, 0.0]))),
    "step_needed": ("step", asked(method="rk4")),
    "step_within_span": ("step", fixed(step=2.0)),
    "steps_countable": ("step", fixed(step=1e-20)),
    "step_above_rounding": ("step", fixed(step=1.0, t0=1e17, times=np.array([1e17 + 1600.0]))),
    "outputs_of_steps": ("step", fixed(step=1e-9, times=np.array([1.0]), own_steps=True)),
    "rounding_of_times": ("t", asked(times=np.array([1e300]))),
    "rounding_of_late_times": ("t", asked(t0=1e17, times=np.array([1e17 + 1600.0]))),
    "tolerance_range": ("tolerance", asked(tolerance=0.5)),
    "tolerance_too_small": ("tolerance", asked(tolerance=1e-20)),
    "whole_range": ("digits", asked(digits=99)),
    "angle_to_certify": ("certify", asked(certify=2.0)),
    "digits_alone": ("digits", fixed(digits=9)),
    "step_of_adaptive": ("step", asked(step=0.1)),
    "tolerance_of_fixed": ("tolerance", fixed(tolerance=1e-9)),
    "events_of_fixed": ("events", fixed(events=[flip(1).for_core()])),
    "rod": ("i", asked(events=[flip(2).for_core()])),
}
# Of methods that need what every system has there is none; what is no number gets to no core.
NEEDS = {f"needs_{each.needs}" for each in METHODS if each.needs != "flow"}  # which all have
# All have a series, and `digits` go by another way.
LEFT = {"number", "needs_series", "not_of_doubles", "rows", *NEEDS}
NOT_TO_BREAK = LEFT - {f"needs_{each.needs}" for each, of in REFUSED if of.can.conservative}
every_rule = pytest.mark.parametrize("rule", BROKEN)


def fault_of(rule: str) -> _engine.Fault:
    found = _engine.check(BROKEN[rule][1])
    assert found is not None
    return found


def error_of(rule: str) -> ArgumentError:
    with pytest.raises(ArgumentError) as error:
        refuse(fault_of(rule))
    return error.value


class Marked(Naming):
    """Other names than Python's."""

    def argument(self, name: str) -> str:
        return f"[{name}]"

    def given(self, name: str, value: str) -> str:
        return f"[{name}]({value})"

    def call(self, name: str) -> str:
        return f"[{name}]()"


# ---- the rules ----


def test_every_rule_can_be_broken() -> None:
    assert set(BROKEN) == set(ROWS) - NOT_TO_BREAK
    assert _engine.check(asked()) is _engine.check(fixed()) is None


@every_rule
def test_a_fault_names_the_rule_and_the_argument(rule: str) -> None:
    found = fault_of(rule)
    assert (found.rule, found.argument) == (rule, BROKEN[rule][0])


@every_rule
def test_what_is_refused_is_not_run(rule: str) -> None:
    result = _engine.solve(BROKEN[rule][1], None)
    assert result.refused is not None
    assert result.refused.rule == rule
    assert (result.t.size, result.n_steps) == (0, 0)


@every_rule
@pytest.mark.parametrize("language", ["english", "spanish"])
def test_its_sentence_is_complete(rule: str, language: str) -> None:
    found, row = fault_of(rule), ROWS[rule]
    sentence, way_out = getattr(row, language), getattr(row, f"way_out_in_{language}")
    told = Message(found.argument, sentence, way_out, value=found.value, **found.details)
    assert told.startswith(f"{found.argument} ")
    assert not re.search(r"[{}<>\n]|  |None", told), told
    assert (way_out == "") == (row.way_out_in_english == "")


@pytest.mark.parametrize("rule", sorted(NOT_TO_BREAK))
def test_sentences_that_nothing_is_told_in_yet_name_what_their_like_do(rule: str) -> None:
    counted = fault_of("count_of_components").details
    places = {*fault_of("needs_separable").details, *counted, "value", "in_unit"}
    row = ROWS[rule]
    for text in (row.english, row.way_out_in_english, row.spanish, row.way_out_in_spanish):
        assert set(re.findall(r"\{(\w+)\}", text)) <= places


@pytest.mark.parametrize("rule", ROWS)
def test_both_languages_say_the_same_with_the_same_values(rule: str) -> None:
    row = ROWS[rule]

    def named(*templates: str) -> list[str]:
        return sorted(re.findall(r"\{\w+\}|<[^>]+>", " ".join(templates)))

    assert named(row.english, row.way_out_in_english) == named(row.spanish, row.way_out_in_spanish)


def test_a_run_of_doubles_refuses_digits() -> None:
    """Which the package makes by runs of many digits."""
    many = _core.ensemble(asked(digits=9), np.zeros((3, 2)), np.zeros((1, 3)), [], 1, None)
    for result in (_core.solve(asked(digits=9), None), many):
        assert result.refused is not None
        assert (result.refused.rule, result.refused.argument) == ("not_of_doubles", "digits")
    assert _engine.check(asked(digits=9)) is None


def test_no_sentence_of_a_rule_stands_in_the_package_too() -> None:
    sentences = {row.english.replace("{in_unit}", "") for row in ROWS.values()}
    for path in sorted(Path(pendula.__file__).parent.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                own = node.value.replace("{in_unit}", "")
                assert own not in sentences, f"{path.name}:{node.lineno}"


@pytest.mark.parametrize(
    ("check", "rule", "argument"),
    [
        (lambda: _checks.number("x", "a", "s"), "number", "x"),
        (lambda: _checks.finite_number("x", math.inf), "finite", "x"),
        (lambda: _checks.positive_number("x", 0), "positive", "x"),
        (lambda: _checks.positive_number("x", -1, zero=True), "not_negative", "x"),
        (lambda: _checks.finite_array("x", [[1.0, math.nan]]), "all_finite", "x"),
        (lambda: _checks.finite_array("x", math.nan), "all_finite", "x"),
        (lambda: _checks.whole_number("x", 0, 9), "whole_range", "x"),
        (lambda: _checks.one_of("x", "a", ["b"]), "unknown_name", "x"),
        (lambda: ensemble(RODS, np.zeros(4), 0.0), "differs_from_start", "t"),
        (lambda: solve(SIMPLE, (1.0, 0.0), 1.0, method=3), "unknown_name", "method"),  # type: ignore[arg-type]
        (lambda: SimplePendulum(-1.0), "positive", "length"),
        (lambda: span_of(1.0, 1.0), "differs_from_start", "t_max"),
        (lambda: times_apart(0.0, 1.0, 2.0), "step_within_span", "every"),
    ],
)
def test_the_package_refuses_in_the_words_of_the_core(
    check: Callable[[], object], rule: str, argument: str
) -> None:
    with pytest.raises(ArgumentError) as error:
        check()
    message, row = error.value.message, ROWS[rule]
    assert (message.argument, message.rule) == (argument, row.english)
    for sentence in (row.english, row.spanish):
        assert not re.search(r"[{}<>]", Message(argument, sentence, **message.details))


# ---- errors as data ----


@every_rule
def test_an_error_is_a_value_error_with_its_data(rule: str) -> None:
    error, found, row = error_of(rule), fault_of(rule), ROWS[rule]
    assert isinstance(error, ValueError)
    assert error.argument == error.message.argument == found.argument
    assert (error.message.rule, error.message.way_out) == (row.english, row.way_out_in_english)
    assert repr(error.message.details) == repr({"value": found.value, **found.details})
    assert str(error) == str(error.message) == message_of(error)


@every_rule
@pytest.mark.parametrize(
    "through", [lambda x: pickle.loads(pickle.dumps(x)), copy.copy, copy.deepcopy]
)
def test_an_error_comes_through_whole(rule: str, through: Callable[[Any], Any]) -> None:
    error = error_of(rule)
    again = through(error)
    assert (type(again), str(again), again.args) == (ArgumentError, str(error), error.args)
    assert isinstance(again.message, Message)
    assert again.message.named(Marked()) == error.message.named(Marked())
    assert repr(again.message.details) == repr(error.message.details)


def test_an_error_of_a_kind_of_its_own_comes_through_with_what_it_adds() -> None:
    with pytest.raises(DigitsError) as error:
        solve(SIMPLE, (2.0**51, 0.0), [1.0], digits=12)
    for again in (pickle.loads(pickle.dumps(error.value)), copy.copy(error.value)):
        assert type(again) is DigitsError
        assert (again.outcome, str(again)) == ("not_finite", str(error.value))
        assert again.argument == "digits"


@every_rule
def test_an_error_can_be_told_in_other_names(rule: str) -> None:
    message = error_of(rule).message
    told = message.named(Marked())
    assert told.startswith(f"[{message.argument}] ")
    templates = f"{message.rule} {message.way_out}".replace("{other}", "method=rk4")
    for name, _, value in re.findall(r"<([\w{}]+)(=([^<>]*))?>", templates):
        assert f"[{name}]" in told
        assert not value or f"[{name}](" in told
    assert message.named(Naming()) == str(message)


# ---- methods and systems that do not go together ----


@pytest.mark.parametrize(("method", "system"), REFUSED, ids=label)
def test_the_core_itself_refuses_a_method_that_does_not_take_the_system(
    method: Any, system: Any
) -> None:
    rest, ideal = at_rest(system), system.can.conservative
    rule = f"needs_{method.needs}" if ideal else "needs_conservative"
    says = "needs a system" if ideal else "is for pendulums without friction and drive"
    one = _core.Request(
        system._description(), method.name, rest, 0.0, np.array([1.0]), **control(method)
    )
    many = _core.ensemble(one, np.tile(rest, (3, 1)), np.zeros((1, 0)), [], 1, None)
    for result in (_core.solve(one, None), many):
        assert result.refused is not None
        assert result.refused.rule == rule
    for call in (
        lambda: solve(system, rest, 1.0, method.name, **control(method)),
        lambda: ensemble(system, rest, 1.0, method.name, **control(method)),
    ):
        with pytest.raises(ArgumentError, match=f"^method '{method.name}' {says}"):
            call()
