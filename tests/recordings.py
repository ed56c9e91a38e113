"""Recordings of real pendulums, which are not part of the project: tests skip where they miss."""

import os
from pathlib import Path

import pytest

_REPOSITORY = Path(__file__).resolve().parent.parent


def recording(name: str) -> Path:
    """The path of a recording; skips the test where there is none."""
    given = os.environ.get("PENDULA_RECORDINGS")
    beside = [up / "shared" / "data" for up in (_REPOSITORY.parent, _REPOSITORY.parent.parent)]
    for folder in [Path(given)] if given else beside:
        if (folder / name).is_file():
            return folder / name
    pytest.skip(f"no recording {name}: name its folder in PENDULA_RECORDINGS")
