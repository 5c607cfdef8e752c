# SPDX-License-Identifier: MIT OR Apache-2.0
"""The folder of a sweep: every finished case in a file of its own, there whole or not at all; what is there is not run again.

A case goes by the digest of all it depends on: verb, arguments, files of the aircraft, program. Files are plain numpy archives
(`numpy.load`), nothing in them is executed.
"""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .. import atomic
from ..folder_lock import FolderLock
from .outcome import Outcome

CASES = "cases"


class SweepFolder:
    """A folder while a sweep is written to it, locked against another one; closed by `with`."""

    def __init__(self, folder: str | Path) -> None:
        """Lock the folder, which is made."""
        self.folder = Path(folder)
        self._lock = FolderLock(self.folder, lambda: "another sweep is being written there", CASES)
        atomic.sweep(self.folder)
        atomic.sweep(self.folder / CASES)

    def __enter__(self) -> SweepFolder:
        """Locked already."""
        return self

    def __exit__(self, *_: object) -> None:
        """Let others in."""
        self._lock.release()

    def any(self) -> int:
        """How many cases are there, of this sweep or another."""
        return sum(1 for _ in (self.folder / CASES).glob("*.npz"))

    def path(self, key: str) -> Path:
        """File of a case."""
        return self.folder / CASES / f"{key}.npz"

    def keep(self, key: str, found: Outcome) -> None:
        """A case has been done."""
        head: dict[str, Any] = {
            "failure": found.failure,
            "warnings": found.warnings,
            "variables": [],
            "coordinates": [],
        }
        arrays: dict[str, Any] = {}
        for kind, named in (("variables", found.variables), ("coordinates", found.coordinates)):
            for name, (dims, values, said) in named.items():
                head[kind].append([name, list(dims), said, len(arrays)])
                arrays[f"a{len(arrays)}"] = values
        stream = io.BytesIO()
        text = np.frombuffer(json.dumps(head).encode(), np.uint8)
        np.savez(stream, head=text, **arrays)
        atomic.write_bytes(self.path(key), stream.getvalue())

    def found(self, key: str) -> Outcome | None:
        """What a case gave; None where it has not been done, or its file is damaged."""
        try:
            with np.load(self.path(key), allow_pickle=False) as file:
                head = json.loads(file["head"].tobytes())
                read: dict[str, Any] = {
                    kind: {name: (tuple(dims), file[f"a{i}"], said) for name, dims, said, i in head[kind]}
                    for kind in ("variables", "coordinates")
                }
            return Outcome(**read, warnings=head["warnings"], failure=head["failure"])
        except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile):
            return None


def digest(depends_on: Mapping[str, Any]) -> str:
    """Name of a case by all it depends on."""
    text = json.dumps(depends_on, sort_keys=True, ensure_ascii=False)
    return hashlib.sha256(text.encode()).hexdigest()[:24]
