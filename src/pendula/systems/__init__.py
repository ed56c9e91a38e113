"""The pendulums: frozen, validated descriptions, and the way back from their data."""

from __future__ import annotations

from typing import Any

from pendula import _engine
from pendula._checks import one_of
from pendula.systems.base import STANDARD_GRAVITY, System
from pendula.systems.double import DoublePendulum, NormalModes
from pendula.systems.single import LinearPendulum, SimplePendulum

__all__ = [
    "STANDARD_GRAVITY",
    "DoublePendulum",
    "LinearPendulum",
    "NormalModes",
    "SimplePendulum",
    "System",
    "system_from",
]


def system_from(description: dict[str, Any]) -> System:
    """The system that `System.description` described.

    Raises:
        ValueError: for an unknown name or form, or parameters out of range.
    """
    name = one_of("system", description.get("name"), _engine.system_entries())
    parameters = description["parameters"]
    if name == DoublePendulum.name:
        form = one_of("form", description.get("form"), ("rods", "bobs", "bodies"))
        return getattr(DoublePendulum, form)(**parameters)  # type: ignore[no-any-return]
    return {each.name: each for each in (LinearPendulum, SimplePendulum)}[name](**parameters)
