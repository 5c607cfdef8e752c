# SPDX-License-Identifier: MIT OR Apache-2.0
"""Corners of a stick history: what is none is refused, and the slopes between them."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np

from .errors import InputError
from .sticks import STICKS
from .units import number

SHORTEST_PIECE = 1e-6
"""Least time [s] between two corners: less than a recorder has, and rates of stick stay numbers."""

Corner = tuple[float, float]
"""Time [s] and inches."""


def check_history(given: Any, absolute: bool) -> None:
    """Refuse what is no stick with its corners, times ascending from 0 s, inches from 0 unless they are absolute."""
    if not isinstance(given, tuple | list) or len(given) != 2:
        raise InputError.of("corners_of", given, "must hold a pair (stick, corners) for each stick that moves")
    stick, corners = given
    if stick not in STICKS:
        raise InputError.choice("controls", stick, STICKS)
    for corner in _doubtful(corners):
        if not isinstance(corner, tuple | list) or len(corner) != 2:
            raise InputError.of(stick, corner, "must hold pairs of numbers (time s, inches from trim)")
        for each in corner:
            number(stick, each)
    if len(corners) < 2:
        raise InputError.of(stick, list(corners), "must have at least two corner points [time s, inches from trim]")
    if corners[0][0] < 0.0:
        raise InputError.of(stick, f"{corners[0][0]:g} s", "must start at 0 s or later")
    if corners[0][1] != 0.0 and not absolute:
        raise InputError.of(stick, f"{corners[0][1]:g} in", "must start from trim, 0 in")
    for (before, _), (after, _) in itertools.pairwise(corners):
        if not after > before:
            raise InputError.of(stick, f"{before:g} s, {after:g} s", "times must ascend strictly")
        if after - before < SHORTEST_PIECE:
            allowed = f"corners must be {SHORTEST_PIECE:g} s apart or more: a hand does not jump"
            raise InputError.of(stick, f"{before:.9g} s, {after:.9g} s", allowed)


def _doubtful(corners: Any) -> Any:
    """Corners that must be looked at one by one: none where all are pairs of finite plain numbers, as a recorder's many are."""
    if not isinstance(corners, tuple | list):
        return [corners]
    if {type(corner) for corner in corners} <= {tuple, list} and {len(corner) for corner in corners} <= {2}:
        plain = {type(x) for pair in corners for x in pair} <= {float}
        return [] if plain and np.isfinite(np.array(corners, dtype=float)).all() else corners
    return corners


def slopes_of(corners: Sequence[Corner]) -> list[float]:
    """Slopes of the pieces between corners [in/s]."""
    return [(b[1] - a[1]) / (b[0] - a[0]) for a, b in itertools.pairwise(corners)]
