# SPDX-License-Identifier: MIT OR Apache-2.0
"""Sticks of a flight that is flown by hand: one sample where every coupling step begins, straight lines between them.

What the hands did becomes a manoeuvre whose corners are the samples. A flight along it finds, at every time that is asked for,
the same bits as the flight by hand did: both lay the same line through the same two samples.
"""

from __future__ import annotations

import numpy as np

from .maneuvers import ROUNDING, Maneuver
from .stick_histories import Corner
from .sticks import INCH, STICKS

DECIMALS = 4
"""Decimals of an inch that a sample keeps: 2.5 micrometres."""


class SampledSticks:
    """A path of sticks over the coupling step that begins, through the last three samples.

    The third is that of the end of the next step: the rate of the stick that follows is known where a step ends, as it is in a
    flight along a manoeuvre.
    """

    def __init__(self, trim_in: np.ndarray, times: tuple[float, float, float], inches: np.ndarray):
        """trim_in (4,) [in from the stop]; times [s]; inches (3, 4) about trim."""
        self.trim_in, self.times, self.inches = trim_in, times, inches

    def at(self, t: float) -> np.ndarray:
        """Positions (4,) [m from the stop] at time `t` [s]."""
        about_trim = [np.interp(t, self.times, each) for each in self.inches.T]
        found: np.ndarray = INCH * (self.trim_in + np.array(about_trim))
        return found

    def rate(self, t: float) -> np.ndarray:
        """Rates (4,) [m/s] just after time `t` [s]."""
        piece = int(np.searchsorted(self.times, t + ROUNDING, side="right")) - 1
        if piece > 1:
            return np.zeros(4)
        rise: np.ndarray = self.inches[piece + 1] - self.inches[piece]
        rate: np.ndarray = INCH * (rise / (self.times[piece + 1] - self.times[piece]))
        return rate

    def pieces(self, t0: float, t1: float) -> list[tuple[float, float]]:
        """One: corners stand at the ends of coupling steps."""
        return [(t0, t1)]


def sampled(name: str, times: np.ndarray, inches: np.ndarray, notes: str = "") -> Maneuver:
    """The manoeuvre of samples (n, 4) [in about trim] at `times` (n,) [s], which ends with the last; sticks rest there.

    Of a stick that rests only the ends of its rest are kept: a line between equal numbers is that number, exactly.
    """
    corners_of = []
    for stick, history in zip(STICKS, inches.T, strict=True):
        if not history.any():
            continue
        kept = np.ones(len(history), dtype=bool)
        kept[1:-1] = (history[1:-1] != history[:-2]) | (history[1:-1] != history[2:])
        corners: tuple[Corner, ...] = tuple(zip(times[kept].tolist(), history[kept].tolist(), strict=True))
        corners_of.append((stick, corners))
    off_trim = bool(inches[0].any())
    return Maneuver(name, tuple(corners_of), seconds=float(times[-1]), notes=notes, off_trim=off_trim)
