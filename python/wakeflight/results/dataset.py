# SPDX-License-Identifier: MIT OR Apache-2.0
"""Datasets assembled from arrays and checked against the schema."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import instruction_set
from .attributes import flat_attributes
from .errors import ResultsError
from .schema import ATTRIBUTES, COORDINATES, LOOP, NAMED, RUN, SCHEMA, TRANSIENT, TRIM, TUNNEL, Variable

if TYPE_CHECKING:
    import xarray as xr

Arrays = Mapping[str, Any]


def assemble(arrays: Arrays, attributes: Mapping[str, Any]) -> xr.Dataset:
    """Dataset of one run, from arrays in SI (sticks in inches) by the names of the schema's `RUN` table.

    `arrays` holds variables and the coordinates `time` [s], `station` (r/R) and, with a wake, `age` [rad];
    the other coordinates are counted if not given. Checked: names, dimensions, shapes, finiteness and the
    required attributes. A run that failed is marked by `failure` in `attributes`: it gets `finished = 0`.
    """
    marked = {**_program(), "failure": "", **attributes}
    # netCDF has no truth values: 0 and 1
    marked["finished"] = int(marked.get("finished", not marked["failure"]))
    if not marked["finished"] and not marked["failure"]:
        raise ResultsError("failure: a run that did not finish must say why")
    missing = [a.name for a in ATTRIBUTES if a.required and a.name not in marked]
    if missing:
        raise ResultsError(f"attributes missing: {', '.join(missing)}")
    return _dataset(RUN, arrays, marked, increasing=("time", "station", "age", "psi"))


def assemble_trim(arrays: Arrays, attributes: Mapping[str, Any]) -> xr.Dataset:
    """Dataset of one trim, from arrays by the names of the schema's `TRIM` table, checked like a run."""
    marked = {**_program(), **attributes}
    return _dataset(TRIM, arrays, marked, increasing=("azimuth", "station"))


def assemble_tunnel(arrays: Arrays, attributes: Mapping[str, Any]) -> xr.Dataset:
    """Dataset of a rotor on a stand, from arrays by the names of the schema's `TUNNEL` table, checked like a run."""
    marked = {**_program(), **attributes}
    return _dataset(TUNNEL, arrays, marked, increasing=("azimuth", "station", "age", "revolution"))


def assemble_transient(arrays: Arrays, attributes: Mapping[str, Any]) -> xr.Dataset:
    """Dataset of a transient on the stand, from arrays by the names of the schema's `TRANSIENT` table, checked like a run."""
    marked = {**_program(), **attributes}
    marked["finished"] = int(not marked.get("failure"))
    return _dataset(TRANSIENT, arrays, marked, increasing=("time", "station", "age"))


def assemble_loop(arrays: Arrays, attributes: Mapping[str, Any]) -> xr.Dataset:
    """Dataset of a section in harmonic motion, from arrays by the names of the schema's `LOOP` table, checked like a run."""
    marked = {**_program(), **attributes}
    return _dataset(LOOP, arrays, marked, increasing=("phase",))


def _dataset(
    table: Sequence[Variable], arrays: Arrays, attributes: Mapping[str, Any], increasing: Sequence[str]
) -> xr.Dataset:
    """Arrays checked against one table and labelled by it."""
    import xarray as xr

    declared = {variable.name: variable for variable in table}
    given = {name: np.asarray(values) for name, values in arrays.items()}
    unknown = sorted(set(given) - set(declared) - set(COORDINATES))
    if unknown:
        raise ResultsError(f"not in the schema: {', '.join(unknown)}")
    missing = [v.name for v in table if not v.optional and v.name not in given]
    if missing:
        raise ResultsError(f"missing: {', '.join(missing)}")
    variables = {name: values for name, values in given.items() if name in declared}
    sizes = _sizes(declared, variables)
    coordinates = _coordinates(given, sizes, increasing)
    for name, values in {**coordinates, **variables}.items():
        _finite(name, values)
    data = {v.name: (v.dims, variables[v.name], _label(v)) for v in table if v.name in variables}
    coords = {name: ((name,), values, _label(COORDINATES[name])) for name, values in coordinates.items()}
    return xr.Dataset(data, coords, flat_attributes(attributes))


def _sizes(declared: Mapping[str, Variable], variables: Arrays) -> dict[str, int]:
    """Length of every dimension, the same in all variables or an error naming the two that differ."""
    sizes: dict[str, tuple[int, str]] = {"xyz": (3, "xyz")}
    for name, values in variables.items():
        dims = declared[name].dims
        if values.ndim != len(dims):
            raise ResultsError(f"{name}: shape {values.shape}, expected dimensions ({', '.join(dims)})")
        if values.dtype.kind not in "fiu":
            raise ResultsError(f"{name}: {values.dtype}, expected numbers")
        for dim, n in zip(dims, values.shape, strict=True):
            known, by = sizes.setdefault(dim, (n, name))
            if n != known:
                raise ResultsError(f"{name}: {n} along {dim}, but {by} has {known}")
    return {dim: n for dim, (n, _) in sizes.items()}


def _coordinates(given: Arrays, sizes: Mapping[str, int], increasing: Sequence[str]) -> dict[str, np.ndarray]:
    """Coordinate of every dimension in use: given, or counted where counting is what it means."""
    coordinates: dict[str, np.ndarray] = {}
    for dim, n in sizes.items():
        if dim in NAMED:
            values = np.array(NAMED[dim])
        elif dim in given:
            values = given[dim]
        elif dim in ("blade", "trailer", "mode", "harmonic", "snapshot", "revolution"):
            values = np.arange(n) if dim in ("harmonic", "snapshot") else np.arange(1, n + 1)
        else:
            raise ResultsError(f"coordinate {dim} [{COORDINATES[dim].units}] is missing")
        if values.shape != (n,):
            raise ResultsError(f"coordinate {dim}: shape {values.shape}, expected ({n},)")
        if dim in increasing and n > 1 and not np.all(np.diff(values) > 0):
            raise ResultsError(f"coordinate {dim}: not increasing")
        coordinates[dim] = values
    return coordinates


def _finite(name: str, values: np.ndarray) -> None:
    """NaN never travels: the error names the first place."""
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        first = tuple(int(i) for i in np.argwhere(~np.isfinite(values))[0])
        raise ResultsError(f"{name}: not finite at index {first}")


def _label(variable: Variable) -> dict[str, str]:
    return {"units": variable.units, "long_name": variable.long_name}


def _program() -> dict[str, str | int]:
    """What computed the run: version and the instruction set of its sums; version of the schema."""
    try:
        program_version = version("wakeflight")
    except PackageNotFoundError:
        program_version = "unknown"
    return {"schema": SCHEMA, "program_version": program_version, "instruction_set": instruction_set()}
