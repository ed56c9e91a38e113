"""Checksums of a recipe and of columns of numbers.

BLAKE2b (Saarinen and Aumasson, RFC 7693 (2015)) of 128 bits: no damage passes by chance, of
whatever kind and size, which 32 bits of a CRC would let do so once in 4e9 damaged columns.
"""

from __future__ import annotations

import json
from hashlib import blake2b
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array

_BYTES = 16


def of_bytes(data: bytes) -> str:
    """The checksum of some bytes, as text."""
    return blake2b(data, digest_size=_BYTES).hexdigest()


def of_column(values: Array) -> str:
    """Of the shape and the bits, the same on every machine; −0.0 is not 0.0, each nan is one."""
    import numpy as np

    # A nan's sign and payload do not survive text.
    same = np.where(np.isnan(values), np.nan, values).astype("<f8")
    return of_bytes(repr(values.shape).encode() + same.tobytes())


def of_recipe(known: Mapping[str, Any]) -> str:
    """Of data from JSON; a float's text gives its bits, blanks between are nothing."""
    return of_bytes(json.dumps(known).encode())
