"""Opens a store for reading; a damaged chunk says in one line which it is and what to do."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zarr.storage import FsspecStore, LocalStore, WrapperStore

from pendula._messages import Message
from pendula.many.chunks.layout import whole

if TYPE_CHECKING:
    from zarr.abc.store import ByteRequest
    from zarr.core.buffer import Buffer, BufferPrototype


class CheckedStore(WrapperStore[Any]):
    """Looks at a chunk's checksum before the codecs do, who do not know its name."""

    async def get(
        self, key: str, prototype: BufferPrototype, byte_range: ByteRequest | None = None
    ) -> Buffer | None:
        """A file, or None; as every store of zarr-python.

        Raises:
            ValueError: for a damaged chunk.
        """
        found = await super().get(key, prototype, byte_range)
        chunk = key.rpartition("/")[2].startswith("c.")
        if found is not None and chunk and byte_range is None and not whole(found.to_bytes()):
            raise ValueError(self._damaged(key))
        return found

    def _damaged(self, key: str) -> Message:
        """What is wrong, and the way out; chunks far away are not read again to find it."""
        here = getattr(self._store, "root", None)
        path = f"{here or self._store.path}/{key}"
        remove = "" if here else "remove it and "
        return Message(
            "",
            "{path} is damaged: its checksum does not fit",
            f"{remove}run <call=the call that made the store again>: it computes the damaged "
            "chunk and keeps the others",
            path=path,
        )


def checked_store(store: str | os.PathLike[str]) -> Any:
    """The store at a path or URL, for reading."""
    text = os.fspath(store)
    if "://" in text:
        return CheckedStore(FsspecStore.from_url(text, read_only=True))
    return CheckedStore(LocalStore(Path(text), read_only=True))
