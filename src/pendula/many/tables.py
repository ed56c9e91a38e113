"""Ensembles as labelled data and as files, with what they were made from."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._attributes import KEY
from pendula._checks import extra, one_of
from pendula._late_methods import method_of
from pendula._version import __version__
from pendula._writing import refuse_existing, replacing
from pendula.many.ensembles import Ensemble
from pendula.run.derivatives import derivative_columns
from pendula.systems import System

if TYPE_CHECKING:
    from collections.abc import Iterator
    from os import PathLike

    import pandas as pd
    import xarray as xr

ENDINGS = (".csv", ".nc", ".parquet", ".zarr")
_TRAJECTORY, _TIME = "trajectory", "t"


@method_of(Ensemble)
def to_xarray(many: Ensemble) -> xr.Dataset:
    """A dataset over (trajectory, t), units on each variable (extra: io).

    For each trajectory its start (`theta_start` …), outcome, steps and, where the systems differ,
    their parameters; of the first event `event1_trajectory`, `event1_t` and the states there
    (`event1_theta` …) over `event1`, and so on. Derivatives are one variable each, such as
    "dtheta_dlength". The attribute "pendula" says as JSON what was run.
    """
    xarray = extra("xarray", "io")
    times = (_TIME, many.t, {"units": "s", "long_name": "time"})
    dataset: xr.Dataset = xarray.Dataset(
        {name: (dims, values, attrs) for name, dims, values, attrs in _variables(many)},
        coords={_TIME: times},
        attrs={KEY: _described(many), "method": many.method},
    )
    return dataset


@method_of(Ensemble)
def to_pandas(many: Ensemble) -> pd.DataFrame:
    """A table with a row for each trajectory and time; columns such as "theta [rad]" (extra: io).

    Times that a run did not reach are left out.
    """
    import numpy as np

    pandas = extra("pandas", "io")
    n, m, d = many.states.shape
    energies = many.energy.reshape(-1)
    kept = np.isfinite(many.states).all(axis=-1).reshape(-1)
    columns: dict[str, Any] = {
        _TRAJECTORY: np.repeat(np.arange(n), m),
        f"{_TIME} [s]": np.tile(many.t, n),
    }
    states = many.states.reshape(-1, d).T
    for each, values in zip(_components(many), states, strict=True):
        columns[f"{each.name} [{each.unit}]"] = values
    for name, (unit, found) in _derivatives(many).items():
        columns[f"{name} [{unit}]"] = found.reshape(-1)
    columns["energy [J]"] = energies
    columns["outcome"] = np.repeat(many.outcomes, m)
    table: pd.DataFrame = pandas.DataFrame({name: each[kept] for name, each in columns.items()})
    return table


@method_of(Ensemble)
def save(many: Ensemble, path: str | PathLike[str], *, overwrite: bool = False) -> None:
    """Write an ensemble; the name's ending chooses.

    .nc and .zarr hold all that `to_xarray` gives, .csv and .parquet the table of `to_pandas`. It is
    written beside the path and moved there when it is complete.

    Raises:
        ValueError: for another ending.
        FileExistsError: where the path exists and `overwrite` is not set.
        OSError: where the path cannot be written.
    """
    target = Path(path)
    try:
        ending = one_of("ending", target.suffix.lower(), ENDINGS)
    except ValueError:
        rule = f"the file name must end in {', '.join(ENDINGS)}"
        raise ValueError(f"{rule}, got {target.name!r}") from None
    refuse_existing(target, overwrite=overwrite)
    with replacing(target, overwrite=overwrite) as unfinished:
        _write(many, unfinished, ending)


def _write(many: Ensemble, path: Path, ending: str) -> None:
    if ending == ".nc":
        extra("h5netcdf", "io")
        to_xarray(many).to_netcdf(path, engine="h5netcdf")
    elif ending == ".zarr":
        extra("zarr", "io")
        dataset = to_xarray(many)
        text = {"outcome": dataset["outcome"].astype(object)}  # of the length of each
        dataset.assign(text).to_zarr(path, zarr_format=3, consolidated=False)
    elif ending == ".parquet":
        arrow, parquet = extra("pyarrow", "io"), extra("pyarrow.parquet", "io")
        table = arrow.Table.from_pandas(to_pandas(many), preserve_index=False)
        parquet.write_table(table.replace_schema_metadata({KEY: _described(many)}), path)
    else:
        table = to_pandas(many)
        with path.open("w", encoding="utf-8", newline="") as file:
            file.write(f"# {KEY}: {_described(many)}\n")
            table.to_csv(file, index=False, lineterminator="\n")


def _variables(many: Ensemble) -> Iterator[tuple[str, tuple[str, ...], Any, dict[str, str]]]:
    """Name, dims, values and attributes of each variable."""
    one, over_time = (_TRAJECTORY,), (_TRAJECTORY, _TIME)
    components = _components(many)
    for row, values in _parameters(many):
        yield row.name, one, values, _attributes(row.unit, row.meaning)
    for i, each in enumerate(components):
        meaning = f"{each.meaning}, at the start"
        yield f"{each.name}_start", one, many.starts[:, i], _attributes(each.unit, meaning)
    for i, each in enumerate(components):
        yield each.name, over_time, many.states[..., i], _attributes(each.unit, each.meaning)
    for name, (unit, found) in _derivatives(many).items():
        yield name, over_time, found, _attributes(unit, "derivative of the state")
    zero = "total energy, zero at rest at the lowest point"
    yield "energy", over_time, many.energy, _attributes("J", zero)
    if many.trust_horizon is not None:
        meaning = f"until when every angle is accurate to {many.task.certify:g} rad"
        yield "trust_horizon", one, many.trust_horizon, _attributes("s", meaning)
    yield "reached", one, many.reached, _attributes("s", "until when the run was made")
    yield "n_steps", one, many.n_steps, _attributes("1", "steps of the run")
    yield "outcome", one, many.outcomes, {"long_name": "how the run ended"}
    for number, found in enumerate(many.events, start=1):
        name = f"event{number}"
        yield f"{name}_{_TRAJECTORY}", (name,), found.trajectories, {"long_name": "trajectory"}
        yield f"{name}_{_TIME}", (name,), found.times, _attributes("s", "time of the crossing")
        for i, each in enumerate(components):
            attrs = _attributes(each.unit, f"{each.meaning}, at the crossing")
            yield f"{name}_{each.name}", (name,), found.states[:, i], attrs


def _parameters(many: Ensemble) -> Iterator[tuple[_engine.Parameter, Any]]:
    """The parameters (n,) of systems that differ."""
    import numpy as np

    if isinstance(many.systems, System) or len(many.systems) != len(many):
        return
    for row in many.systems[0]._rows():
        yield row, np.array([each.parameters[row.name] for each in many.systems])


def _derivatives(many: Ensemble) -> dict[str, tuple[str, Any]]:
    """Name → (unit, values (n, m)); none where they were not asked for."""
    if many.derivatives is None:
        return {}
    one = many.systems if isinstance(many.systems, System) else many.systems[0]
    return derivative_columns(one, many.derivative_names, many.derivatives)


def _components(many: Ensemble) -> tuple[_engine.Component, ...]:
    return tuple(_engine.system_entries()[many.task.system].components)


def _attributes(unit: str, meaning: str) -> dict[str, str]:
    return {"units": unit, "long_name": meaning}


def _described(many: Ensemble) -> str:
    """What was run, as a line of JSON; the states and the parameters are in the file."""
    systems = (many.systems,) if isinstance(many.systems, System) else many.systems
    task = many.task
    run = {
        "system": systems[0].description() if len(set(systems)) == 1 else None,
        "kind": task.system,
        "form": task.form,
        "method": task.method,
        "t0": task.t0,
        **task.described(),
    }
    return json.dumps({"pendula": __version__, "ensemble": run, "trajectories": len(many)})
