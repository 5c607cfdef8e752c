# SPDX-License-Identifier: MIT OR Apache-2.0
"""The four sticks: their names, their order everywhere, and paths of them over a coupling step."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

STICKS = ("lateral", "longitudinal", "collective", "pedal")
"""Order of sticks everywhere: right +, aft +, up +, right +, inches from the stop."""

LONGEST_FLIGHT = 100_000
"""Most revolutions of a flight: hours."""

INCH = 0.0254
"""An inch [m]."""


class StickPath(Protocol):
    """Sticks over a coupling step, linear in time between corners."""

    def at(self, t: float) -> np.ndarray:
        """Positions (4,) [m from the stop] at time `t` [s]."""

    def rate(self, t: float) -> np.ndarray:
        """Rates (4,) [m/s] at time `t` [s]."""

    def pieces(self, t0: float, t1: float) -> list[tuple[float, float]]:
        """The interval t0..t1 cut at the corners."""


class Ramp:
    """Sticks [m] that go from one place to another in a coupling step, and arrive with the rate they moved at."""

    def __init__(self, begin: float, end: float, start: np.ndarray, target: np.ndarray):
        """From `start` at `begin` [s] to `target` at `end` [s]."""
        self.begin, self.end, self.start, self.target = begin, end, start, target
        self._rate: np.ndarray = (target - start) / (end - begin)

    def at(self, t: float) -> np.ndarray:
        """Positions (4,) [m from the stop] at time `t` [s]."""
        if t >= self.end:
            return self.target
        return self.start if t == self.begin else self.start + self._rate * (t - self.begin)

    def rate(self, t: float) -> np.ndarray:
        """Rates (4,) [m/s]."""
        return self._rate

    def pieces(self, t0: float, t1: float) -> list[tuple[float, float]]:
        """One."""
        return [(t0, t1)]


@dataclass(frozen=True)
class Added:
    """A path of sticks with an offset (4,) [m] that is held; `known`: times at which the sum is known."""

    path: StickPath
    offset: np.ndarray
    known: dict[float, np.ndarray] = field(default_factory=dict)

    def at(self, t: float) -> np.ndarray:
        """Positions (4,) [m from the stop] at time `t` [s]."""
        found = self.known.get(t)
        return self.path.at(t) + self.offset if found is None else found

    def rate(self, t: float) -> np.ndarray:
        """Rates (4,) [m/s]: those of the path."""
        return self.path.rate(t)

    def pieces(self, t0: float, t1: float) -> list[tuple[float, float]]:
        """Those of the path."""
        return self.path.pieces(t0, t1)
