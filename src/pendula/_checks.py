"""One clear line for a bad value: the argument, the rule, the value, the way out."""

from __future__ import annotations

import importlib.util
import json
import math
import operator
import os
from typing import TYPE_CHECKING, Any

from pendula._given import doubles, plain
from pendula._messages import ArgumentError, meant
from pendula._rules import broken

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import ArrayLike

    from pendula._given import Units
    from pendula._types import Array

MOST_THREADS = 1024
LARGEST_COUNT = 2**53  # whole numbers are exact in a double up to here
_FEW = 8  # numbers that are looked at sooner one by one than by numpy


class MissingExtraError(ImportError):
    """A part of pendula needs packages that the base install leaves out."""


def extra(module: str, name: str) -> Any:
    """Import `module`, or say which extra brings it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise _missing(module, name) from error


def installed(module: str, name: str) -> None:
    """Refuse, as `extra`, a module that is not there, without importing it: that takes seconds."""
    if importlib.util.find_spec(module) is None:
        raise _missing(module, name)


def _missing(module: str, name: str) -> MissingExtraError:
    package = module.partition(".")[0]
    return MissingExtraError(f"{package} is not installed; {how_to_install(name)}")


def how_to_install(name: str) -> str:
    """What brings an extra: pendula is in no registry, pip notes the clone that it came from."""
    from importlib.metadata import PackageNotFoundError, distribution
    from urllib.parse import urlsplit
    from urllib.request import url2pathname

    try:
        noted = json.loads(distribution("pendula").read_text("direct_url.json") or "{}")
    except PackageNotFoundError:
        noted = {}
    url = urlsplit(noted.get("url", ""))
    if url.scheme == "file":
        return f'run: pip install "{url2pathname(url.path)}[{name}]"'
    return f'in a clone of pendula run: pip install ".[{name}]"'


def number(name: str, value: object, unit: str = "") -> float:
    """`value` as a float, finite or not; where it carries a unit, converted to this one."""
    if type(value) is float:  # most are, and every system is checked when a run begins
        return value
    try:
        given = plain(name, value, unit)
        kind = getattr(getattr(given, "dtype", None), "kind", "f")
        if kind == "O" and getattr(given, "ndim", 1) == 0:
            return number(name, given.item(), unit)
        if isinstance(given, str | bytes) or kind not in "iuf" or getattr(given, "ndim", 0) != 0:
            raise TypeError
        return float(given)
    except OverflowError:
        return math.inf
    except ArgumentError:
        raise
    except (TypeError, ValueError):
        raise broken(name, "number", value=value, unit=unit) from None


def finite_number(name: str, value: object, unit: str = "") -> float:
    """`value` as a float that is neither infinite nor NaN."""
    found = number(name, value, unit)
    if not math.isfinite(found):
        raise broken(name, "finite", value=found, unit=unit)
    return found


def positive_number(name: str, value: object, unit: str = "", *, zero: bool = False) -> float:
    """`value` as a finite float above zero, or not below it where `zero` is allowed."""
    found = finite_number(name, value, unit)
    if found < 0 or (found == 0 and not zero):
        raise broken(name, "not_negative" if zero else "positive", value=found, unit=unit)
    return found


def number_pair(name: str, value: object, rule: str, unit: str) -> tuple[float, float]:
    """`value` as two finite floats; `rule` says what it must be, otherwise."""
    try:
        pair: tuple[Any, ...] = tuple(value)  # type: ignore[arg-type]
    except TypeError:
        pair = (value,)
    if len(pair) != 2:
        raise ArgumentError(name, f"{rule}, got {{value}}", value=value)
    return finite_number(name, pair[0], unit), finite_number(name, pair[1], unit)


def numbers_array(name: str, value: ArrayLike, unit: Units = "") -> Array:
    """`value` as a contiguous array of doubles, a copy that its owner cannot change.

    Where it carries a unit it is converted to this one; `unit` may be that of each component.
    """
    import numpy as np

    try:
        array = np.array(plain(name, value, unit), order="C")
        if array.dtype.kind == "O" and array.ndim:  # its entries may carry units
            array = np.array(plain(name, array.tolist(), unit), order="C")
        return doubles(array)
    except ArgumentError:
        raise
    except (OverflowError, TypeError, ValueError):
        rule = "must hold numbers{in_unit}, got {value}"
        one = unit if isinstance(unit, str) else ""
        raise ArgumentError(name, rule, value=value, unit=one) from None


def finite_array(name: str, value: ArrayLike, unit: str = "") -> Array:
    """`value` as `numbers_array`, of numbers that are neither infinite nor NaN."""
    array = numbers_array(name, value, unit)
    check_finite(name, array, unit)
    return array


def any_as_large(array: Array, bound: float) -> bool:
    """Whether a number of an array is so large in size, or larger."""
    if array.size <= _FEW:
        return any(abs(each) >= bound for each in array.ravel().tolist())
    return bool((abs(array) >= bound).any())


def check_finite(name: str, array: Array, unit: str = "") -> None:
    """Name the first number that is infinite or NaN."""
    if array.size <= _FEW and all(map(math.isfinite, array.ravel().tolist())):
        return
    import numpy as np

    finite = np.isfinite(array)
    if not finite.all():
        bad = ~finite
        place = np.unravel_index(int(bad.argmax()), array.shape)
        where = f"{name}[{', '.join(str(int(i)) for i in place)}]" if array.ndim else name
        raise broken(name, "all_finite", value=float(array[place]), unit=unit, place=where)


def broadcast_shape(**shapes: tuple[int, ...]) -> tuple[int, ...]:
    """The shape that arguments of these shapes have together."""
    import numpy as np

    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        first, *others = shapes
        given = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        rule = "must have a shape that goes with that of {other}, got {text}"
        raise ArgumentError(first, rule, other=" and ".join(others), text=given) from None


def states_array(
    value: ArrayLike, components: Mapping[str, str], *, finite: bool = True, name: str = "state"
) -> Array:
    """`value` as states of shape (..., d), finite unless the caller checks that.

    `components` gives the unit of each by its name.
    """
    states = numbers_array(name, value, components)
    if finite:
        check_finite(name, states)
    if states.ndim == 0 or states.shape[-1] != len(components):
        raise ArgumentError(
            name,
            "must be ({text}) or an array of such rows, got shape {value}",
            text=", ".join(components),
            value=states.shape,
        )
    return states


def whole(name: str, value: object, unit: str = "") -> int:
    """`value` as an int of any size."""
    try:
        return operator.index(plain(name, value, ""))
    except TypeError:
        rule = "must be a whole number of at least 1, got {value}"
        raise ArgumentError(name, rule, value=value) from None


def whole_number(name: str, value: object, most: int) -> int:
    """`value` as an int from 1 to `most`."""
    found = whole(name, value)
    if not 1 <= found <= most:
        raise broken(name, "whole_range", least=1, most=most, value=found)
    return found


def counted(name: str, value: object, most: int) -> int:
    """`value` as `whole_number`; a recipe may write it as a float, 1e5."""
    given = int(value) if isinstance(value, float) and value.is_integer() else value
    return whole_number(name, given, most)


def check_threads(threads: object) -> int | None:
    """A number of threads; None: whoever runs them chooses it."""
    return None if threads is None else whole_number("threads", threads, MOST_THREADS)


def checked_threads(threads: object) -> int:
    """How many threads: those asked for, or one for each processor that this process may use."""
    asked = check_threads(threads)
    if asked is not None:
        return asked
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def flag(name: str, value: object) -> bool:
    """`value`, which has to be True or False itself."""
    if type(value).__name__ not in ("bool", "bool_"):
        raise ArgumentError(name, "must be True or False, got {value}", value=value)
    return bool(value)


def checked_progress(progress: object) -> Any:
    """`progress`, which has to be a function or None: `with_bar` has made one of True."""
    if progress is not None and not callable(progress):
        rule = "must be a function of the part that is done, True for a bar, or None, got {value}"
        raise ArgumentError("progress", rule, value=progress)
    return progress


def one_of(name: str, value: object, choices: Iterable[str]) -> str:
    """`value`, which has to be one of the names."""
    known = tuple(choices)
    if not isinstance(value, str) or value not in known:
        way_out = meant(value, known) if isinstance(value, str) else ""
        raise broken(name, "unknown_name", way_out=way_out, choices=known, value=value)
    return str(value)
