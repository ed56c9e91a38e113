"""Kills runs into a store and goes on with them; run by test_store_killed.py in its own process.

The runs are forked before any of the libraries' threads begin, so that each costs milliseconds.
"""

from __future__ import annotations

import itertools
import os
import random
import signal
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

# before the first fork, so that no run waits for them
import numpy as np
import xarray
import zarr.storage

import pendula.many.chunks.reading
from chunked import files, waves
from pendula.chunks import Work, run
from pendula.many.chunks.places import place_at
from pendula.many.chunks.store import Store

IMPORTED = xarray, zarr.storage, pendula.many.chunks.reading

KILLS = 10
TRACED = ("open", "os.mkdir", "os.rename", "os.remove")  # reported by Python before they are done


def write(work: Work, store: Path) -> None:
    """As `run` does, without opening the result."""
    place = place_at(store)
    with place.locked():
        target = Store(place, work)
        for index in target.begin(resume=True, overwrite=False):
            chunk = work.chunk(index)
            target.put(chunk, work.compute(chunk, None, None))
        target.finish()


def forked(action: Callable[[], object]) -> int:
    """Start an action in a process of its own; its id."""
    process = os.fork()
    if process == 0:
        try:
            action()
        except BaseException as error:
            print(f"{type(error).__name__}: {error}", file=sys.stderr, flush=True)
            os._exit(1)
        os._exit(0)
    return process


def ended(process: int) -> int:
    """How a process ended: its exit code, or minus the signal."""
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])


def done(action: Callable[[], object]) -> None:
    assert ended(forked(action)) == 0


def at_random(folder: Path, seed: int) -> None:
    """Ten kills at random moments, each in the run that goes on from the one before."""
    chance, work = random.Random(seed), waves()
    calm, killed = folder / "calm.zarr", folder / "killed.zarr"
    begun = time.monotonic()
    done(lambda: slowly(lambda: run(work, calm)))
    whole = time.monotonic() - begun
    kills = 0
    for _ in range(KILLS):
        process = forked(lambda: slowly(lambda: run(work, killed)))
        time.sleep(chance.uniform(0.0, whole / KILLS * 2))
        os.kill(process, signal.SIGKILL)
        kills += ended(process) == -signal.SIGKILL
    there = len(list(killed.glob("wave/c.*")))
    done(lambda: run(work, killed))
    assert files(killed) == files(calm)
    print(f"{kills} kills, {there} of 25 chunks there")


def slowly(action: Callable[[], object]) -> None:
    """Time to be killed between what is written and what is renamed."""
    sync = os.fsync

    def slow(handle: int) -> None:
        time.sleep(1e-3)
        sync(handle)
        time.sleep(1e-3)

    os.fsync = slow  # type: ignore[assignment]
    action()


def at_every_step(folder: Path) -> None:
    """Every place in a run at which the power can go, one after the other.

    Of a file that was not synced, half is there.
    """
    small = waves((15, 24))
    axes = small.axes[0], replace(small.axes[1], values=None)
    small = replace(small, axes=axes, variables=small.variables[:2])
    small = replace(small, compute=Small())
    calm = folder / "calm.zarr"
    done(lambda: write(small, calm))
    for steps in itertools.count():
        store = folder / f"{steps}.zarr"
        code = ended(forked(lambda: write_until(small, store, steps)))  # noqa: B023
        if code == 0:
            break
        assert code == 9, f"step {steps}"
        done(lambda: write(small, store))  # noqa: B023
        assert files(store) == files(calm), f"step {steps}"
    print(f"{steps} steps")


class Small:
    """Some numbers for two variables."""

    def __call__(self, chunk: Any, threads: Any, progress: Any) -> dict[str, Any]:
        wave = np.full(chunk.shape, float(chunk.index[0]))
        return {"wave": wave, "positive": wave > 0}


def write_until(work: Work, store: Path, steps: int) -> None:
    """Write, up to the step with that number."""
    synced: set[int] = set()
    sync = os.fsync

    def step() -> None:
        nonlocal steps
        steps -= 1
        if steps < 0:
            cut_unsynced(store, synced)
            os._exit(9)

    def traced(event: str, told: tuple[Any, ...]) -> None:
        inside = event in TRACED and str(store) in map(str, told[:1])
        beneath = event in TRACED and str(told[0]).startswith(f"{store}/")
        if steps >= 0 and (inside or beneath):
            step()

    def counted(handle: int) -> None:
        step()
        sync(handle)
        synced.add(os.fstat(handle).st_ino)

    os.fsync = counted  # type: ignore[assignment]
    sys.addaudithook(traced)
    write(work, store)


def cut_unsynced(store: Path, synced: set[int]) -> None:
    for path in store.rglob("*"):
        about = path.stat()
        if path.is_file() and about.st_ino not in synced:
            os.truncate(path, about.st_size // 2)


if __name__ == "__main__":
    if sys.argv[1] == "at-random":
        at_random(Path(sys.argv[2]), int(sys.argv[3]))
    else:
        at_every_step(Path(sys.argv[2]))
