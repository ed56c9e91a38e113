"""Files and folders that are there as a whole or not at all: written beside, moved into place."""

from __future__ import annotations

import os
import shutil
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from pendula._messages import Message

if TYPE_CHECKING:
    from collections.abc import Iterator

_PART = ".part"  # ends the name of a file that `write_durably` has not finished


def check_folder(target: Path) -> None:
    """Refuse a path whose folder is not there.

    Raises:
        OSError: where it is missing, or no folder.
    """
    folder = target.absolute().parent
    if not folder.is_dir():
        kind = NotADirectoryError if folder.exists() else FileNotFoundError
        raise kind(f"cannot write {target}: {folder} is not a folder; make it first")


def refuse_existing(target: Path, *, overwrite: bool) -> None:
    """Refuse, before any work, a path that cannot be written.

    Raises:
        FileExistsError: where the path exists and `overwrite` is not set.
        OSError: where it cannot be written: no such folder, not a folder, no permission.
    """
    check_folder(target)
    folder = target.absolute().parent
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


def write_durably(target: Path, data: bytes) -> None:
    """Write beside, sync, move there, sync the folder: it survives a power cut, complete.

    The folder is made where it is missing. What a killed process leaves `is_unfinished`.
    """
    part = target.with_name(f".{target.name}{_PART}")
    try:
        make_folder(target.parent)
        with part.open("wb", buffering=0) as file:
            view = memoryview(data)
            while view:
                view = view[file.write(view) :]
            os.fsync(file.fileno())
        part.replace(target)
        sync_folder(target.parent)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def is_unfinished(name: str) -> bool:
    """Whether a file of this name is what a killed `write_durably` left."""
    return name.startswith(".") and name.endswith(_PART)


def make_folder(path: Path) -> None:
    """Make a folder that survives a power cut."""
    if not path.is_dir():
        path.mkdir()
        sync_folder(path.parent)


def sync_folder(path: Path) -> None:
    """Make the names in a folder survive a power cut; Windows has no call for it."""
    if not hasattr(os, "O_DIRECTORY"):
        return
    handle = os.open(path, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


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
