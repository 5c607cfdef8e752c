# SPDX-License-Identifier: MIT OR Apache-2.0
"""Gains, times and authorities as a user types them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..errors import InputError
from ..sticks import INCH
from ..units import quantity


def gain(field: str, text: str | None, unit: str) -> float:
    """Gain of `field` in inches per SI `unit` of its signal, 0 where none is given; text such as `"2 in/(rad/s)"`."""
    if text is None:
        return 0.0
    try:
        return quantity(text, unit, field) / INCH
    except InputError as reason:
        raise InputError.of(field, text, f"must be inches per signal, with unit, such as {_EXAMPLES[unit]}") from reason


_EXAMPLES = {
    "m s/rad": "'2 in/(rad/s)'",
    "m/rad": "'5 in/rad'",
    "1": "'0.05 in/ft'",
    "s": "'0.05 in/(ft/s)'",
    "1/s": "'0.01 in/(ft s)'",
    "s2": "'0.1 in/(m/s2)'",
    "m": "'3 in'",
    "m/s": "'1 in/s'",
}


def seconds(field: str, text: str | None) -> float | None:
    """A time constant [s] above 0, None where none is given."""
    if text is None:
        return None
    found = quantity(text, "s", field)
    if not 0.0 < found <= 1000.0:
        raise InputError.of(field, text, "must lie above 0 and at most 1000 s")
    return found


def authority(field: str, text: str | None, travel_in: Sequence[float]) -> np.ndarray:
    """Most inches to either side, by stick (4,): text in inches or in % of the travel, None: no limit."""
    if text is None:
        return np.full(4, math.inf)
    try:
        found = np.full(4, quantity(text, "m", field) / INCH)
    except InputError:
        try:
            found = quantity(text, "1", field) * np.asarray(travel_in)
        except InputError as reason:
            raise InputError.of(field, text, "must be inches or a share of the travel, '1 in' or '10 %'") from reason
    if not (found > 0.0).all():
        raise InputError.of(field, text, "must be above 0")
    return found
