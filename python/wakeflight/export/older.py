# SPDX-License-Identifier: MIT OR Apache-2.0
"""NetCDF-3, which every NetCDF reader takes: whole numbers of 32 bits, no compression."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..atomic import write_bytes

if TYPE_CHECKING:
    import xarray as xr


def write(data: xr.Dataset, path: Path) -> Path:
    """Write the whole result as NetCDF-3 with 64-bit offsets: the same variables, units and attributes."""
    plain = data.copy()
    # NetCDF-3 knows no names with dots and no whole numbers of 64 bits
    plain.attrs = {name.replace(".", "_"): _attribute(value) for name, value in data.attrs.items()}
    for name in plain.variables:
        plain[name].encoding = {}
    return write_bytes(path, plain.to_netcdf(engine="scipy", format="NETCDF3_64BIT"))


def _attribute(value: object) -> object:
    """Counters beyond 32 bits as floating point."""
    if isinstance(value, int) and not np.iinfo(np.int32).min <= value <= np.iinfo(np.int32).max:
        return float(value)
    return value
