# SPDX-License-Identifier: MIT OR Apache-2.0
"""Signals that end a run: the first at the next exchange, with everything saved, a second one at once.

The command line answers SIGINT and SIGTERM so; a program that uses the package keeps its own handlers.
"""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Iterator
from types import FrameType

from .errors import Interrupted

SIGNALS = (signal.SIGINT, signal.SIGTERM)

_asked: int | None = None
_deferred = False


def asked() -> int | None:
    """The signal that asked for an end, None where there was none."""
    return _asked


def text(number: int) -> str:
    """Its name."""
    return f"interrupted by {signal.Signals(number).name}"


@contextlib.contextmanager
def answered() -> Iterator[None]:
    """Answer signals while the block lasts: by `Interrupted` at once, or at the next exchange where a flight can be kept."""
    global _asked
    _asked = None
    if threading.current_thread() is not threading.main_thread():
        # only there signals can be answered
        yield
        return
    before = {number: signal.signal(number, _signalled) for number in SIGNALS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextlib.contextmanager
def deferred() -> Iterator[None]:
    """A first signal waits here until `asked` is asked."""
    global _deferred
    outer, _deferred = _deferred, True
    try:
        yield
    finally:
        _deferred = outer


def _signalled(number: int, _: FrameType | None) -> None:
    global _asked
    _asked = number
    # what is written is there whole or not at all: a second signal need not wait for anything
    for each in SIGNALS:
        signal.signal(each, signal.SIG_DFL)
    if not _deferred:
        raise Interrupted(text(number), number)
