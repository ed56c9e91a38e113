"""Where a store's files are: a folder of this machine, or what fsspec reaches."""

from __future__ import annotations

import errno
import os
import shutil
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from pendula._checks import MissingExtraError, extra
from pendula._messages import ArgumentError, Message
from pendula._writing import (
    check_folder,
    is_unfinished,
    make_folder,
    sync_folder,
    write_durably,
)
from pendula.many.chunks.folder_lock import FolderLock

if TYPE_CHECKING:
    from collections.abc import Iterator

_FILES = (".nc", ".h5", ".parquet", ".csv")  # endings of what is no store
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class Place(Protocol):
    """Files by key: "zarr.json", "flip_time/c.0.3"."""

    checked: bool  # whether `read` is cheap enough to check every checksum

    def occupied(self) -> Iterator[str]:
        """Names of files and folders at the top."""

    def sizes(self, folder: str) -> dict[str, int]:
        """Files of a folder and their sizes; leftovers of a killed run are removed."""

    def read(self, key: str) -> bytes | None:
        """A file; None where there is none."""

    def write(self, key: str, data: bytes) -> None:
        """Write a file completely or not at all; durable once this returns."""

    def remove(self, key: str) -> None:
        """Remove a file, where it is there; durable once this returns."""

    def clear(self, kept: str) -> None:
        """Remove all but one file."""

    def locked(self) -> Any:
        """A context that excludes other writers."""


def place_at(store: str | os.PathLike[str]) -> Place:
    """The place of a path, or of a URL such as s3://bucket/flips.zarr."""
    text = checked_name(store)
    if Path(text).suffix in _FILES:
        raise ArgumentError(
            "store",
            "must be a Zarr store such as 'map.zarr', got {value}",
            "other files are written from the dataset",
            value=text,
        )
    return Remote(text) if "://" in text else Folder(Path(text))


def checked_name(store: object) -> str:
    """The path or URL of a store, as text.

    Raises:
        ValueError: for anything else.
    """
    text = os.fspath(store) if isinstance(store, (str, os.PathLike)) else store
    if not isinstance(text, str) or not text:
        rule = "must be a path or a URL such as 'map.zarr', got {value}"
        raise ArgumentError("store", rule, value=text)
    return text


class Folder:
    """A folder of a file system."""

    checked = True

    def __init__(self, path: Path) -> None:
        self.path = path

    def __str__(self) -> str:
        return str(self.path)

    def occupied(self) -> Iterator[str]:
        """Names at the top, those of leftovers apart."""
        if self.path.is_dir():
            yield from (each for each in os.listdir(self.path) if not is_unfinished(each))

    def sizes(self, folder: str) -> dict[str, int]:
        """One look at the folder, however many files it holds."""
        found = {}
        try:
            with os.scandir(self.path / folder) as entries:
                for entry in entries:
                    if is_unfinished(entry.name):
                        os.unlink(entry.path)
                    else:
                        found[entry.name] = entry.stat().st_size
        except FileNotFoundError:
            pass
        return found

    def read(self, key: str) -> bytes | None:
        """A file; None where there is none."""
        try:
            return (self.path / key).read_bytes()
        except FileNotFoundError:
            return None

    def write(self, key: str, data: bytes) -> None:
        """Write a file, all of it or nothing."""
        target = self.path / key
        try:
            write_durably(target, data)
        except OSError as error:
            raise _cannot_write(target, error) from error

    def remove(self, key: str) -> None:
        """Remove a file."""
        target = self.path / key
        try:
            target.unlink(missing_ok=True)
            if target.parent.is_dir():
                sync_folder(target.parent)
        except OSError as error:
            raise _cannot_write(target, error) from error

    def clear(self, kept: str) -> None:
        """Remove all but one file."""
        for each in self.path.iterdir():
            if each.is_dir() and not each.is_symlink():
                shutil.rmtree(each)
            elif each.name != kept:
                each.unlink()
        sync_folder(self.path)

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Make the folder and hold a lock on it, which ends with the process and leaves no trace.

        Raises:
            OSError: where another process writes there, or the folder cannot be made.
        """
        self._check_place()
        try:
            make_folder(self.path)
            lock = FolderLock(self.path)
        except OSError as error:
            raise _cannot_write(self.path, error) from error
        with lock:
            yield

    def _check_place(self) -> None:
        check_folder(self.path)
        if os.path.lexists(self.path) and not self.path.is_dir():
            raise FileExistsError(f"{self.path} exists and is no folder; choose another name")


class Remote:
    """A folder of an object store; an object is there as a whole or not at all."""

    checked = False

    def __init__(self, url: str) -> None:
        self.url = url
        core = extra("fsspec.core", "cluster")
        try:
            self._files, self._root = core.url_to_fs(url)
        except ImportError as error:  # each kind of store has a package of its own
            raise MissingExtraError(f"{url} cannot be reached: {error}") from error

    def __str__(self) -> str:
        return self.url

    def occupied(self) -> Iterator[str]:
        """Names at the top."""
        yield from (name for name, _ in self._entries(self._root))

    def sizes(self, folder: str) -> dict[str, int]:
        """Objects of a folder and their sizes."""
        return dict(self._entries(f"{self._root}/{folder}"))

    def read(self, key: str) -> bytes | None:
        """An object; None where there is none."""
        try:
            return bytes(self._files.cat_file(f"{self._root}/{key}"))
        except FileNotFoundError:
            return None

    def write(self, key: str, data: bytes) -> None:
        """Write an object, which is there when it is whole."""
        try:
            self._files.pipe_file(f"{self._root}/{key}", data)
        except OSError as error:
            raise _cannot_write(f"{self.url}/{key}", error) from error

    def remove(self, key: str) -> None:
        """Remove an object."""
        with suppress(FileNotFoundError):
            self._files.rm_file(f"{self._root}/{key}")

    def clear(self, kept: str) -> None:
        """Remove all but one object."""
        for path in self._files.find(self._root):
            if path != f"{self._root}/{kept}":
                self._files.rm_file(path)

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Nothing: object stores have no locks; two writers write the same bytes."""
        yield

    def _entries(self, path: str) -> Iterator[tuple[str, int]]:
        self._files.invalidate_cache()
        try:
            for entry in self._files.ls(path, detail=True):
                yield entry["name"].rpartition("/")[2], entry["size"] or 0
        except FileNotFoundError:
            return


def _cannot_write(target: Path | str, error: OSError) -> OSError:
    """One line, with the way out; of the same kind and number."""
    first = "make room, then" if error.errno in _FULL else "when that is mended,"
    shown = type(error)(
        Message(
            "",
            "cannot write {path}: {text}",
            f"complete chunks are kept: {first} run <call=the same call again>",
            path=target,
            text=error.strerror or error,
        )
    )
    shown.errno = error.errno
    return shown
