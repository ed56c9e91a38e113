"""The pendulums: frozen, validated descriptions, and the way back from their data."""

from __future__ import annotations

from typing import Any

from pendula._checks import one_of
from pendula.systems.base import (
    STANDARD_GRAVITY,
    ClosedForm,
    System,
    check_system,
    class_names_that,
    systems_that,
    with_closed_form,
)
from pendula.systems.damped_double import DampedDoublePendulum
from pendula.systems.double import DoublePendulum, NormalModes
from pendula.systems.driven import DrivenPendulum
from pendula.systems.single import LinearPendulum, SimplePendulum

__all__ = [
    "STANDARD_GRAVITY",
    "ClosedForm",
    "DampedDoublePendulum",
    "DoublePendulum",
    "DrivenPendulum",
    "LinearPendulum",
    "NormalModes",
    "SimplePendulum",
    "System",
    "check_system",
    "class_names_that",
    "system_from",
    "systems_that",
    "with_closed_form",
]


def system_from(description: dict[str, Any]) -> System:
    """The system that `System.description` described.

    Raises:
        ValueError: for an unknown name or form, or parameters out of range.
    """
    name = one_of("system", description.get("name"), System.classes)
    return System.classes[name].of_form(description.get("form", ""), description["parameters"])
