# SPDX-License-Identifier: MIT OR Apache-2.0
"""Numbers of an aircraft file replaced by others: dotted names as the file has them, checked as the file is.

A rotor of a file with several goes by its name (`rotor.tail.radius`, `main_rotor.radius`), without one it is that with blades. A
column of a table is named behind it (`rotor.blade.structure.mass_kg_m`).
"""

from __future__ import annotations

import copy
import math
import re
import tomllib
from collections.abc import Mapping, Sequence
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from ..arguments import is_number
from ..errors import InputError
from ..units import parted
from .number import Provenance
from .reading import validated
from .schema import AircraftFile, Discretisation
from .tables import read_csv
from .versions import BLADED, groups_of

VARIED = "varied"
"""Source of the numbers that were given in place of the file's."""

PLAIN = ("discretisation",)
"""Groups whose entries are no numbers with a source."""

_FACTOR = re.compile(r"[x×]\s*([0-9]*\.?[0-9]+(?:[eE][+-]?[0-9]+)?)")

Changes = Mapping[str, Any]


def plain(changes: Any) -> dict[str, Any]:
    """Changes as they are kept and written: texts, numbers, lists and groups of them; InputError names what is none."""
    if not isinstance(changes, Mapping) or not all(isinstance(name, str) and name for name in changes):
        raise InputError.of("changes", changes, 'must be values by dotted names, {"rotor.radius": "27 ft"}')
    return {name: _plain(name, value) for name, value in changes.items()}


def _plain(name: str, value: Any) -> Any:
    if value is None or isinstance(value, str | bool):
        return value
    if hasattr(value, "magnitude") and hasattr(value, "units"):
        return f"{float(value.magnitude)!r} {value.units}"
    if isinstance(value, Mapping):
        return {str(key): _plain(f"{name}.{key}", each) for key, each in value.items()}
    if is_number(value):
        return int(value) if float(value) == int(value) else float(value)
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, Sequence) and not isinstance(value, bytes):
        return [_plain(name, each) for each in value]
    allowed = "must be text with a unit, a pint quantity, a finite number, a list, a group, or None to leave it out"
    raise InputError.of(name, value, allowed)


def varied(spec: AircraftFile, path: Path, steps: Sequence[Changes]) -> AircraftFile:
    """The content of an aircraft file with numbers replaced, one step after the other; what was chosen beside the file stays."""
    texts = spec.contents
    data = tomllib.loads(next(iter(texts.values())))
    touched = set()
    for step in steps:
        for name, value in step.items():
            _replace(data, name, value, texts)
            touched |= {".".join(name.split(".")[:n]) for n in range(1, name.count(".") + 2)}
    told = "given in place of the file's number"
    data.setdefault("sources", {})[VARIED] = {"text": told}
    try:
        found: AircraftFile = validated(path, groups_of(path, data), AircraftFile, dict(texts), True, known=texts)
    except InputError as reason:
        raise InputError(f"varied: {reason}") from None
    chosen: dict[str, Any] = {}
    if "mirrored" not in touched:
        chosen["mirrored"] = spec.mirrored
    if not any(name.endswith((".model", ".flexible")) for name in touched):
        blade = found.rotor.blade.model_copy(update={"flexible": spec.rotor.blade.flexible})
        chosen["rotor"] = found.rotor.model_copy(update={"blade": blade})
    own, given = dict(spec.discretisation), dict(found.discretisation)
    kept = {key: given[key] if f"discretisation.{key}" in touched else own[key] for key in own}
    chosen["discretisation"] = Discretisation(**kept)
    found = found.model_copy(update=chosen)
    found.changes.extend(dict(step) for step in steps)
    return found


def rewritten(data: dict[str, Any], texts: Mapping[str, str], steps: Sequence[Changes]) -> dict[str, Any]:
    """Content of a rotor file, its numbers written out, with numbers replaced, one step after the other."""
    for step in steps:
        for name, value in step.items():
            _replace(data, name, value, texts)
    data.setdefault("sources", {})[VARIED] = {"text": "given in place of the file's number"}
    return data


