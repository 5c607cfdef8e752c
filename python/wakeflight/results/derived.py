# SPDX-License-Identifier: MIT OR Apache-2.0
"""What was drawn of a run: files that belong to it and go when another run takes its place."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable
from pathlib import Path

from ..atomic import write_text

LIST = ".drawn"
"""File with the names of what was drawn, one a line."""


def drawn(folder: Path, names: Iterable[str]) -> None:
    """Say that these files of `folder` are to be drawn of the run there."""
    write_text(folder / LIST, "".join(f"{name}\n" for name in names))


def forget_drawn(folder: Path) -> None:
    """Remove what was drawn of the run that was in `folder`."""
    with contextlib.suppress(OSError):
        names = (folder / LIST).read_text(encoding="utf-8").splitlines()
        for name in [*names, LIST]:
            # a name, never a path
            if name == Path(name).name:
                with contextlib.suppress(OSError):
                    (folder / name).unlink()
