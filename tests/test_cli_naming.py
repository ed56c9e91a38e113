"""Errors as data: the command's sentences from those of Python, and their way through a process."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest

from pendula import _engine
from pendula._messages import ArgumentError, Message, message_of
from pendula.cli.app import _pendula
from pendula.cli.naming import CommandNaming
from pendula.run.trust import DigitsError

COMMAND = CommandNaming(_pendula)
EXISTS = Message(
    "", "{path} exists", "pass <resume=True>, or <overwrite=True>", path=Path("overwrite=True.zarr")
)


@pytest.mark.parametrize(
    ("argument", "option"),
    [
        *(("step", "--step"), ("t_max", "--t-max"), ("store", "--output"), ("shape", "--size")),
        *(("length", "--length"), ("theta1", "--theta1"), ("I1", "--I1"), ("client", "client")),
        *(("max_steps", "--max-steps"), ("methods", "--methods"), ("which", "--which")),
        *(("t", "--t-max"), ("state", "the start"), ("i", "the rod of an --event")),
    ],
)
def test_arguments_are_options(argument: str, option: str) -> None:
    assert COMMAND.argument(argument) == option


def test_every_option_of_a_run_is_named_with_its_unit() -> None:
    for row in _engine.option_rows():
        given = f"--{row.name.replace('_', '-')} {row.example:g}{row.unit}"
        assert COMMAND.given(row.name, f"{row.example:g}") == given


def test_a_sentence_is_made_and_not_searched() -> None:
    rule = "is not taken together with <{other}>, got {value}; use <call=solve>"
    error = ArgumentError("digits", rule, "or <tolerance=1e-9>", value="step=1", other="step")
    assert str(error) == (
        "digits is not taken together with step, got 'step=1'; use solve; or tolerance=1e-9"
    )
    assert COMMAND.one_line(error) == (
        "--digits is not taken together with --step, got 'step=1'; use pendula solve; "
        "or --tolerance 1e-9"
    )
    assert COMMAND.one_line(ValueError("step must be overwrite=True")) == (
        "step must be overwrite=True"
    )


@pytest.mark.parametrize("kind", [FileExistsError, RuntimeError, ValueError])
def test_any_error_may_carry_a_message(kind: type[Exception]) -> None:
    error = kind(EXISTS)
    assert str(error) == "overwrite=True.zarr exists; pass resume=True, or overwrite=True"
    named = "overwrite=True.zarr exists; pass --resume, or --force"
    assert COMMAND.one_line(error) == named
    assert COMMAND.one_line(pickle.loads(pickle.dumps(error))) == named


def test_errors_keep_their_data_on_the_way_from_a_worker() -> None:
    error = DigitsError(
        "digits_limit", "too long", "= {digits} at <t>", "take <digits=3>", digits=9
    )
    for again in (pickle.loads(pickle.dumps(error)), pickle.loads(pickle.dumps(error, 2))):
        assert isinstance(again, DigitsError)
        assert (again.outcome, again.reason, again.argument) == (
            "digits_limit",
            "too long",
            "digits",
        )
        assert again.message.details == {"digits": 9}
        assert COMMAND.one_line(again) == "--digits = 9 at --t-max; take --digits 3"
        assert message_of(again) == str(error)
