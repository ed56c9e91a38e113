"""The numbers behind the figures of a recording, in SI units and radians."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pendula.measured.whole_swings import periods_at

if TYPE_CHECKING:
    from pendula.measured.fitted import Fit
    from pendula.measured.periods import PeriodFit
    from pendula.study.data import Columns
    from pendula.study.measured.comparison import MethodComparison
    from pendula.study.measured.results import MeasuredResults


def measured_tables(results: MeasuredResults) -> dict[str, Columns]:
    """Columns of each table by its name: units in the header."""
    fit = results.fit
    tables = {"measured_fit": _samples(fit), "measured_values": _values(fit)}
    if results.swings is not None:
        found = results.swings
        by_formula = periods_at(fit["omega0_squared"].value, found.amplitude)
        tables["measured_swings"] = {
            "t [s]": found.t.tolist(),
            "amplitude [rad]": found.amplitude.tolist(),
            "period [s]": found.period.tolist(),
            "period by 4 K(k)/omega0 [s]": by_formula.tolist(),
        }
    if results.compared is not None:
        tables["measured_methods"] = _methods(results.compared)
    return tables


def period_tables(fit: PeriodFit) -> dict[str, Columns]:
    """Columns of each table by its name: units in the header."""
    rows: Columns = {}
    if fit.table.length is not None:
        rows["length [m]"] = fit.table.length.tolist()
    if fit.table.amplitude is not None:
        rows["amplitude [rad]"] = fit.table.amplitude.tolist()
    rows |= {
        "period [s]": fit.table.period.tolist(),
        "uncertainty [s]": fit.errors.tolist(),
        "fitted [s]": fit.fitted.tolist(),
        "residual [s]": fit.residuals.tolist(),
    }
    values = {
        "quantity": fit.names,
        "value": fit.values.tolist(),
        "standard uncertainty": fit.standard_errors.tolist(),
        "unit": fit.units,
    }
    return {"measured_periods": rows, "measured_values": values}


def _samples(fit: Fit) -> Columns:
    recording = fit.recordings[0]
    measurement = recording.measurement
    columns: Columns = {"t [s]": recording.t.tolist()}
    for i, name in enumerate(measurement.names[: recording.fitted.shape[1]]):
        unit = f"[{measurement.unit}]"
        columns[f"{name} measured {unit}"] = recording.measured[:, i].tolist()
        columns[f"{name} fitted {unit}"] = recording.fitted[:, i].tolist()
        columns[f"{name} residual {unit}"] = recording.residuals[:, i].tolist()
    return columns


def _values(fit: Fit) -> Columns:
    named = {name: fit[name] for name in (*fit.derived, *fit.names)}
    value, error, unit = zip(*named.values(), strict=True)
    return {
        "quantity": list(named),
        "value": value,
        "standard uncertainty": error,
        "unit": unit,
    }


def _methods(compared: MethodComparison) -> Columns:
    unit = "[rad]" if compared.is_angle else "[rad/s]"
    columns: Columns = {
        "t [s]": compared.t.tolist(),
        f"measured {unit}": compared.measured.tolist(),
    }
    for name in compared.runs:
        columns[f"{name} {unit}"] = compared.values(name).tolist()
        columns[f"{name} error {unit}"] = compared.difference(name).tolist()
    return columns
