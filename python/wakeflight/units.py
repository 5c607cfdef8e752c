# SPDX-License-Identifier: MIT OR Apache-2.0
"""Units at the edge: text with a unit, or a pint quantity, to SI and radians.

Inside the package every number is SI and radians; a bare number for a dimensional quantity is refused.
Common units are read here; anything else is handed to pint, which is imported only then.
"""

from __future__ import annotations

import math
import re
from numbers import Integral, Real
from typing import Any

from .errors import InputError

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity [m/s2]: a weight is this times the mass."""

# kg, m, s, rad: angle is kept as a dimension of its own, so that a stiffness per radian is not a moment
_POUND = 0.45359237
_FOOT = 0.3048
_DIMENSIONS = {
    "1": (1.0, (0, 0, 0, 0)),
    "m": (1.0, (0, 1, 0, 0)),
    "mm": (1e-3, (0, 1, 0, 0)),
    "km": (1e3, (0, 1, 0, 0)),
    "ft": (_FOOT, (0, 1, 0, 0)),
    "in": (_FOOT / 12.0, (0, 1, 0, 0)),
    "nmi": (1852.0, (0, 1, 0, 0)),
    "s": (1.0, (0, 0, 1, 0)),
    "min": (60.0, (0, 0, 1, 0)),
    "h": (3600.0, (0, 0, 1, 0)),
    "kt": (1852.0 / 3600.0, (0, 1, -1, 0)),
    "knot": (1852.0 / 3600.0, (0, 1, -1, 0)),
    "knots": (1852.0 / 3600.0, (0, 1, -1, 0)),
    "rad": (1.0, (0, 0, 0, 1)),
    "deg": (math.pi / 180.0, (0, 0, 0, 1)),
    "rev": (2.0 * math.pi, (0, 0, 0, 1)),
    "rpm": (math.pi / 30.0, (0, 0, -1, 1)),
    "kg": (1.0, (1, 0, 0, 0)),
    "lb": (_POUND, (1, 0, 0, 0)),
    "slug": (_POUND * STANDARD_GRAVITY / _FOOT, (1, 0, 0, 0)),
    "N": (1.0, (1, 1, -2, 0)),
    "kN": (1e3, (1, 1, -2, 0)),
    "lbf": (_POUND * STANDARD_GRAVITY, (1, 1, -2, 0)),
    "W": (1.0, (1, 2, -3, 0)),
    "kW": (1e3, (1, 2, -3, 0)),
    "hp": (550.0 * _FOOT * _POUND * STANDARD_GRAVITY, (1, 2, -3, 0)),
}

_TEXT = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*$")
_UNIT = re.compile(r"([*/ ]?)\s*([A-Za-z]+|1)(?:\^|\*\*)?(-?\d+)?\s*")

EXAMPLES = {
    "m/s": "'80 kt'",
    "rad": "'-6 deg'",
    "m": "'5250 ft'",
    "kg": "'16000 lbf'",
    "rad/s": "'3 deg/s'",
    "s": "'0.5 s'",
}
"""One example of accepted text for each SI unit, for error lines."""


def factor(unit: str) -> tuple[float, tuple[int, ...]] | None:
    """SI factor of a unit such as `slug ft2`, and its powers of kg, m, s, rad; None if not known here."""
    total, powers, position = 1.0, [0, 0, 0, 0], 0
    text = unit.strip() or "1"
    while position < len(text):
        match = _UNIT.match(text, position)
        if match is None or match.group(2) not in _DIMENSIONS:
            return None
        scale, dimension = _DIMENSIONS[match.group(2)]
        power = int(match.group(3) or 1) * (-1 if match.group(1) == "/" else 1)
        total *= scale**power
        powers = [have + power * each for have, each in zip(powers, dimension, strict=True)]
        position = match.end()
    return total, tuple(powers)


def convert(value: float, unit: str, si_unit: str) -> float:
    """`value` in `unit` as a number in `si_unit`; ValueError where dimensions differ or a unit is unknown."""
    known, wanted = factor(unit), factor(si_unit)
    if known is not None and wanted is not None:
        if known[1] != wanted[1]:
            raise ValueError(f"unit '{unit}' is not a unit of {si_unit}")
        return value * known[0] / wanted[0]
    try:
        return float(_registry().Quantity(value, unit).to(si_unit.replace(" ", "*")).magnitude)
    except Exception as reason:  # pint raises many kinds, tokenizer errors among them
        raise ValueError(f"unit '{unit}' is unknown or not a unit of {si_unit}") from reason


def number(field: str, value: Any, low: float = -math.inf, high: float = math.inf) -> float:
    """`value` as a float if it is a finite number within low..high, without a unit; an InputError of `field` otherwise."""
    ranged = math.isfinite(low) and math.isfinite(high)
    allowed = f"must be a number between {low:g} and {high:g}" if ranged else "must be a finite number"
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InputError.of(field, value, allowed)
    try:
        found = float(value)
    except OverflowError:
        found = math.inf
    if not (math.isfinite(found) and low <= found <= high):
        raise InputError.of(field, value, allowed)
    return found


def whole(field: str, value: Any, low: int, high: int) -> int:
    """`value` if it is a whole number within low..high; an InputError of `field` otherwise."""
    if isinstance(value, bool) or not isinstance(value, Integral) or not low <= value <= high:
        raise InputError.of(field, value, f"must be a whole number between {low} and {high}")
    return int(value)


def quantity(value: Any, si_unit: str, field: str) -> float:
    """`value` (text with a unit, or a pint quantity) in `si_unit`, finite.

    field: name used in the error line.
    """
    example = EXAMPLES.get(si_unit, f"a number with a unit of {si_unit}")
    if hasattr(value, "magnitude") and hasattr(value, "to"):
        try:
            number = float(value.to(si_unit.replace(" ", "*")).magnitude)
        except Exception as reason:  # pint's DimensionalityError, without importing pint for it
            raise InputError.of(field, value, f"must have a unit of {si_unit}, for example {example}") from reason
    elif isinstance(value, str):
        match = _TEXT.match(value)
        if match is None or not match.group(2):
            raise InputError.of(field, value, f"must be a number with a unit, for example {example}")
        try:
            number = convert(float(match.group(1)), match.group(2), si_unit)
        except ValueError as reason:
            raise InputError.of(field, value, f"{reason}; allowed is for example {example}") from reason
    else:
        raise InputError.of(field, value, f"must be text with a unit or a pint quantity, for example {example}")
    if not math.isfinite(number):
        raise InputError.of(field, value, "must be a finite number")
    return number


def mass_of_weight(value: Any, field: str = "weight") -> float:
    """Mass [kg] of a weight given as force (`lbf`, `N`) or mass (`lb`, `kg`), standard gravity between."""
    for si_unit, scale in (("N", 1.0 / STANDARD_GRAVITY), ("kg", 1.0)):
        try:
            return quantity(value, si_unit, field) * scale
        except InputError:
            continue
    return quantity(value, "kg", field)


def shown(value: float, unit: str) -> str:
    """SI `value` as text in `unit`, for messages: six significant digits."""
    known = factor(unit)
    return f"{value / (known[0] if known else 1.0):.6g} {'' if unit == '1' else unit}".rstrip()


def _registry() -> Any:
    import pint

    registry: Any = pint
    return registry.get_application_registry()
