# SPDX-License-Identifier: MIT OR Apache-2.0
"""A wind of whatever states one: an object, a function, a table of a file, what a run's file tells, words of a command line."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..text import read_toml
from .field import WindField
from .gust import Gust
from .kinds import OwnWind, SteadyWind, Wind, Winds
from .turbulence import Dryden, VonKarman

KINDS: dict[str, Any] = {kind.kind: kind for kind in (SteadyWind, Gust, Dryden, VonKarman, WindField)}
"""Winds by the names that files give them."""
ALLOWED = "must be a wind such as wf.SteadyWind or wf.Gust, several in a list, or a function of points (n, 3) and time"


def wind_of(wind: Any) -> Wind | None:
    """The wind that is meant; none where there is none."""
    match wind:
        case None:
            return None
        case Wind():
            return wind
        case list() | tuple() if wind:
            parts = [wind_of(part) for part in wind]
            return Winds(*(part for part in parts if part is not None))
        case Mapping():
            return wind_of_table(wind)
    if callable(wind):
        return OwnWind(wind)
    raise InputError.of("wind", wind, ALLOWED)


def wind_of_table(table: Mapping[str, Any], file: object = None) -> Wind:
    """Of a table: `kind`, and what that kind is made with; several in `parts`."""
    given = dict(table)
    kind = given.pop("kind", None)
    if kind == Winds.kind:
        parts = given.get("parts", ())
        if not isinstance(parts, list | tuple) or not parts:
            raise InputError.of("wind.parts", parts, "must be tables, one for each wind", file)
        return Winds(*(wind_of_table(part, file) for part in parts))
    if kind == OwnWind.kind:
        raise InputError.of(
            "wind", given.get("name"), "a function of your own or a field without a file is in no file", file
        )
    if kind not in KINDS:
        raise InputError.of("wind.kind", kind, f"allowed: {', '.join((*KINDS, Winds.kind))}", file)
    known = inspect.signature(KINDS[kind]).parameters
    for name in given:
        if name not in known:
            raise InputError.of(f"wind.{name}", "unknown key", f"allowed: {', '.join(known)}", file)
    if "origin" in given:
        given["origin"] = tuple(given["origin"])
    try:
        made: Wind = KINDS[kind](**given)
    except InputError as reason:
        raise InputError(str(reason) if file is None else f"{file}: {reason}") from None
    return made


def wind_from_text(text: str) -> Wind:
    """Of words: `10 kt`, `10 kt from 270 deg`, or the name of a TOML file with a table [wind] or several [[wind]]."""
    if text.endswith(".toml"):
        path = Path(text)
        found = read_toml(path)
        unknown = [name for name in found if name != "wind"]
        if unknown or "wind" not in found:
            raise InputError.of(
                "wind file", ", ".join(unknown) or "empty", "must have a table [wind], or several [[wind]]", path
            )
        tables = found["wind"] if isinstance(found["wind"], list) else [found["wind"]]
        parts = [wind_of_table(table, path) for table in tables]
        return parts[0] if len(parts) == 1 else Winds(*parts)
    speed, _, direction = text.partition(" from ")
    return SteadyWind(speed.strip(), *([direction.strip()] if direction else []))
