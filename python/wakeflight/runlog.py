# SPDX-License-Identifier: MIT OR Apache-2.0
"""Append-only logs: records of one size, each with its number and a checksum.

A log can be read while it is written, by another process too. A tail that was torn is cut where the checksums end to be met;
what stands before it is whole. Layout: magic, length and text of a header (JSON) that names the fields, its sha256, zeros to a
multiple of 64 bytes; then records: CRC-32 of the rest of the record, number of the coupling step, fields, all little-endian.
"""

from __future__ import annotations

import errno
import hashlib
import json
import os
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .atomic import synced
from .errors import InputError, StorageFailure

MAGIC = b"WKFL-LOG\n"
VERSION = 1
ALIGNED = 64
LARGEST_HEADER = 1 << 16

Fields = Mapping[str, tuple[int, ...]]
"""Shapes of the numbers of a record by their names, () for one number."""


def layout(fields: Fields) -> np.dtype:
    """A record of these fields."""
    return np.dtype([("crc", "<u4"), ("step", "<u4"), *((name, "<f8", shape) for name, shape in fields.items())])


def head(fields: Fields) -> bytes:
    """What stands before the records."""
    text = json.dumps({"version": VERSION, "fields": [[name, list(shape)] for name, shape in fields.items()]}).encode()
    block = MAGIC + len(text).to_bytes(8, "little") + text
    block += hashlib.sha256(block).digest()
    return block + bytes(-len(block) % ALIGNED)


@dataclass(frozen=True)
class Log:
    """A log as it was found: records that are whole (a view of the file), and what is to be said of the rest, if anything."""

    path: Path
    records: np.ndarray
    damage: str = ""

    @property
    def steps(self) -> np.ndarray:
        """Coupling step of every record."""
        return self.records["step"]

    def arrays(self, n: int | None = None) -> dict[str, np.ndarray]:
        """Fields of the first `n` records by name, views of the file."""
        names = [name for name in self.records.dtype.names or () if name not in ("crc", "step")]
        return {name: self.records[name][:n] for name in names}


def read(path: Path) -> Log:
    """A log up to where its checksums are met; InputError where it has no head that can be read."""
    try:
        with path.open("rb") as stream:
            start = stream.read(len(MAGIC) + 8)
            length = int.from_bytes(start[len(MAGIC) :], "little")
            if start[: len(MAGIC)] != MAGIC or length > LARGEST_HEADER:
                raise InputError.of("log", str(path), "is no log of a flight, or its head is damaged")
            text, digest = stream.read(length), stream.read(32)
            size = os.fstat(stream.fileno()).st_size
    except OSError as reason:
        raise InputError.of("log", str(path), f"cannot be read: {reason.strerror}") from reason
    if hashlib.sha256(start + text).digest() != digest:
        raise InputError.of("log", str(path), "its head is damaged: its checksum is not met")
    header = json.loads(text)
    if header["version"] != VERSION:
        raise InputError.of("log version", header["version"], f"allowed: {VERSION}", file=path)
    dtype = layout({name: tuple(shape) for name, shape in header["fields"]})
    begin = len(start) + length + 32
    begin += -begin % ALIGNED
    n = max(0, size - begin) // dtype.itemsize
    if n == 0:
        return Log(path, np.empty(0, dtype))
    records = np.memmap(path, dtype, "r", begin, (n,)).view(np.ndarray)
    whole, last = 0, -1
    for k in range(n):
        # numbers ascend: a record that strayed into another place is none
        if zlib.crc32(records[k].tobytes()[4:]) != records["crc"][k] or records["step"][k] <= last:
            break
        whole, last = k + 1, int(records["step"][k])
    if whole == n:
        return Log(path, records)
    return Log(path, records[:whole], f"{path}: record {whole + 1} of {n} is damaged; used up to the one before")


