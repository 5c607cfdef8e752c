# SPDX-License-Identifier: MIT OR Apache-2.0
"""Units at the edge: text with a unit, or a pint quantity, to SI and radians.

Inside the package every number is SI and radians; a bare number for a dimensional quantity is refused.
Common units are read here; anything else is handed to pint, which is imported only then.
"""

from __future__ import annotations

import math
import re
from functools import lru_cache
from typing import Any

from .arguments import is_number, is_whole
from .errors import InputError, shortened

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity [m/s2]: a weight is this times the mass."""

# kg, m, s, rad: angle is kept as a dimension of its own, so that a stiffness per radian is not a moment
_POUND = 0.45359237
_FOOT = 0.3048
_DIMENSIONS = {
    "1": (1.0, (0, 0, 0, 0)),
    "%": (0.01, (0, 0, 0, 0)),
    "Hz": (1.0, (0, 0, -1, 0)),
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
    "°": (math.pi / 180.0, (0, 0, 0, 1)),
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

LONGEST = 80
"""Longest text of a quantity or a unit: the longest in use, `slug ft2/s`-like products, have twenty characters."""

HIGHEST_POWER = 9
"""Highest power of a unit that is read: moments of area, the highest in mechanics, have four."""

# thousands stand in groups of three behind one kind of separator; a comma before any other number of digits is no thousand
_THOUSANDS = r"[0-9]{1,3}(?:(?P<apart>[ ,'\u2019_])[0-9]{3})(?:(?P=apart)[0-9]{3})*(?:\.[0-9]*)?"
_TEXT = re.compile(
    rf"(?P<number>[+-]?(?:{_THOUSANDS}|[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)(?![0-9,])\s*(?P<unit>.*)"
)
_APART = re.compile(r"(?<=[0-9])[ ,'\u2019_](?=[0-9])")
_TYPED = str.maketrans({"\u2212": "-", "\u2013": "-", "\u00a0": " ", "\u202f": " ", "\u2009": " "})
_UNIT = re.compile(r"([*/ ]?)\s*([A-Za-z°]+|%|1)(?:\^|\*\*)?(-?[0-9]+)?\s*")

# what is handed to pint: names, `*`, `/`, blanks, one level of brackets, and powers that are one small number each
_BETWEEN = r"(?:\s*+[*/·]\s*+|\s++)"
_FACTOR = rf"(?:[^\W\d]\w*+|[%°µΩ]\w*+|1)(?:\s*+(?:\^|\*\*)\s*+-?[0-{HIGHEST_POWER}](?![0-9.]))?"
_TERM = rf"(?:{_FACTOR}|\(\s*+{_FACTOR}(?:{_BETWEEN}{_FACTOR})*+\s*+\))"
_FOREIGN = re.compile(rf"{_TERM}(?:{_BETWEEN}{_TERM})*+")
# a unit per quotient, "in/(rad/s)", or per product, "in/(ft s)"
_PER_QUOTIENT = re.compile(r"/\s*\(([^()/]+)/([^()/]+)\)")
_PER_PRODUCT = re.compile(r"/\s*\(([^()/ *]+)[ *]([^()/ *]+)\)")

EXAMPLES = {
    "m/s": "'80 kt'",
    "rad": "'-6 deg'",
    "m": "'5250 ft'",
    "kg": "'16000 lbf'",
    "rad/s": "'3 deg/s'",
    "s": "'0.5 s'",
}
"""One example of accepted text for each SI unit, for error lines."""


# a table asks for the same two units at every one of its thousands of numbers
@lru_cache(maxsize=1024)
def factor(unit: str) -> tuple[float, tuple[int, ...]] | None:
    """SI factor of a unit such as `slug ft2`, and its powers of kg, m, s, rad; None if not known here."""
    total, powers, position = 1.0, [0, 0, 0, 0], 0
    text = unit.strip() or "1"
    if len(text) > LONGEST:
        return None
    text = _PER_PRODUCT.sub(r"/\1/\2", _PER_QUOTIENT.sub(r"/\1*\2", text))
    while position < len(text):
        match = _UNIT.match(text, position)
        if match is None or match.group(2) not in _DIMENSIONS:
            return None
        scale, dimension = _DIMENSIONS[match.group(2)]
        power = int(match.group(3) or 1) * (-1 if match.group(1) == "/" else 1)
        if abs(power) > HIGHEST_POWER:
            return None
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
    if len(unit) > LONGEST or not _FOREIGN.fullmatch(unit.strip()):
        raise ValueError(f"unit '{shortened(unit, LONGEST)}' is no product of units with powers up to {HIGHEST_POWER}")
    try:
        return float(_registry().Quantity(value, unit).to(si_unit.replace(" ", "*")).magnitude)
    except Exception as reason:  # pint raises many kinds, tokenizer errors among them
        raise ValueError(f"unit '{unit}' is unknown or not a unit of {si_unit}") from reason


def number(field: str, value: Any, low: float = -math.inf, high: float = math.inf) -> float:
    """`value` as a float if it is a finite number within low..high, without a unit; an InputError of `field` otherwise."""
    ranged = math.isfinite(low) and math.isfinite(high)
    allowed = f"must be a number between {low:g} and {high:g}" if ranged else "must be a finite number"
    if not is_number(value) or not low <= value <= high:
        raise InputError.of(field, value, allowed)
    return float(value)


def whole(field: str, value: Any, low: int, high: int) -> int:
    """`value` if it is a whole number within low..high; an InputError of `field` otherwise."""
    if not is_whole(value) or not low <= value <= high:
        raise InputError.of(field, value, f"must be a whole number between {low} and {high}")
    return int(value)


def quantity(value: Any, si_unit: str, field: str) -> float:
    """`value` (text with a unit, or a pint quantity) in `si_unit`, finite.

    Text is taken as people write it: `-6 deg` with the typographic minus too, `5250 ft` as `5,250 ft` or `5 250 ft` too.
    field: name used in the error line.
    """
    example = EXAMPLES.get(si_unit, f"a number with a unit of {si_unit}")
    if hasattr(value, "magnitude") and hasattr(value, "to"):
        try:
            number = float(value.to(si_unit.replace(" ", "*")).magnitude)
        except Exception as reason:  # pint's DimensionalityError, without importing pint for it
            raise InputError.of(field, value, f"must have a unit of {si_unit}, for example {example}") from reason
    elif isinstance(value, str):
        match = _TEXT.fullmatch(value.strip().translate(_TYPED)) if len(value) <= LONGEST else None
        if match is None or not match["unit"]:
            raise InputError.of(field, value, f"must be a number with a unit, for example {example}")
        try:
            number = convert(float(_APART.sub("", match["number"])), match["unit"], si_unit)
        except ValueError as reason:
            raise InputError.of(field, value, f"{reason}; allowed is for example {example}") from reason
    else:
        raise InputError.of(field, value, f"must be text with a unit or a pint quantity, for example {example}")
    if not math.isfinite(number):
        raise InputError.of(field, value, "must be a finite number")
    return number


def parted(text: Any) -> tuple[float, str] | None:
    """Number and unit of a text such as `5,250 ft`; a number alone has the unit `1`; None of what is no such text."""
    if not isinstance(text, str) or len(text) > LONGEST:
        return None
    match = _TEXT.fullmatch(text.strip().translate(_TYPED))
    if match is None:
        return None
    number, unit = float(_APART.sub("", match["number"])), match["unit"].strip() or "1"
    return (number, unit) if math.isfinite(number) else None


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
