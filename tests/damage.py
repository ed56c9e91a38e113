"""Runs in every format, and damaged copies of their files."""

from __future__ import annotations

import faulthandler
import random
import shutil
from typing import TYPE_CHECKING, Any

import numpy as np

import pendula
from alike import same
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, exact, solve
from pendula.events import flip
from pendula.io.files import FORMATS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from pendula import Trajectory

RUNS: dict[str, Callable[[], Trajectory]] = {
    "times": lambda: solve(SimplePendulum(), (1, 0), np.linspace(0, 1, 21)),
    "steps": lambda: solve(DoublePendulum.rods(), (2, 2.5, 0, 0), 0.2, "rk4", step=0.01),
    "backward": lambda: solve(LinearPendulum(), (1, 0), np.linspace(0.5, -1, 21), t0=0.5),
    "events": lambda: solve(
        DoublePendulum.rods(), (2, 2.5, 0, 0), np.linspace(0, 9, 21), events=flip(2)
    ),
    "exact": lambda: exact(SimplePendulum(), (2.9, 0), np.linspace(3, -3, 21)),
}


class Saved(dict[str, Any]):
    """The runs by name, each in every format in a folder."""

    def __init__(self, folder: Path) -> None:
        super().__init__({name: make() for name, make in RUNS.items()})
        self.folder = folder
        for name, run in self.items():
            for ending in FORMATS:
                run.save(folder / f"{name}{ending}")


COUNTS = {".csv": 250, ".nc": 250, ".parquet": 200, ".zarr": 150}  # a few seconds each


def mutated(data: bytes, chance: random.Random) -> bytes:
    """Bits and bytes changed, left out, put in; the end cut off."""
    changed, place = bytearray(data), chance.randrange(len(data))
    end = place + chance.choice([1, 2, 8, 64])
    match chance.randrange(7):
        case 0 | 1:
            changed[place] ^= 1 << chance.randrange(8)
        case 2:
            changed[place] = chance.randrange(256)
        case 3:
            del changed[place:]
        case 4:
            del changed[place:end]
        case 5:
            changed[place:place] = chance.choice([b"\0", b"9", b"\xff" * 4, data[:place][-40:]])
        case _:
            changed[place:end] = chance.choice([b"\0", b"\xff", b"9"]) * (end - place)
    return bytes(changed)


def damages(source: Path, target: Path, count: int, seed: int) -> Iterator[int]:
    """So many damaged copies of a file or a folder, one after the other; their numbers."""
    for number in range(count):
        chance = random.Random(seed * 100_000 + number)
        shutil.rmtree(target) if target.is_dir() else target.unlink(missing_ok=True)
        if source.is_dir():
            shutil.copytree(source, target)
            file = chance.choice(sorted(each for each in target.rglob("*") if each.is_file()))
            file.write_bytes(mutated(file.read_bytes(), chance))
        else:
            target.write_bytes(mutated(source.read_bytes(), chance))
        yield number


def read(path: Path, reader: Callable[[Path], Any]) -> tuple[Any, str | None]:
    """What a reader makes of a file, or what it says when it refuses it."""
    try:
        return reader(path), None
    except ValueError as error:
        return None, str(error)


def one_line_about(path: Path, told: str) -> bool:
    return "\n" not in told and len(told) < 600 and told.startswith(str(path))


def read_all(folder: Path, ending: str) -> None:
    """Read damaged copies of the runs; it ends the process, in time, where something is wrong."""
    target = folder / f"damaged{ending}"
    for seed, (name, run) in enumerate((name, make()) for name, make in RUNS.items()):
        for number in damages(folder / f"{name}{ending}", target, COUNTS[ending] // 5, seed):
            faulthandler.dump_traceback_later(25, exit=True)
            found, told = read(target, pendula.load)
            if told is None:
                same(found, run)
            assert told is None or one_line_about(target, told), (name, number, told)
    faulthandler.cancel_dump_traceback_later()
