# SPDX-License-Identifier: MIT OR Apache-2.0
"""Text of an input file: UTF-8, or what a byte order mark at its head says; the mark itself is no content."""

from __future__ import annotations

import codecs
import tomllib
from pathlib import Path
from typing import Any

_MARKS = ((codecs.BOM_UTF8, "utf-8"), (codecs.BOM_UTF16_LE, "utf-16-le"), (codecs.BOM_UTF16_BE, "utf-16-be"))

LARGEST_FILE = 32 << 20
"""Largest input file [bytes]: a section table of a degree by a hundredth of Mach has 0.3 MB, a flight's sticks at 10 kHz 20."""


def file_beside(directory: Path, name: str) -> Path:
    """Path of a file named in another one; ValueError where no file can have that name."""
    if len(name) > 255 or "\0" in name:
        raise ValueError(f"names a file '{name[:20]}...' of {len(name)} characters, which no file can have")
    return directory / name


def read_text(path: Path) -> str:
    """Content of a text file without its byte order mark; ValueError says why it cannot be read, and where."""
    try:
        if not path.is_file():
            raise ValueError("cannot be read: no such file")
        if path.stat().st_size > LARGEST_FILE:
            raise ValueError(f"cannot be read: it is larger than {LARGEST_FILE >> 20} MiB")
        content = path.read_bytes()
    except OSError as reason:
        raise ValueError(f"cannot be read: {reason.strerror}") from reason
    mark, encoding = next(((mark, name) for mark, name in _MARKS if content.startswith(mark)), (b"", "utf-8"))
    content = content[len(mark) :]
    try:
        return content.decode(encoding)
    except UnicodeDecodeError as reason:
        line = content[: reason.start].count(b"\n") + 1
        found = f"byte 0x{content[reason.start]:02x} in line {line}"
        raise ValueError(f"is not {encoding.upper()} text ({found}); save it as UTF-8") from reason


def read_toml(path: Path) -> dict[str, Any]:
    """Content of a TOML file; ValueError says why it cannot be read, and where."""
    text = read_text(path)
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as reason:
        raise ValueError(f"not readable as TOML: {reason}") from reason
