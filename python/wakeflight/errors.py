# SPDX-License-Identifier: MIT OR Apache-2.0
"""The ways a run can end early: input that cannot be used, numbers that cannot go on, a disk that does not take it, a signal."""

from __future__ import annotations

from typing import Any


class WakeflightError(Exception):
    """Base of every error this package raises on purpose; `exit_code` is that of the command line."""

    exit_code = 1


class InputError(WakeflightError, ValueError):
    """Input that is wrong, in one line: file, field, value and what is allowed. Nothing was started."""

    exit_code = 2

    @classmethod
    def of(cls, field: str, value: object, allowed: str, file: object = None) -> InputError:
        """Error about one field: `file: field = value: allowed`."""
        where = f"{file}: " if file is not None else ""
        return cls(one_line(f"{where}{field} = {_shown(value)}: {allowed}"))


class NumericalFailure(WakeflightError, RuntimeError):
    """A solution that could not be continued: where and when, with what was computed up to it.

    partial: whatever the verb had computed (a trim, a flight), None if nothing.
    """

    exit_code = 3

    def __init__(self, message: str, partial: Any = None) -> None:
        super().__init__(one_line(message))
        self.partial = partial


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


def one_line(text: str) -> str:
    """`text` with its line breaks and runs of blanks made single blanks."""
    return " ".join(str(text).split())


def _shown(value: object, width: int = 80) -> str:
    """`value` as a person would type it, shortened."""
    text = one_line(f"'{value}'" if isinstance(value, str) else str(value))
    return text if len(text) <= width else text[: width - 3] + "..."
