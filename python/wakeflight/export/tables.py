# SPDX-License-Identifier: MIT OR Apache-2.0
"""Tables for spreadsheets: one CSV file for every set of dimensions, a row for each place, the unit in the column's name."""

from __future__ import annotations

import csv
import io
import itertools
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..atomic import write_text

if TYPE_CHECKING:
    import xarray as xr

ACROSS = ("xyz", "mode", "harmonic", "state")
"""Dimensions whose parts become columns of their own: `hub_force_x`, `modal_1`."""


def write(data: xr.Dataset, folder: Path) -> Path:
    """Write `time.csv`, `time-blade.csv` ... and `scalars.csv`, as far as the result has them; returns the first."""
    groups: dict[tuple[str, ...], list[str]] = {}
    for name, variable in data.data_vars.items():
        rows = tuple(str(dim) for dim in variable.dims if dim not in ACROSS)
        groups.setdefault(rows, []).append(str(name))
    written = [_table(data, rows, names, folder) for rows, names in groups.items()]
    return written[0]


def _table(data: xr.Dataset, rows: tuple[str, ...], names: list[str], folder: Path) -> Path:
    """One file: coordinates of the rows first, then every variable."""
    sizes = [data.sizes[dim] for dim in rows]
    grid = np.meshgrid(*(data[dim].values for dim in rows), indexing="ij")
    columns = {_head(data, dim): values.ravel() for dim, values in zip(rows, grid, strict=True)}
    for name in names:
        across = [str(dim) for dim in data[name].dims if dim in ACROSS]
        labels = [[str(each) for each in data[dim].values] for dim in across]
        values = data[name].transpose(*across, *rows).values.reshape(-1, int(np.prod(sizes)))
        for parts, column in zip(itertools.product(*labels), values, strict=True):
            columns[_head(data, name, "_".join([name, *parts]))] = column
    path = folder / f"{'-'.join(rows) or 'scalars'}.csv"
    text = io.StringIO(newline="")
    writer = csv.writer(text)
    writer.writerow(columns)
    writer.writerows(zip(*(values.tolist() for values in columns.values()), strict=True))
    return write_text(path, text.getvalue())


def _head(data: xr.Dataset, name: str, shown: str | None = None) -> str:
    return f"{shown or name} [{data[name].attrs.get('units', '1')}]"
