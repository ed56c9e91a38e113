"""One writer of a folder at a time, on every system that portalocker knows."""

from __future__ import annotations

import errno
import os
from contextlib import suppress
from typing import TYPE_CHECKING

from pendula._checks import extra

if TYPE_CHECKING:
    from pathlib import Path

_NO_LOCKS = (errno.EBADF, errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP)  # of some network disks


class FolderLock:
    """Excludes other processes from a folder; it ends with the process, however that ends.

    The folder itself is locked. Where folders cannot be opened, as on Windows, it is a file beside,
    removed at the end.

    Args:
        path: of the folder, which is there.

    Raises:
        OSError: where it cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        self._locker = extra("portalocker", "io")
        self._path = path
        self._file = None if hasattr(os, "O_DIRECTORY") else path.with_name(f".{path.name}.lock")
        if self._file is None:
            self._handle = os.open(path, os.O_RDONLY | os.O_DIRECTORY)
        else:
            self._handle = os.open(self._file, os.O_RDWR | os.O_CREAT)

    def __enter__(self) -> None:
        locker = self._locker
        try:
            locker.lock(self._handle, locker.LockFlags.EXCLUSIVE | locker.LockFlags.NON_BLOCKING)
        except locker.exceptions.AlreadyLocked:
            os.close(self._handle)
            raise BlockingIOError(
                f"another process is writing {self._path}; wait for it, or choose another name"
            ) from None
        except locker.exceptions.LockException as error:
            if getattr(error.__cause__, "errno", None) not in _NO_LOCKS:
                os.close(self._handle)
                raise OSError(f"cannot lock {self._path}: {error}") from error

    def __exit__(self, *_: object) -> None:
        # Closing alone is not enough: a process that was just forked holds the folder too.
        with suppress(self._locker.exceptions.LockException):
            self._locker.unlock(self._handle)
        os.close(self._handle)
        if self._file is not None:
            with suppress(OSError):  # another process has it open
                self._file.unlink()
