"""The laboratory's module in wasmtime: what web/src/core asks of it in a browser, from Python."""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from pendula import _engine, methods
from pendula.run.events import Event
from pendula.run.options import options_from

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pendula.systems import System

    Array = NDArray[np.float64]

MODULE = Path(__file__).parents[1] / "build" / "wasm" / "lab.wasm"
SYSTEMS = tuple(_engine.system_entries())
METHODS = tuple(each.name for each in methods())
NAN = math.nan


class RefusedError(Exception):
    """What the module refuses: a fault as data."""

    def __init__(self, fault: dict[str, Any]) -> None:
        super().__init__(fault)
        self.fault = fault


def listed(values: Iterable[float]) -> list[float]:
    """A list as the module reads it: its length and its numbers."""
    numbers = [float(each) for each in np.ravel(np.asarray(values))]
    return [float(len(numbers)), *numbers]


def described(system: System) -> list[float]:
    """A system as the module reads it."""
    entry = _engine.system_entries()[system.name]
    form = entry.form_index(system.form)
    parameters = system.parameters.values()
    return [float(SYSTEMS.index(system.name)), float(form), *listed(list(parameters))]


def requested(
    system: System,
    method: str,
    state: Sequence[float] | Array,
    times: float | Sequence[float] | Array = (),
    t0: float = 0.0,
    events: Sequence[Event] = (),
    **given: Any,
) -> list[float]:
    """A request as the module reads it; one number for `times`: outputs at the own steps."""
    asked = options_from(given)
    own = isinstance(times, float)
    options = [asked.get(name) for name in ("step", "tolerance", "certify", "max_steps")]
    numbers = [
        *described(system),
        float(METHODS.index(method)),
        t0,
        float(own),
        *(NAN if value is None else float(value) for value in options),
        *listed(state),
        *listed(np.atleast_1d(np.asarray(times))),
        float(len(events)),
    ]
    for each in events:
        numbers += [
            float(_engine.EVENT_KINDS.index(each.kind)),
            float(max(each.index - 1, 0)),
            each.value,
            float(each.every_turn),
            float(each.direction),
            float(each.terminal),
        ]
    return numbers


class Lab:
    """One instance of the module."""

    def __init__(self, path: Path) -> None:
        wasmtime: Any = pytest.importorskip("wasmtime")
        engine = wasmtime.Engine()
        self._store = wasmtime.Store(engine)
        linker = wasmtime.Linker(engine)
        linker.define_wasi()
        self._store.set_wasi(wasmtime.WasiConfig())
        instance = linker.instantiate(self._store, wasmtime.Module.from_file(engine, str(path)))
        self._exports: Any = instance.exports(self._store)
        self._memory: Any = self._exports["memory"]
        self._call("_initialize")

    def ask(self, name: str, numbers: Sequence[float]) -> list[Array]:
        """The lists of an answer.

        Raises:
            RefusedError: where it is refused.
        """
        place = self._call("input", len(numbers))
        self._memory.write(self._store, struct.pack(f"<{len(numbers)}d", *numbers), place)
        if self._call(name) != 0:
            raise RefusedError(self._fault())
        return [self._answer(i) for i in range(self._call("answer_count"))]

    def _call(self, name: str, *values: int) -> Any:
        return self._exports[name](self._store, *values)

    def _read(self, place: int, count: int) -> bytes:
        return bytes(self._memory.read(self._store, place, place + count)) if count else b""

    def _answer(self, i: int) -> Array:
        data = self._read(self._call("answer_data", i), 8 * self._call("answer_size", i))
        return np.frombuffer(data, "<f8")

    def _fault(self) -> dict[str, Any]:
        text = self._read(self._call("fault_data"), self._call("fault_size"))
        fault: dict[str, Any] = json.loads(text)
        return fault


@cache
def the_lab() -> Lab:
    """The module that was built, in one instance for all tests; without it they are skipped."""
    if not MODULE.exists():
        pytest.skip("the laboratory's module is not built: make build/wasm/lab.wasm")
    return Lab(MODULE)


def same_bits(found: Array, expected: Any) -> bool:
    """Whether all numbers are the same, bit for bit; any NaN is as good as another."""
    wanted = np.ascontiguousarray(expected, dtype=np.float64).ravel()
    if found.shape != wanted.shape:
        return False
    equal = found.view(np.uint64) == wanted.view(np.uint64)
    return bool((equal | (np.isnan(found) & np.isnan(wanted))).all())
