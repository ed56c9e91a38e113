"""Opens a store for reading; a damaged chunk says in one line which it is and what to do."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from zarr.storage import FsspecStore, LocalStore, WrapperStore

from pendula._attributes import KEY, UNFINISHED
from pendula._messages import Message
from pendula.many.chunks.layout import ROOT, whole

if TYPE_CHECKING:
    from zarr.abc.store import ByteRequest
    from zarr.core.buffer import Buffer, BufferPrototype


class CheckedStore(WrapperStore[Any]):
    """Looks at a chunk's checksum before the codecs do, who do not know its name."""

    _finished: bool | None = None

    async def get(
        self, key: str, prototype: BufferPrototype, byte_range: ByteRequest | None = None
    ) -> Buffer | None:
        """A file, or None; as every store of zarr-python.

        Raises:
            ValueError: for a damaged chunk, or one that a finished store lacks.
        """
        found = await super().get(key, prototype, byte_range)
        if not key.rpartition("/")[2].startswith("c."):
            return found
        if found is None and await self._is_finished(prototype):
            raise ValueError(self._damaged(key, "is missing"))
        if found is not None and byte_range is None and not whole(found.to_bytes()):
            raise ValueError(self._damaged(key, "is damaged: its checksum does not fit"))
        return found

    async def _is_finished(self, prototype: BufferPrototype) -> bool:
        """Whether all chunks were there once: zarr gives the fill value for one that is not."""
        if self._finished is None:
            root = await super().get(ROOT, prototype)
            attributes = {} if root is None else json.loads(root.to_bytes())["attributes"]
            self._finished = KEY in attributes and UNFINISHED not in attributes
        return self._finished

    def _damaged(self, key: str, rule: str) -> Message:
        """What is wrong, and the way out; chunks far away are not read again to find it."""
        here = getattr(self._store, "root", None)
        path = f"{here or self._store.path}/{key}"
        remove = "" if here or rule == "is missing" else "remove it and "
        return Message(
            "",
            f"{{path}} {rule}",
            f"{remove}run <call=the call that made the store again>: it computes that "
            "chunk and keeps the others",
            path=path,
        )


def checked_store(store: str | os.PathLike[str]) -> Any:
    """The store at a path or URL, for reading."""
    text = os.fspath(store)
    if "://" in text:
        return CheckedStore(FsspecStore.from_url(text, read_only=True))
    return CheckedStore(LocalStore(Path(text), read_only=True))
