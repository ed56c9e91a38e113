"""Video analyses as Tracker saves them: .trk files, and the ways it names its tracks."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING
from xml.etree import ElementTree

from pendula._messages import ArgumentError
from pendula.measured.tables import Table, table_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from pendula._types import Array

_PLACE = re.compile(r"\[(\d+)\]")
_COORDINATES = "ImageCoordSystem"


def tracker_table(data: bytes) -> Table:
    """The marked points of a .trk file, in its own axes and scale, y up.

    Tracker keeps pixels, y down, and the axes' origin, angle and scale. A point marked in one frame
    only stands still; it is told, and left out.

    Raises:
        ArgumentError: for a file that is damaged, or marks no point that moves.
    """
    try:
        root = ElementTree.fromstring(data)
    except ElementTree.ParseError as error:
        raise ArgumentError("path", "is no whole .trk file: {text}", text=str(error)) from None
    axes = next((each for each in _objects(root, _COORDINATES) if _of(each, "framedata")), None)
    tracks = [(_text(each, "name"), _points(each)) for each in _objects(root, "PointMass")]
    moving = [(name, points) for name, points in tracks if len(points) > 1]
    if not moving:
        rule = "marks no point in more than one frame"
        raise ArgumentError("path", rule, "mark the bob in Tracker, and save")
    notes = [f"Tracker's {name!r} is marked in one frame only: left out." for name, points in tracks
             if len(points) == 1]  # fmt: skip
    return _table(root, axes, moving, notes)


def _table(
    root: ElementTree.Element,
    axes: ElementTree.Element | None,
    tracks: list[tuple[str, dict[int, tuple[float, float]]]],
    notes: list[str],
) -> Table:
    """The points at each frame in which any is marked."""
    import numpy as np

    frames = sorted({frame for _, points in tracks for frame in points})
    step, first = _frame_time(root)
    times = np.array([step * (frame - first) for frame in frames])
    unit = _text(root, "length_unit") or "m"
    labels, values, groups = ["t (s)"], [times], [""]
    scaled = False
    for name, points in tracks:
        pixels = np.array([points.get(frame, (math.nan, math.nan)) for frame in frames])
        x, y, scaled = _in_axes(pixels, axes, frames)
        labels += [f"x ({unit if scaled else 'px'})", f"y ({unit if scaled else 'px'})"]
        values += [x, y]
        groups += [name, name]
    said = f"scale and origin as the file keeps them, lengths in {unit}" if scaled else "no scale"
    notes += [f"Tracker's axes: {said}, y up; {step:.6g} s from frame to frame."]
    lines = np.array(frames, dtype=np.float64)
    return table_of("", labels, values, groups=groups, lines=lines, notes=notes, what="frame")


def _in_axes(
    pixels: Array, axes: ElementTree.Element | None, frames: list[int]
) -> tuple[Array, Array, bool]:
    """Points in the axes of the frame each is in, y up, and whether there is a scale."""
    import numpy as np

    kept = [] if axes is None else sorted(_items(axes, "framedata"))
    if not kept:
        return pixels[:, 0], -pixels[:, 1], False
    rows = [[_number(each, name, fallback) for name, fallback in _AXES] for _, each in kept]
    at = np.searchsorted([frame for frame, _ in kept], frames, side="right") - 1
    origin_x, origin_y, angle, scale_x, scale_y = np.array(rows)[np.maximum(at, 0)].T
    right, up = pixels[:, 0] - origin_x, origin_y - pixels[:, 1]
    cosine, sine = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    x, y = right * cosine + up * sine, up * cosine - right * sine
    return x / scale_x, y / scale_y, bool((scale_x != 1.0).any())


_AXES = (("xorigin", 0.0), ("yorigin", 0.0), ("angle", 0.0), ("xscale", 1.0), ("yscale", 1.0))


def _frame_time(root: ElementTree.Element) -> tuple[float, int]:
    """Seconds from frame to frame, and the frame at which time is 0."""
    control = next(_objects(root, "StepperClipControl"), None)
    milliseconds = 0.0 if control is None else _number(control, "delta_t", 0.0)
    clip = next(_objects(root, "VideoClip"), None)
    first = 0 if clip is None else int(_number(clip, "startframe", 0.0))
    if milliseconds <= 0.0:
        rate = next((float(each) for each in _texts(root, "frame_rate")), 0.0)
        if rate <= 0.0:
            rule = "does not say how long a frame lasts"
            raise ArgumentError("path", rule, "set the frame rate in Tracker's clip settings")
        milliseconds = 1000.0 / rate
    return milliseconds / 1000.0, first


def _points(track: ElementTree.Element) -> dict[int, tuple[float, float]]:
    """The pixels of a track by frame."""
    points = {}
    for frame, each in _items(track, "framedata"):
        x, y = _number(each, "x", math.nan), _number(each, "y", math.nan)
        points[frame] = (x, y)
    return points


def _objects(root: ElementTree.Element, kind: str) -> Iterator[ElementTree.Element]:
    """The objects of a class, by the end of its name."""
    for each in root.iter("object"):
        if each.get("class", "").endswith("." + kind):
            yield each


def _of(parent: ElementTree.Element, name: str) -> ElementTree.Element | None:
    """A property of an object, by its name; None: it has none, or an empty one."""
    for each in parent.findall("property"):
        if each.get("name") == name and (len(each) or (each.text or "").strip()):
            return each
    return None


def _items(parent: ElementTree.Element, name: str) -> Iterator[tuple[int, ElementTree.Element]]:
    """The entries of an array of objects, by their places."""
    for each in _of(parent, name) or ():
        place = _PLACE.fullmatch(each.get("name", ""))
        inner = each.find("object")
        if place and inner is not None:
            yield int(place[1]), inner


def _text(parent: ElementTree.Element, name: str) -> str:
    found = _of(parent, name)
    return "" if found is None else (found.text or "").strip()


def _texts(root: ElementTree.Element, name: str) -> Iterator[str]:
    for each in root.iter("property"):
        if each.get("name") == name and each.text:
            yield each.text


def _number(parent: ElementTree.Element, name: str, fallback: float) -> float:
    text = _text(parent, name)
    return float(text) if text else fallback
