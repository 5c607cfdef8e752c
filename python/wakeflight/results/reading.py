# SPDX-License-Identifier: MIT OR Apache-2.0
"""Results that come back from files: whole and unchanged, of the kind that is asked for, or refused in one line.

A file is data: nothing in it is executed, nothing unpickled. HDF5 checks little of what it reads and may read damage without
end, so a file ends with a digest of its bytes, which HDF5 does not look at and which is met before HDF5 sees the file; and it
carries one of its content, for files that another program has copied.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from ..errors import one_line, shortened
from ..text import is_file
from .errors import ResultsError
from .schema import ATTRIBUTES, LOOP, RUN, SCHEMA, TRANSIENT, TRIM, TUNNEL, Variable

if TYPE_CHECKING:
    import xarray as xr

DIGEST = "content"
"""Attribute with the digest of all variables and attributes."""

KINDS: dict[str, tuple[Variable, ...]] = {
    "flight": RUN,
    "trim": TRIM,
    "stand": TUNNEL,
    "transient of a stand": TRANSIENT,
    "section in motion": LOOP,
}
"""Kinds of results by their variables."""

SEAL = b"WKFLSEAL"
"""Mark before the digest that ends a file."""

PACKED = 1100
"""Most bytes that one byte of a compressed file can stand for: deflate reaches 1032."""


def seal(stream: BinaryIO) -> None:
    """Put the digest of all its bytes at the end of a file that is written; the stream can be read."""
    stream.seek(0)
    stream.write(SEAL + _summed(iter(lambda: stream.read(1 << 20), b"")))


def sealed(path: Path) -> bool:
    """Whether a file has a seal, which those of other programs and older ones lack; refused where other bytes were sealed."""
    with path.open("rb") as stream:
        left = max(path.stat().st_size - _SEALED, 0)
        found = _summed(iter(lambda: stream.read(min(1 << 20, left - stream.tell())), b""))
        end = stream.read(_SEALED)
    if end.startswith(SEAL) and end != SEAL + found:
        raise ResultsError(f"{_told(path)}: damaged or changed: its bytes are not those it was written with")
    return end.startswith(SEAL)


def _summed(parts: Iterable[bytes | memoryview]) -> bytes:
    """Digest of bytes."""
    summed = hashlib.blake2b(digest_size=16)
    for part in parts:
        summed.update(part)
    return summed.digest()


_SEALED = len(SEAL) + 16
"""Bytes of a seal."""


def opened(path: Path) -> xr.Dataset:
    """The dataset of a NetCDF-4 file, in memory, unchanged since it was written; the file is closed."""
    import h5py
    import xarray as xr

    if not is_file(path):
        raise ResultsError(f"{_told(path)}: no such file")
    size = path.stat().st_size
    if size == 0:
        raise ResultsError(f"{_told(path)}: the file is empty: the program that wrote it was stopped")
    sealed(path)
    try:
        # no HDF5, or one without a head, is refused here: deeper down it would be told on the standard error as well
        with h5py.File(path, "r") as head:
            dict(head.attrs)
        with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as file:
            unpacked = sum(each.dtype.itemsize * each.size for each in file.variables.values())
            if unpacked > PACKED * size + (1 << 20):
                raise ResultsError(f"{_told(path)}: {size} bytes cannot hold the {unpacked} bytes that the file claims")
            data = file.load()
    except ResultsError:
        raise
    except (Exception, MemoryError) as reason:  # HDF5 tells damage by errors of many kinds
        why = shortened(one_line(reason), 160)
        raise ResultsError(f"{_told(path)}: not a NetCDF-4 file, or a damaged one ({why})") from reason
    kept = data.attrs.pop(DIGEST, None)
    if kept is not None and kept != digest(data):
        raise ResultsError(f"{_told(path)}: damaged or changed: its numbers are not those it was written with")
    schema = data.attrs.get("schema", 1)
    if schema not in range(1, SCHEMA + 1):
        found = f"schema = {schema!s:.20}: this program reads 1 to {SCHEMA}; a newer one wrote the file"
        raise ResultsError(f"{_told(path)}: {found}")
    return data


def of_kind(data: xr.Dataset, path: Path, wanted: str | None = None) -> xr.Dataset:
    """`data` if it is whole by the schema of its kind, of the kind `wanted` where one is; ResultsError otherwise."""
    found = next((kind for kind, table in KINDS.items() if not _lacking(data, table)), None)
    if wanted is not None and wanted not in KINDS:
        raise ResultsError.of("kind", wanted, f"allowed: {', '.join(KINDS)}")
    if wanted is not None and found != wanted:
        lacking = _lacking(data, KINDS[wanted])
        what = f"holds a {found}" if found else f"holds no {wanted}: it has no {', '.join(lacking[:3])}"
        raise ResultsError(f"{_told(path)}: {what}; needed is the file of a {wanted}")
    if found is None:
        return data
    for name, variable in data.variables.items():
        if variable.dtype.kind == "f" and not np.isfinite(variable.values).all():
            raise ResultsError(f"{_told(path)}: {shortened(one_line(name), 60)} holds numbers that are not finite")
    if found == "flight":
        missing = [each.name for each in ATTRIBUTES if each.required and each.name not in data.attrs]
        if missing:
            raise ResultsError(f"{_told(path)}: the attributes {', '.join(missing)} are missing; a flight has them")
    return data


def digest(data: xr.Dataset) -> str:
    """Digest of names, dimensions, numbers and attributes of a dataset, the same before and after a file."""
    return _summed(_content(data)).hex()


def _content(data: xr.Dataset) -> Iterator[bytes | memoryview]:
    """Everything a dataset says, in an order of its own."""
    yield _attributes(data.attrs)
    for name in sorted(map(str, data.variables)):
        variable = data.variables[name]
        yield json.dumps([name, list(variable.dims), list(variable.shape)]).encode()
        yield _attributes(variable.attrs)
        if variable.dtype.kind in "fiub":
            wide = np.asarray(variable.values, "<f8" if variable.dtype.kind == "f" else "<i8")
            yield np.ascontiguousarray(wide).data
        else:
            yield json.dumps([str(each) for each in variable.values.ravel()]).encode()


def _attributes(attributes: Mapping[Any, Any]) -> bytes:
    """Attributes as text: numbers as Python writes them."""
    plain = {
        str(name): value.tolist() if isinstance(value, np.generic | np.ndarray) else value
        for name, value in attributes.items()
    }
    return json.dumps(plain, sort_keys=True, default=str).encode()


def _lacking(data: xr.Dataset, table: tuple[Variable, ...]) -> list[str]:
    """Variables of a table that a dataset does not have, with its dimensions, as numbers and not empty."""

    def has(variable: Variable) -> bool:
        if variable.name not in data.variables:
            return False
        given = data.variables[variable.name]
        return given.dims == variable.dims and given.dtype.kind in "fiu" and given.size > 0

    return [variable.name for variable in table if not variable.optional and not has(variable)]


def _told(path: Path) -> str:
    return shortened(one_line(path), 240)
