# SPDX-License-Identifier: MIT OR Apache-2.0
"""JSON schemas of the files that people write, for editors that complete and check them: aircraft, rotor, manoeuvre.

Made from the same declarations that read the files. An editor with TOML support takes one by a first line
`#:schema aircraft.schema.json`. Version 2 of the aircraft format; what a schema cannot say is checked on loading.
"""

from __future__ import annotations

from typing import Any

from .arguments import checked
from .errors import InputError

KINDS = ("aircraft", "rotor", "maneuver")
DRAFT = "https://json-schema.org/draft/2020-12/schema"


@checked
def file_schema(kind: str) -> dict[str, Any]:
    """JSON schema of a kind of file: `aircraft`, `rotor` or `maneuver`."""
    if kind not in KINDS:
        raise InputError.choice("kind", kind, KINDS)
    made = {"aircraft": _aircraft, "rotor": _rotor, "maneuver": _maneuver}[kind]()
    return {"$schema": DRAFT, **made}


def _maneuver() -> dict[str, Any]:
    from pydantic import TypeAdapter

    from .maneuver_files import FILE_MODEL

    return TypeAdapter(FILE_MODEL).json_schema()


def _aircraft() -> dict[str, Any]:
    from .aircraft.schema import AircraftFile

    return _version_2(AircraftFile.model_json_schema())


def _rotor() -> dict[str, Any]:
    from .aircraft.rotor_file import RotorFile

    # numbers of a rotor file may be written short, "1.143 m" or 0.97
    return _version_2(RotorFile.model_json_schema(), short=True)


def _version_2(schema: dict[str, Any], short: bool = False) -> dict[str, Any]:
    """The groups that are checked as a file of version 2 has them: a list of rotors, positions, shafts, models."""
    from .aircraft.versions import BLADED, RENAMED

    definitions = schema["$defs"]
    for name in ("TableFile", "Deck"):
        definitions[name] = _table(short)
    definitions.pop("Provenance", None)
    properties = schema["properties"]
    main = definitions[properties["rotor"]["$ref"].rsplit("/", 1)[-1]]
    blade = definitions[main["properties"]["blade"]["$ref"].rsplit("/", 1)[-1]]
    blade["properties"].pop("flexible", None)
    _either(main["properties"], "airfoil")
    kinds = [_renamed(main, RENAMED["rotor"], {"enum": list(BLADED)})]
    if "tail_rotor" in properties:
        kinds.append(_renamed(definitions["TailRotor"], RENAMED["tail_rotor"], {"const": "closed-form"}))
        properties["tail_rotor"] = kinds[1]
        properties["main_rotor"] = kinds[0]
    listed = {"type": "array", "items": {"anyOf": kinds}}
    properties["rotor"] = {"anyOf": [listed, kinds[0]]} if short else listed
    properties["schema"] = {"const": 2, "description": "version of the format"}
    schema["required"] = ["schema", *(name for name in schema["required"] if name != "rotor")]
    if short:
        _shorten(schema)
    return schema


def _table(short: bool) -> dict[str, Any]:
    """A table beside the file, or in place."""
    return {
        "type": "object",
        "description": "a CSV file beside this one, or columns in place; the unit in the name of each column",
        "properties": {
            "table": {"type": "string"},
            "columns": {"type": "object", "additionalProperties": {"type": "array"}},
            "source": {"type": ["string", "array"]},
            "confidence": {"type": "string"},
            "note": {"type": "string"},
        },
        "required": [] if short else ["source", "confidence"],
    }


def _either(properties: dict[str, Any], name: str) -> None:
    """One group where a list of them is allowed too."""
    listed = properties[name]
    properties[name] = {"anyOf": [listed["items"], {"type": "array", "items": listed["items"], "minItems": 1}]}


def _renamed(
    group: dict[str, Any], renamed: dict[tuple[str, ...], tuple[str, ...]], model: dict[str, Any]
) -> dict[str, Any]:
    """A rotor by the keys of version 2, its `name` and `model` among them."""
    properties = dict(group["properties"])
    required = [name for name in group.get("required", []) if name in properties]
    shaft: dict[str, Any] = {}
    needed: list[str] = []
    for ours, theirs in renamed.items():
        if len(theirs) > 1 or theirs[0] not in properties:
            continue
        value, must = properties.pop(theirs[0]), theirs[0] in required
        required = [name for name in required if name != theirs[0]]
        if len(ours) > 1:
            shaft[ours[1]] = value
            needed += [ours[1]] * must
        else:
            properties[ours[0]] = value
            required += [ours[0]] * must
    if shaft:
        properties["shaft"] = {"type": "object", "properties": shaft, "required": needed, "additionalProperties": False}
        required += ["shaft"] * bool(needed)
    properties["model"] = model
    return {**group, "properties": properties, "required": [*required, "model"]}


def _shorten(node: Any) -> None:
    """Allow numbers as text with a unit, plain numbers and lists where a table with value and source may stand."""
    for value in node.values() if isinstance(node, dict) else node if isinstance(node, list) else []:
        _shorten(value)
    if isinstance(node, dict) and isinstance(node.get("properties"), dict) and "confidence" in node["properties"]:
        node["type"] = ["object", "string", "number", "array"]
        node["required"] = []
