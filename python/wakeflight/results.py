"""Results: datasets assembled and checked against the schema, saved to and loaded from NetCDF."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .schema import ATTRIBUTES, COORDINATES, RUN, TRANSIENT, TRIM, TUNNEL, Variable

if TYPE_CHECKING:
    import xarray as xr

Arrays = Mapping[str, Any]


class ResultsError(ValueError):
    """Arrays that do not fit the schema: names the variable, what it has and what is expected."""


def assemble(arrays: Arrays, attributes: Mapping[str, Any]) -> xr.Dataset:
    """Dataset of one run, from arrays in SI (sticks in inches) by the names of the schema's `RUN` table.

    `arrays` holds variables and the coordinates `time` [s], `station` (r/R) and, with a wake, `age` [rad];
    the other coordinates are counted if not given. Checked: names, dimensions, shapes, finiteness and the
    required attributes. A run that failed is marked by `failure` in `attributes`: it gets `finished = 0`.
    """
    marked = {"program_version": _program_version(), "failure": "", **attributes}
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
    marked = {"program_version": _program_version(), **attributes}
    return _dataset(TRIM, arrays, marked, increasing=("azimuth", "station"))


def assemble_tunnel(arrays: Arrays, attributes: Mapping[str, Any]) -> xr.Dataset:
    """Dataset of a rotor on a stand, from arrays by the names of the schema's `TUNNEL` table, checked like a run."""
    marked = {"program_version": _program_version(), **attributes}
    return _dataset(TUNNEL, arrays, marked, increasing=("azimuth", "station", "age", "revolution"))


def assemble_transient(arrays: Arrays, attributes: Mapping[str, Any]) -> xr.Dataset:
    """Dataset of a transient on the stand, from arrays by the names of the schema's `TRANSIENT` table, checked like a run."""
    marked = {"program_version": _program_version(), **attributes}
    marked["finished"] = int(not marked.get("failure"))
    return _dataset(TRANSIENT, arrays, marked, increasing=("time", "station", "age"))


def save(dataset: xr.Dataset, path: str | Path) -> Path:
    """Write NetCDF-4, compressed; the same dataset gives the same bytes. Returns the path."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    flat = dataset.copy()
    flat.attrs = flat_attributes(dataset.attrs)
    encoding = {
        name: {"zlib": True, "complevel": 4, "shuffle": True}
        for name, variable in flat.variables.items()
        if variable.ndim and variable.dtype.kind in "fiu"
    }
    flat.to_netcdf(path, engine="h5netcdf", format="NETCDF4", encoding=encoding)
    return path


def load(path: str | Path) -> xr.Dataset:
    """Read a run or a trim back into memory; the file is closed."""
    import xarray as xr

    path = Path(path)
    if not path.is_file():
        raise ResultsError(f"{path}: no such file")
    try:
        return xr.load_dataset(path, engine="h5netcdf")
    except OSError as error:
        raise ResultsError(f"{path}: not a NetCDF-4 file ({error})") from error


def flat_attributes(attributes: Mapping[str, Any]) -> dict[str, str | int | float]:
    """Attributes as plain text and numbers: a mapping becomes JSON text and a dotted name per scalar."""
    flat: dict[str, str | int | float] = {}
    for name, value in attributes.items():
        if isinstance(value, Mapping):
            flat |= _leaves(name, value)
            flat[name] = _scalar(name, value)
        else:
            flat[name] = _scalar(name, value)
    return flat


def _leaves(prefix: str, mapping: Mapping[str, Any]) -> dict[str, str | int | float]:
    """Scalars of a nested mapping by dotted names; tables and lists stay in the JSON text alone."""
    leaves: dict[str, str | int | float] = {}
    for key, value in mapping.items():
        name = f"{prefix}.{key}"
        if isinstance(value, Mapping):
            leaves |= _leaves(name, value)
        elif not isinstance(_plain(value), list):
            leaves[name] = _scalar(name, value)
    return leaves


def _scalar(name: str, value: Any) -> str | int | float:
    """One attribute as text or a finite number."""
    value = _plain(value)
    if value is None:
        return "none"
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, float) and not np.isfinite(value):
        raise ResultsError(f"attribute {name}: {value} is not finite")
    if isinstance(value, str | int | float):
        return value
    try:
        return json.dumps(value, default=_plain, sort_keys=True, allow_nan=False)
    except ValueError as error:
        raise ResultsError(f"attribute {name}: {error}") from error


def _plain(value: Any) -> Any:
    """Numpy numbers and arrays, paths and tuples as what JSON knows."""
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Path):
        return str(value)
    if isinstance(value, tuple | set | frozenset):
        return list(value)
    if isinstance(value, str | int | float | bool | list | dict | Mapping) or value is None:
        return dict(value) if isinstance(value, Mapping) else value
    raise ResultsError(f"{type(value).__name__} cannot be stored as an attribute")


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
        if dim == "xyz":
            values = np.array(["x", "y", "z"])
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


def _program_version() -> str:
    try:
        return version("wakeflight")
    except PackageNotFoundError:
        return "unknown"
