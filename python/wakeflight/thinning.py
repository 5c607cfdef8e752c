# SPDX-License-Identifier: MIT OR Apache-2.0
"""Stick histories with more corners than the flight has steps: flown by straight pieces between a bounded number of stops.

The solver stops at every corner of a stick history, since the forces jump there with the stick's rate. A recorder has a corner
at every sample, of its noise. Where a coupling step holds more than `MOST_CORNERS`, the history is replaced by the continuous
one of `PIECES` straight pieces a step that is nearest to it in the mean square: what the two differ by has no mean about any
stop (weighted by the distance from it), so that a state that is slow beside a step does not see it. Steps with fewer corners
are flown corner by corner.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.linalg import solveh_banded

from .maneuvers import ROUNDING, Maneuver
from .rotor_speed import Clock
from .stick_histories import Corner

MOST_CORNERS = 2
"""Corners within a coupling step at which the solver still stops one by one."""

PIECES = 2
"""Straight pieces of a coupling step that holds more."""


def thinned(maneuver: Maneuver, clock: Clock, n_steps: int) -> Maneuver:
    """The manoeuvre as it is flown in `n_steps` coupling steps of `clock`; `adapted` says so where that changed it."""
    corners = np.array(maneuver.corners())
    # corners at the edge of a step belong to neither side: the solver stops there anyway
    edges = clock.time(np.arange(n_steps + 1))
    inside = np.searchsorted(corners, edges[1:] - ROUNDING) - np.searchsorted(
        corners, edges[:-1] + ROUNDING, side="right"
    )
    dense = np.flatnonzero(inside > MOST_CORNERS)
    if dense.size == 0:
        return maneuver
    # runs of dense steps, one after the other
    runs = np.split(dense, np.flatnonzero(np.diff(dense) > 1) + 1)
    stops = [clock.time(run[0] + np.arange(PIECES * len(run) + 1) / PIECES) for run in runs]
    corners_of = tuple((stick, _replaced(history, stops)) for stick, history in maneuver.corners_of)
    length = 1e3 * edges[-1] / n_steps
    text = (
        f"{maneuver.name}: up to {inside.max()} corners in a step of {length:.3g} ms; {dense.size} steps are flown by "
        f"{PIECES} straight pieces each, nearest to the history in the mean square"
    )
    return replace(maneuver, corners_of=corners_of, adapted=(*maneuver.adapted, text))


def _replaced(history: Sequence[Corner], stops: Sequence[np.ndarray]) -> tuple[Corner, ...]:
    """Corners of one stick with those within each run of stops replaced by the run's own."""
    times, inches = (np.array(each, dtype=float) for each in zip(*history, strict=True))
    kept: list[tuple[np.ndarray, np.ndarray]] = []
    at = 0
    for run in stops:
        before = int(np.searchsorted(times, run[0] - ROUNDING))
        kept.append((times[at:before], inches[at:before]))
        kept.append((run, nearest(times, inches, run)))
        at = int(np.searchsorted(times, run[-1] + ROUNDING, side="right"))
    kept.append((times[at:], inches[at:]))
    time, value = (np.concatenate(each) for each in zip(*kept, strict=True))
    return tuple((float(t), float(x)) for t, x in zip(time, value, strict=True))


def nearest(times: np.ndarray, inches: np.ndarray, stops: np.ndarray) -> np.ndarray:
    """Values at `stops` of the piecewise-linear function nearest in the mean square to the one through (times, inches).

    Its ends are those of the history, and it goes no further than the history does between them. Within that range, with
    the hat functions h_i of the inner stops, int (f - s) h_i dt = 0 for each: a tridiagonal system, exact, since s, f and
    h_i are linear between any two of all times.
    """
    values = np.interp(stops, times, inches)
    n = len(stops) - 2
    within = times[(times > stops[0]) & (times < stops[-1])]
    grid = np.union1d(stops, within)
    s = np.interp(grid, times, inches)
    cell = np.clip(np.searchsorted(stops, grid[:-1], side="right") - 1, 0, n)
    width = np.diff(stops)
    left, right = (grid[:-1] - stops[cell]) / width[cell], (grid[1:] - stops[cell]) / width[cell]
    length = np.diff(grid)
    # Simpson's rule: exact for products of linear functions
    middle, rise = 0.5 * (s[:-1] + s[1:]), 0.5 * (left + right)
    to_right = length / 6.0 * (s[:-1] * left + 4.0 * middle * rise + s[1:] * right)
    whole = length / 6.0 * (s[:-1] + 4.0 * middle + s[1:])
    load = np.bincount(cell + 1, to_right, n + 2) + np.bincount(cell, whole - to_right, n + 2)
    inner = load[1:-1].copy()
    inner[0] -= width[0] / 6.0 * values[0]
    inner[-1] -= width[-1] / 6.0 * values[-1]
    diagonal = (width[:-1] + width[1:]) / 3.0
    # one stop between the ends of a single step: an equation, no band beside it
    beside = np.concatenate([[0.0], width[1:-1] / 6.0])
    values[1:-1] = inner / diagonal if n == 1 else solveh_banded(np.array([beside, diagonal]), inner)
    # a least-squares fit overshoots beside a jump: not beyond where the stick itself goes, such as its stop
    found: np.ndarray = np.clip(values, s.min(), s.max())
    return found
