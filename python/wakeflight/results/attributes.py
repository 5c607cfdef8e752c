# SPDX-License-Identifier: MIT OR Apache-2.0
"""Attributes of a dataset as plain text and numbers, which is what NetCDF knows."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .errors import ResultsError


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
