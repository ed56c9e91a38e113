"""Errors made of the rules that the core states, in one set of sentences for both."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from pendula._engine import Fault


def broken(
    argument: str, rule: str, *, way_out: str = "", digits: bool = True, **details: Any
) -> ArgumentError:
    """The error of an argument that breaks a rule.

    Args:
        argument: its name.
        rule: the rule's key.
        way_out: a better one than the rule's.
        digits: whether there is an option of that name that the way out can offer.
        **details: what the sentence names.
    """
    row = _engine.rule_rows()[rule]
    usual = row.way_out_in_english
    if not digits and "<digits" in usual:
        usual = ""
    return ArgumentError(argument, row.english, way_out or usual, **details)


def refuse(fault: Fault | None, *, digits: bool = True, **names: str) -> None:
    """Raise what the core found wrong.

    Args:
        fault: None: nothing.
        digits: as for `broken`.
        **names: other names of arguments here.

    Raises:
        ArgumentError: where it found anything.
    """
    if fault is None:
        return
    details = {"value": fault.value, **fault.details}
    raise broken(names.get(fault.argument, fault.argument), fault.rule, digits=digits, **details)
