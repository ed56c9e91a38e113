"""Animations: frames at exact times, any speed, several runs, each format as it is read back."""

from __future__ import annotations

import base64
import re
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from pendula import DoublePendulum, LinearPendulum, SimplePendulum, exact, load, plot, solve
from pendula.events import flip
from pendula.plot.animation import count_frames, motions

if TYPE_CHECKING:
    from commands import Call
    from pendula import Trajectory

av = pytest.importorskip("av")
image = pytest.importorskip("PIL.Image")

RODS = DoublePendulum.rods()
WILD = (2.0, 2.5, 0.0, 0.0)
SMALL = (240, 200)
MAKERS: dict[str, Any] = {
    "linear": lambda t: solve(LinearPendulum(), (0.2, 0.0), t),
    "simple": lambda t: solve(SimplePendulum(), (3.0, 0.5), t),
    "double": lambda t: solve(RODS, WILD, t),
    "dop853": lambda t: solve(RODS, WILD, t, "dop853"),
    "rk4": lambda t: solve(RODS, WILD, t, "rk4", step=0.03),
    "exact": lambda t: exact(SimplePendulum(), (3.0, 0.5), [0.0, t]),
    "digits": lambda t: solve(SimplePendulum(), (3.0, 0.5), [0.0, t], digits=10),
}


def pictures(path: Path) -> tuple[list[Any], list[float]]:
    """The frames of a file, and the times at which they are shown [s]."""
    if path.suffix == ".gif":
        with image.open(path) as file:
            frames, times, now = [], [], 0.0
            for i in range(file.n_frames):
                file.seek(i)
                frames.append(np.asarray(file.convert("RGB")))
                times.append(now)
                now += file.info["duration"] / 1000
            return frames, times
    source: Any = str(path)
    if path.suffix == ".html":
        data = re.search(r'src="data:video/mp4;base64,([^"]+)"', path.read_text("utf-8"))
        assert data is not None
        source = BytesIO(base64.b64decode(data[1]))
    with av.open(source) as video:
        found = [(each.to_ndarray(format="rgb24"), each.time) for each in video.decode(video=0)]
    return [each for each, _ in found], [time for _, time in found]


@pytest.mark.parametrize("name", list(MAKERS))
@pytest.mark.parametrize("end", [1.3, -1.3])
def test_a_motion_is_that_of_a_run_with_outputs_at_the_frames(name: str, end: float) -> None:
    """In the bits of `solve` and `exact`, backward in time too."""
    run = MAKERS[name](end)
    times = motions.frame_times([run], 0.04, 1.0)
    np.testing.assert_allclose(times, np.sign(end) * 0.04 * np.arange(33), rtol=1e-15)
    found = motions.motion(run, times)
    asked = run.request
    if name == "exact":
        expected = exact(run.system, asked.state, times)
    else:
        options = {"step": asked.step, "digits": asked.digits}
        expected = solve(run.system, asked.state, times, run.method, **options)
    assert found.points.tobytes() == run.system.positions(expected.states).tobytes()
    assert found.kinetic.tobytes() == expected.kinetic_energy.tobytes()
    assert found.potential.tobytes() == expected.potential_energy.tobytes()


def test_frames_follow_the_speed() -> None:
    run = MAKERS["double"](2.0)
    for speed, count in ((1.0, 51), (0.25, 201), (2.0, 26), (0.3, 167)):
        times = motions.frame_times([run], 0.04, speed)
        np.testing.assert_allclose(times, 0.04 * speed * np.arange(count), rtol=1e-14)
        assert count_frames(run, "x.gif", speed=speed) == count
    assert count_frames(run, "x.mp4") == 61
    assert count_frames(run, "x.gif", fps=30) == 67  # each for 3 hundredths of a second


def test_runs_are_shown_between_their_ends() -> None:
    early = solve(RODS, WILD, 60.0, events=flip(2, terminal=True))
    late = solve(RODS, WILD, [1.0, 2.0, 4.0], t0=0.5)
    coming = solve(RODS, WILD, -1.0)
    times = motions.frame_times([early, late, coming], 0.04, 1.0)
    assert (times[0], len(times)) == (-1.0, 126)
    for run, (first, last) in (
        (early, (0.0, 2.9157546)),
        (late, (1.0, 4.0)),
        (coming, (-1.0, 0.0)),
    ):
        found = motions.motion(run, times)
        there = (times >= first - 1e-9) & (times <= last + 1e-9)
        assert (np.isfinite(found.points).all(axis=(1, 2)) == there).all()
        assert (np.isfinite(found.kinetic) == there).all()


def test_fine_times_hold_those_of_the_frames() -> None:
    times = motions.frame_times([MAKERS["double"](2.0)], 1 / 30, 0.7)
    fine = motions.finer(times, 7)
    assert fine[::7].tolist() == times.tolist()
    assert (np.diff(fine) > 0).all()


