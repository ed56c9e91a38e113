"""Nothing half-written where a result should be."""

from __future__ import annotations

import os
import shutil
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from pendula._messages import Message

if TYPE_CHECKING:
    from collections.abc import Iterator


def refuse_existing(target: Path, *, overwrite: bool) -> None:
    """Say at once what would go wrong at the end.

    Raises:
        FileExistsError: where the path exists and `overwrite` is not set.
        OSError: where it cannot be written: no such folder, not a folder, no permission.
    """
    folder = target.absolute().parent
    if not folder.is_dir():
        kind = NotADirectoryError if folder.exists() else FileNotFoundError
        raise kind(f"cannot write {target}: {folder} is not a folder; make it first")
    if not os.access(folder, os.W_OK):
        raise PermissionError(f"cannot write {target}: no permission to write in {folder}")
    if os.path.lexists(target) and not overwrite:
        way_out = "choose another name, or pass <overwrite=True>"
        raise FileExistsError(Message("", "{path} exists", way_out, path=target))


@contextmanager
def replacing(target: Path, *, overwrite: bool) -> Iterator[Path]:
    """A path beside `target` to write to; moved there at the end, removed on failure."""
    refuse_existing(target, overwrite=overwrite)
    name, target = target, target.resolve()  # a link stays one, what it names is replaced
    unfinished = target.with_name(f".{target.stem}.{os.getpid()}.unfinished{target.suffix}")
    try:
        yield unfinished
        if target.exists() and target.is_dir() != unfinished.is_dir():
            kind = "folder" if target.is_dir() else "file"
            raise FileExistsError(f"{name} exists and is a {kind}; choose another name")
        if target.is_dir():
            _swap(unfinished, target)
        else:
            unfinished.replace(target)
    finally:
        _remove(unfinished)


def _swap(new: Path, old: Path) -> None:
    """Folders cannot be replaced in one go: the old one steps aside until the new one stands."""
    aside = old.with_name(f".{old.stem}.{os.getpid()}.old{old.suffix}")
    old.rename(aside)
    try:
        new.rename(old)
    except BaseException:
        aside.rename(old)
        raise
    _remove(aside)


def _remove(path: Path) -> None:
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
