# SPDX-License-Identifier: MIT OR Apache-2.0
"""Progress of long work: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import functools
import sys
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, ParamSpec, TextIO, TypeVar

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")


class Progress:
    """Where a verb reports: `phase(name, total)`, then `advance(n, text)`; called with text, a remark.

    On a terminal one bar per phase with time left, elsewhere at most ten lines per phase.
    """

    def __init__(self, stream: TextIO | None = None, bars: bool = True) -> None:
        """Report to `stream`, the standard error by default; without `bars` plain lines on a terminal too."""
        self._stream = stream or sys.stderr
        self._bars: Any = None
        self._task: Any = None
        self._name, self._done = "", 0.0
        self._total: float | None = None
        self._start = self._next_line = 0.0
        if bars and self._stream.isatty():
            from rich.console import Console
            from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
            from rich.progress import Progress as Bars

            self._bars = Bars(
                TextColumn("{task.description}"),
                BarColumn(),
                MofNCompleteColumn(),
                TimeRemainingColumn(),
                TextColumn("{task.fields[text]}"),
                console=Console(file=self._stream),
            )

    def __enter__(self) -> Progress:
        """Start the display."""
        if self._bars is not None:
            self._bars.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        """End the display."""
        if self._bars is not None:
            self._bars.stop()

    def __call__(self, text: str) -> None:
        """Show a remark, a warning for instance, on a line of its own."""
        if self._bars is not None:
            self._bars.console.print(text, markup=False, highlight=False)
        else:
            print(text, file=self._stream, flush=True)

    def phase(self, name: str, total: float | None = None) -> None:
        """Begin a phase of `total` steps (revolutions, iterations), None if their number is not known."""
        self._name, self._total, self._done = name, total, 0.0
        self._start = self._next_line = time.monotonic()
        if self._bars is not None:
            self._task = self._bars.add_task(name, total=total, text="")
        else:
            self(name if total is None else f"{name}: {total:g} steps")

    def advance(self, n: float = 1.0, text: str = "") -> None:
        """Report `n` more steps done, with a short text."""
        self._done += n
        if self._bars is not None:
            if self._task is not None:
                self._bars.update(self._task, advance=n, text=text)
            return
        now = time.monotonic()
        finished = self._total is not None and self._done >= self._total * (1.0 - 1e-9)
        if now < self._next_line and not finished:
            return
        line = f"{self._name}: {self._done:.4g}"
        if self._total:
            left = (now - self._start) * (self._total / self._done - 1.0) if self._done > 0.0 else 0.0
            line += f" of {self._total:g}, {max(left, 0.0):.0f} s left"
            # a tenth of what the phase will take, so that a long one says something about ten times
            self._next_line = now + max(1.0, 0.1 * (now - self._start + left))
        else:
            self._next_line = now + 5.0
        self(f"{line} {text}".rstrip())


class Silent:
    """Reports nothing: what a verb uses when it is given no progress."""

    def __call__(self, text: str) -> None:
        """Drop a remark."""

    def phase(self, name: str, total: float | None = None) -> None:
        """Begin a phase."""

    def advance(self, n: float = 1.0, text: str = "") -> None:
        """Report steps done."""


Reported = Progress | Silent | bool | None
"""What a verb takes as `progress`: True shows it on the standard error, None and False show nothing."""


def heard(progress: Reported) -> Progress | Silent:
    """Where a verb reports, from what it was given as `progress`."""
    if progress is True:
        return Progress(bars=False)
    return progress or Silent()


def reporting(verb: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """A verb whose `progress=True` shows a display from its beginning to its end."""

    @functools.wraps(verb)
    def shown(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        if kwargs.get("progress") is not True:
            return verb(*args, **kwargs)
        with Progress() as display:
            kwargs["progress"] = display
            return verb(*args, **kwargs)

    return shown
