# SPDX-License-Identifier: MIT OR Apache-2.0
"""Units in which figures and reports are drawn: SI, or those of a cockpit (kt, ft, lbf, hp). Angles are in deg, sticks in inches.

Labels carry their unit in brackets, `X [kN]`; here it is told what stands in its place, and how many of that one of it is.
"""

from __future__ import annotations

import re
from functools import cache

from ..errors import InputError
from ..units import convert

# what is drawn in SI: the unit by its symbol, in its place, how many of the latter are drawn as one
_US = {
    "m/s": ("m/s", "kt", 1.0, "kt"),
    "m": ("m", "ft", 1.0, "ft"),
    "kN": ("kN", "lbf", 1e3, "1000 lbf"),
    "kN m": ("kN m", "ft lbf", 1e3, "1000 ft lbf"),
    "kW": ("kW", "hp", 1.0, "hp"),
    "kJ": ("kJ", "ft lbf", 1e3, "1000 ft lbf"),
}
UNITS = ("si", "us")
"""Choices of units: SI with multiples of a thousand, or knots, feet, pounds and horsepower."""


def check_units(units: str, field: str = "units") -> str:
    """`units`, if it is a choice."""
    if units not in UNITS:
        raise InputError.choice(field, units, UNITS)
    return units


@cache
def shown(label: str, units: str) -> tuple[str, float]:
    """The label with the unit that is drawn, and the factor from the one it had."""
    found = re.search(r"\[([^\]]+)\]", label)
    if units == "si" or found is None or found[1] not in _US:
        return label, 1.0
    from_unit, to_unit, thousand, symbol = _US[found[1]]
    return label.replace(found[0], f"[{symbol}]"), convert(1.0, from_unit, to_unit) / thousand
