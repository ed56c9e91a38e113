"""Numbers to draw, as they are given: with their unit, in shapes that go together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from pendula._checks import check_finite, numbers_array
from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from pendula._types import Array


def axis(name: str, value: Any, unit: str = "") -> Array:
    """What the others are drawn over: finite numbers, (n,), at least one."""
    found = curve(name, value, unit)
    check_finite(name, found, unit)
    return found


def curve(name: str, value: Any, unit: str = "", over: Array | None = None) -> Array:
    """Numbers, (n,), as many as they are drawn over; converted where they carry a unit.

    Raises:
        ArgumentError: for no numbers, masked ones, another unit, or another shape.
    """
    found = numbers_array(name, value, unit)
    if found.ndim != 1 or found.size == 0:
        raise ArgumentError(name, "must have shape (n,), got shape {value}", value=found.shape)
    if over is not None and found.shape != over.shape:
        rule = "must have shape {wanted}, got shape {value}"
        raise ArgumentError(name, rule, wanted=over.shape, value=found.shape)
    return found


def curves(name: str, value: Any, unit: str, over: Array) -> dict[Any, Array]:
    """Several by name."""
    return {key: curve(f"{name}[{key!r}]", each, unit, over) for key, each in items(name, value)}


def items(name: str, value: Any) -> list[tuple[Any, Any]]:
    """Names and values of a dict."""
    if not isinstance(value, Mapping):
        raise ArgumentError(name, "must be a dict, got {value}", value=value)
    return list(value.items())
