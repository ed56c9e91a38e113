"""Frames to files: GIF by Pillow, MP4 and WebM by the FFmpeg inside PyAV, a page with a video."""

from __future__ import annotations

import base64
from fractions import Fraction
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._checks import extra

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from pendula.plot.animation.scene import Picture

ENDINGS = (".gif", ".mp4", ".webm", ".html")
_EXTRA = "animation"
_TICKS = 100  # in a second, in which a GIF counts
_WHITE = 246  # and more of each colour is white
_SAMPLES = 8  # frames that a GIF's colours are taken from
_VIDEO: dict[str, tuple[str, dict[str, str]]] = {  # codec, and its options
    "mp4": ("libx264", {"crf": "18", "preset": "medium"}),
    "webm": ("libvpx-vp9", {"crf": "24", "b": "0", "cpu-used": "4"}),
}


def standard_rate(ending: str) -> int:
    """Frames in a second, where none are asked for."""
    return 25 if ending == ".gif" else 30


def interval(ending: str, rate: int) -> Fraction:
    """From frame to frame [s]; that of a GIF is a whole number of hundredths."""
    if ending == ".gif":
        return Fraction(max(2, round(_TICKS / rate)), _TICKS)  # browsers slow shorter ones down
    return Fraction(1, rate)


def check_encoder(ending: str) -> None:
    """Refuse, before long work, what there is no encoder for.

    Raises:
        MissingExtraError: where its package is not installed.
    """
    extra("PIL.Image" if ending == ".gif" else "av", _EXTRA)


def write(
    ending: str, path: Path, frames: Iterator[Picture], every: Fraction, sample: list[Picture]
) -> None:
    """Write frames, so long from one to the next.

    Args:
        ending: of the file's name: what is written.
        path: where.
        frames: (height, width, 3) each, in order.
        every: from frame to frame [s].
        sample: some frames, for the colours of a GIF.
    """
    if ending == ".gif":
        _write_gif(path, frames, every, sample)
    elif ending == ".html":
        video = BytesIO()
        _write_video("mp4", video, frames, every)
        path.write_text(_page(video.getvalue(), sample[0]), encoding="utf-8")
    else:
        with path.open("wb") as file:
            _write_video(ending[1:], file, frames, every)


def sampled(count: int) -> list[int]:
    """Which of so many frames a GIF's colours are taken from."""
    return sorted({round(i) for i in np.linspace(0, count - 1, _SAMPLES)})


def _write_gif(
    path: Path, frames: Iterator[Picture], every: Fraction, sample: list[Picture]
) -> None:
    image = extra("PIL.Image", _EXTRA)
    found = np.array(image.fromarray(np.concatenate(sample)).quantize(256).getpalette("RGB"))
    found = found.reshape(-1, 3)
    found[(found > _WHITE).all(axis=1)] = 255  # the paper stays white
    colours = image.new("P", (1, 1))
    colours.putpalette(found.ravel().tolist())
    indexed = (
        image.fromarray(each).quantize(palette=colours, dither=image.Dither.NONE) for each in frames
    )
    first = next(indexed)
    milliseconds = int(every * 1000)
    moving = {"save_all": True, "append_images": indexed, "duration": milliseconds, "loop": 0}
    with path.open("wb") as file:
        first.save(file, format="GIF", **moving)


def _write_video(kind: str, file: Any, frames: Iterator[Picture], every: Fraction) -> None:
    """One thread encodes, and colours are ours, so that the same frames give the same bytes."""
    av = extra("av", _EXTRA)
    codec, options = _VIDEO[kind]
    with av.open(file, "w", format=kind, options={"fflags": "+bitexact"}) as video:
        stream = None
        for each in frames:
            if stream is None:
                stream = video.add_stream(codec, rate=1 / every, options=options)
                stream.height, stream.width = each.shape[:2]
                stream.pix_fmt = "yuv420p"
                stream.codec_context.thread_count = 1
            for packet in stream.encode(
                av.VideoFrame.from_ndarray(_planes(each), format="yuv420p")
            ):
                video.mux(packet)
        if stream is not None:
            for packet in stream.encode():
                video.mux(packet)


# Luminance and two colour differences of red, green and blue, 0 to 255: ITU-R BT.601-7, 2.5.
_PARTS = (
    np.array([[65.738, 129.057, 25.064], [-37.945, -74.494, 112.439], [112.439, -94.154, -18.285]])
    / 256
)
_ZEROS = 16.0, 128.0, 128.0


def _planes(picture: Picture) -> Picture:
    """A picture as video holds it, the colour of four pixels together, (3 height / 2, width).

    FFmpeg's own conversion gave other bits once in a hundred videos.
    """
    height, width, _ = picture.shape
    colour = picture.astype(np.float64)
    four = colour.reshape(height // 2, 2, width // 2, 2, 3).mean(axis=(1, 3))
    planes = (colour, four, four)
    bytes_of = [
        np.rint(zero + plane @ part).astype(np.uint8).ravel()
        for plane, part, zero in zip(planes, _PARTS, _ZEROS, strict=True)
    ]
    return np.concatenate(bytes_of).reshape(height * 3 // 2, width)


def _page(video: bytes, first: Picture) -> str:
    """A page that holds the video: nothing else has to be there to watch it."""
    height, width = first.shape[:2]
    data = base64.b64encode(video).decode()
    return (
        '<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n<title>Pendula</title>\n'
        '<meta name="viewport" content="width=device-width">\n'
        "<style>body { margin: 0; display: grid; place-items: center; min-height: 100vh } "
        "video { max-width: 100%; height: auto }</style>\n"
        f'<video controls loop autoplay muted playsinline width="{width}" height="{height}" '
        f'src="data:video/mp4;base64,{data}"></video>\n</html>\n'
    )
