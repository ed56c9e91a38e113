"""A recording as it was measured, before anything is fitted to it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from pendula._late_methods import method_of
from pendula.measured.measurement import Measurement
from pendula.plot.labels import Labels, labels
from pendula.plot.style import panels, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_IN_DEGREES = ("angle", "rate")


@method_of(Measurement)
@styled
def plot(measurement: Measurement, *, language: str = "en") -> Figure:
    """The samples over time, a panel for each column (extra: report); angles in degrees.

    Args:
        measurement: of any quantity.
        language: "en" or "es".
    """
    words, m = labels(language), measurement.values.shape[1]
    figure, axes = panels(m, 1, 0.9 + 1.7 * m, words, sharex=True)
    in_degrees = measurement.quantity in _IN_DEGREES
    values = np.degrees(measurement.values) if in_degrees else measurement.values
    for i, ax in enumerate(axes[:, 0]):
        ax.plot(measurement.t, values[:, i], color="#0072b2", linewidth=0.9)
        ax.set_ylabel(_label(measurement, i, words))
    axes[-1, 0].set_xlabel(words.axis["time"])
    if measurement.t.size > 1:
        axes[-1, 0].set_xlim(measurement.t[0], measurement.t[-1])
    return figure


def _label(measurement: Measurement, i: int, words: Labels) -> str:
    """What stands at the axis of a column."""
    kind, name = measurement.quantity, measurement.names[i]
    if kind == "angle" and measurement.bodies == 2:
        return words.axis[f"angle_{i + 1}"]
    if measurement.bodies == 1 and f"measured_{kind}" in words.axis:
        return words.axis[f"measured_{kind}"]
    return f"{name} [{'°/s' if kind == 'rate' else measurement.unit}]"
