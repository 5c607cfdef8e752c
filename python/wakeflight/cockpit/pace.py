# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flight time against the clock on the wall: never ahead of it by more than a little, slower than it where it must be."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable

AHEAD = 0.013
"""How far [s] a flight may be ahead of the wall clock: two exchanges of a UH-60A."""
LATE = 0.1
"""How late [s] it may be before time itself goes slower: what is lost beyond is not caught up with."""
WINDOW = 1.0
"""Wall clock [s] over which the real-time factor is a mean."""


class Pace:
    """Waits so that a flight keeps real time; clock [s] and sleep are those of the wall."""

    def __init__(
        self, clock: Callable[[], float] = time.perf_counter, sleep: Callable[[float], None] = time.sleep
    ) -> None:
        """At a standstill."""
        self._clock, self._sleep = clock, sleep
        self._seen: deque[tuple[float, float]] = deque()
        self._lead = 0.0
        self.begin(0.0)

    def begin(self, t: float) -> None:
        """Flight time `t` [s] is now: after a pause, or in another flight."""
        now = self._clock()
        self._lead = t - now
        self._seen.clear()
        self._seen.append((now, t))

    def wait(self, t: float) -> None:
        """The flight has reached `t` [s]: wait until it may go on, or let time be slower where it is late."""
        now = self._clock()
        ahead = t - now - self._lead
        if ahead < -LATE:
            self._lead = t - now
        elif ahead > AHEAD:
            self._sleep(ahead - AHEAD)
            now = self._clock()
        self._seen.append((now, t))
        while now - self._seen[1][0] > WINDOW and len(self._seen) > 2:
            self._seen.popleft()

    @property
    def factor(self) -> float:
        """Flight time over wall clock in the last second: 1 in real time, less in slow motion; 1 before anything is known."""
        (wall, flight), (now, t) = self._seen[0], self._seen[-1]
        return (t - flight) / (now - wall) if now - wall > 0.05 else 1.0
