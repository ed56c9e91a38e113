"""What a work has to be, and one that is its own mirror image."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from chunked import PAIR, Waves, centres, files, mirrored, waves
from pendula.chunks import Axis, Chunk, Variable, Work, computed, run


class Even:
    """cos x cos y: the same when both are turned round; which chunks were asked for."""

    def __init__(self) -> None:
        self.asked: list[Any] = []

    def __call__(self, chunk: Chunk, threads: int | None, progress: Any) -> dict[str, Any]:
        self.asked.append(chunk.index)
        x, y = (np.cos(centres(24, chunk[name])) for name in PAIR)
        return {"wave": x[:, np.newaxis] * y}


def even(compute: Even, chunk: int = 8) -> Work:
    axes = tuple(Axis(name, 24, chunk) for name in PAIR)
    return Work({"even": chunk}, axes, (Variable("wave", PAIR, "float64", np.nan),), compute)


def test_a_mirrored_work_is_half_the_work(tmp_path: Path) -> None:
    half, all_of_it, parts = Even(), Even(), list[float]()
    work = mirrored(even(half))
    xr.testing.assert_identical(run(work, progress=parts.append), run(even(all_of_it)))
    assert len(half.asked) == 5
    assert len(all_of_it.asked) == 9
    assert parts == sorted(parts)
    assert parts[-1] == 1.0
    run(work, tmp_path / "half.zarr")
    run(even(all_of_it), tmp_path / "all.zarr")
    assert files(tmp_path / "half.zarr") == files(tmp_path / "all.zarr")
    (tmp_path / "half.zarr/wave/c.2.1").unlink()
    half.asked.clear()
    run(work, tmp_path / "half.zarr")
    assert half.asked == [(2, 1)]
    assert files(tmp_path / "half.zarr") == files(tmp_path / "all.zarr")


# ---- what a work has to be ----


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"axes": (Axis("x", 3),)}, "needs a cut axis"),
        ({"variables": ()}, "needs a cut axis and variables"),
        ({"axes": (Axis("x", 0, 1),)}, "axis x must have a size"),
        ({"axes": (Axis("x", 3, 1, np.zeros(2)),)}, "axis x must have values of shape"),
        ({"axes": (Axis("x", 3, 2),), "mirrored": True}, "mirrored chunks must divide"),
        ({"variables": (Variable("a", ("t",), "bool", 0),)}, "a must have the cut axes"),
    ],
)
def test_a_work_that_cannot_be_is_refused(given: dict[str, Any], message: str) -> None:
    good = {"axes": (Axis("x", 3, 1),), "variables": (Variable("a", ("x",), "bool", 0),)}
    with pytest.raises(ValueError, match=message):
        Work(inputs={}, compute=Waves(), **{**good, **given})


@pytest.mark.parametrize("wrong", [np.zeros((3, 24)), np.zeros((30, 24), bool), None])
def test_a_chunk_that_is_not_what_was_told_is_refused(wrong: Any) -> None:
    class Wrong(Waves):
        def __call__(self, chunk: Chunk, threads: Any, progress: Any) -> dict[str, Any]:
            made = super().__call__(chunk, threads, progress)
            return made | {"wave": wrong} if wrong is not None else {"wave": made["wave"]}

    with pytest.raises(ValueError, match=r"chunk \(0, 0\) must be"):
        list(computed(replace(waves((30, 24)), compute=Wrong())))


@pytest.mark.parametrize("threads", [0, 1.5, True, 2000])
def test_threads_are_a_whole_number(threads: Any) -> None:
    with pytest.raises(ValueError, match="threads must be a whole number"):
        run(waves(), threads=threads)
