"""What recordings and fits have in common: tables and files, which `pendula.io` makes of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pendula._late_methods import with_promised

if TYPE_CHECKING:
    from os import PathLike

    import pandas as pd
    import xarray as xr


@with_promised
class Storable:
    """A recording, a table of periods, a fit of either, or a comparison of models."""

    if TYPE_CHECKING:  # attached by the module that defines them

        def save(self, path: str | PathLike[str], *, overwrite: bool = False) -> None:
            """See `pendula.io.measured.save`."""

        def to_pandas(self) -> pd.DataFrame:
            """See `pendula.io.measured_tables.to_pandas`."""

        def to_xarray(self) -> xr.Dataset:
            """See `pendula.io.measured_tables.to_xarray`."""
