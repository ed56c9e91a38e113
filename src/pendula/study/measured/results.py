"""Everything that a report says of a recording, computed once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula.measured.compare import Comparison
from pendula.measured.whole_swings import seen, swings
from pendula.study.measured.comparison import compare_methods

if TYPE_CHECKING:
    from pendula.measured.fitted import Fit
    from pendula.measured.whole_swings import Seen, Swings
    from pendula.study.measured.comparison import MethodComparison

_FEWEST_SWINGS = 3  # that say anything of damping and period


@dataclass(frozen=True, eq=False)
class MeasuredResults:
    """A fit with what is told and drawn beside it.

    Attributes:
        fit: of the recording.
        recorded: the recording as angle or rate; None: of accelerations, or without a physical
            model.
        swings: whole swings of it; None: too few, or of a double pendulum.
        model_swings: those of the fitted model.
        compared: formulas and methods beside the experiment; None as for `recorded`.
        models: the comparison that preferred this fit; None: its model was chosen.
    """

    fit: Fit
    recorded: Seen | None
    swings: Swings | None
    model_swings: Swings | None
    compared: MethodComparison | None
    models: Comparison | None


def measured_results(given: Fit | Comparison) -> MeasuredResults:
    """What can be said of the first recording of a fit, or of the preferred of several models."""
    models = given if isinstance(given, Comparison) else None
    fit = given.best if isinstance(given, Comparison) else given
    recording = fit.recordings[0]
    if recording.system is None or recording.measurement.quantity == "acceleration":
        return MeasuredResults(fit, None, None, None, None, models)
    recorded = seen(recording)
    compared = compare_methods(fit, recorded)
    if recorded.values.ndim > 1:
        return MeasuredResults(fit, recorded, None, None, compared, models)
    found = swings(recorded)
    if len(found.t) < _FEWEST_SWINGS:
        return MeasuredResults(fit, recorded, None, None, compared, models)
    own = recorded.model.theta if recorded.is_angle else recorded.model.omega
    return MeasuredResults(
        fit, recorded, found, swings(recorded._replace(values=own)), compared, models
    )
