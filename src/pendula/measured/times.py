"""Times of samples: rounded ones made again, steps of frames, gaps told, falls refused."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pendula._types import Array
    from pendula.measured.asked_of_file import Log
    from pendula.measured.tables import Table

# Frames per second of films and sensors, to which a rate found from rounded times is set.
_RATES = (23.976, 24, 25, 29.97, 30, 48, 50, 59.94, 60, 90, 100, 119.88, 120, 200, 239.76, 240)
_LONG = 3.0  # times the usual step: a gap
_UNEVEN = 0.05  # of a step: steps that differ by more are told


def falls(t: Array) -> NDArray[Any]:
    """Places at which the time is before that of the sample in front, (k,)."""
    import numpy as np

    return np.flatnonzero(np.diff(t) < 0) + 1


def stacked(t: Array) -> list[slice]:
    """The runs that stand one below the other, each with times that begin again; else one."""
    import numpy as np

    starts = [0, *falls(t).tolist()]
    ends = [*starts[1:], t.size]
    spans = [float(t[end - 1] - t[start]) for start, end in zip(starts, ends, strict=True)]
    longest = max(spans, default=0.0)
    again = [t[start] <= t[0] + 0.1 * longest for start in starts]
    whole = [end - start >= 10 for start, end in zip(starts, ends, strict=True)]
    if len(starts) < 2 or not np.all(again) or not np.all(whole):
        return [slice(0, t.size)]
    return [slice(start, end) for start, end in zip(starts, ends, strict=True)]


def check_rising(t: Array, table: Table, label: str) -> None:
    """Refuse times that fall, with the line at which they do.

    Raises:
        ArgumentError: where any does.
    """
    fallen = falls(t)
    if fallen.size:
        i = int(fallen[0])
        rule = (
            f"falls from {t[i - 1]:g} to {t[i]:g} s at {table.what} {table.lines[i]:.0f} of the "
            f"file, in {label}"
        )
        way_out = (
            "correct that line, name another column of times with <time=1>, or give the frames per "
            "second with <frame_rate=30> if they are even"
        )
        raise ArgumentError("time", rule, way_out)


def standing(t: Array, values: Array, log: Log, table: Table) -> tuple[Array, NDArray[Any]]:
    """Times that are told apart, and which samples are kept (n,), of times that may repeat.

    Printed times are rounded: frames of the same printed time follow one another evenly. Where
    even frames explain all printed times to their rounding, the times are made again of them. A
    sample that is there twice is kept once.

    Raises:
        ArgumentError: where samples that differ have the same time, and no even frames explain it.
    """
    import numpy as np

    kept = np.ones(t.size, dtype=bool)
    again = np.diff(t) == 0
    if not again.any():
        return t, kept
    rate = frame_rate_of(t)
    if rate is not None:
        log.took["frame_rate"] = rate
        made = t[0] + np.arange(t.size) / rate
        log.note(
            f"{int(again.sum())} printed times repeat the one before, as they are rounded: times "
            f"are made again from {rate:g} frames a second, at most "
            f"{np.abs(made - t).max():.2g} s from the printed ones."
        )
        return made, kept
    same = again & ((values[1:] == values[:-1]) | np.isnan(values[1:])).all(axis=1)
    if (same == again).all():
        kept[1:] = ~again
        log.note(f"{int(again.sum())} samples are there twice: each is kept once.")
        return t, kept
    i = int(np.flatnonzero(again & ~same)[0]) + 1
    rule = (
        f"stands still at {t[i]:g} s, at {table.what} {table.lines[i]:.0f} of the file, and no "
        "even frames explain it"
    )
    raise ArgumentError("time", rule, "give the frames per second with <frame_rate=30>")


def frame_rate_of(t: Array) -> float | None:
    """Frames per second of rounded times of even frames; None: they are not even.

    Each printed time bounds the frame's: within half of the last digit that is printed. The rate
    is a usual one, or a whole one, if such a one fits; else the straight line's.
    """
    import numpy as np

    frames = np.arange(t.size, dtype=np.float64)
    half = _rounding(t) / 2 * (1 + 1e-9) + 1e-12
    slope = float(np.polyfit(frames, t, 1)[0])
    if slope <= 0:
        return None
    for rate in (*_RATES, float(round(1 / slope)), 1 / slope):
        made = t[0] + frames / rate if rate > 0 else t
        off = t - made
        # the first printed time is rounded too: all may be off by as much, in the same direction
        if rate > 0 and (off - half).max() <= (off + half).min():
            return float(rate)
    return None


def _rounding(t: Array) -> Array:
    """The steps of the printed digits around each time, (n,).

    They are as fine as the longest number of a decade shows, and never coarser than those of larger
    times: programs print as many decimals for all, or as many digits.
    """
    import numpy as np

    steps = np.diff(t)
    risen = steps[steps > 0]
    if not risen.size:
        return np.full(t.size, np.inf)
    size = np.abs(t)
    decades = np.floor(np.log10(np.maximum(size, risen.min())))
    rounding, digits = np.empty(t.size), 0
    for decade in np.unique(decades)[::-1]:
        inside = decades == decade
        digits = next((d for d in range(digits, 9) if _has_digits(t[inside], d)), 9)
        rounding[inside] = 10.0**-digits
    return rounding


def _has_digits(t: Array, digits: int) -> bool:
    import numpy as np

    return bool((np.abs(np.round(t, digits) - t) <= 1e-9 * np.maximum(np.abs(t), 1)).all())


def told(t: Array, values: Array, log: Log) -> None:
    """Tell of gaps, uneven steps, missing samples and frames that repeat a value."""
    import numpy as np

    steps = np.diff(t)
    if not steps.size:
        return
    usual = float(np.median(steps))
    gaps = int((steps > _LONG * usual).sum())
    uneven = float(np.median(np.abs(steps - usual)) / usual)
    log.note(f"{t.size} samples, {t[0]:g} … {t[-1]:g} s, {1 / usual:.4g} a second.")
    if gaps:
        log.note(f"{gaps} gaps, the longest of {steps.max():.3g} s: left as they are.")
    if uneven > _UNEVEN:
        log.note(f"The steps in time differ, typically by {100 * uneven:.0f} %: left as they are.")
    missing = int(np.isnan(values).any(axis=1).sum())
    if missing:
        log.note(f"{missing} samples are missing in a column: left as they are.")
    repeated = int((np.diff(values, axis=0) == 0).all(axis=1).sum())
    if repeated > 0.02 * t.size:
        share = 100 * repeated / t.size
        log.note(f"{repeated} samples ({share:.0f} %) repeat the value before: left as they are.")
