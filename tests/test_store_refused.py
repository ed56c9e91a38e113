"""What a store refuses, a full disk, and the order in which files become there."""

import errno
import os
import resource
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import portalocker
import pytest
import zarr

from chunked import chunks_in, files, waves
from pendula.chunks import opened, run
from pendula.many.chunks.places import Folder
from pendula.many.chunks.store import first_difference


@pytest.mark.parametrize(
    ("recipe", "message"),
    [
        ({"scale": 2.0}, "scale is 1.0 there and 2.0 here"),
        ({"part": {"of": [1, 2.25], "rest": None}}, r"part.of\[1\] is 2.5 there and 2.25 here"),
        ({"part": {"of": [1]}}, r"part.of is \[1, 2.5\] there and \[1\] here"),
        ({"part": {"of": [1, 2.5]}}, "part.rest is null there and missing here"),
        ({"new": True}, "new is missing there and true here"),
        ({"pendula": "1"}, 'pendula is "0" there and "1" here'),
    ],
)
def test_a_store_of_another_recipe_is_refused(
    recipe: dict[str, Any], message: str, undisturbed: Path
) -> None:
    before, work = files(undisturbed), waves()
    with pytest.raises(ValueError, match=f"holds another computation: {message}; choose") as error:
        run(replace(work, inputs={**work.inputs, **recipe}), undisturbed)
    assert "\n" not in str(error.value)
    assert files(undisturbed) == before


def test_chunks_of_another_size_are_another_store(undisturbed: Path) -> None:
    with pytest.raises(ValueError, match=r"chunks\.y is 5 there and 6 here"):
        run(waves((7, 6)), undisturbed)


def test_the_same_numbers_are_the_same_recipe() -> None:
    assert first_difference({"a": [1, {"b": 2.5}]}, {"a": [1, {"b": 2.5}]}) is None
    assert first_difference({"a": 1}, {"a": True}) == ("a", "1", "true")
    assert first_difference([1], {"a": 1}) == ("the identity", "[1]", '{"a": 1}')


@pytest.mark.parametrize("overwrite", [False, True])
def test_what_is_not_a_store_stays(overwrite: bool, tmp_path: Path) -> None:
    """Asked to overwrite or not: it might be anything."""
    folder, file, group = (tmp_path / name for name in ("folder", "file", "group"))
    folder.mkdir()
    (folder / "thesis.tex").write_text("years", encoding="utf-8")
    file.write_text("years", encoding="utf-8")
    zarr.create_group(group, attributes={"mine": 1})
    for path in (folder, file, group):
        with pytest.raises(FileExistsError, match=f"{path.name}.*choose another name"):
            run(waves(), path, overwrite=overwrite)
    assert (folder / "thesis.tex").read_text(encoding="utf-8") == "years"
    assert file.read_text(encoding="utf-8") == "years"
    assert list(files(folder)) == ["thesis.tex"]


def test_a_store_is_started_again_when_asked(undisturbed: Path, tmp_path: Path) -> None:
    store = tmp_path / "w.zarr"
    run(waves((9, 9), scale=2.0), store)
    with pytest.raises(FileExistsError, match="pass resume=True to resume it"):
        run(waves((9, 9), scale=2.0), store, resume=False)
    run(waves(), store, overwrite=True)
    assert files(store) == files(undisturbed)


