# SPDX-License-Identifier: MIT OR Apache-2.0
"""A folder that takes one writer at a time."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Callable
from pathlib import Path

from .errors import InputError, StorageFailure


class FolderLock:
    """A folder, which is made, locked against every other writer until it is released or the process ends."""

    def __init__(self, folder: Path, taken: Callable[[], str], below: str = "."):
        """InputError with what `taken` says where somebody else writes there. below: a folder in it that is made too."""
        try:
            (folder / below).mkdir(parents=True, exist_ok=True)
            self._entry = os.open(folder, os.O_RDONLY)
        except OSError as reason:
            raise StorageFailure.of(folder, reason) from reason
        try:
            fcntl.flock(self._entry, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as reason:
            self.release()
            said = f"{taken()}; allowed: another folder, or wait until it has ended"
            raise InputError.of("out", str(folder), said) from reason
        except OSError:
            # a file system without locks
            pass

    def release(self) -> None:
        """Let others in."""
        os.close(self._entry)
