"""Motions as moving pictures: GIF, MP4, WebM, or a page with a video."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING

from pendula._checks import checked_progress, extra, flag, one_of, positive_number, whole_number
from pendula._late_methods import method_of
from pendula._messages import ArgumentError
from pendula._progress import with_bar
from pendula._writing import replacing
from pendula.plot.animation import encoding, motions
from pendula.plot.animation.scene import Film, Scene
from pendula.plot.labels import labels
from pendula.plot.style import look
from pendula.run.trajectory import Trajectory

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from os import PathLike

    from pendula._progress import AskedProgress, Progress
    from pendula.plot.animation.scene import Picture

SIZE = (720, 600)
_SMALLEST, _LARGEST = 200, 4000  # pixels
_FASTEST = 120  # frames in a second
_TRAIL = 1.0


@method_of(Trajectory)
@with_bar("animation")
def animate(
    runs: Trajectory | Iterable[Trajectory],
    path: str | PathLike[str],
    *,
    speed: float = 1.0,
    fps: int | None = None,
    trail: float = _TRAIL,
    energy: bool = True,
    size: tuple[int, int] = SIZE,
    names: Sequence[str] | None = None,
    language: str = "en",
    overwrite: bool = False,
    progress: AskedProgress = None,
) -> None:
    """Write the motion as a moving picture, in true time or at another speed (extra: animation).

    Each frame shows the state at its exact time: from the dense output of the method, or from the
    same run with outputs at the frames. Several runs are drawn over one another, the first one
    broader; a run is not shown before it begins and after it ends.

    Args:
        runs: one trajectory, or several; one with several exact solutions counts as several.
        path: where to write; its ending chooses: .gif, .mp4, .webm, or .html, a page that holds
            the video.
        speed: seconds of the motion in a second that is watched; 1: true time.
        fps: frames in a second; None: 25 in a .gif, which shows each for a whole number of
            hundredths of a second, 30 otherwise.
        trail: how long the path behind the last bob is; 0: none [s].
        energy: whether bars show the energies, of up to 8 motions, at 320 pixels or more.
        size: width and height; an odd one becomes even [pixels].
        names: one for each motion; None: those of the methods, where they differ.
        language: "en" or "es".
        overwrite: replace an existing file.
        progress: called with the part that is done, 0 to 1; True: a bar.

    Raises:
        ValueError: for an argument out of range, or a motion too short or too long for its frames.
        FileExistsError: where the path exists and `overwrite` is not set.
        OSError: where the path cannot be written.
    """
    report: Progress = checked_progress(progress)
    target, ending = Path(path), ending_of(path)
    words = labels(language)
    encoding.check_encoder(ending)
    extra("matplotlib", "animation")
    every = _interval(ending, fps)
    shown = motions.single(runs)
    film = _film(
        shown,
        _names(shown, names, words.name),
        every=float(every),
        speed=positive_number("speed", speed),
        trail=positive_number("trail", trail, "s", zero=True),
        energy=flag("energy", energy),
        size=_size(size),
    )
    with replacing(target, overwrite=overwrite) as unfinished, look():
        scene = Scene(film, words)
        sample = [scene.draw(i) for i in encoding.sampled(len(scene))]
        encoding.write(ending, unfinished, _frames(scene, report), every, sample)


def count_frames(
    runs: Trajectory | Iterable[Trajectory],
    path: str | PathLike[str],
    *,
    speed: float = 1.0,
    fps: int | None = None,
) -> int:
    """How many frames `animate` would write.

    Raises:
        ValueError: as for `animate`.
    """
    every = float(_interval(ending_of(path), fps))
    return motions.frame_times(motions.single(runs), every, positive_number("speed", speed)).size


def _interval(ending: str, fps: int | None) -> Fraction:
    """From frame to frame [s]."""
    rate = encoding.standard_rate(ending) if fps is None else whole_number("fps", fps, _FASTEST)
    return encoding.interval(ending, rate)


def ending_of(path: str | PathLike[str]) -> str:
    """The ending of an animation's file.

    Raises:
        ValueError: for another one.
    """
    ending = Path(path).suffix.lower()
    try:
        return one_of("ending", ending, encoding.ENDINGS)
    except ValueError:
        rule = f"the file name must end in {', '.join(encoding.ENDINGS)}"
        raise ValueError(f"{rule}, got {Path(path).name!r}") from None


def _film(
    runs: list[Trajectory],
    names: tuple[str, ...],
    *,
    every: float,
    speed: float,
    trail: float,
    energy: bool,
    size: tuple[int, int],
) -> Film:
    """The motions at all times that are drawn."""
    times = motions.frame_times(runs, every, speed)
    parts = motions.points_a_frame(runs, times)
    fine = motions.finer(times, parts)
    behind = trail / (every * speed) * parts
    return Film(
        motions=[motions.motion(run, fine) for run in runs],
        names=names,
        times=times,
        parts=parts,
        trail=min(math.ceil(behind), fine.size) if math.isfinite(behind) else fine.size,
        speed=speed,
        energy=energy,
        size=size,
    )


def _frames(scene: Scene, progress: Progress) -> Iterator[Picture]:
    for frame in range(len(scene)):
        yield scene.draw(frame)
        if progress is not None:
            progress((frame + 1) / len(scene))


def _names(
    runs: list[Trajectory], names: Sequence[str] | None, name_of: Callable[[str], str]
) -> tuple[str, ...]:
    """What the motions are called; one alone needs no name."""
    if names is not None:
        given = (names,) if isinstance(names, str) else tuple(map(str, names))
        if len(given) != len(runs):
            rule = "must be one for each of the {count} motions, got {value}"
            raise ArgumentError("names", rule, count=len(runs), value=given)
        return given
    methods = [run.method for run in runs]
    if len(runs) == 1 or len(set(methods)) < len(runs):
        return ()
    return tuple(name_of(method) for method in methods)


def _size(size: object) -> tuple[int, int]:
    """Width and height, even as video has to be."""
    given = tuple(size) if isinstance(size, tuple | list) else ()
    if len(given) != 2:
        rule = "must be width and height in pixels, got {value}"
        raise ArgumentError("size", rule, value=size)
    found = [whole_number("size", each, _LARGEST) for each in given]
    if min(found) < _SMALLEST:
        rule = "must be at least {least} pixels each way, got {value}"
        raise ArgumentError("size", rule, least=_SMALLEST, value=tuple(found))
    return found[0] + found[0] % 2, found[1] + found[1] % 2
