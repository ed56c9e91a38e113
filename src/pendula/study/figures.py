"""The study's figures: which runs go into which figure."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula import plot
from pendula.analysis import (
    agm_iterations,
    largest_energy_errors,
    linear_model_error,
    series_terms,
)
from pendula.study.runs import METHODS, periods

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path

    from matplotlib.figure import Figure

    from pendula._types import Array
    from pendula.run.trajectory import Trajectory
    from pendula.study.notation import Numbers
    from pendula.study.runs import Comparison, Results


_DOTS = 300  # an inch, of figures of pixels: for print


class Figures:
    """Draws the study's figures in one language."""

    def __init__(
        self, results: Results, language: str, titles: dict[str, str], numbers: Numbers
    ) -> None:
        self._results = results
        self._language: dict[str, Any] = {"language": language}
        self._titles = titles
        self._numbers = numbers

    def write(self, folder: Path, also: Sequence[str] = ()) -> Iterator[float]:
        """Write each figure as NAME.svg into a folder that exists; yield the part done.

        Args:
            folder: where.
            also: other kinds to write each as, "pdf" or "png".
        """
        drawers = self._drawers()
        for done, (name, draw) in enumerate(drawers.items(), start=1):
            write_figure(draw(), folder, name, also)
            yield done / len(drawers)

    def _drawers(self) -> dict[str, Callable[[], Figure]]:
        return {
            "models": self._models,
            "linear-error": self._linear_error,
            "periods": self._periods,
            "phase-portrait": self._phase_portrait,
            "elliptic": self._elliptic,
            "methods": self._methods,
            "errors": self._errors,
            "energy": self._energy,
            "convergence": self._convergence,
            "work": self._work,
            "double-angles": self._double_angles,
            "double-paths": self._double_paths,
            "double-energy": self._double_energy,
            "double-parting": self._double_parting,
            **({"double-section": self._section} if self._results.chaos.section else {}),
        }

    def _models(self) -> Figure:
        cases = [
            dict(zip(("exact", "linear"), pair, strict=True))
            for pair in self._results.models.values()
        ]
        part = self._results.recipe.simple
        titles = [f"θ₀ = {self._numbers.chosen_degrees(a)}" for a in (part.gentle, part.large)]
        return plot.angles(cases, titles, **self._language)

    def _linear_error(self) -> Figure:
        part = self._results.linear_errors
        marked = [limit for limits in part.limits.values() for limit in limits.values()]
        low = min(*part.amplitudes, *marked) * 0.8
        amplitudes = np.geomspace(low, max(*part.amplitudes, *marked), 60)
        errors = {n: linear_model_error(amplitudes, n) for n in part.errors}
        return plot.linear_error(amplitudes, errors, part.limits, **self._language)

    def _periods(self) -> Figure:
        part = self._results.periods
        # Up to where the exact period has grown so long that the series would be flattened.
        amplitudes = np.linspace(0, np.radians(175), 120)[1:]
        fine = periods(self._results.pendulum, amplitudes, tuple(part.series))
        series = {n: values / fine.small for n, values in fine.series.items()}
        return plot.periods(amplitudes, fine.exact / fine.small, series, **self._language)

    def _phase_portrait(self) -> Figure:
        part = self._results.recipe.simple
        return plot.phase_portrait(
            self._results.pendulum, (part.gentle, part.large), **self._language
        )

    def _elliptic(self) -> Figure:
        part = self._results.recipe.elliptic
        first, last = (math.cos(end(part.amplitudes) / 2) for end in (min, max))
        kc = np.geomspace(first, last, 32)
        terms = series_terms(kc, part.error, largest=part.largest_terms)
        return plot.elliptic_cost(kc, terms, agm_iterations(kc, part.error), **self._language)

    def _both(self) -> tuple[Comparison, Comparison]:
        return self._results.linear, self._results.simple

    def _headings(self, *systems: str) -> list[str]:
        return [self._titles[system] for system in systems]

    def _methods(self) -> Figure:
        cases = [{"exact": each.reference, **each.runs} for each in self._both()]
        return plot.angles(cases, self._headings("linear", "simple"), **self._language)

    def _errors(self) -> Figure:
        cases = [(each.reference.t, _degrees(each.differences)) for each in self._both()]
        headings = self._headings("linear", "simple")
        return plot.series(cases, "difference", headings, **self._language)

    def _energy(self) -> Figure:
        cases = [(each.reference.t, _energy_errors("exact", each)) for each in self._both()]
        headings = self._headings("linear", "simple")
        return plot.series(cases, "energy_error", headings, **self._language)

    def _convergence(self) -> Figure:
        orders = self._results.orders
        headings = self._headings(*orders.cases)
        return plot.convergence(
            orders.steps, list(orders.cases.values()), headings, **self._language
        )

    def _work(self) -> Figure:
        cases, headings = list(self._results.work.values()), self._headings(*self._results.work)
        return plot.work_precision(cases, headings, against=("evaluations",), **self._language)

    def _double_runs(self) -> dict[str, Trajectory]:
        return {"reference": self._results.double.reference, **self._results.double.runs}

    def _double_angles(self) -> Figure:
        return plot.angles([self._double_runs()], **self._language)

    def _double_paths(self) -> Figure:
        end = self._results.recipe.double.path_until
        runs = {name: _up_to(run, end) for name, run in self._double_runs().items()}
        return plot.tip_paths(runs, **self._language)

    def _double_energy(self) -> Figure:
        double = self._results.double
        case = (double.reference.t, _energy_errors("reference", double))
        return plot.series([case], "energy_error", **self._language)

    def _double_parting(self) -> Figure:
        double = self._results.double
        differences = _degrees({"reference": double.own_difference, **double.differences})
        moments = {"reference": double.horizon} | {m: double.trusted_parting(m) for m in METHODS}
        tolerance = float(np.degrees(self._results.recipe.double.tolerance))
        t = double.reference.t
        return plot.parting(t, differences, moments, tolerance, **self._language)

    def _section(self) -> Figure:
        found = self._results.chaos
        assert found.section is not None
        drawn: Figure = plot.section(found.section, found.indicator, **self._language)
        return drawn


def write_figure(figure: Figure, folder: Path, name: str, also: Sequence[str]) -> None:
    """Write a figure as NAME.svg, and as the other kinds."""
    (folder / f"{name}.svg").write_bytes(plot.svg(figure))
    for kind in also:
        (folder / f"{name}.{kind}").write_bytes(plot.picture(figure, kind, _DOTS))


def _degrees(differences: dict[str, Array]) -> dict[str, Array]:
    return {name: np.degrees(values) for name, values in differences.items()}


def _energy_errors(reference: str, compared: Comparison) -> dict[str, Array]:
    """What is largest since the point before; nan after the end of a run that ended early."""
    largest = {reference: largest_energy_errors(compared.reference), **compared.energy_errors}
    size = len(compared.reference.t)
    return {
        name: np.pad(errors, (0, size - len(errors)), constant_values=np.nan)
        for name, errors in largest.items()
    }


def _up_to(run: Trajectory, t: float) -> Trajectory:
    kept = run.t <= t
    return replace(run, t=run.t[kept], states=run.states[kept])
