# SPDX-License-Identifier: MIT OR Apache-2.0
"""One section by itself: of a C81 deck, or of a blade at a station."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..units import number
from .airfoils import checked, read_c81
from .model import Aircraft
from .rotor import Rotor, load_rotor
from .sections import check_sections


@dataclass(frozen=True)
class SectionAt:
    """Tables of a section as the core reads them, sections along the span and the station [m] at which it is."""

    name: str
    data: dict[str, Any]
    station: float
    references: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()


def section_at(airfoil: str | Path | Rotor | Aircraft, station: float | None) -> SectionAt:
    """The section of a C81 deck (a path ending in .c81), or of an aircraft or rotor at `station` (r/R, 0.75 where not given)."""
    if isinstance(airfoil, str | Path) and Path(airfoil).suffix.lower() == ".c81":
        if station is not None:
            raise InputError.of("station", station, "a C81 deck is one section; a station belongs to a blade")
        return _deck(Path(airfoil))
    rotor = load_rotor(airfoil)
    at = 0.75 if station is None else number("station", station, 0.0, 1.0)
    return SectionAt(f"{rotor.name} at {at:g} R", rotor.data["airfoil"], at * rotor.radius, rotor.references)


def _deck(path: Path) -> SectionAt:
    if not path.is_file():
        raise InputError.of("airfoil", str(path), "no such file; needed is a C81 deck, an aircraft or a rotor")
    try:
        grids, notes = read_c81(path)
        for key, grid in grids.items():
            checked(key, grid)
    except ValueError as reason:
        raise InputError(f"airfoil: {reason}") from reason

    def refuse(name: str, value: object, allowed: str) -> InputError:
        return InputError.of(f"airfoil {name}", value, allowed, file=path)

    warnings = (*notes, *check_sections(grids, 0.0, refuse))
    data = {"stations": [0.0], "stepwise": False, "tables": [{**grids, "cd_increment": 0.0}]}
    return SectionAt(path.name, data, 0.0, (), tuple(f"{path.name}: {text}" for text in warnings))