def test_an_old_store_is_what_it_says_until_it_is_empty(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Or the chunks of one recipe, of the same size, would be taken for those of another."""

    def stop(self: Folder, kept: str) -> None:
        raise KeyboardInterrupt

    store, other = tmp_path / "w.zarr", replace(waves(scale=2.0), inputs={"scale": 2.0})
    run(other, store)
    monkeypatch.setattr(Folder, "clear", stop)
    with pytest.raises(KeyboardInterrupt):
        run(waves(), store, overwrite=True)
    with pytest.raises(ValueError, match="holds another computation"):
        run(waves(), store)


def test_nowhere_to_write_is_told(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"cannot write .*no/w\.zarr: .*is not a folder"):
        run(waves(), tmp_path / "no/w.zarr")


def test_two_runs_do_not_write_one_store(tmp_path: Path) -> None:
    store = tmp_path / "w.zarr"
    code = (
        "import sys; from chunked import waves; from pendula.chunks import run\n"
        "run(waves(seconds=60), sys.argv[1], progress=lambda _: print('on', flush=True))"
    )
    here = Path(__file__).parent
    with subprocess.Popen(
        [sys.executable, "-c", code, store], cwd=here, stdout=subprocess.PIPE
    ) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == b"on\n"
        with pytest.raises(BlockingIOError, match=r"another process is writing .*w\.zarr; wait"):
            run(waves(), store)
        other.kill()
    run(waves(), store)
    assert "unfinished" not in opened(store).attrs


def test_a_store_is_written_where_there_is_neither_fcntl_nor_an_open_folder(tmp_path: Path) -> None:
    """As on Windows: the lock is a file beside, held by another module, and gone at the end."""
    code = (
        "import os, sys, portalocker\n"
        "del os.O_DIRECTORY; sys.modules['fcntl'] = None\n"
        "from chunked import waves; from pendula.chunks import run\n"
        "def on(share):\n"
        "    assert os.listdir(os.path.dirname(sys.argv[1])).count('.w.zarr.lock') == 1\n"
        "    try: run(waves(), sys.argv[1])\n"
        "    except BlockingIOError as error: assert 'another process is writing' in str(error)\n"
        "    else: raise AssertionError('two writers')\n"
        "run(waves(), sys.argv[1], progress=on)\n"
        "run(waves(), sys.argv[1])\n"
    )
    store = tmp_path / "w.zarr"
    subprocess.run(
        [sys.executable, "-c", code, store], cwd=Path(__file__).parent, check=True, timeout=60
    )
    assert [path.name for path in tmp_path.iterdir()] == ["w.zarr"]
    assert "unfinished" not in opened(store).attrs


@pytest.mark.parametrize("number", [errno.ENOLCK, errno.ENOSYS])
def test_a_disk_without_locks_is_written_without(
    number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def none(handle: int, how: int) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(portalocker.portalocker, "LOCKER", none)
    with Folder(tmp_path).locked():
        pass


def test_a_lock_that_fails_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def none(handle: int, how: int) -> None:
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    monkeypatch.setattr(portalocker.portalocker, "LOCKER", none)
    with (
        pytest.raises(OSError, match="cannot lock .*Input/output error"),
        Folder(tmp_path).locked(),
    ):
        pass


def test_a_lock_ends_though_a_process_just_forked_holds_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    lock, copies = portalocker.portalocker.LOCKER, list[int]()

    def shared(handle: int, how: int) -> None:
        copies.append(os.dup(handle))  # as a fork does
        lock(handle, how)  # type: ignore[operator,call-arg]

    monkeypatch.setattr(portalocker.portalocker, "LOCKER", shared)
    for _ in range(2):
        with Folder(tmp_path).locked():
            pass
    for each in copies:
        os.close(each)


# ---- a full disk ----


def test_a_full_disk_keeps_what_is_complete(
    undisturbed: Path, tmp_path: Path, counted: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store, sync, left = tmp_path / "w.zarr", os.fsync, 60

    def full(handle: int) -> None:
        nonlocal left
        left -= 1
        if left < 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        sync(handle)

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        with pytest.raises(OSError, match=r"cannot write .*/c\..*: No space left.*make room") as e:
            run(waves(log=counted), store)
    assert e.value.errno == errno.ENOSPC
    assert not [key for key in files(store) if ".part" in key]
    complete = len(list(store.glob("moments/c.*")))
    run(waves(log=counted), store)
    assert chunks_in(counted) == 25 + 1
    assert 0 < complete < 25
    assert files(store) == files(undisturbed)


def test_a_file_that_may_not_grow_is_told(tmp_path: Path) -> None:
    """As the system says it: by a limit for files, which a chunk passes."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    place = Folder(tmp_path)
    place.write("wave", b"0" * 100)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, hard))
    try:
        with pytest.raises(OSError, match=r"cannot write .*wave: File too large; complete chunks"):
            place.write("wave", b"1" * 2000)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert files(tmp_path) == {"wave": b"0" * 100}


# ---- what is synced when ----


def test_a_file_is_synced_before_it_is_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The data, then the name, then the folder: a power cut leaves nothing half there."""
    seen: list[str] = []
    sync, replace_file = os.fsync, Path.replace

    def synced(handle: int) -> None:
        path = Path(os.readlink(f"/proc/self/fd/{handle}"))
        seen.append(f"sync {path.relative_to(tmp_path)}")
        sync(handle)

    def replaced(self: Path, target: Path) -> Path:
        assert self.stat().st_size == 3
        seen.append(f"{self.relative_to(tmp_path)} -> {target.relative_to(tmp_path)}")
        return replace_file(self, target)

    monkeypatch.setattr(os, "fsync", synced)
    monkeypatch.setattr(Path, "replace", replaced)
    Folder(tmp_path).write("wave/c.0", b"abc")
    assert seen == [
        "sync .",
        "sync wave/.c.0.part",
        "wave/.c.0.part -> wave/c.0",
        "sync wave",
    ]
