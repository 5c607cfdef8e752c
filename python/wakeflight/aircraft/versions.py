# SPDX-License-Identifier: MIT OR Apache-2.0
"""Versions of the aircraft and rotor format: what a file of either holds, as the groups that are checked.

Version 2 (`schema = 2`) has a list of rotors, `[[rotor]]`, each with its name, model, position, shaft and sense of rotation;
`[main_rotor]` and `[tail_rotor]` stand for entries of these names. Version 1 (`format = 1`) has `[rotor]` and `[tail_rotor]`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, NamedTuple

from ..errors import InputError

BLADED = {"elastic": True, "rigid": False}
"""Models of a rotor whose blades are simulated, and whether they bend."""

MODELS = (*BLADED, "closed-form")
"""Models of a rotor: blades that bend, blades that turn about their hinges, thrust of momentum theory alone."""

POSSIBLE = "one rotor with blades (model elastic or rigid) and at most one closed-form tail rotor can be simulated"

Keys = tuple[str, ...]

RENAMED: dict[str, dict[Keys, Keys]] = {
    "rotor": {
        ("position",): ("hub",),
        ("shaft", "forward"): ("shaft_tilt_forward",),
        ("shaft", "lateral"): ("shaft_tilt_lateral",),
        ("model",): ("blade", "flexible"),
    },
    "tail_rotor": {("position",): ("hub",), ("shaft", "cant"): ("cant",)},
}
"""Keys of a rotor in version 2 by those of version 1, for either kind of rotor."""


class Written(NamedTuple):
    """Content of a file as groups to be checked; raw: the same before short numbers were written out."""

    version: int
    data: dict[str, Any]
    raw: dict[str, Any]

    def key(self, location: list[str]) -> list[str]:
        """`location` among the groups by the keys that the file has."""
        if self.version == 1 or not location or location[0] not in RENAMED:
            return location
        group, *rest = location
        for ours, checked in RENAMED[group].items():
            if tuple(rest[: len(checked)]) == checked:
                rest = [*ours, *rest[len(checked) :]]
                break
        return [group, *rest]

    def allowed(self, location: list[str], keys: list[str]) -> list[str]:
        """Keys that a file may have at `location`, of those of the group that is checked there."""
        if not location:
            own = {1: {"format"}, 2: {"schema", "main_rotor"}}[self.version]
            return sorted({*keys, *own})
        if self.version == 1 or location[0] not in RENAMED:
            return [key for key in keys if location not in (["rotor"], ["tail_rotor"]) or key != "name"]
        depth = location[1:]
        found = set(keys) | ({"model"} if not depth else set())
        for ours, checked in RENAMED[location[0]].items():
            if list(checked[:-1]) == depth:
                found.discard(checked[-1])
            if list(ours[:-1]) == depth or not depth:
                found.add(ours[len(depth)])
        return sorted(found)


def groups_of(path: Path, raw: dict[str, Any]) -> Written:
    """Content of a file of any version; InputError where it has none, or rotors that cannot be simulated."""
    if "schema" in raw and "format" in raw:
        raise InputError.of("format", raw["format"], "schema is given too: one of the two", file=path)
    key = "schema" if "schema" in raw else "format"
    if key not in raw:
        raise InputError.of("schema", "missing", "must be given: 2 (or format = 1 in a file of version 1)", file=path)
    if isinstance(raw[key], bool) or raw[key] != {"schema": 2, "format": 1}[key]:
        allowed = "must be 2 (files of version 1 say format = 1)" if key == "schema" else "must be 1 (or schema = 2)"
        raise InputError.of(key, raw[key], allowed, file=path)
    rest = {name: value for name, value in raw.items() if name != key}
    if key == "schema":
        return _of_version_2(path, rest)
    for group in RENAMED:
        if isinstance(rest.get(group), list):
            raise InputError.of(group, "a list", "a list of rotors needs schema = 2", file=path)
        if isinstance(rest.get(group), dict) and "name" in rest[group]:
            raise InputError.of(f"{group}.name", "unknown key", "rotors have names with schema = 2", file=path)
    return Written(1, rest, rest)


def _of_version_2(path: Path, rest: dict[str, Any]) -> Written:
    entries = _entries(path, rest)
    data = {key: value for key, value in rest.items() if key not in ("rotor", "main_rotor", "tail_rotor")}
    names: list[str] = []
    bladed: list[tuple[str, dict[str, Any]]] = []
    closed: list[tuple[str, dict[str, Any]]] = []
    for place, entry in entries:
        name, model = entry["name"], entry.get("model")
        if not isinstance(name, str) or not name:
            raise InputError.of(f"{place}.name", name, "must be text", file=path)
        if name in names:
            raise InputError.of(f"{place}.name", name, "another rotor has it; names must differ", file=path)
        if model not in MODELS:
            given = "missing" if model is None else model
            raise InputError.of(f"{place}.model", given, f"allowed: {', '.join(MODELS)}", file=path)
        names.append(name)
        (bladed if model in BLADED else closed).append((place, entry))
    if len(bladed) != 1 or len(closed) > 1:
        listed = ", ".join(f"{entry['name']} ({entry['model']})" for _, entry in entries) or "none"
        raise InputError.of("rotor", listed, POSSIBLE, file=path)
    for group, found in (("rotor", bladed), ("tail_rotor", closed)):
        for place, entry in found:
            data[group] = _as_checked(path, place, group, entry)
    return Written(2, data, data)


def _entries(path: Path, rest: dict[str, Any]) -> list[tuple[str, dict[str, Any]]]:
    """Rotors of a file, with the place of each in messages; those by alias have its name."""
    listed = rest.get("rotor", [])
    found = []
    for i, entry in enumerate(listed if isinstance(listed, list) else [listed]):
        if not isinstance(entry, dict):
            raise InputError.of("rotor", entry, "must be a list of groups, [[rotor]]", file=path)
        if isinstance(listed, list) and "name" not in entry:
            raise InputError.of(f"rotor[{i}].name", "missing", "must be given", file=path)
        place = f"rotor[{entry['name']}]" if isinstance(listed, list) else "rotor"
        found.append((place, {"name": "main", **entry}))
    for alias, given in (("main_rotor", {"name": "main"}), ("tail_rotor", {"name": "tail", "model": "closed-form"})):
        if alias in rest:
            if not isinstance(rest[alias], dict):
                raise InputError.of(alias, rest[alias], "must be a group", file=path)
            found.append((alias, {**given, **rest[alias]}))
    return found


def _as_checked(path: Path, place: str, group: str, entry: dict[str, Any]) -> dict[str, Any]:
    """A rotor of version 2 by the keys of the group that checks it."""
    rotor = {key: value for key, value in entry.items() if key not in ("position", "shaft", "model")}
    for ours, checked in RENAMED[group].items():
        # keys of version 1 say nothing in version 2
        if len(checked) == 1 and checked[0] in rotor:
            allowed = f"unknown key; in version 2 it is {'.'.join(ours)}"
            raise InputError.of(f"{place}.{checked[0]}", entry[checked[0]], allowed, file=path)
    if "position" in entry:
        rotor["hub"] = entry["position"]
    shaft = entry.get("shaft", {})
    angles = {ours[1]: checked[0] for ours, checked in RENAMED[group].items() if ours[0] == "shaft"}
    if not isinstance(shaft, dict) or set(shaft) - set(angles):
        given = shaft if not isinstance(shaft, dict) else ", ".join(sorted(set(shaft) - set(angles)))
        raise InputError.of(f"{place}.shaft", given, f"must be a group with keys of: {', '.join(angles)}", file=path)
    rotor |= {checked: shaft[ours] for ours, checked in angles.items() if ours in shaft}
    blade = rotor.get("blade")
    if group == "rotor" and isinstance(blade, dict):
        if "flexible" in blade:
            raise InputError.of(
                f"{place}.blade.flexible", blade["flexible"], "unknown key; in version 2 it is model", file=path
            )
        rotor["blade"] = {**blade, "flexible": BLADED[entry["model"]]}
    return rotor
