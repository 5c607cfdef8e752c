# SPDX-License-Identifier: MIT OR Apache-2.0
"""Memory of controllers as text: numbers to the last bit, nothing that could run when it is read."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

KEPT = "numbers, text, arrays of numbers, and lists, tuples and dicts of them"


def packed(state: Mapping[str, Any]) -> bytes:
    """`state` as JSON text; ValueError names what cannot be kept."""
    return json.dumps({name: _packed(name, value) for name, value in state.items()}).encode()


def unpacked(block: bytes) -> dict[str, Any]:
    """What `packed` was given."""
    return {name: _unpacked(value) for name, value in json.loads(block).items()}


def _packed(name: str, value: Any) -> Any:
    if value is None or isinstance(value, bool | str):
        return value
    if isinstance(value, np.ndarray | np.generic):
        array = np.asarray(value)
        if array.dtype.kind not in "fiub":
            raise ValueError(f"{name} is an array of {array.dtype}; kept are {KEPT}")
        kind = "array" if isinstance(value, np.ndarray) else "scalar"
        return {kind: [array.dtype.str, list(array.shape), array.tobytes().hex()]}
    if isinstance(value, int | float):
        # text of a float is its shortest that reads back as the same bits
        return value
    if isinstance(value, list | tuple):
        kind = "list" if isinstance(value, list) else "tuple"
        return {kind: [_packed(f"{name}[{k}]", each) for k, each in enumerate(value)]}
    if isinstance(value, dict):
        return {"dict": [[_packed(f"a key of {name}", k), _packed(f"{name}[{k!r}]", v)] for k, v in value.items()]}
    raise ValueError(f"{name} is a {type(value).__name__}; kept are {KEPT}")


def _unpacked(value: Any) -> Any:
    if not isinstance(value, dict):
        return value
    (kind, content), *_ = value.items()
    if kind in ("array", "scalar"):
        dtype, shape, text = content
        array = np.frombuffer(bytes.fromhex(text), np.dtype(dtype)).reshape(shape).copy()
        return array if kind == "array" else array[()]
    if kind == "dict":
        return {_unpacked(k): _unpacked(v) for k, v in content}
    return [_unpacked(each) for each in content] if kind == "list" else tuple(_unpacked(each) for each in content)
