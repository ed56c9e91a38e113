"""Angles of people: degrees as radians, and radians that look like degrees."""

from __future__ import annotations

import math
import sys
import warnings
from typing import TYPE_CHECKING, Any

from pendula._checks import any_as_large, numbers_array
from pendula._given import carries_unit
from pendula._unit_names import PI
from pendula.units import scaled

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


# A start of more than a turn, but not of many, and with hardly any decimals: written by a person.
# The angles of a motion, never wrapped, have all the digits of a double.
_LEAST, _MOST, _DECIMALS = math.tau, 3600.0, 2


class DegreesWarning(UserWarning):
    """An angle in radians that looks like one in degrees."""


def degrees(x: ArrayLike) -> Any:
    """Angles of x degrees in radians: x·π/180, correctly rounded.

    `numpy.radians` rounds twice: of 120 it makes the double below, and a chaotic motion shows the
    difference within half a minute. The command line's "120deg" has the bits of `degrees(120)`.

    Args:
        x: angles [deg], or angular velocities [deg/s]; any shape.

    Returns:
        A float, or an array of the shape of `x` [rad, rad/s]; NaN stays NaN.

    Raises:
        ValueError: for what is no number.
    """
    found = scaled(numbers_array("x", x), PI / 180)
    return found if found.ndim else float(found)


def warn_of_degrees(name: str, given: Any, angles: ArrayLike, *, deeper: int = 0) -> None:
    """Warn of angles that look like degrees, at the line that called the public function.

    Calls from inside the package, whose angles are radians, and values that carry a unit pass.

    Args:
        name: of the argument.
        given: what was given for it.
        angles: in it [rad].
        deeper: calls between the public function and its caller of this one.
    """
    import numpy as np

    if not any_as_large(np.asarray(angles), _LEAST) or carries_unit(given):
        return
    sizes = np.abs(angles)
    depth = 2 + deeper
    while _module(depth) == "pendula._progress":  # which the function may be wrapped in
        depth += 1
    if _module(depth).partition(".")[0] == "pendula":
        return
    likely = (sizes > _LEAST) & (sizes <= _MOST) & (np.round(sizes, _DECIMALS) == sizes)
    if not likely.any():
        return
    angle = float(np.ravel(angles)[int(likely.argmax())])
    warnings.warn(
        f"{name}: {angle:g} rad is {math.degrees(angle):.0f} degrees; angles are in radians, for "
        f"{angle:g} degrees give pendula.degrees({angle:g})",
        DegreesWarning,
        stacklevel=depth + 1,
    )


def _module(depth: int) -> str:
    """Of the frame so far above the caller's."""
    return str(sys._getframe(depth + 1).f_globals.get("__name__", ""))
