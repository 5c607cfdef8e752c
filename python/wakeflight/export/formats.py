# SPDX-License-Identifier: MIT OR Apache-2.0
"""Formats by name, and the verb that writes one of them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from ..arguments import checked
from ..errors import InputError
from . import matlab, older, tables, vtk, wopwop

if TYPE_CHECKING:
    import xarray as xr

FORMATS: dict[str, tuple[str, Callable[[xr.Dataset, Path], Path]]] = {
    "vtk": ("wake, blades and path for ParaView, in hub and in earth axes", vtk.write_all),
    "mat": (
        "MATLAB: every variable with unit and meaning",
        lambda data, folder: matlab.write(data, folder / "run.mat"),
    ),
    "csv": ("tables for spreadsheets, one per set of dimensions", tables.write),
    "netcdf3": (
        "NetCDF-3, for readers older than NetCDF-4",
        lambda data, folder: older.write(data, folder / "run-netcdf3.nc"),
    ),
    "wopwop": (
        "PSU-WOPWOP: the blades' lift along lines, for loading noise",
        lambda data, folder: wopwop.export_wopwop(data, folder),
    ),
}
"""What each format is for, and what writes it into a folder."""


@checked
def export(data: xr.Dataset, folder: str | Path, to: str = "vtk") -> Path:
    """Write a result for another program into `folder`; returns the file to open.

    data: Dataset of a flight, a trim or a stand (`flight.data`, `start.to_dataset()`, `wakeflight.results.load(path)`).
    to: a name of `FORMATS`: `vtk`, `mat`, `csv`, `netcdf3`, `wopwop`; `wf.export_wopwop` takes revolutions and observers too.
    """
    if to not in FORMATS:
        raise InputError.choice("to", to, FORMATS)
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    try:
        return FORMATS[to][1](data, folder)
    except ValueError as reason:
        raise InputError.of("to", to, str(reason)) from reason
