"""Which model describes a recording: all of them fitted, and a verdict."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula.measured.asked import measurements_of, model_name, model_parts
from pendula.measured.begun import Begun
from pendula.measured.fit import fitted
from pendula.measured.model import FRICTIONS
from pendula.measured.one_thread import on_one_thread
from pendula.measured.plan import planned
from pendula.measured.storable import Storable
from pendula.measured.words import Note

if TYPE_CHECKING:
    from os import PathLike
    from pathlib import Path

    from pendula.measured.fitted import Fit
    from pendula.measured.measurement import Measurement

MODELS = (
    "undamped",
    "viscous",
    "coulomb",
    "quadratic",
    "viscous + coulomb",
    "viscous + quadratic",
    "coulomb + quadratic",
    "viscous + coulomb + quadratic",
    "viscous + coulomb + cubic",
    "linear",
    "linear + viscous",
)
_STRONG = 10.0  # of BIC: very strong evidence (Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773)
_SIMILAR = 1.03  # times the residuals of the best: a model that is about as good


class Compared(NamedTuple):
    """A model among others.

    Attributes:
        model: its name.
        fit: of it.
        rms: of its residuals, in the measured unit.
        parameters: how many were fitted.
        aic: less that of the best, by the common effective number of samples.
        bic: likewise.
        admitted: its friction is not at a bound: it is no smaller model in disguise.
    """

    model: str
    fit: Fit
    rms: float
    parameters: int
    aic: float
    bic: float
    admitted: bool


@with_promised
@dataclass(frozen=True, eq=False)
class Comparison(Storable):
    """Models of one recording, and the one that is preferred.

    Attributes:
        rows: one a model, in the order in which they were asked for.
        preferred: name of the simplest model that is about as good as any.
        dominant: the friction that takes most of its energy; empty: it is undamped.
        shares: part of the lost energy that each friction of the preferred model takes.
        linear_enough: the linear model describes the record as well; None: it was not compared.
        n_effective: independent samples that all are judged by: those of the residuals of the model
            with the smallest.
        notes: the verdict in words: `note.sentence("es")`.
        recipe: the arguments of `compare_models` but for the measurements, as JSON has them.
    """

    rows: tuple[Compared, ...]
    preferred: str
    dominant: str
    shares: dict[str, float]
    linear_enough: bool | None
    n_effective: float
    notes: tuple[Note, ...]
    recipe: Mapping[str, Any] = field(default_factory=dict)

    def __getitem__(self, model: str) -> Compared:
        """The row of a model."""
        name = model_name(*model_parts(model))
        return next(row for row in self.rows if row.model == name)

    @property
    def best(self) -> Fit:
        """The fit of the preferred model."""
        return self[self.preferred].fit

    def verdict(self, language: str = "en") -> str:
        """The verdict in words."""
        return " ".join(note.sentence(language) for note in self.notes)

    if TYPE_CHECKING:  # attached by the module that defines it

        def report(
            self,
            path: str | PathLike[str],
            lang: str = "en",
            *,
            title: str = "",
            author: str = "",
            overwrite: bool = False,
        ) -> Path:
            """See `pendula.study.measured.report.report`."""


@on_one_thread
def compare_models(
    measurement: Measurement | Iterable[Measurement],
    models: Iterable[str | Sequence[str]] = MODELS,
    **options: Any,
) -> Comparison:
    """Fit several models to one recording, and say which describes it.

    A model is better by Schwarz's criterion (BIC) with the effective number of samples, as the
    residuals are correlated: with all of them nearly every recording would call for the largest
    model. One whose friction ended at zero is a smaller model in disguise, and is not preferred.
    Among those that are about as good as the best, the simplest is preferred.

    Args:
        measurement: one recording, or several that are fitted together.
        models: as for `fit`. A model never fits worse than one within it.
        **options: of `fit`, the same for all.

    Raises:
        ValueError: as for `fit`.
    """
    parts = list(dict.fromkeys(model_parts(each, "models") for each in models))
    fits = _fits(_of_one_pendulum(measurement), parts, options)
    least = min(fits.values(), key=_rms)
    effective = min(least.n_effective, float(least.n_samples))
    logs = {each: effective * math.log(made.rms**2) for each, made in fits.items()}
    aic = {each: logs[each] + 2.0 * len(made.values) for each, made in fits.items()}
    bic = {each: logs[each] + math.log(effective) * len(made.values) for each, made in fits.items()}
    rows = tuple(
        Compared(
            model_name(*each),
            made,
            made.rms,
            len(made.values),
            aic[each] - min(aic.values()),
            bic[each] - min(bic.values()),
            not made.at_bounds and not made.unphysical,
        )
        for each, made in fits.items()
    )
    preferred = preferred_of(rows)
    shares = energy_shares(preferred.fit)
    found = Comparison(
        rows,
        preferred.model,
        max(shares, key=lambda name: shares[name]) if shares else "",
        shares,
        _linear_enough(rows, preferred),
        effective,
        (),
    )
    asked = {name: each for name, each in preferred.fit.recipe.items() if name != "system"}
    names = tuple(row.model for row in rows)
    return replace(found, notes=_verdict(found), recipe={"models": names, **asked})


def _of_one_pendulum(
    measurement: Measurement | Iterable[Measurement],
) -> tuple[Measurement, ...]:
    """The recordings.

    Raises:
        ValueError: where they are of a double pendulum.
    """
    given = measurements_of(measurement)
    if given[0].bodies == 2:
        rule = "must be of one pendulum for models to be compared, got one of a double pendulum"
        raise ArgumentError("measurement", rule, "fit it with <call=pendula.measured.fit>")
    return given


def _fits(
    measurement: Iterable[Measurement],
    parts: Sequence[tuple[bool, tuple[str, ...]]],
    options: dict[str, Any],
) -> dict[tuple[bool, tuple[str, ...]], Fit]:
    """Each model's fit; what one finds on the way is the start of others."""
    begun: dict[bool, Begun] = {}
    fits = {}
    for linear, frictions in parts:
        plan, recordings = planned(measurement, model_name(linear, frictions), **options)
        if linear not in begun:
            begun[linear] = Begun(plan, recordings)
        fits[linear, frictions] = fitted(plan, recordings, begun[linear])
    return fits


