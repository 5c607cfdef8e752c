# SPDX-License-Identifier: MIT OR Apache-2.0
"""The ways a run can end early: input that cannot be used, numbers that cannot go on, a disk that does not take it, a signal."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from typing import Any, Self, TypeVar

Value = TypeVar("Value")

LONGEST = 640
"""Longest message of an input error: a line that a person reads. What is beyond is left out of its middle."""


def known(value: Value | None) -> Value:
    """`value`, which is there: what comes before has seen to it."""
    if value is None:
        raise AssertionError("a value that must be known here is not")
    return value


class WakeflightError(Exception):
    """Base of every error this package raises on purpose; `exit_code` is that of the command line."""

    exit_code = 1


class InputError(WakeflightError, ValueError):
    """Input that is wrong, in one line: file, field, value and what is allowed. Nothing was started."""

    exit_code = 2

    def __init__(self, message: str) -> None:
        """Keep `message` as one line that can be printed."""
        super().__init__(shortened(one_line(message), LONGEST))

    @classmethod
    def of(cls, field: str, value: object, allowed: str, file: object = None) -> Self:
        """Error about one field: `file: field = value: allowed`."""
        where = f"{shortened(str(file), 240)}: " if file is not None else ""
        return cls(f"{where}{shortened(str(field), 120)} = {shown(value)}: {allowed}")

    @classmethod
    def choice(cls, field: str, value: object, names: Iterable[str], more: str = "", file: object = None) -> Self:
        """Error about a field that takes one of `names`, the nearest of them first; more: what else is taken."""
        known = list(names)
        near = get_close_matches(shown(value).strip("'").lower(), known, n=1, cutoff=0.6)
        meant = f"did you mean {near[0]}? " if near else ""
        return cls.of(field, value, f"{meant}allowed: {', '.join(known)}{more}", file)

    def within(self, file: object) -> InputError:
        """The same error with the file it is found in, said once."""
        return self if str(file) in str(self) else type(self)(f"{shortened(str(file), 240)}: {self}")


class ArgumentError(InputError, TypeError):
    """Arguments that do not fit a function: one too many, one missing, one that it does not have."""


class NumericalFailure(WakeflightError, RuntimeError):
    """A solution that could not be continued: where and when, with what was computed up to it.

    partial: whatever the verb had computed (a trim, a flight), None if nothing.
    """

    exit_code = 3

    def __init__(self, message: str, partial: Any = None) -> None:
        super().__init__(one_line(message))
        self.partial = partial


class GroundContact(NumericalFailure):
    """A flight that ends on the ground: its origin, tail rotor or a tail surface has reached it."""


class StorageFailure(WakeflightError):
    """Something that could not be written: which file and why; what had been written before is whole."""

    exit_code = 3

    @classmethod
    def of(cls, path: object, reason: OSError) -> StorageFailure:
        """From what the system said of `path`."""
        return cls(one_line(f"{path}: cannot be written: {reason.strerror or reason}"))


class Interrupted(WakeflightError):
    """A signal ended the work: what was flown is kept; `exit_code` is that of the shell, 128 and the signal's number.

    partial: whatever the verb had computed (a flight), None if nothing.
    """

    def __init__(self, message: str, signal: int, partial: Any = None) -> None:
        super().__init__(one_line(message))
        self.exit_code = 128 + signal
        self.partial = partial


def said(reason: Exception) -> str:
    """An error of a user's code in words."""
    return str(reason) if type(reason) is ValueError else f"{type(reason).__name__}: {reason}"


def one_line(text: object) -> str:
    """`text` with line breaks and runs of blanks made single blanks, and what cannot be printed written as its escape.

    Names come from files: an escape sequence of a terminal or a mark that turns the direction of writing stays visible text.
    """
    words = " ".join(str(text).split())
    if words.isprintable():
        return words
    return "".join(each if each.isprintable() else ascii(each)[1:-1] for each in words)


def shortened(text: str, width: int) -> str:
    """`text`, of what is longer than `width` its begin and its end."""
    if len(text) <= width:
        return text
    head = (width - 5) * 2 // 3
    return f"{text[:head]} ... {text[head + 5 - width :]}"


def shown(value: object, width: int = 80) -> str:
    """`value` as a person would type it, shortened; what does not show itself, by its type."""
    if isinstance(value, str | bytes):
        # only what is shown is looked at: a value may have the length of a file
        value = value[: 4 * width]
    try:
        text = one_line(f"'{value}'" if isinstance(value, str) else value)
    except Exception:  # whatever another's object raises when it is printed
        text = f"<{type(value).__name__}>"
    return text if len(text) <= width else text[: width - 3] + "..."
