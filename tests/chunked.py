"""A small work in chunks, and what a store holds."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from pendula.chunks import Axis, Chunk, Variable, Work

PAIR = ("x", "y")


@dataclass(frozen=True)
class Waves:
    """cos x cos 2y, not there (NaN) in one quarter; each chunk takes its time."""

    scale: float = 1.0
    seconds: float = 0.0
    log: Path | None = None

    def __call__(self, chunk: Chunk, threads: int | None, progress: Any) -> dict[str, Any]:
        if self.log is not None:
            with self.log.open("a", encoding="utf-8") as file:
                file.write(f"{chunk.index} {os.getpid()}\n")
        time.sleep(self.seconds)
        if progress is not None:
            progress(0.5)
        x, y = (centres(n, chunk[name]) for name, n in zip(PAIR, (30, 24), strict=True))
        wave = self.scale * np.cos(x)[:, np.newaxis] * np.cos(2 * y)
        return {
            "wave": np.where(x[:, np.newaxis] * y > 2.0, np.nan, wave),
            "positive": wave > 0,
            "moments": np.stack([wave, wave**2, wave**3]).astype(np.float32),
        }


def centres(n: int, part: slice) -> Any:
    return (np.arange(n)[part] - (n - 1) / 2) / n * 6


def waves(chunk: tuple[int, int] = (7, 5), **told: Any) -> Work:
    """30 × 24 cells in chunks that do not divide them."""
    made = Waves(**told)
    return Work(
        inputs={"pendula": "0", "scale": made.scale, "part": {"of": [1, 2.5], "rest": None}},
        axes=(
            Axis("x", 30, chunk[0], centres(30, slice(None)), {"units": "rad"}),
            Axis("y", 24, chunk[1], centres(24, slice(None)), {"units": "rad"}),
            Axis("power", 3, None, np.arange(1, 4)),
        ),
        variables=(
            Variable("wave", PAIR, "float64", float("nan"), {"units": "m", "long_name": "wave"}),
            Variable("positive", PAIR, "bool", False),
            Variable("moments", ("power", *PAIR), "float32", 0.0, {"units": "1"}),
        ),
        compute=made,
        attrs={"title": "waves", "ü": "ü"},
    )


def files(store: Path) -> dict[str, bytes]:
    """All that is there, hidden files included."""
    return {
        str(path.relative_to(store)): path.read_bytes()
        for path in sorted(store.rglob("*"))
        if path.is_file()
    }


def mirrored(work: Work) -> Work:
    return replace(work, mirrored=True)


def chunks_in(log: Path) -> int:
    return len(log.read_text(encoding="utf-8").splitlines()) if log.exists() else 0