def test_a_path_is_smooth() -> None:
    """Its points are so close that no rod turns far from one to the next."""
    run = solve(SimplePendulum(length=0.1), (3.0, 30.0), 2.0)
    times = motions.frame_times([run], 0.04, 1.0)
    parts = motions.points_a_frame([run], times)
    angles = run.at(motions.finer(times, parts))[:, 0]
    assert 0.01 < np.abs(np.diff(angles)).max() <= 0.0501


@pytest.mark.parametrize("ending", ["gif", "mp4", "webm", "html"])
def test_a_file_shows_the_frames_in_true_time(tmp_path: Path, ending: str) -> None:
    run, path, told = MAKERS["double"](1.0), tmp_path / f"run.{ending}", list[float]()
    run.animate(path, size=(241, 200), progress=told.append)
    frames, times = pictures(path)
    count = count_frames(run, path)
    assert len(frames) == len(told) == count
    assert (told[-1], told) == (1.0, sorted(told))
    rate = 25 if ending == "gif" else 30
    np.testing.assert_allclose(times, np.arange(count) / rate, atol=6e-4)
    assert {each.shape for each in frames} == {(200, 242, 3)}
    assert (frames[0][-3:, :20] >= (255 if ending == "gif" else 250)).all()  # the paper
    assert (np.abs(np.diff(np.array(frames, int), axis=0)).max(axis=(1, 2, 3)) > 60).all()
    assert list(tmp_path.iterdir()) == [path]


def test_bobs_are_where_the_motion_is(tmp_path: Path) -> None:
    """The middle of all that is ink goes with the sine of the angle."""
    pendulum = SimplePendulum(length=1.0)
    run = exact(pendulum, (1.5, 0.0), [0.0, 1.0])
    scale = []
    for energy in (False, True):
        path = tmp_path / f"{energy}.gif"
        run.animate(path, energy=energy, trail=0.0, size=(400, 400))
        frames, _ = pictures(path)
        dark = [each[36:, : 250 if energy else 400].sum(axis=2) < 150 for each in frames]
        centres = np.array([np.argwhere(each).mean(axis=0) for each in dark])
        x = run.at(0.04 * np.arange(len(frames)))[:, 0]
        assert np.corrcoef(centres[:, 1], np.sin(x))[0, 1] > 0.999
        scale.append(np.ptp(centres[:, 1]))
    assert scale[0] > scale[1] > 50


def test_the_same_runs_give_the_same_bytes(tmp_path: Path) -> None:
    run = MAKERS["simple"](0.5)
    for ending in ("gif", "mp4", "webm", "html"):
        one, other = tmp_path / f"one.{ending}", tmp_path / f"other.{ending}"
        for path in (one, other):
            run.animate(path, size=SMALL)
        assert one.read_bytes() == other.read_bytes(), ending


def test_several_runs_are_drawn_over_one_another(tmp_path: Path) -> None:
    """In colours of their own, with names; from a file too."""
    a, b = MAKERS["double"](1.0), MAKERS["rk4"](1.0)
    b.save(tmp_path / "b.csv")
    plot.animate([a, load(tmp_path / "b.csv")], tmp_path / "both.gif", language="es", speed=0.5)
    frames, _ = pictures(tmp_path / "both.gif")
    orange = np.abs(frames[-1].astype(int) - [213, 94, 0]).max(axis=2) < 40
    assert orange.sum() > 200
    many = exact(SimplePendulum(), [(x, 0.0) for x in np.linspace(0.1, 3.0, 9)], [0.0, 0.5])
    many.animate(tmp_path / "many.gif", size=SMALL)
    assert len(pictures(tmp_path / "many.gif")[0]) == 13


def test_a_motion_at_rest_is_shown(tmp_path: Path) -> None:
    solve(RODS, (0.0, 0.0, 0.0, 0.0), 0.2).animate(tmp_path / "rest.gif", size=SMALL, trail=0.0)
    with image.open(tmp_path / "rest.gif") as file:
        assert file.size == SMALL


def _blown_up() -> Trajectory:
    return solve(SimplePendulum(), (1e9, 0.0), 1.0)


