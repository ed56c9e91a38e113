"""What follows from fitted values: g from a known length, damping rate, quality factor, period."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula.measured.fitted import Quantity
from pendula.measured.system_model import inertia_and_pull

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from pendula._types import Array
    from pendula.measured.asked import Known


def derived_of(
    names: tuple[str, ...],
    values: dict[str, float],
    covariance: Array,
    length: Known | None,
    gravity: Known | None,
) -> dict[str, Quantity]:
    """Quantities by name, with errors by their derivatives.

    Args:
        names: of the parameters of the first recording, (k,).
        values: of all parameters of that recording.
        covariance: of those that were fitted, (k, k).
        length: from the pivot to the bob, if known [m].
        gravity: if known [m/s²].
    """

    def error(**by: float) -> float:
        slope = [by.get(name, 0.0) for name in names]
        return math.sqrt(max(float(slope @ covariance @ slope), 0.0))

    if "C_over_A" in values:
        return _of_double(values, error, length)
    if "omega0_squared" not in values:
        return _of_system(values, error)
    square = values["omega0_squared"]
    root = math.sqrt(square)
    found = {
        "natural_frequency": Quantity(root, error(omega0_squared=0.5 / root), "rad/s"),
        "period": Quantity(2.0 * math.pi / root, error(omega0_squared=math.pi / root**3), "s"),
    }
    if length is not None:
        g, relative = square * length.value, length.sigma / length.value
        own = error(omega0_squared=length.value)
        found["gravity"] = Quantity(g, math.hypot(own, g * relative), "m/s²")
    if gravity is not None:
        reach, relative = gravity.value / square, gravity.sigma / gravity.value
        own = error(omega0_squared=reach / square)
        found["length"] = Quantity(reach, math.hypot(own, reach * relative), "m")
    if "viscous" in names and values["viscous"] > 0.0:
        b = values["viscous"]
        found["damping_rate"] = Quantity(0.5 * b, error(viscous=0.5), "1/s")
        found["quality_factor"] = Quantity(
            root / b, error(viscous=-root / b**2, omega0_squared=0.5 / (root * b)), ""
        )
    return found


def _of_double(
    values: Mapping[str, float], error: Callable[..., float], length: Known | None
) -> dict[str, Quantity]:
    """E/C, which is g over the first length, and g where that length is known."""
    c, e = values["C_over_A"], values["E_over_A"]
    ratio, own = e / c, error(E_over_A=1.0 / c, C_over_A=-e / c**2)
    found = {"gravity_over_length1": Quantity(ratio, own, "1/s²")}
    if length is not None:
        spread = math.hypot(own * length.value, ratio * length.sigma)
        found["gravity"] = Quantity(ratio * length.value, spread, "m/s²")
    return found


def _of_system(values: Mapping[str, float], error: Callable[..., float]) -> dict[str, Quantity]:
    """ω0² = m g c / I of one pendulum, by its own parameters; nothing of a double one."""
    if "m1" in values:
        return {}
    inertia, pull = inertia_and_pull(values)
    square = pull / inertia
    powers = {"gravity": 1.0, "length": -1.0}
    if "inertia" in values:
        powers = {"gravity": 1.0, "mass": 1.0, "centre": 1.0, "inertia": -1.0}
    parts = {name: power / values[name] for name, power in powers.items() if name in values}
    relative = error(**parts)
    root = math.sqrt(square)
    return {
        "omega0_squared": Quantity(square, square * relative, "1/s²"),
        "natural_frequency": Quantity(root, 0.5 * root * relative, "rad/s"),
        "period": Quantity(2.0 * math.pi / root, math.pi / root * relative, "s"),
    }
