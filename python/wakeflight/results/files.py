# SPDX-License-Identifier: MIT OR Apache-2.0
"""Datasets to and from NetCDF."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ..arguments import checked
from .attributes import flat_attributes
from .reading import DIGEST, digest, of_kind, opened, seal

if TYPE_CHECKING:
    import xarray as xr


@checked
def save(dataset: xr.Dataset, path: str | Path) -> Path:
    """Write NetCDF-4, compressed; the same dataset gives the same bytes. Returns the path."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    flat = dataset.copy()
    flat.attrs = flat_attributes(dataset.attrs)
    flat.attrs[DIGEST] = digest(flat)
    encoding = {
        name: {"zlib": True, "complevel": 4, "shuffle": True}
        for name, variable in flat.variables.items()
        if variable.ndim and variable.dtype.kind in "fiu"
    }
    flat.to_netcdf(path, engine="h5netcdf", format="NETCDF4", encoding=encoding)
    with path.open("r+b") as stream:
        seal(stream)
    return path


@checked
def load(path: str | Path, kind: str | None = None) -> xr.Dataset:
    """Read a run or a trim back into memory; the file is closed. Nothing in it is executed.

    kind: what it must be, a key of `reading.KINDS`. Refused is what is damaged, changed or no such result.
    """
    return of_kind(opened(Path(path)), Path(path), kind)


def by_name(runs: xr.Dataset | Mapping[str, xr.Dataset], single: str | None = None) -> dict[str, xr.Dataset]:
    """Runs by name; a single one (a Dataset is a mapping too) goes by the name `single`, or by its inflow model."""
    import xarray as xr

    if isinstance(runs, xr.Dataset):
        return {str(runs.attrs.get("inflow_model", "run")) if single is None else single: runs}
    return dict(runs)
