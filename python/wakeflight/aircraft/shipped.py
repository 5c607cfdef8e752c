# SPDX-License-Identifier: MIT OR Apache-2.0
"""Aircraft that come with the package, and their files."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

SHIPPED = ("uh60a", "bo105")
"""Names of the aircraft that come with the package."""


def folder_of(name: str) -> Path:
    """Folder of a shipped aircraft: its file and its tables."""
    return Path(str(resources.files(__package__))) / name
