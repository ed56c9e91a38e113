"""What the error of a wrong call says."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable


def told(call: Callable[..., object], kind: type[Exception] = ValueError) -> str:
    """What the error of a wrong call says, in one line."""
    with pytest.raises(kind) as error:
        call()
    assert "\n" not in str(error.value)
    return str(error.value)
