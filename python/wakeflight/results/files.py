# SPDX-License-Identifier: MIT OR Apache-2.0
"""Datasets to and from NetCDF."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from ..arguments import checked
from ..atomic import written
from ..text import is_file
from .attributes import flat_attributes
from .errors import ResultsError
from .reading import DIGEST, digest, of_kind, opened, seal, sealed

if TYPE_CHECKING:
    import xarray as xr


class _Kept(io.RawIOBase):
    """A file under HDF5, which falls over a failing write, once more at the end of the process.

    The first failure is kept here; from there on the file goes on in memory, so that HDF5 comes to its end.
    """

    def __init__(self, file: io.FileIO) -> None:
        """Of an unbuffered file."""
        self.file: io.FileIO | io.BytesIO = file
        self.failure: OSError | None = None

    def write(self, content: memoryview) -> int:  # type: ignore[override]
        """Write all of it."""
        done = 0
        while done < len(content):
            try:
                done += self.file.write(content[done:]) or 0
            except OSError as reason:
                self._failed(reason)
        return done

    def truncate(self, size: int | None = None) -> int:
        """Cut or grow."""
        try:
            return self.file.truncate(size)
        except OSError as reason:
            self._failed(reason)
            return self.file.truncate(size)

    def _failed(self, reason: OSError) -> None:
        at = self.file.tell()
        self.file.seek(0)
        self.file = io.BytesIO(self.file.read())
        self.file.seek(at)
        self.failure = reason

    def readinto(self, buffer: memoryview) -> int:  # type: ignore[override]
        """Read back."""
        return self.file.readinto(buffer)

    def seek(self, offset: int, whence: int = 0) -> int:
        """Go to a place."""
        return self.file.seek(offset, whence)

    def tell(self) -> int:
        """The place."""
        return self.file.tell()


@checked
def save(dataset: xr.Dataset, path: str | Path) -> Path:
    """Write NetCDF-4, compressed; the same dataset gives the same bytes. Returns the path.

    The file is there whole or not at all; whoever holds the one before open keeps it.
    """
    import h5netcdf
    from xarray.backends import H5NetCDFStore

    flat = dataset.copy()
    flat.attrs = flat_attributes(dataset.attrs)
    flat.attrs[DIGEST] = digest(flat)
    encoding = {
        name: {"zlib": True, "complevel": 4, "shuffle": True}
        for name, variable in flat.variables.items()
        if variable.ndim and variable.dtype.kind in "fiu"
    }
    with written(path, buffering=0) as stream:
        kept = _Kept(stream)
        with h5netcdf.File(kept, "w") as file:
            flat.dump_to_store(H5NetCDFStore(file, mode="w"), encoding=encoding)
        if kept.failure is not None:
            raise kept.failure
        seal(stream)
    return Path(path)


@checked
def load(path: str | Path, kind: str | None = None) -> xr.Dataset:
    """Read a run or a trim back into memory; the file is closed. Nothing in it is executed.

    kind: what it must be, a key of `reading.KINDS`. Refused is what is damaged, changed or no such result. Files of older
    schemas are read as they are; those of a newer one are refused.
    """
    return of_kind(opened(Path(path)), Path(path), kind)


def finished(path: Path) -> bool:
    """Whether there is a result that came to its end."""
    import h5py
    import xarray as xr

    with contextlib.suppress(ResultsError, OSError):
        # what has the bytes it was written with need not be read through for one attribute
        if is_file(path) and sealed(path):
            with h5py.File(path, "r") as head:
                return bool(head.attrs.get("finished", 0))
    try:
        with xr.open_dataset(path, engine="h5netcdf") as data:
            return bool(data.attrs.get("finished", 0))
    except (OSError, ValueError, KeyError):
        return False


def by_name(runs: xr.Dataset | Mapping[str, xr.Dataset], single: str | None = None) -> dict[str, xr.Dataset]:
    """Runs by name; a single one (a Dataset is a mapping too) goes by the name `single`, or by its inflow model."""
    import xarray as xr

    if isinstance(runs, xr.Dataset):
        return {str(runs.attrs.get("inflow_model", "run")) if single is None else single: runs}
    return dict(runs)
