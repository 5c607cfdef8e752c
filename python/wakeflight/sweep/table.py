# SPDX-License-Identifier: MIT OR Apache-2.0
"""One labelled table of what the cases gave, in the order of the cases, whatever the order in which they were done.

Numbers of a case without an answer are nan, texts empty. Along dimensions of their own, results are put side by side: by
their names where the coordinate is text, as they are where all have the same numbers; where those differ (times of flights of
different length) by their places along `NAME_step`, and the coordinate becomes a variable.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .cases import Cases
from .outcome import Outcome

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class _Along:
    """A dimension of the results: its name and length in the table, its coordinate, and where those of a case go."""

    name: str
    size: int
    coordinate: np.ndarray | None
    places: Mapping[int, np.ndarray]


def assembled(cases: Cases, outcomes: Sequence[Outcome], attributes: Mapping[str, Any]) -> xr.Dataset:
    """The table."""
    import xarray as xr

    done = {k: each for k, each in enumerate(outcomes) if not each.failure}
    outer = tuple(name for name, _ in cases.shape)
    shape = tuple(n for _, n in cases.shape)
    along = _dimensions(done)
    arrays: dict[str, Any] = {}
    said: dict[str, dict[str, str]] = {}
    coordinates: dict[str, Any] = {
        name: (dims, values, attributes) for name, (dims, values, attributes) in cases.coordinates.items()
    }
    names: dict[str, tuple[str, ...]] = {}
    for each in done.values():
        for name, (dims, _, told) in (*each.variables.items(), *each.coordinates.items()):
            names.setdefault(name, dims)
            said.setdefault(name, told)
    for name, dims in names.items():
        if name in along and along[name].name == name:
            coordinate = along[name].coordinate
            if coordinate is not None:
                coordinates[name] = ((name,), coordinate, said[name])
            continue
        given = {k: {**each.variables, **each.coordinates}.get(name) for k, each in done.items()}
        arrays[_free(name, outer, cases)] = (
            (*outer, *(along[dim].name for dim in dims)),
            _filled(
                cases,
                shape,
                {k: each for k, each in given.items() if each is not None and each[0] == dims},
                dims,
                along,
            ),
            said[name],
        )
    texts = {
        "failure": ([each.failure for each in outcomes], "why there is no answer, empty where there is one"),
        "warnings": ([each.warnings for each in outcomes], "what lies beyond a limit of aircraft or model"),
    }
    for name, (lines, meaning) in texts.items():
        arrays[name] = (outer, np.array(lines, dtype=str).reshape(shape), {"long_name": meaning})
    found = xr.Dataset(arrays, coords=coordinates)
    return found.assign_attrs({**attributes, "cases": len(outcomes), "failed": len(outcomes) - len(done)})


def _free(name: str, outer: tuple[str, ...], cases: Cases) -> str:
    """Name of a variable; one that an axis has too (a speed that was asked for, and found) is called what was found."""
    return f"{name}_found" if name in outer or name in cases.coordinates else name


def _dimensions(done: Mapping[int, Outcome]) -> dict[str, _Along]:
    """Dimensions of the results by their own names."""
    sizes: dict[str, dict[int, int]] = {}
    labels: dict[str, dict[int, np.ndarray]] = {}
    for k, each in done.items():
        for name, (dims, values, _) in (*each.variables.items(), *each.coordinates.items()):
            for dim, n in zip(dims, values.shape, strict=True):
                sizes.setdefault(dim, {})[k] = n
            if dims == (name,):
                labels.setdefault(name, {})[k] = values
    return {dim: _dimension(dim, of_case, labels.get(dim, {})) for dim, of_case in sizes.items()}


def _dimension(name: str, sizes: Mapping[int, int], labels: Mapping[int, np.ndarray]) -> _Along:
    size = max(sizes.values())
    in_row = {k: np.arange(n) for k, n in sizes.items()}
    if set(labels) != set(sizes):
        return _Along(name if len(set(sizes.values())) == 1 else f"{name}_step", size, None, in_row)
    first = next(iter(labels.values()))
    if all(np.array_equal(first, each) for each in labels.values()):
        return _Along(name, size, first, in_row)
    if first.dtype.kind == "U":
        known = {label: i for i, label in enumerate(dict.fromkeys(str(x) for each in labels.values() for x in each))}
        if all(len(set(each.tolist())) == each.size for each in labels.values()):
            places = {k: np.array([known[str(x)] for x in each], dtype=int) for k, each in labels.items()}
            return _Along(name, len(known), np.array(list(known)), places)
    return _Along(f"{name}_step", size, None, in_row)


def _filled(
    cases: Cases, shape: tuple[int, ...], given: Mapping[int, Any], dims: tuple[str, ...], along: Mapping[str, _Along]
) -> np.ndarray:
    """Values of all cases in one array."""
    own = tuple(along[dim].size for dim in dims)
    text = any(values.dtype.kind == "U" for _, values, _ in given.values())
    whole: Any = np.full((*shape, *own), "" if text else np.nan, dtype=object if text else float)
    for k, (_, values, _) in given.items():
        target = whole[cases.place(k)] if cases.shape else whole
        if dims:
            target[np.ix_(*(np.asarray(along[dim].places[k]) for dim in dims))] = values
        else:
            whole[(*cases.place(k), ...)] = values
    table: np.ndarray = whole.astype(str) if text else whole
    return table
