# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a sweep asks of what it runs, and any function of a case as such."""

from __future__ import annotations

import hashlib
import inspect
import pickle
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from ..arguments import is_number, is_whole
from ..errors import InputError
from .outcome import Kept

Case = Mapping[str, Any]


class Verb(Protocol):
    """What a sweep asks of what it runs."""

    @property
    def name(self) -> str:
        """What it is called."""

    @property
    def sent(self) -> Any:
        """What another process finds the verb by: its name, or the function."""

    def check(self, case: Case) -> None:
        """Refuse a case that the verb would refuse; nothing is run."""

    def run(self, case: Case) -> Any:
        """What the case gives: a Dataset."""

    def told(self, case: Case) -> dict[str, Any]:
        """All that the answer depends on, as JSON takes it."""

    def kept(self, keep: Any) -> Kept:
        """Which variables a table keeps."""


def plain(value: Any) -> Any:
    """A value as JSON takes it; of an object the digest of its content."""
    if value is None or isinstance(value, str | bool):
        return value
    if is_number(value):
        return int(value) if is_whole(value) else float(value)
    if isinstance(value, Mapping):
        return {str(name): plain(each) for name, each in value.items()}
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    return {"object": type(value).__name__, "digest": hashlib.sha256(pickle.dumps(value, 4)).hexdigest()}


def kept_of(keep: Any, dims: tuple[str, ...] | None, known: Collection[str] = ()) -> Kept:
    """Variables by names, `all`, or by their dimensions; known: names that there are, none where a case must be run to know."""
    if keep == "all":
        return Kept()
    if keep is not None:
        names = (keep,) if isinstance(keep, str) else tuple(keep)
        if not names or not all(isinstance(name, str) for name in names):
            raise InputError.of("keep", keep, "must be names of variables, or all")
        for name in names:
            if known and name not in known:
                raise InputError.choice("keep", name, known)
        return Kept(names=names)
    return Kept(dims=dims)


@dataclass(frozen=True)
class Own:
    """A user's function of a case: takes its arguments by name, returns a Dataset, a mapping of numbers or arrays, or a
    number."""

    function: Callable[..., Any]

    @property
    def name(self) -> str:
        """Module and name of the function."""
        match self.function:
            case object(__module__=str() as module, __qualname__=str() as name):
                return f"{module}.{name}"
        return type(self.function).__name__

    @property
    def sent(self) -> Any:
        """The function itself."""
        return self.function

    def check(self, case: Case) -> None:
        """Refuse a case whose names the function does not take."""
        try:
            inspect.signature(self.function).bind(**case)
        except TypeError as reason:
            raise InputError.of("case", ", ".join(case), f"{self.name}: {reason}") from None
        except ValueError:
            # written in another language: what it takes is not known
            return

    def run(self, case: Case) -> Any:
        """What the function returns."""
        return self.function(**case)

    def told(self, case: Case) -> dict[str, Any]:
        """The case, and the text of the function."""
        try:
            text = inspect.getsource(self.function)
        except (OSError, TypeError):
            text = ""
        return {"case": plain(dict(case)), "function": hashlib.sha256(text.encode()).hexdigest()}

    def kept(self, keep: Any) -> Kept:
        """All, unless names are given."""
        return kept_of(keep, None)
