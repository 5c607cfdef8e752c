# SPDX-License-Identifier: MIT OR Apache-2.0
"""The two ways a run can end early: input that cannot be used, and numbers that cannot go on."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
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

    @classmethod
    def choice(cls, field: str, value: object, names: Iterable[str], more: str = "", file: object = None) -> InputError:
        """Error about a field that takes one of `names`, the nearest of them first; more: what else is taken."""
        known = list(names)
        near = get_close_matches(str(value).lower(), known, n=1, cutoff=0.6)
        meant = f"did you mean {near[0]}? " if near else ""
        return cls.of(field, value, f"{meant}allowed: {', '.join(known)}{more}", file)


class NumericalFailure(WakeflightError, RuntimeError):
    """A solution that could not be continued: where and when, with what was computed up to it.

    partial: whatever the verb had computed (a trim, a flight), None if nothing.
    """

    exit_code = 3

    def __init__(self, message: str, partial: Any = None) -> None:
        super().__init__(one_line(message))
        self.partial = partial


def one_line(text: str) -> str:
    """`text` with its line breaks and runs of blanks made single blanks."""
    return " ".join(str(text).split())


def _shown(value: object, width: int = 80) -> str:
    """`value` as a person would type it, shortened."""
    text = one_line(f"'{value}'" if isinstance(value, str) else str(value))
    return text if len(text) <= width else text[: width - 3] + "..."
