"""A store that is written chunk by chunk and can be killed at any moment.

The root is written first and holds the identity. It says "unfinished" until all chunks are there.
A chunk counts once all its variables have a file, each of the right size and, where they are on
this machine, with the right checksum. All bytes follow from the inputs: the finished store does not
depend on interruptions.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from pendula._attributes import KEY, UNFINISHED
from pendula._messages import Message
from pendula.many.chunks.growing import size_before
from pendula.many.chunks.layout import NOTE, ROOT, Layout, whole

if TYPE_CHECKING:
    from pendula.many.chunks.places import Place
    from pendula.many.chunks.work import Arrays, Chunk, Index, Work


class Store:
    """A store of the chunks of some work; for one process at a time."""

    def __init__(self, place: Place, work: Work) -> None:
        self._place, self._work = place, work
        self._layout = Layout(work)

    def begin(self, *, resume: bool, overwrite: bool) -> list[Index]:
        """Make the place a store of this work; the chunks that are missing.

        Raises:
            ValueError: where the store has other inputs.
            FileExistsError: where something else is there, or a store that was not asked for.
        """
        place, layout = self._place, self._layout
        root = place.read(ROOT)
        if root is None:
            self._refuse_other_things()
            place.write(ROOT, layout.unfinished)
        else:
            size = self._refuse_other_stores(root, resume=resume, overwrite=overwrite)
            if overwrite:
                place.clear(kept=ROOT)
                place.write(ROOT, layout.unfinished)
            elif size is not None:
                self._make_room(root, size)
        place.sizes("")  # for the leftovers at the top
        missing = self._missing()
        damaged = {key: data for key, data in layout.rest.items() if place.read(key) != data}
        if missing or damaged:
            self._write_root(layout.unfinished)
        for key, data in damaged.items():
            place.write(key, data)
        return missing

    def _make_room(self, root: bytes, size: int) -> None:
        """Let a store of `size` values grow; its last chunk, where it is not full, is made again.

        That chunk is removed before the root names the larger work: whenever this is stopped, the
        store is that of one of the two, without that chunk.
        """
        place, layout, work = self._place, self._layout, self._work
        (axis,) = work.cut
        if size % axis.step:
            known = json.loads(root)
            known["attributes"][UNFINISHED] = NOTE
            place.write(ROOT, json.dumps(known).encode())
            for each in work.variables:
                place.remove(f"{each.name}/{layout.name(each, (size // axis.step,))}")
        place.write(ROOT, layout.unfinished)

    def put(self, chunk: Chunk, arrays: Arrays) -> None:
        """Write a chunk; durable once this returns."""
        for key, data in self._layout.files(chunk, arrays).items():
            self._place.write(key, data)

    def summary(self) -> str:
        """How many chunks are complete, for whoever has stopped the run."""
        names = ([*self._place.sizes(each.name)] for each in self._work.variables)
        there = min(sum(name.startswith("c.") for name in each) for each in names)
        return f"{there} of {len(list(self._work.indices()))} chunks are in {self._place}"

    def finish(self) -> None:
        """Mark the store as complete."""
        self._write_root(self._layout.root)

    def _write_root(self, data: bytes) -> None:
        if self._place.read(ROOT) != data:
            self._place.write(ROOT, data)

    def _missing(self) -> list[Index]:
        """The chunks that lack a variable, or hold one that is truncated or damaged."""
        place, layout, work = self._place, self._layout, self._work
        missing: set[Index] = set()
        for variable in work.variables:
            sizes, right = place.sizes(variable.name), layout.size(variable)
            for index in work.indices():
                name = layout.name(variable, index)
                if index in missing:
                    continue
                fits = name in sizes and right in (None, sizes[name])
                if not fits or not self._sound(f"{variable.name}/{name}"):
                    missing.add(index)
        return [index for index in work.indices() if index in missing]

    def _sound(self, key: str) -> bool:
        """Whether a file of the right size is what was written."""
        if not self._place.checked:
            return True
        data = self._place.read(key)
        return data is not None and whole(data)

    def _refuse_other_things(self) -> None:
        for name in self._place.occupied():
            raise FileExistsError(
                f"{self._place} exists and is not a store of pendula (it holds {name}); "
                "choose another name"
            )

    def _refuse_other_stores(self, root: bytes, *, resume: bool, overwrite: bool) -> int | None:
        """The size of a store that this work goes on with; None: it has the same size."""
        place = self._place
        there = identity_of(root)
        if there is None:
            raise FileExistsError(
                f"{place} exists and is not a store of pendula ({ROOT} holds no identity); "
                "choose another name"
            )
        if overwrite:
            return None
        size = size_before(self._work, there)
        different = first_difference(there, json.loads(self._work.identity))
        if different is not None and size is None:
            name, old, new = different
            text = f"holds another computation: {name} is {old} there and {new} here"
            if name == "format":
                text = "is in the format of an earlier version: it can be read, not gone on with"
            way_out = "choose another name, or pass <overwrite=True>"
            raise ValueError(Message("", "{path} {text}", way_out, path=place, text=text))
        if not resume:
            raise FileExistsError(
                Message(
                    "",
                    "{path} exists",
                    "pass <resume=True> to resume it, <overwrite=True> to overwrite it, or "
                    "choose another name",
                    path=place,
                )
            )
        return size


def identity_of(root: bytes) -> Any:
    """The identity in a store's first file; None where there is none."""
    try:
        return json.loads(json.loads(root)["attributes"][KEY])
    except (KeyError, TypeError, ValueError):
        return None


def first_difference(there: Any, here: Any, name: str = "") -> tuple[str, str, str] | None:
    """The first place at which two identities differ, with both values; None where they agree."""
    if isinstance(there, dict) and isinstance(here, dict):
        keys = {str(key): f"{name}.{key}" if name else str(key) for key in {**here, **there}}
    elif isinstance(there, list) and isinstance(here, list) and len(there) == len(here):
        there, here = (dict(zip(map(str, range(len(a))), a, strict=True)) for a in (there, here))
        keys = {str(i): f"{name}[{i}]" for i in range(len(here))}
    else:
        same = there == here and type(there) is type(here)
        return None if same else (name or "the identity", json.dumps(there), json.dumps(here))
    for key, full in keys.items():
        if (key in there) != (key in here):
            first, second = (
                json.dumps(each[key]) if key in each else "missing" for each in (there, here)
            )
            return full, first, second
        different = first_difference(there[key], here[key], full)
        if different is not None:
            return different
    return None
