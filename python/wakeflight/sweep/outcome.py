# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a case gave: arrays by name as plain numbers and texts, or why there are none."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError, Interrupted, WakeflightError, one_line

Array = tuple[tuple[str, ...], np.ndarray, dict[str, str]]
"""Dimensions, values (float64 or text), and what is said of them."""


@dataclass(frozen=True)
class Outcome:
    """Variables and coordinates of a case; failure: why it stopped, empty if it did not. lasting: whether it would again."""

    variables: Mapping[str, Array] = field(default_factory=dict)
    coordinates: Mapping[str, Array] = field(default_factory=dict)
    warnings: str = ""
    failure: str = ""
    lasting: bool = True


def attempted(run: Callable[[Mapping[str, Any]], Any], case: Mapping[str, Any], kept: Kept) -> Outcome:
    """Run a case; an error becomes the failure."""
    try:
        return outcome(run(case), kept)
    except (Interrupted, KeyboardInterrupt):
        raise
    except (Exception, MemoryError) as reason:
        return Outcome(failure=told(reason))


def told(reason: BaseException) -> str:
    """An error in words; of one that is not the program's own also where it came from."""
    if isinstance(reason, WakeflightError):
        return str(reason) or type(reason).__name__
    trace = traceback.extract_tb(reason.__traceback__)
    where = f" ({Path(trace[-1].filename).name}, line {trace[-1].lineno})" if trace else ""
    return one_line(f"{type(reason).__name__}: {reason}{where}")


@dataclass(frozen=True)
class Kept:
    """Variables that a table keeps: those of `names`, or where there are none, those with no other dimensions than `dims`."""

    names: tuple[str, ...] | None = None
    dims: tuple[str, ...] | None = None

    def of(self, names: Mapping[str, tuple[str, ...]]) -> list[str]:
        """Names of those that are kept, of variables with their dimensions."""
        if self.names is not None:
            for name in self.names:
                if name not in names:
                    raise InputError.choice("keep", name, names)
            return list(self.names)
        return [name for name, dims in names.items() if self.dims is None or set(dims) <= set(self.dims)]


def outcome(data: Any, kept: Kept) -> Outcome:
    """What a case returned, a Dataset or numbers by name, as plain arrays."""
    match data:
        case dict() if all(np.ndim(value) == 0 for value in data.values()):
            # numbers by name need no xarray, which takes a second to be imported
            scalars = {str(name): np.asarray(value) for name, value in data.items()}
            chosen = kept.of({name: () for name in scalars})
            return Outcome({k: v for name in chosen for k, v in _plain(name, (), scalars[name], {}).items()})
    found = _dataset(data)
    names = kept.of({str(name): tuple(map(str, each.dims)) for name, each in found.variables.items()})
    chosen = [name for name in names if name in found.data_vars]
    dims = {dim for name in chosen for dim in found[name].dims}
    variables: dict[str, Array] = {}
    for name in chosen:
        variables |= _plain(name, found[name].dims, found[name].values, found[name].attrs)
    coordinates: dict[str, Array] = {}
    for name, each in found.coords.items():
        if each.dims and set(each.dims) <= dims:
            coordinates |= _plain(str(name), each.dims, each.values, each.attrs)
    return Outcome(variables, coordinates, str(found.attrs.get("warnings", "")))


def _dataset(data: Any) -> Any:
    """What a function returned as a Dataset."""
    import xarray as xr

    match data:
        case xr.Dataset():
            return data
        case xr.DataArray():
            return data.to_dataset(name=data.name or "value")
        case Mapping():
            return xr.Dataset({str(name): value for name, value in data.items()})
        case None:
            return xr.Dataset()
    return xr.Dataset({"value": data})


def _plain(name: str, along: Sequence[Any], values: Any, attributes: Mapping[Any, Any]) -> dict[str, Array]:
    """A variable as float64 or text; a complex one as two."""
    values, dims = np.asarray(values), tuple(map(str, along))
    said = {key: str(attributes[key]) for key in ("units", "long_name") if key in attributes}
    if values.dtype.kind == "c":
        parts: Sequence[tuple[str, np.ndarray]] = (("real", values.real), ("imag", values.imag))
        return {f"{name}_{part}": (dims, np.asarray(each, dtype=float), said) for part, each in parts}
    if values.dtype.kind in "biuf":
        return {name: (dims, np.asarray(values, dtype=float), said)}
    return {name: (dims, np.asarray(values, dtype=str), said)}