class LogWriter:
    """A log being written: a window of records in memory, whose full ones go to the file by `flush`."""

    WINDOW = 1 << 20
    """Bytes of the window, about."""

    def __init__(self, path: Path, fields: Fields, kept: int | None = None):
        """A new log; or, with `kept`, one that is there goes on after its first `kept` records."""
        self.path = path
        dtype = layout(fields)
        self.window = np.zeros(max(1, self.WINDOW // dtype.itemsize), dtype)
        self._bytes, self._size = memoryview(self.window.data).cast("B"), dtype.itemsize
        self._steps, self._sums = self.window["step"], self.window["crc"]
        self._filled = self._written = 0
        start = head(fields)
        try:
            self._file = os.open(path, os.O_RDWR | os.O_CREAT | (0 if kept is not None else os.O_TRUNC), 0o666)
            if kept is None:
                self._put(memoryview(start))
                synced(path.parent)
            else:
                os.ftruncate(self._file, len(start) + kept * dtype.itemsize)
                os.lseek(self._file, 0, os.SEEK_END)
        except OSError as reason:
            raise StorageFailure.of(path, reason) from reason

    def place(self) -> int:
        """Where in the window the next record goes."""
        if self._filled == len(self.window):
            self.flush()
            self._filled = self._written = 0
        return self._filled

    def done(self, step: int) -> None:
        """The record at `place` is complete."""
        k, size = self._filled, self._size
        self._steps[k] = step
        self._sums[k] = zlib.crc32(self._bytes[k * size + 4 : (k + 1) * size])
        self._filled = k + 1

    def flush(self, to_disk: bool = False) -> None:
        """Complete records to the file; to_disk: and the file to the disk."""
        size = self._size
        try:
            if os.fstat(self._file).st_nlink == 0:
                raise FileNotFoundError(errno.ENOENT, "the folder is gone")
            self._put(self._bytes[self._written * size : self._filled * size])
            if to_disk:
                os.fsync(self._file)
        except OSError as reason:
            raise StorageFailure.of(self.path, reason) from reason
        self._written = self._filled

    def _put(self, content: memoryview) -> None:
        while content:
            content = content[os.write(self._file, content) :]

    def close(self) -> None:
        """No record follows."""
        if self._file >= 0:
            os.close(self._file)
            self._file = -1


class MemoryRows:
    """Rows of a flight that is kept in memory alone: arrays for all of them."""

    def __init__(self, fields: Fields, n: int):
        self.window: dict[str, np.ndarray] = {name: np.empty((n, *shape)) for name, shape in fields.items()}
        self._filled = 0

    def place(self) -> int:
        """Where the next row goes."""
        return self._filled

    def done(self, step: int) -> None:
        """The row at `place` is complete."""
        self._filled += 1

    def whole(self) -> dict[str, np.ndarray]:
        """All rows by name."""
        return self.window


class FileRows(LogWriter):
    """Rows of a flight in a log; `whole` reads them back without holding them in memory."""

    def whole(self) -> dict[str, np.ndarray]:
        """All rows by name, views of the file."""
        self.flush()
        return read(self.path).arrays()


class MemoryWakes:
    """Wakes of a flight that is kept in memory alone."""

    def __init__(self) -> None:
        """None yet."""
        self._steps: list[int] = []
        self._kept: list[dict[str, np.ndarray]] = []

    def append(self, step: int, arrays: dict[str, np.ndarray]) -> None:
        """Keep the wake of a step."""
        self._steps.append(step)
        self._kept.append(arrays)

    def whole(self) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Steps, and arrays by name over them; empty where there is no wake."""
        names = self._kept[0] if self._kept else ()
        return np.array(self._steps), {name: np.array([each[name] for each in self._kept]) for name in names}


class FileWakes:
    """Wakes of a flight in a log, which begins with the first of them."""

    def __init__(self, path: Path, kept: int = 0):
        """kept: how many of those that are in the file the flight goes on after."""
        self.path = path
        self._kept = kept
        self._log: LogWriter | None = None

    def append(self, step: int, arrays: dict[str, np.ndarray]) -> None:
        """Keep the wake of a step."""
        if self._log is None:
            fields = {name: values.shape for name, values in arrays.items()}
            self._log = LogWriter(self.path, fields, self._kept or None)
        k = self._log.place()
        for name, values in arrays.items():
            self._log.window[name][k] = values
        self._log.done(step)

    def flush(self, to_disk: bool = False) -> None:
        """What is kept to the file."""
        if self._log is not None:
            self._log.flush(to_disk)

    def close(self) -> None:
        """No wake follows."""
        if self._log is not None:
            self._log.close()

    def whole(self) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Steps, and arrays by name over them, views of the file; empty where there is no wake."""
        self.flush()
        return wakes_of(self.path) if self._log is not None or self._kept else (np.array([]), {})


class LoggedRows:
    """Rows of a log that is only read."""

    def __init__(self, arrays: dict[str, np.ndarray]):
        """Fields by name."""
        self.window = arrays

    def place(self) -> int:
        """Where the next row would go."""
        return len(next(iter(self.window.values())))

    def done(self, step: int) -> None:
        """No row is added."""
        raise InputError.of("row", step, "the log is only read")

    def whole(self) -> dict[str, np.ndarray]:
        """All rows by name."""
        return self.window


class LoggedWakes:
    """Wakes of a log that is only read; there may be none."""

    def __init__(self, path: Path):
        """Of a file."""
        self._path = path

    def append(self, step: int, arrays: dict[str, np.ndarray]) -> None:
        """No wake is added."""
        raise InputError.of("wake", step, "the log is only read")

    def whole(self) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Steps, and arrays by name over them."""
        return wakes_of(self._path)


def wakes_of(path: Path) -> tuple[np.ndarray, dict[str, Any]]:
    """Steps and arrays of a log of wakes; empty where there is none."""
    if not path.is_file():
        return np.array([]), {}
    log = read(path)
    return log.steps, log.arrays()
