"""Recordings and fits as tables of pandas and datasets of xarray, with units."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from pendula._checks import extra
from pendula._late_methods import method_of
from pendula.measured.compare import Comparison
from pendula.measured.fitted import Fit
from pendula.measured.measurement import Measurement, PeriodTable
from pendula.measured.periods import PeriodFit
from pendula.measured.storable import Storable

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from pendula._types import Array

    Measured = Measurement | PeriodTable | Fit | PeriodFit
    Columns = dict[str, tuple[str, Array]]  # values with their unit, by name
    Variables = dict[str, tuple[tuple[str, ...], str, Array]]  # with dimensions in front


@method_of(Storable)
def to_pandas(measured: Measured | Comparison) -> pd.DataFrame:
    """A table (extra: io).

    Of a recording a row for each sample, columns such as "theta [rad]"; of a table of periods its
    rows; of a fit a row for each parameter, with its errors and unit; of a comparison a row for
    each model.
    """
    pandas = extra("pandas", "io")
    if isinstance(measured, Comparison):
        index = pandas.Index([row.model for row in measured.rows], name="model")
        models: pd.DataFrame = pandas.DataFrame(_judged(measured), index)
        return models
    if isinstance(measured, Fit | PeriodFit):
        index = pandas.Index(measured.names, name="parameter")
        columns: dict[str, Any] = {name: values for name, (_, values) in _told(measured).items()}
        fitted: pd.DataFrame = pandas.DataFrame({**columns, "unit": list(measured.units)}, index)
        return fitted
    columns = {f"{name} [{unit}]": values for name, (unit, values) in _rows(measured).items()}
    frame: pd.DataFrame = pandas.DataFrame(columns)
    return frame


@method_of(Storable)
def to_xarray(measured: Measured | Comparison) -> xr.Dataset:
    """A dataset, units on each variable (extra: io).

    Of a recording over t; of a table of periods over row; of a fit its parameters over parameter,
    with their covariance, and what was measured and fitted over t, or row; a second recording's are
    called measured2 and so on, over t2; of a comparison its table over model.
    """
    xarray = extra("xarray", "io")
    if isinstance(measured, Comparison):
        table: xr.Dataset = xarray.Dataset(
            {name: (("model",), values) for name, values in _judged(measured).items()},
            {"model": [row.model for row in measured.rows]},
            {"preferred": measured.preferred, "recipe": _json(measured.recipe)},
        )
        table["rms"].attrs["units"] = measured.best.measurement.unit
        return table
    dataset: xr.Dataset = xarray.Dataset(
        {name: (dims, values, {"units": u}) for name, (dims, u, values) in _all(measured).items()},
        attrs=_attributes(measured),
    )
    if isinstance(measured, Fit | PeriodFit):
        dataset = dataset.assign_coords(
            parameter=list(measured.names), unit=("parameter", list(measured.units))
        )
    if isinstance(measured, Fit):
        dataset = dataset.assign_coords(other_parameter=list(measured.names))
    return dataset if "t" not in dataset else dataset.set_coords("t")


def _judged(measured: Comparison) -> dict[str, list[Any]]:
    """Columns of the table of models."""
    names = ("rms", "parameters", "aic", "bic", "admitted")
    return {name: [getattr(row, name) for row in measured.rows] for name in names}


def _told(measured: Fit | PeriodFit) -> Columns:
    """Values and errors of parameters."""
    return {
        "value": ("", measured.values),
        "standard_error": ("", measured.standard_errors),
        "plain_standard_error": ("", measured.plain_standard_errors),
    }


def _rows(measured: Measurement | PeriodTable | PeriodFit) -> Columns:
    """Columns with a row for each sample, or each period."""
    if isinstance(measured, Measurement):
        columns = zip(measured.names, measured.values.T, strict=True)
        return {"t": ("s", measured.t), **{name: (measured.unit, each) for name, each in columns}}
    if isinstance(measured, PeriodFit):
        own = {"fitted": measured.fitted, "residual": measured.residuals, "error": measured.errors}
        return {**_rows(measured.table), **{name: ("s", each) for name, each in own.items()}}
    given = {
        "length": ("m", measured.length),
        "amplitude": ("rad", measured.amplitude),
        "period": ("s", measured.period),
    }
    return {name: (unit, each) for name, (unit, each) in given.items() if each is not None}


def _all(measured: Measured) -> Variables:
    """Dimensions, unit and values of every variable, by name."""
    if isinstance(measured, Fit):
        return _of_parameters(measured) | _of_recordings(measured)
    along = "t" if isinstance(measured, Measurement) else "row"
    rows: Variables = {name: ((along,), *each) for name, each in _rows(measured).items()}
    return _of_parameters(measured) | rows if isinstance(measured, PeriodFit) else rows


def _of_parameters(measured: Fit | PeriodFit) -> Variables:
    found: Variables = {name: (("parameter",), *each) for name, each in _told(measured).items()}
    if isinstance(measured, Fit):
        found["covariance"] = (("parameter", "other_parameter"), "", measured.covariance)
    return found


def _of_recordings(measured: Fit) -> Variables:
    found: Variables = {}
    for i, each in enumerate(measured.recordings):
        mark = str(i + 1) if i else ""
        dims, unit = (f"t{mark}", f"column{mark}"), each.measurement.unit
        found[f"t{mark}"] = (dims[:1], "s", each.t)
        for name in ("measured", "fitted", "residuals"):
            found[f"{name}{mark}"] = (dims, unit, getattr(each, name))
    return found


def _attributes(measured: Measured) -> dict[str, str]:
    """The attributes a person reads first."""
    if isinstance(measured, Fit):
        source = measured.measurement.source
        return {"model": measured.model, "source": source, "recipe": _json(measured.recipe)}
    if isinstance(measured, PeriodFit):
        return {"law": measured.law, "source": measured.table.source}
    told = {"source": measured.source, "checksum": measured.checksum}
    return {**told, "reading": _json(measured.reading), "notes": "\n".join(measured.notes)}


def _json(known: Any) -> str:
    return json.dumps(known, ensure_ascii=False, default=str)
