"""Events in words: those asked for with --event, and what was found of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._checks import LARGEST_COUNT, whole_number
from pendula.cli.tables import digits_of, table

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from pendula.run.events import Event
    from pendula.run.trajectory import Trajectory

EXAMPLES = "'flip 1', 'angle 1 0deg rising', 'velocity-zero 2' or 'tip-height 50cm falling end'"
_NAME = "--event"
_DIRECTIONS = {"rising": 1, "falling": -1}
_END, _EVERY_TURN = "end", "every-turn"
_SHOWN = 100  # most crossings of an event that are printed


def event_of(text: str) -> Event:
    """The event that words such as "angle 1 0deg rising end" ask for.

    The kind and its rod and value; then, in any order, rising or falling, every-turn (of an angle),
    and end, perhaps with a number: so many of them end the run.

    Raises:
        ValueError: for other words.
    """
    from pendula.run import events

    words = text.split()
    kind = words.pop(0) if words else ""
    makers: dict[str, Callable[..., Event]] = {
        "flip": lambda *how: events.flip(_rod(words, text), *how),
        "angle": lambda *how: events.angle(
            _rod(words, text), _value(words, "rad", text), *how, every_turn=every_turn
        ),
        "velocity-zero": lambda *how: events.velocity_zero(_rod(words, text), *how),
        "tip-height": lambda *how: events.tip_height(_value(words, "m", text), *how),
    }
    if kind not in makers:
        raise _misread(text)
    terminal = _taken_end(words, text)
    every_turn = kind == "angle" and _taken(words, _EVERY_TURN)
    direction = sum(sign for word, sign in _DIRECTIONS.items() if _taken(words, word))
    event = makers[kind](direction, terminal)
    if words:
        raise _misread(text)
    return event


def words_of(event: Event) -> str:
    """The event as `event_of` reads it, angles in radians."""
    kind = event.kind.replace("_", "-")
    unit = {"angle": "rad", "tip_height": "m"}.get(event.kind)
    value = unit and repr(event.value).removesuffix(".0") + unit
    turns = event.every_turn
    if event.kind == "angle" and turns and event.value == math.pi:
        kind, value, turns = "flip", None, False
    words = [kind, event.index or None, value, _EVERY_TURN if turns else None]
    words += [word for word, sign in _DIRECTIONS.items() if sign == event.direction]
    words += [_END if event.terminal else None, event.terminal if event.terminal > 1 else None]
    return " ".join(str(word) for word in words if word is not None)


def found(run: Trajectory) -> str:
    """Each event with a table of its crossings; of very many the first, and how many there are."""
    components = _engine.system_entries()[run.system.name].components
    header = ["n", "t [s]", *(f"{row.name}\n[{row.unit}]" for row in components)]
    digits = digits_of(len(components))
    parts: list[str] = []
    for event, (times, states) in zip(run.request.events, run.events, strict=True):
        rows = [
            [str(i + 1), f"{times[i]:.10g}", *(f"{each:.{digits}g}" for each in state)]
            for i, state in enumerate(states[:_SHOWN])
        ]
        count = f"{len(times)} time{'' if len(times) == 1 else 's'}" if rows else "none"
        name = words_of(event)
        parts.append(f"{name}: {count}")
        parts += [table(header, rows)] if rows else []
        if len(times) > _SHOWN:
            parts.append(f"{_SHOWN} of {len(times)} shown; --events-file FILE writes all")
    return "\n".join(parts)


def check_events_file(given: dict[str, Any]) -> Path | None:
    """The file for all crossings; refuses before a long run what cannot be written.

    Raises:
        ValueError: for an unknown ending, the run's own file, or no event to write.
        OSError: where the file exists without --force, or cannot be written.
    """
    from pathlib import Path

    from pendula.io.rows import check_rows_target

    if given["events_file"] is None:
        return None
    path = Path(given["events_file"])
    if not given["events"]:
        raise ValueError("--events-file needs events to write; name one with --event 'flip 1', say")
    if given["out"] is not None and path.resolve() == Path(given["out"]).resolve():
        raise ValueError(f"--events-file must differ from --output, got {str(path)!r} for both")
    check_rows_target(path, overwrite=given["force"])
    return path


def write_found(run: Trajectory, path: Path, *, force: bool) -> None:
    """Write all crossings, a row each, with the run they are of."""
    from pendula._attributes import KEY
    from pendula._version import __version__
    from pendula.io.rows import write_rows

    columns: dict[str, list[Any]] = {name: [] for name in ("event", "n", *_columns(run))}
    for event, (times, states) in zip(run.request.events, run.events, strict=True):
        numbers = range(1, len(times) + 1)
        names = [words_of(event)] * len(times)
        parts = names, numbers, times.tolist(), *states.T.tolist()
        for column, part in zip(columns.values(), parts, strict=True):
            column.extend(part)
    attributes = {
        KEY: __version__,
        "system": run.system.description(),
        "method": run.method,
        "state": run.request.state.tolist(),
        "t0": run.request.t0,
        "reached": run.reached,
        "outcome": run.outcome,
    }
    write_rows(columns, attributes, path, overwrite=force)


def _columns(run: Trajectory) -> list[str]:
    components = _engine.system_entries()[run.system.name].components
    return ["t [s]", *(f"{row.name} [{row.unit}]" for row in components)]


def _rod(words: list[str], text: str) -> int:
    try:
        return int(words.pop(0))
    except (IndexError, ValueError):
        raise _misread(text) from None


def _value(words: list[str], unit: str, text: str) -> float:
    from pendula.units import quantity

    given = " ".join(words)
    words.clear()
    if not given:
        raise _misread(text)
    return quantity(given, unit, _NAME)


def _taken(words: list[str], word: str) -> bool:
    if word not in words:
        return False
    words.remove(word)
    return True


def _taken_end(words: list[str], text: str) -> int:
    """0: does not end the run; n: the nth does."""
    if _END not in words:
        return 0
    place = words.index(_END)
    del words[place]
    if place == len(words) or not words[place].isdigit():
        return 1
    return whole_number(f"{_NAME}: the number after end", int(words.pop(place)), LARGEST_COUNT)


def _misread(text: str) -> ValueError:
    return ValueError(f"{_NAME} must be such as {EXAMPLES}, got {text!r}")
