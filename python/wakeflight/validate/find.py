# SPDX-License-Identifier: MIT OR Apache-2.0
"""Where the cases are, and which of them are meant."""

from __future__ import annotations

from pathlib import Path

from ..errors import InputError
from .case import Case


def cases_folder(given: str | Path | None = None) -> Path:
    """Folder of the cases: the one given, else `validation` in the working folder or the nearest one above it."""
    if given is not None:
        folder = Path(given)
        if not folder.is_dir():
            raise InputError.of("--cases", str(folder), "must be a folder of cases")
        return folder
    here = Path.cwd()
    for above in (here, *here.parents):
        folder = above / "validation"
        if any(folder.glob("*/case.toml")):
            return folder
    raise InputError(f"no folder validation with cases in {here} or above it: stand in a checkout, or give --cases DIR")


def cases(folder: Path) -> list[Case]:
    """Every case of `folder`, by name."""
    return [Case.read(path.parent) for path in sorted(folder.glob("*/case.toml"))]


def select(found: list[Case], names: list[str]) -> list[Case]:
    """Cases by identifier (H01), name of the folder, group, or kind; all for no name."""
    if not names:
        return found
    chosen: list[Case] = []
    for name in names:
        wanted = name.lower()
        matching = [
            case for case in found if wanted in (case.id.lower(), case.slug.lower(), case.group.lower(), case.kind)
        ]
        if not matching:
            allowed = ", ".join(dict.fromkeys([*(case.id for case in found), *(case.group for case in found)]))
            raise InputError.of("CASE", name, f"allowed: {allowed}")
        chosen += [case for case in matching if case not in chosen]
    return chosen
