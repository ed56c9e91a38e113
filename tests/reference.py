"""Stored 60-digit solutions that lie beside the project on some machines; elsewhere tests skip."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

FOLDER = Path(__file__).resolve().parents[2] / "shared" / "reference"


def cases(name: str) -> list[dict[str, Any]]:
    """The cases of one file."""
    path = FOLDER / name
    if not path.exists():
        pytest.skip(f"the stored solutions {name} are not on this machine")
    loaded: list[dict[str, Any]] = json.loads(path.read_text(encoding="utf-8"))
    return loaded
