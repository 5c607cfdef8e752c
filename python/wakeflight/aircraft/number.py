# SPDX-License-Identifier: MIT OR Apache-2.0
"""Numbers of an aircraft file: SI values that keep their published value, unit, source and confidence."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import BeforeValidator, ValidationInfo, WithJsonSchema

from ..errors import one_line
from ..units import STANDARD_GRAVITY, convert, shown

CONFIDENCES = ("A", "B", "C", "A/B", "A/C", "B/C", "A/B/C")
"""A read in a source, B recalled, C estimated or computed; several letters where parts differ."""

_KEYS = {"value", "unit", "source", "confidence", "note"}


def told(
    value: dict[str, Any], text: str, required: tuple[str, ...] = ("value", "source", "confidence")
) -> WithJsonSchema:
    """A number as editors are told of it: `value` is the JSON schema of what is published, `text` what it may be."""
    properties = {
        "value": value,
        "unit": {"type": "string"},
        "source": {
            "type": ["string", "array"],
            "items": {"type": "string"},
            "description": "a key of [sources], or several",
        },
        "confidence": {"enum": list(CONFIDENCES), "description": "A read in a source, B recalled, C estimated"},
        "note": {"type": "string"},
    }
    return WithJsonSchema(
        {
            "type": "object",
            "description": text,
            "properties": properties,
            "required": list(required),
            "additionalProperties": False,
        }
    )


@dataclass(frozen=True)
class Provenance:
    """Where a number comes from: published value and unit, keys of `[sources]`, confidence, note."""

    value: Any
    unit: str
    sources: tuple[str, ...]
    confidence: str
    note: str


class Number(float):
    """A number in SI and radians; `.provenance` says where it comes from."""

    provenance: Provenance

    def __new__(cls, si: float, provenance: Provenance) -> Number:
        """Keep `si` as the number itself."""
        number = super().__new__(cls, si)
        number.provenance = provenance
        return number

    def __getnewargs__(self) -> tuple[float, Provenance]:  # type: ignore[override]  # one more than float has
        """Arguments a copy is made with."""
        return float(self), self.provenance


class Numbers(tuple[Any, ...]):
    """Several numbers in SI and radians (nested tuples for a matrix); `.provenance` is common to all."""

    provenance: Provenance

    def __new__(cls, si: tuple[Any, ...], provenance: Provenance) -> Numbers:
        """Keep `si` as the tuple itself."""
        numbers = super().__new__(cls, si)
        numbers.provenance = provenance
        return numbers

    def __getnewargs__(self) -> tuple[tuple[Any, ...], Provenance]:
        """Arguments a copy is made with."""
        return tuple(self), self.provenance


def provenance_of(entry: Any, info: ValidationInfo, keys: set[str], allowed: str) -> Provenance:
    """Check the keys of an inline table and read its source, confidence and note."""
    if not isinstance(entry, dict):
        raise ValueError(f"must be {allowed}")
    unknown = sorted(set(entry) - keys)
    if unknown:
        raise ValueError(f"has the unknown key '{unknown[0]}'; allowed: {', '.join(sorted(keys))}")
    for key in ("source", "confidence"):
        if key not in entry:
            raise ValueError(f"has no {key}; every number keeps its source and confidence")
    sources = entry["source"] if isinstance(entry["source"], list) else [entry["source"]]
    declared = (info.context or {}).get("sources")
    for source in sources:
        if not isinstance(source, str) or (declared is not None and source not in declared):
            raise ValueError(f"names the source '{source}', which is not in [sources]")
    if entry["confidence"] not in CONFIDENCES:
        raise ValueError(f"has the confidence '{entry['confidence']}'; allowed: {', '.join(CONFIDENCES)}")
    for key in ("unit", "note"):
        if not isinstance(entry.get(key, ""), str):
            raise ValueError(f"has a {key} that is not text")
    return Provenance(
        entry.get("value"), entry.get("unit", "1"), tuple(sources), entry["confidence"], entry.get("note", "")
    )


def _real(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"has the value {one_line(str(value)[:60])}, which is not a number")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ValueError("must be finite")
    return number


def _reader(si_unit: str, low: float, high: float, above: float | None) -> Callable[[Any, str], float]:
    def read(value: Any, unit: str) -> float:
        number = convert(_real(value), unit, si_unit)
        if above is not None and not number > above:
            raise ValueError(f"must be above {shown(above, unit)}")
        if number > high and not math.isfinite(low):
            raise ValueError(f"must be at most {shown(high, unit)}")
        if not low <= number <= high:
            raise ValueError(f"must lie between {shown(low, unit)} and {shown(high, unit)}")
        return number

    return read


def scalar(
    si_unit: str,
    low: float = -math.inf,
    high: float = math.inf,
    above: float | None = None,
    whole: bool = False,
) -> Any:
    """Type of one number of dimension `si_unit` within low..high (SI), strictly above `above` if given."""
    read = _reader(si_unit, low, high, above)
    allowed = f"a table {{ value, unit, source, confidence }} with a unit of {si_unit}"

    def validate(entry: Any, info: ValidationInfo) -> Number:
        provenance = provenance_of(entry, info, _KEYS, allowed)
        if "value" not in entry:
            raise ValueError(f"has no value; must be {allowed}")
        number = read(provenance.value, provenance.unit)
        if whole and number != int(number):
            raise ValueError("must be a whole number")
        return Number(number, provenance)

    return Annotated[Number, BeforeValidator(validate), told({"type": "number"}, f"a number with a unit of {si_unit}")]


def _weight(entry: Any, info: ValidationInfo) -> Number:
    allowed = "a table { value, unit, source, confidence } with a unit of force (lbf, N) or mass (lb, kg)"
    provenance = provenance_of(entry, info, _KEYS, allowed)
    published = _real(provenance.value)
    try:
        newtons = convert(published, provenance.unit, "N")
    except ValueError:
        newtons = convert(published, provenance.unit, "kg") * STANDARD_GRAVITY
    if not 0.0 < newtons <= 1e6:
        raise ValueError(f"must be above 0 and at most {shown(1e6, 'lbf')}")
    return Number(newtons, provenance)


Weight = Annotated[Number, BeforeValidator(_weight), told({"type": "number"}, "a force (lbf, N) or a mass (lb, kg)")]
"""Type of a weight [N], given as force or as mass (times 9.80665 m/s2)."""


def _noted(entry: Any, info: ValidationInfo) -> Provenance:
    return provenance_of(entry, info, _KEYS, "a table { value, unit, source, confidence }")


Noted = Annotated[
    Provenance, BeforeValidator(_noted), told({}, "a published figure, for comparison alone", ("source", "confidence"))
]
"""Type of a published figure kept for comparison: any value, any unit, never used by the model."""


def vector(
    si_unit: str | tuple[str, ...], length: int, low: float = -math.inf, high: float = math.inf, rows: int = 0
) -> Any:
    """Type of `length` numbers, or `rows` rows of them; units may differ by entry (`kt, kt, deg`)."""
    units = (si_unit,) * length if isinstance(si_unit, str) else si_unit
    readers = [_reader(unit, low, high, None) for unit in units]
    shape = f"{rows} rows of {length} numbers" if rows else f"{length} numbers"
    allowed = f"a table {{ value, unit, source, confidence }} with {shape} in {', '.join(dict.fromkeys(units))}"

    def row(values: Any, given: list[str]) -> tuple[float, ...]:
        if not isinstance(values, list) or len(values) != length:
            raise ValueError(f"must be {allowed}")
        return tuple(read(value, unit) for read, value, unit in zip(readers, values, given, strict=True))

    def validate(entry: Any, info: ValidationInfo) -> Numbers:
        provenance = provenance_of(entry, info, _KEYS, allowed)
        given = [unit.strip() for unit in provenance.unit.split(",")]
        given = given * length if len(given) == 1 else given
        if len(given) != length:
            raise ValueError(f"must be {allowed}")
        values = provenance.value
        if not rows:
            return Numbers(row(values, given), provenance)
        if not isinstance(values, list) or len(values) != rows:
            raise ValueError(f"must be {allowed}")
        return Numbers(tuple(row(each, given) for each in values), provenance)

    return Annotated[
        Numbers, BeforeValidator(validate), told({"type": "array"}, f"{shape} in {', '.join(dict.fromkeys(units))}")
    ]


def numbers(si_unit: str, low: float = -math.inf, high: float = math.inf) -> Any:
    """Type of one or more numbers of dimension `si_unit` within low..high (SI)."""
    read = _reader(si_unit, low, high, None)
    allowed = f"a table {{ value, unit, source, confidence }} with one or more numbers in {si_unit}"

    def validate(entry: Any, info: ValidationInfo) -> Numbers:
        provenance = provenance_of(entry, info, _KEYS, allowed)
        values = provenance.value if isinstance(provenance.value, list) else [provenance.value]
        if not values or values == [None]:
            raise ValueError(f"must be {allowed}")
        return Numbers(tuple(read(value, provenance.unit) for value in values), provenance)

    shown = told({"type": ["number", "array"]}, f"one or more numbers in {si_unit}")
    return Annotated[Numbers, BeforeValidator(validate), shown]
