# SPDX-License-Identifier: MIT OR Apache-2.0
"""Files that are there whole or not at all: written beside, on the disk, then renamed into their place.

Whoever holds the old file open keeps it; a write that fails leaves the old one as it was.
"""

from __future__ import annotations

import contextlib
import errno
import itertools
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from .errors import StorageFailure

_counted = itertools.count()
_PART = re.compile(r"\..+\.\d+-\d+\.part")


@contextlib.contextmanager
def written(path: str | Path, buffering: int = -1) -> Iterator[Any]:
    """A binary stream that becomes the file `path` when the block ends without an error; a StorageFailure where it cannot.

    Folders on the way are made. A link is followed: the file it names is replaced. buffering: 0 for a stream without.
    """
    asked = Path(path)
    whole = Path(os.path.realpath(asked))
    if whole.exists() and not whole.is_file():
        # a folder, a device or a pipe is never replaced
        raise StorageFailure.of(asked, OSError(errno.EINVAL, "not a plain file"))
    part = whole.with_name(f".{whole.name}.{os.getpid()}-{next(_counted)}.part")
    try:
        whole.parent.mkdir(parents=True, exist_ok=True)
        try:
            with part.open("x+b", buffering) as stream:
                yield stream
                stream.flush()
                os.fsync(stream.fileno())
            part.replace(whole)
            synced(whole.parent)
        finally:
            with contextlib.suppress(OSError):
                part.unlink()
    except OSError as reason:
        raise StorageFailure.of(asked, reason) from reason


def write_bytes(path: str | Path, content: bytes | memoryview) -> Path:
    """Write a file from its content."""
    with written(path) as stream:
        stream.write(content)
    return Path(path)


def write_text(path: str | Path, text: str, encoding: str = "utf-8") -> Path:
    """Write a text file, its line ends as they are."""
    return write_bytes(path, text.encode(encoding))


def synced(folder: Path) -> None:
    """What was renamed in `folder` is so on the disk too, where the system can say that of a folder."""
    with contextlib.suppress(OSError):
        entry = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(entry)
        finally:
            os.close(entry)


def remove(path: Path) -> None:
    """Remove a file that may be there; a StorageFailure where that is refused."""
    try:
        path.unlink(missing_ok=True)
    except OSError as reason:
        raise StorageFailure.of(path, reason) from reason


def sweep(folder: Path) -> None:
    """Remove what writes that were killed have left in `folder`; nobody may be writing there."""
    for entry in folder.iterdir():
        if _PART.fullmatch(entry.name):
            with contextlib.suppress(OSError):
                entry.unlink()
