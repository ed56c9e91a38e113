"""The file formats: a writer and a reader each. Readers give (attributes, times, states)."""

from __future__ import annotations

import csv
from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._attributes import KEY
from pendula._checks import extra
from pendula.io.attributes import NotATrajectoryError
from pendula.io.tables import columns, one_motion, to_pandas, to_xarray

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from pendula._types import Array
    from pendula.run.trajectory import Trajectory

    Read = tuple[str, Array, Array]

MARK = f"# {KEY}: "  # before the attributes, in the first line of a CSV file


def packages(ending: str) -> tuple[str, ...]:
    """What reading and writing files of that ending needs beyond the base install."""
    return {
        ".csv": (),
        ".nc": ("xarray", "h5netcdf"),
        ".parquet": ("pandas", "pyarrow"),
        ".zarr": ("xarray", "zarr"),
    }[ending]


def _write_csv(trajectory: Trajectory, attributes: str, path: Path) -> None:
    one_motion(trajectory, "a .csv file")
    table = columns(trajectory)
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write(f"{MARK}{attributes}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t [s]", *(f"{name} [{unit}]" for name, (unit, _) in table.items())])
        # float's own shortest decimal form: it gives the same bits back
        writer.writerows(
            zip(
                trajectory.t.tolist(),
                *(values.tolist() for _, values in table.values()),
                strict=True,
            )
        )


def _read_csv(path: Path) -> Read:
    import numpy as np

    with path.open(encoding="utf-8", newline="") as file:
        first = file.readline()
        if not first.startswith(MARK):
            raise NotATrajectoryError(
                f"{path} was not written by pendula: its first line lacks {MARK!r}"
            )
        rows = list(csv.reader(file))
    if not rows or any(len(row) != len(rows[0]) for row in rows):
        raise ValueError(
            f"{path} is not whole: its rows differ in length, or the header is missing"
        )
    try:
        cells = [[float(cell) for cell in row] for row in rows[1:]]
    except ValueError as error:
        raise NotATrajectoryError(f"{path} holds something else than numbers: {error}") from None
    header, values = rows[0], np.array(cells, dtype=np.float64)
    names = [name.partition(" [")[0] for name in header]
    table = {name: values[:, i] if values.size else np.empty(0) for i, name in enumerate(names)}
    return first[len(MARK) :], table["t"], _states(table, path)


def _states(table: Any, path: Path) -> Array:
    """The states' columns of a table, (n, d); whose names say which system it is."""
    import numpy as np

    for entry in _engine.system_entries().values():
        names = [each.name for each in entry.components]
        if all(name in table for name in names):
            return np.stack([np.asarray(table[name], dtype=np.float64) for name in names], axis=-1)
    raise NotATrajectoryError(f"{path} lacks the columns of a pendulum's states")


def _write_parquet(trajectory: Trajectory, attributes: str, path: Path) -> None:
    arrow, parquet = extra("pyarrow", "io"), extra("pyarrow.parquet", "io")
    table = arrow.Table.from_pandas(to_pandas(trajectory), preserve_index=False)
    parquet.write_table(table.replace_schema_metadata({KEY: attributes}), path)


def _read_parquet(path: Path) -> Read:
    table = extra("pyarrow.parquet", "io").read_table(path)
    frame = {name.partition(" [")[0]: table[name].to_numpy() for name in table.column_names}
    metadata = table.schema.metadata or {}
    return metadata.get(KEY.encode(), b"{}").decode(), frame["t"], _states(frame, path)


def _write_netcdf(trajectory: Trajectory, attributes: str, path: Path) -> None:
    extra("h5netcdf", "io")
    to_xarray(trajectory).to_netcdf(path, engine="h5netcdf")


def _write_zarr(trajectory: Trajectory, attributes: str, path: Path) -> None:
    extra("zarr", "io")
    to_xarray(trajectory).to_zarr(path, zarr_format=3, consolidated=False)


def _read_dataset(engine: str) -> Callable[[Path], Read]:
    def read(path: Path) -> Read:
        xarray = extra("xarray", "io")
        options = {"consolidated": False} if engine == "zarr" else {}
        with xarray.open_dataset(path, engine=engine, **options) as dataset:
            return str(dataset.attrs.get(KEY, "{}")), dataset["t"].values, _states(dataset, path)

    return read


FORMATS: dict[str, tuple[Callable[[Trajectory, str, Path], None], Callable[[Path], Read]]] = {
    ".csv": (_write_csv, _read_csv),
    ".nc": (_write_netcdf, _read_dataset("h5netcdf")),
    ".parquet": (_write_parquet, _read_parquet),
    ".zarr": (_write_zarr, _read_dataset("zarr")),
}
