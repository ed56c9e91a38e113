"""What an accelerometer in a pendulum shows, and its derivatives."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array


def shown(states: Array, values: Mapping[str, float]) -> Array:
    """R (ω² + s ω0² cos θ) cos τ − (1 − s) R ω0² sin θ sin τ of states (n, 2), (n,) [m/s²].

    Along an axis that is off the string by the tilt τ; s = 1 for a sensor that feels gravity, whose
    part along the motion is that of friction alone, which is left out.
    """
    import numpy as np

    radial, along = _parts(states, values)
    tilt = values["tilt"]
    return np.asarray(values["sensor_radius"] * (radial * np.cos(tilt) - along * np.sin(tilt)))


def derived(states: Array, values: Mapping[str, float]) -> tuple[Array, dict[str, Array]]:
    """Derivatives by the state (n, 2), and by the parameters that stand there themselves, (n,)."""
    import numpy as np

    theta, omega = states.T
    radial, along = _parts(states, values)
    radius, felt, square = (
        values[name] for name in ("sensor_radius", "gravity_seen", "omega0_squared")
    )
    cosine, sine = np.cos(values["tilt"]), np.sin(values["tilt"])
    by_theta = -felt * np.sin(theta) * cosine - (1.0 - felt) * np.cos(theta) * sine
    by_state = radius * np.stack([square * by_theta, 2.0 * omega * cosine], axis=1)
    by_square = felt * np.cos(theta) * cosine - (1.0 - felt) * np.sin(theta) * sine
    return by_state, {
        "sensor_radius": radial * cosine - along * sine,
        "omega0_squared": radius * by_square,
        "tilt": -radius * (radial * sine + along * cosine),
    }


def _parts(states: Array, values: Mapping[str, float]) -> tuple[Array, Array]:
    """Along the string and across it, over the distance from the pivot, (n,) each [1/s²]."""
    import numpy as np

    theta, omega = states.T
    felt, square = values["gravity_seen"], values["omega0_squared"]
    return omega**2 + felt * square * np.cos(theta), (1.0 - felt) * square * np.sin(theta)