def _rms(made: Fit) -> float:
    return made.rms


def preferred_of(rows: Sequence[Compared]) -> Compared:
    """The simplest of the admitted models that are about as good as the best of them.

    Among equally simple ones the usual order of frictions decides, unless one is clearly better.
    """
    plain = [row for row in rows if row.admitted and not row.model.startswith("linear")]
    candidates = plain or list(rows)
    best = min(candidates, key=_bic)
    close = [row for row in candidates if row is best or _as_good(row, best)]
    fewest = min(row.parameters for row in close)
    simplest = [row for row in close if row.parameters == fewest]
    least = min(map(_bic, simplest))
    return next(row for row in sorted(simplest, key=_usual_order) if row.bic - least < _STRONG)


def _bic(row: Compared) -> float:
    return row.bic


def _usual_order(row: Compared) -> list[int]:
    """Places of a model's frictions in their usual order."""
    return [FRICTIONS.index(name) for name in model_parts(row.model)[1]]


def _as_good(row: Compared, best: Compared) -> bool:
    """Whether a model with no more parameters is about as good as the best.

    Drag that grows with a power of the speed comes with a part that grows with the speed itself, so
    it is not preferred without that where the two together are better.
    """
    drag = {"quadratic", "cubic"} & set(model_parts(row.model)[1])
    if drag and "viscous" not in row.model and "viscous" in best.model:
        return False
    good = row.bic - best.bic < _STRONG or row.rms < _SIMILAR * best.rms
    return row.parameters <= best.parameters and good


def energy_shares(made: Fit) -> dict[str, float]:
    """Part of the energy lost in the whole record that each friction takes."""
    import numpy as np

    lost: dict[str, float] = {}
    powers = {"viscous": 2, "coulomb": 1, "quadratic": 3, "cubic": 4}
    for i, recording in enumerate(made.recordings):
        values = dict(zip(made.names, made.values.tolist(), strict=True))
        speed = np.abs(recording.rates)
        for name in FRICTIONS:
            strength = values.get(name, values.get(f"{name}[{i + 1}]", 0.0))
            work = strength * float(np.trapezoid(speed ** powers[name], recording.t))
            if work > 0.0:
                lost[name] = lost.get(name, 0.0) + work
    total = sum(lost.values())
    return {name: work / total for name, work in lost.items()}


def _linear_enough(rows: Sequence[Compared], preferred: Compared) -> bool | None:
    """Whether the linear model with the preferred friction, or viscous, is about as good."""
    beside = {"undamped": "linear", "viscous": "linear + viscous"}
    partners = [
        (row, other) for row in rows for other in rows if beside.get(row.model) == other.model
    ]
    for row, other in partners:
        if row.model in (preferred.model, "viscous"):
            return other.rms < _SIMILAR * row.rms
    return None


def _verdict(found: Comparison) -> tuple[Note, ...]:
    notes = [Note("preferred", {"model": found.preferred})]
    if len(found.shares) > 1:
        share = f"{100.0 * found.shares[found.dominant]:.0f}"
        notes.append(Note("dominant", {"friction": found.dominant, "share": share}))
    if found.linear_enough is not None:
        notes.append(Note("linear_enough" if found.linear_enough else "not_linear"))
    notes += [note for note in found.best.notes if note.key in ("gravity_unlikely", "damped")]
    return tuple(notes)
