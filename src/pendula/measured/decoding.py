"""Bytes of a text file as its text."""

from __future__ import annotations

import codecs

_WIDE = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_LOOKED_AT = 2000  # bytes, for the zeros that UTF-16 has without a byte order mark


def decoded(data: bytes) -> tuple[str, str]:
    """The text of a file, and what it is written in.

    UTF-8 and UTF-16, with or without a byte order mark; what is neither is Windows-1252, which
    holds Latin-1.
    """
    if data.startswith(_WIDE):
        return data.decode("utf-16", errors="replace"), "UTF-16"
    start = data[:_LOOKED_AT]
    if start.count(0) * 3 > len(start):
        name = "utf-16-le" if start[1::2].count(0) > start[::2].count(0) else "utf-16-be"
        return data.decode(name, errors="replace"), "UTF-16"
    try:
        return data.decode("utf-8-sig"), "UTF-8"
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace"), "Latin-1"
