# SPDX-License-Identifier: MIT OR Apache-2.0
"""Finding, reading and checking an aircraft file; every complaint is one line."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..arguments import checked
from ..errors import InputError, one_line
from ..text import is_file, read_text, read_toml
from .model import Aircraft
from .reading import validated
from .schema import AircraftFile
from .shipped import SHIPPED, folder_of
from .versions import groups_of


@checked
def load_aircraft(
    name_or_path: str | Path = "uh60a", loading: str | None = None, allow_outside: bool = False
) -> Aircraft:
    """Aircraft from its file, checked: type, unit, range, missing and unknown keys, coverage of every table.

    name_or_path: a shipped name (`uh60a`, `bo105`) or the path of a TOML file.
    loading: a named mass and centre of gravity of the file; None is the file's `[loading]`.
    allow_outside: whether tables may lie elsewhere than beside the file or below it.
    Raises InputError, one line naming file, key, value and what is allowed.
    """
    path = find(name_or_path)
    spec = validated(path, groups_of(path, parsed(path)), AircraftFile, {path.name: read_text(path)}, allow_outside)
    return Aircraft(spec, path, loading)


def find(name_or_path: str | Path) -> Path:
    """Path of a shipped aircraft by its name, or of a file; InputError where there is none."""
    if str(name_or_path) in SHIPPED:
        return folder_of(str(name_or_path)) / f"{name_or_path}.toml"
    path = Path(name_or_path)
    if not is_file(path):
        raise InputError.choice(
            "aircraft",
            str(name_or_path),
            SHIPPED,
            " or the path of an aircraft file (.toml), and there is no such file",
        )
    return path


def parsed(path: Path) -> dict[str, Any]:
    """Content of a TOML file; InputError where it cannot be read."""
    try:
        return read_toml(path)
    except ValueError as reason:
        raise InputError(one_line(f"{path}: {reason}")) from reason
