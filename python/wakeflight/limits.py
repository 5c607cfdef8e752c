# SPDX-License-Identifier: MIT OR Apache-2.0
"""What limits steady flight: stall over the disk, stick travel, the vortex-ring range. Pure functions of numbers and tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

SEARCHED = np.radians(30.0)
"""Angle from zero lift [rad] within which stall is looked for; a table without one counts as stalled beyond."""
SHELF = 0.25
"""Share of the largest lift slope below which lift no longer grows: a peak, or at high Mach numbers a shelf instead of one."""
_WINDOW = np.radians(2.0)
_STEP = np.radians(0.25)


@dataclass(frozen=True)
class StallAngles:
    """Angles of attack [rad] at which lift stops growing, by Mach number: each (n_mach,), held beyond the ends."""

    mach: np.ndarray
    positive: np.ndarray
    negative: np.ndarray

    def at(self, mach: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Negative and positive stall angle [rad] at Mach numbers of any shape."""
        return np.interp(mach, self.mach, self.negative), np.interp(mach, self.mach, self.positive)


@dataclass(frozen=True)
class StallAlongSpan:
    """Stall angles of every station: those of its neighbouring sections, weighted like their tables.

    sections: inboard to outboard; inner (n_stations,): section inboard of each station; share (n_stations,): of the next one.
    """

    sections: tuple[StallAngles, ...]
    inner: np.ndarray
    share: np.ndarray

    def at(self, mach: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Negative and positive stall angle [rad] at Mach numbers (..., n_stations)."""
        ends = np.array([section.at(mach) for section in self.sections])
        outer = np.minimum(self.inner + 1, len(self.sections) - 1)
        stations = np.arange(self.inner.size)
        # (n_stations, negative and positive, ...) behind the two indices
        inner, next_one = (np.moveaxis(ends[index, ..., stations], 0, -1) for index in (self.inner, outer))
        low, high = inner + self.share * (next_one - inner)
        return low, high


def stall_along_span(airfoil: Mapping[str, Any], stations: np.ndarray) -> StallAngles | StallAlongSpan:
    """Stall angles of the sections of a blade at `stations` [m]; airfoil: {stations, stepwise, tables} as the core has it."""
    sections = tuple(stall_angles(table) for table in airfoil["tables"])
    if len(sections) == 1:
        return sections[0]
    named = np.asarray(airfoil["stations"])
    inner = np.clip(np.searchsorted(named, stations, side="right") - 1, 0, named.size - 1)
    share = np.clip(np.interp(stations, named, np.arange(named.size)) - inner, 0.0, 1.0)
    return StallAlongSpan(sections, inner, np.zeros_like(share) if airfoil["stepwise"] else share)


def table_end(airfoil: Mapping[str, Any]) -> float:
    """Mach number to which all section tables of a blade reach."""
    return float(min(table[name]["y"][-1] for table in airfoil["tables"] for name in ("cl", "cd", "cm")))


def stall_angles(airfoil: Mapping[str, Any]) -> StallAngles:
    """Stall angles by Mach number of the lift table of `airfoil`: {"cl": {"x": alpha [rad], "y": Mach, "values"}, ...}.

    Outwards from zero lift, the first angle from which lift grows, over the next two degrees and the two after them, by less
    than a quarter of the largest slope before it: a shock that bends the curve for a degree or two is no stall.
    """
    table = airfoil["cl"]
    alpha, columns = np.asarray(table["x"]), np.asarray(table["values"]).T
    ends = np.array([[_stall(alpha, cl, sign) for cl in columns] for sign in (1.0, -1.0)])
    return StallAngles(np.asarray(table["y"], dtype=float), ends[0], ends[1])


def _stall(alpha: np.ndarray, cl: np.ndarray, sign: float) -> float:
    """Stall angle [rad] of one column of a lift table, upwards (`sign` 1) or downwards (-1) from zero lift."""
    near = np.arange(-SEARCHED, SEARCHED, _STEP)
    lift = np.interp(near, alpha, cl)
    crossings = near[1:][(lift[:-1] < 0.0) & (lift[1:] >= 0.0)]
    zero = crossings[np.argmin(np.abs(crossings))] if crossings.size else 0.0
    from_zero = np.arange(0.0, SEARCHED + 2.0 * _WINDOW, _STEP)
    along = sign * np.interp(zero + sign * from_zero, alpha, cl)
    window = round(_WINDOW / _STEP)
    growth = along[window:] - along[:-window]
    largest = np.maximum.accumulate(growth)
    flat = growth < SHELF * largest
    shelf = np.flatnonzero(flat[:-window] & flat[window:])
    if not shelf.size:
        return float(zero + sign * SEARCHED)
    # within that window: where lift itself stops growing
    begin = shelf[0]
    least = SHELF * largest[begin] / window
    step = begin + int(np.argmax(np.diff(along[begin : begin + window + 1]) < least))
    return float(zero + sign * from_zero[step])


def stalled(angles: StallAngles | StallAlongSpan, alpha: np.ndarray, mach: np.ndarray, slow: float = 0.0) -> np.ndarray:
    """Whether sections at `alpha` [rad] and `mach` are beyond stall; not counted: reversed flow, Mach numbers below `slow`."""
    low, high = angles.at(np.asarray(mach))
    turned = np.remainder(np.asarray(alpha) + np.pi, 2 * np.pi) - np.pi
    return ~reversed_flow(turned) & ((turned < low) | (turned > high)) & (np.asarray(mach) >= slow)


def reversed_flow(alpha: np.ndarray) -> np.ndarray:
    """Whether the air meets a section from behind: more than 90 deg either way; alpha [rad]."""
    return np.abs(np.remainder(np.asarray(alpha) + np.pi, 2 * np.pi) - np.pi) > 0.5 * np.pi


def stalled_share(
    airfoil: Mapping[str, Any], alpha: np.ndarray, mach: np.ndarray, weights: np.ndarray, slow: float = 0.0
) -> float:
    """Share of the disk (0 to 1) whose sections are beyond stall.

    alpha [rad] and mach (n_azimuths, n_stations); weights (n_stations,): shares of the disk area, summing to one; slow: Mach
    number below which a section is not counted.
    """
    return float(np.mean(stalled(stall_angles(airfoil), alpha, mach, slow) @ np.asarray(weights)))


def sticks_beyond(stick: Mapping[str, float], travel: Sequence[float]) -> list[str]:
    """What each stick beyond its stops needs, `collective needs 18.4 of 10 in`; sticks and travel [in], from the lower stop.

    Travel is in the order of the sticks. A thousandth of an inch is not beyond.
    """
    texts = []
    for (name, value), full in zip(stick.items(), travel, strict=True):
        if value > full + 1e-3:
            texts.append(f"{name} needs {value:.3g} of {full:.4g} in")
        elif value < -1e-3:
            texts.append(f"{name} needs {value:.2g} in, below its stop (0 to {full:.4g} in)")
    return texts


def in_vortex_ring(descent: float, in_plane: float, hover_inflow: float) -> bool:
    """Whether a disk is where momentum theory has no answer: it descends along its axis at half to twice the induced velocity of
    hover, and moves in its plane slower than that velocity, which would carry the wake away. All three in one unit.
    """
    return 0.5 * hover_inflow < descent < 2.0 * hover_inflow and in_plane < hover_inflow
