# SPDX-License-Identifier: MIT OR Apache-2.0
"""The one way a file comes in: a plain file, of bounded size, text in a known encoding, and no name that leads elsewhere.

UTF-8, or what a byte order mark at the head says; the mark itself is no content. Devices, pipes and files without end are refused
before they are read; a name in a file stays within the folder of that file unless the user allows more.
"""

from __future__ import annotations

import codecs
import math
import os
import re
import stat
import tomllib
from pathlib import Path
from typing import Any

from .errors import one_line, shortened

# the longer marks first: one of UTF-32 begins as one of UTF-16 does
_MARKS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)

LARGEST_FILE = 32 << 20
"""Largest input file [bytes]: a section table of a degree by a hundredth of Mach has 0.3 MB, a flight's sticks at 10 kHz 20."""

LARGEST_TOML = 8 << 20
"""Largest TOML file [bytes]: read a hundred times slower than a table; sticks at 1 kHz have 20 kB a second."""

DEEPEST = 12
"""Deepest nesting of groups and lists in a TOML file: those of the formats have six."""

# a key of many parts: reading it takes the square of their number
_LONG_KEY = re.compile(
    rf"(?<![\w-])(?:(?:[\w-]++|\"[^\"\n]*+\"|'[^'\n]*+')[ \t]*+\.[ \t]*+){{{DEEPEST + 1}}}", re.ASCII
)

LONGEST_NAME = 200
"""Longest name of an aircraft, a section, a manoeuvre."""

_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff]")
_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eEdD][+-]?[0-9]+)?", re.ASCII)


def plain_number(text: str) -> float | None:
    """The finite number that `text` is, written as programs write numbers (exponents by E or D); None where it is none."""
    text = text.strip()
    if len(text) > 64 or not _NUMBER.fullmatch(text):
        return None
    number = float(text.replace("d", "e").replace("D", "e"))
    return number if math.isfinite(number) else None


def is_file(path: Path) -> bool:
    """Whether there is a plain file of that name; names that no file can have are none."""
    try:
        return stat.S_ISREG(path.stat().st_mode)
    except (OSError, ValueError):
        return False


def file_beside(directory: Path, name: str, anywhere: bool = False) -> Path:
    """Path of a file named in another one, in `directory` or below it; ValueError where it leads elsewhere.

    anywhere: the user allows files in other folders. Links are followed before it is asked where a file lies.
    """
    if len(name) > 255 or "\0" in name:
        told = shortened(one_line(name), 40)
        raise ValueError(f"names a file '{told}' of {len(name)} characters, which no file can have")
    path = directory / name
    if anywhere:
        return path
    try:
        inside = path.resolve().is_relative_to(directory.resolve())
    except (OSError, RuntimeError):
        inside = False
    if not inside:
        allowed = "files beside this one or below; allow_outside=True, --allow-outside, reads others"
        raise ValueError(f"names a file '{shortened(one_line(name), 120)}' outside its folder: allowed are {allowed}")
    return path


def slug(name: str, otherwise: str = "run") -> str:
    """A name from a file as the name of a folder: letters, digits, `.`, `_` and `-`; never a path, never hidden."""
    kept = re.sub(r"[^\w.-]+", "-", name).strip("-._")[:80].rstrip("-._")
    return kept or otherwise


def content_of(path: Path, largest: int = LARGEST_FILE) -> bytes:
    """Content of a plain file of at most `largest` bytes; ValueError says why it cannot be read."""
    try:
        # a pipe must not be waited for: it is opened without blocking, and refused as all that is no plain file
        handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    except (OSError, ValueError) as reason:
        told = reason.strerror if isinstance(reason, OSError) else "no file can have that name"
        raise ValueError(f"cannot be read: {(told or 'refused').lower()}") from reason
    try:
        what = os.fstat(handle)
        if not stat.S_ISREG(what.st_mode):
            raise ValueError(f"cannot be read: it is {_kind(what.st_mode)}, no file")
        # files of the system say a size of 0 and go on without end
        with open(handle, "rb", closefd=False) as file:
            content = file.read(largest + 1) if what.st_size <= largest else b""
    except OSError as reason:
        raise ValueError(f"cannot be read: {(reason.strerror or 'refused').lower()}") from reason
    finally:
        os.close(handle)
    if what.st_size > largest or len(content) > largest:
        raise ValueError(f"cannot be read: it is larger than {largest >> 20} MiB")
    return content


def _kind(mode: int) -> str:
    """What a path is that is no file."""
    kinds = ((stat.S_ISDIR, "a folder"), (stat.S_ISFIFO, "a pipe"), (stat.S_ISSOCK, "a socket"))
    return next((words for test, words in kinds if test(mode)), "a device")


def read_text(path: Path, largest: int = LARGEST_FILE) -> str:
    """Content of a text file without its byte order mark; ValueError says why it cannot be read, and where."""
    content = content_of(path, largest)
    mark, encoding = next(((mark, name) for mark, name in _MARKS if content.startswith(mark)), (b"", "utf-8"))
    content = content[len(mark) :]
    try:
        text = content.decode(encoding)
    except UnicodeDecodeError as reason:
        line = content[: reason.start].count(b"\n") + 1
        found = f"byte 0x{content[reason.start]:02x} in line {line}"
        raise ValueError(f"is not {encoding.upper()} text ({found}); save it as UTF-8") from reason
    if "\0" in text:
        line = text[: text.index("\0")].count("\n") + 1
        raise ValueError(f"is no text: it holds a zero byte in line {line}; save it as UTF-8")
    return text


def lines_of(text: str) -> list[str]:
    """Lines of a text as every editor counts them: ended by LF, CR LF or CR, by nothing else."""
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def read_toml(path: Path) -> dict[str, Any]:
    """Content of a TOML file; ValueError says why it cannot be read, and where."""
    text = read_text(path, LARGEST_TOML)
    long = _LONG_KEY.search(text)
    if long is not None:
        line = text[: long.start()].count("\n") + 1
        raise ValueError(f"not readable: line {line} has a name of more than {DEEPEST} parts between dots")
    try:
        content = tomllib.loads(text)
    except (ValueError, RecursionError) as reason:
        told = "groups or lists within one another without end" if isinstance(reason, RecursionError) else reason
        raise ValueError(f"not readable as TOML: {told}") from reason
    level: list[Any] = [content]
    for _ in range(DEEPEST):
        for each in level:
            _check_texts(each)
        level = [inner for each in level for inner in _inside(each)]
        if not level:
            return content
    raise ValueError(f"not readable: groups and lists stand within one another more than {DEEPEST} deep")


def name_of(text: str) -> str:
    """`text` if it can be a name: printed as it is, in a line, by every program; ValueError otherwise."""
    if not text.strip():
        raise ValueError("must not be empty")
    if len(text) > LONGEST_NAME:
        raise ValueError(f"must have at most {LONGEST_NAME} characters")
    if not text.isprintable():
        wrong = next(each for each in text if not each.isprintable())
        raise ValueError(f"must be text that can be printed; it holds {wrong!a}")
    return text


def _check_texts(value: Any) -> None:
    """Refuse texts and keys with characters that end files, lines or screens: of control ones, blanks and line ends are text."""
    texts = [*value, *value.values()] if isinstance(value, dict) else value
    for each in texts:
        if isinstance(each, str) and _CONTROL.search(each):
            raise ValueError(f"not readable: the text '{shortened(one_line(each), 60)}' holds a control character")


def _inside(value: Any) -> list[Any]:
    """Groups and lists within a group or a list."""
    values = value.values() if isinstance(value, dict) else value
    return [each for each in values if isinstance(each, dict | list)]
