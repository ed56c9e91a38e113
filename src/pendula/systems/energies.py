"""Kinetic and potential energy, to the ends of the range of numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pendula import _engine

if TYPE_CHECKING:
    from pendula._types import Array

_SMALLER = 600  # binary digits by which velocities are scaled where their squares overflow


def energies(description: _engine.Description, states: Array) -> tuple[Array, Array]:
    """Kinetic and potential energy of states (..., d), each (...) [J]; inf: beyond all doubles."""
    import numpy as np

    kinetic, potential = _engine.energies(description, states)
    # Where terms overflow their sum is no number or too large, whatever it should be.
    lost = ~np.isfinite(kinetic) & np.isfinite(states).all(axis=-1)
    if lost.any():
        angles, velocities = np.split(states[lost], 2, axis=-1)
        small = np.concatenate([angles, np.ldexp(velocities, -_SMALLER)], axis=-1)
        with np.errstate(over="ignore"):
            found = np.ldexp(_engine.energies(description, small)[0], 2 * _SMALLER)
        kinetic = np.where(lost, 0.0, kinetic)
        kinetic[lost] = found
    return kinetic, potential