def _replace(data: dict[str, Any], name: str, value: Any, texts: Mapping[str, str]) -> None:
    """Put a value in its place."""
    group: Any
    group, rest = _rotor(data, name.split("."))
    for depth, part in enumerate(rest[:-1]):
        inner = group[int(part)] if isinstance(group, list) and part.isdecimal() and int(part) < len(group) else None
        inner = group.setdefault(part, {}) if isinstance(group, dict) else inner
        if isinstance(inner, dict) and {"table", "columns"} & set(inner):
            _column(inner, ".".join(rest[depth + 1 :]), value, name, texts)
            return
        if not isinstance(inner, dict | list) or "value" in inner:
            raise InputError.of(name, value, f"must name a number, text or group of the file: {part} is none")
        group = inner
    key = rest[-1]
    if not isinstance(group, dict):
        raise InputError.of(name, value, "must name a number, text or group of the file")
    if value is None:
        if key not in group:
            raise InputError.choice("changes", name, (name.replace(key, each) for each in group))
        del group[key]
    elif isinstance(value, dict) and not {"value", "table", "columns"} & set(value):
        for inner_name, each in value.items():
            _replace(data, f"{name}.{inner_name}", each, texts)
    else:
        group[key] = _entry(group.get(key), value, name, name.split(".")[0] in PLAIN)


def _rotor(data: dict[str, Any], parts: list[str]) -> tuple[dict[str, Any], list[str]]:
    """The group that a name begins in, and what of the name is left."""
    head, rest = parts[0], parts[1:]
    if head not in ("rotor", "main_rotor", "tail_rotor") or not rest:
        return data, parts
    listed = data.get("rotor", [])
    rotors = {each.get("name", "main"): each for each in (listed if isinstance(listed, list) else [listed])}
    for alias in ("main_rotor", "tail_rotor"):
        if alias in data:
            rotors[data[alias].get("name", alias.removesuffix("_rotor"))] = data[alias]
    if head == "rotor" and rest[0] in rotors and len(rest) > 1:
        return rotors[rest[0]], rest[1:]
    if head == "rotor":
        bladed = [each for each in rotors.values() if each.get("model", "elastic") in BLADED]
        return (bladed[0], rest) if bladed else (data, parts)
    own = rotors.get(head.removesuffix("_rotor"))
    return (data, parts) if own is None else (own, rest)


def _column(entry: dict[str, Any], header: str, value: Any, name: str, texts: Mapping[str, str]) -> None:
    """Replace a column of a table, or multiply it."""
    if "columns" not in entry:
        nowhere = Provenance(None, "table", (), "C", "")
        table = read_csv(Path(entry["table"]), nowhere, texts[entry["table"]])
        entry["columns"] = {each: list(values) for each, values in table.columns.items()}
        del entry["table"]
    columns = entry["columns"]
    found = header if header in columns else None
    if found is None:
        bare = [each for each in columns if each.startswith(f"{header}_")]
        found = bare[0] if len(bare) == 1 else None
    if found is None:
        near = get_close_matches(header, columns, n=1)
        meant = f"is {near[0]} meant? " if near else ""
        raise InputError.of(name, value, f"{meant}columns of the table: {', '.join(columns)}")
    factor = _factor(value)
    columns[found] = [factor * each for each in columns[found]] if factor is not None else value
    entry["source"] = VARIED


def _factor(value: Any) -> float | None:
    """The factor that a text such as `x 1.05` states, None of any other value."""
    match = _FACTOR.fullmatch(value.strip()) if isinstance(value, str) else None
    return float(match[1]) if match else None


def _entry(before: Any, value: Any, name: str, unsourced: bool) -> Any:
    """What stands in the file in place of `before`."""
    numbered = isinstance(before, dict) and "value" in before
    own = {"source": VARIED, "confidence": "C"}
    if isinstance(value, dict):
        return {**own, **value}
    if unsourced or (before is not None and not isinstance(before, dict)):
        return value
    factor = _factor(value)
    if factor is not None:
        if not (isinstance(before, dict) and numbered):
            raise InputError.of(name, value, "must be a value: the file has no number to be multiplied")
        return {**before, **own, "value": _times(before["value"], factor)}
    given = [value] if not isinstance(value, list) else value
    read = [(each, "1") if is_number(each) else parted(each) for each in given]
    if None in read or not read:
        # a word, where the file may hold one
        return value
    units = [pair[1] for pair in read if pair is not None]
    numbers = [pair[0] for pair in read if pair is not None]
    unit = units[0] if len(set(units)) == 1 else ", ".join(units)
    measured = {} if unit == "1" else {"unit": unit}
    return {**own, **measured, "value": numbers if isinstance(value, list) else numbers[0]}


def _times(value: Any, factor: float) -> Any:
    if isinstance(value, list):
        return [_times(each, factor) for each in value]
    product = float(value) * factor
    return int(product) if product == math.floor(product) and isinstance(value, int) else product


def joined(before: Sequence[Changes], changes: Changes) -> list[Changes]:
    """Steps with another one behind them."""
    return [*copy.deepcopy(list(before)), changes]
