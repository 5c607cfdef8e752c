# SPDX-License-Identifier: MIT OR Apache-2.0
"""Cost of Python that no other load of the machine changes: the lines that are run."""

import sys
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")


def lines_run(work: Callable[[], T]) -> tuple[int, T]:
    """Lines of Python that `work` runs, and what it returns."""
    count = 0

    def line(frame, event, argument):
        nonlocal count
        count += event == "line"
        return line

    before = sys.gettrace()
    sys.settrace(lambda frame, event, argument: line)
    try:
        done = work()
    finally:
        sys.settrace(before)
    return count, done
