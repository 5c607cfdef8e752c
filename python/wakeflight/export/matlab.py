# SPDX-License-Identifier: MIT OR Apache-2.0
"""MATLAB: every variable by its name, beside it `units`, `meaning`, `dimensions` and `attributes` as structs."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

OWN = ("units", "meaning", "dimensions", "attributes")


def write(data: xr.Dataset, path: Path) -> Path:
    """Write a .mat file (version 5, read by MATLAB and Octave). Axes keep the order of `dimensions.NAME`; the same data give
    the same bytes but for the time in the file's head."""
    from scipy.io import savemat

    content: dict[str, Any] = {str(name): _plain(variable.values) for name, variable in data.variables.items()}
    clash = sorted(set(content) & set(OWN))
    if clash:
        raise ValueError(f"variables have names of the file's own structs: {', '.join(clash)}")
    names = [str(name) for name in data.variables]
    content["units"] = {name: str(data[name].attrs.get("units", "")) for name in names}
    content["meaning"] = {name: str(data[name].attrs.get("long_name", "")) for name in names}
    content["dimensions"] = {name: ", ".join(map(str, data[name].dims)) for name in names}
    content["attributes"] = {_field(str(name)): value for name, value in data.attrs.items()}
    savemat(path, content, long_field_names=True, do_compression=True, oned_as="column")
    return path


def _plain(values: np.ndarray) -> np.ndarray:
    """Text as MATLAB has it: a cell of strings."""
    return values.astype(object) if values.dtype.kind == "U" else values


def _field(name: str) -> str:
    """A name that a struct may have: letters, digits, underscores."""
    return re.sub(r"\W", "_", name)[:63]