@pytest.mark.parametrize(
    ("runs", "path", "options", "told"),
    [
        (None, "x.avi", {}, r"must end in \.gif, \.mp4, \.webm, \.html, got 'x\.avi'"),
        (None, "x", {}, "must end in"),
        (None, "x.gif", {"speed": 0.0}, "speed must be positive, got 0.0"),
        (None, "x.gif", {"speed": float("nan")}, "speed must be a finite number"),
        (None, "x.gif", {"speed": 1e3}, "speed must give from 2 to 20000 frames, got 1 for 1 s"),
        (None, "x.gif", {"speed": 1e-4}, "speed must give from 2 to 20000 frames, got 250001"),
        (None, "x.gif", {"fps": 0}, "fps must be a whole number from 1 to 120, got 0"),
        (None, "x.gif", {"fps": 2.5}, "fps must be a whole number"),
        (None, "x.gif", {"trail": -1.0}, r"trail must not be negative \[s\], got -1.0"),
        (None, "x.gif", {"size": 300}, "size must be width and height in pixels, got 300"),
        (None, "x.gif", {"size": (300, 20)}, "size must be at least 200 pixels each way"),
        (None, "x.gif", {"size": (300, 5000)}, "size must be a whole number from 1 to 4000"),
        (None, "x.gif", {"energy": 1}, "energy must be True or False, got 1"),
        (None, "x.gif", {"names": ["a", "b"]}, "names must be one for each of the 1 motions"),
        (None, "x.gif", {"language": "de"}, "language must be one of en, es; got 'de'"),
        (None, "x.gif", {"progress": 3}, "progress must be a function"),
        ([], "x.gif", {}, "runs must be from 1 to 50 motions, got 0"),
        ([RODS], "x.gif", {}, "runs must be trajectories"),
    ],
)
def test_wrong_use_is_one_line_and_leaves_nothing(
    tmp_path: Path, runs: Any, path: str, options: dict[str, Any], told: str
) -> None:
    shown = MAKERS["simple"](1.0) if runs is None else runs
    with pytest.raises(ValueError, match=told) as caught:
        plot.animate(shown, tmp_path / path, **options)
    assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_an_existing_file_is_replaced_only_if_asked_to(tmp_path: Path) -> None:
    path = tmp_path / "x.gif"
    path.write_text("old")
    run = MAKERS["simple"](0.2)
    with pytest.raises(FileExistsError, match=r"x\.gif exists"):
        run.animate(path, size=SMALL)
    run.animate(path, size=SMALL, overwrite=True)
    assert path.read_bytes().startswith(b"GIF89a")


def test_an_interrupted_animation_leaves_nothing(tmp_path: Path) -> None:
    def stop(share: float) -> None:
        if share > 0.5:
            raise KeyboardInterrupt

    for ending in ("gif", "mp4", "webm", "html"):
        with pytest.raises(KeyboardInterrupt):
            MAKERS["simple"](0.5).animate(tmp_path / f"x.{ending}", size=SMALL, progress=stop)
    assert list(tmp_path.iterdir()) == []


# ---- the command ----


def test_the_command_animates_files_and_systems(call: Call, monkeypatch: Any) -> None:
    monkeypatch.setattr("pendula.cli.progress._MOMENT", 600.0)
    for method in ("taylor", "dop853"):
        call(f"solve simple --theta 2rad --t-max 0.4s --method {method} -o {method}.csv")
    for line, out in (
        ("taylor.csv dop853.csv", "both.gif"),
        ("files taylor.csv --speed 0.5", "slow.mp4"),
        ("simple --theta 2rad --t-max -0.4s --no-energy --trail 0s --lang es", "back.webm"),
        ("double --t-max 0.4s --method rk4 --method taylor --step 10ms --fps 20", "two.html"),
    ):
        done = call(f"animate {line} -o {out} --size 240x200")
        frames, _ = pictures(Path(out))
        assert done == (0, f"{out}: {len(frames)} frames\n", "")
    assert call("animate -o first.gif taylor.csv --size 240x200")[0] == 0


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("", "name a file of a trajectory, or a system: linear, simple, double"),
        (
            "doubel -o x.gif",
            "no file and no system 'doubel'; the systems are linear, simple, double",
        ),
        ("none.csv -o x.gif", "no such file: none.csv"),
        ("run.csv", "Missing option '-o'"),
        ("run.csv -o x.avi", "the file name must end in .gif, .mp4, .webm, .html, got 'x.avi'"),
        ("run.csv -o x.gif --speed 0", "--speed must be positive, got 0.0"),
        ("run.csv -o x.gif --fps 500", "--fps must be a whole number from 1 to 120, got 500"),
        ("run.csv -o x.gif --size 300", "--size must be width x height such as 720x600"),
        ("run.csv -o x.gif --trail 1", "x.gif"),
        ("double -o x.gif", "Missing option '--t-max'"),
        ("double -o x.gif --t-max 1s --method rk4", "--step"),
        ("double -o run.csv --t-max 1s", "must end in .gif"),
    ],
)
def test_the_command_tells_wrong_use_in_one_line(call: Call, line: str, told: str) -> None:
    call("solve simple --t-max 0.4s -o run.csv")
    code, _, error = call(f"animate {line}")
    if told == "x.gif":  # a time without a unit is one of seconds
        assert (code, error) == (0, "")
        return
    assert code == 2
    assert error.count("\n") == 1
    assert told in error
