"""What the error of a wrong call says."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path


def told(call: Callable[..., object], kind: type[Exception] = ValueError) -> str:
    """What the error of a wrong call says, in one line."""
    with pytest.raises(kind) as error:
        call()
    assert "\n" not in str(error.value)
    return str(error.value)


def refused_at(call: Callable[..., object], path: Path, line: int, says: str) -> None:
    """A mistake in a file is said in one line, with its place."""
    message = told(call)
    assert message.startswith(f"{path}, line {line}: ")
    assert says in message
