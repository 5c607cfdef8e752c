# SPDX-License-Identifier: MIT OR Apache-2.0
"""Files to begin from: the template loads, trims and is what its schema says; so are the files that come with the package."""

import json
import tomllib
from importlib import resources
from pathlib import Path

import pytest

import wakeflight as wf
from wakeflight import cli

PACKAGE = Path(str(resources.files("wakeflight")))
FILES = [
    ("aircraft", PACKAGE / "aircraft" / "template.toml"),
    ("aircraft", PACKAGE / "aircraft" / "bo105" / "bo105.toml"),
    ("aircraft", PACKAGE / "aircraft" / "uh60a" / "uh60a.toml"),
    ("maneuver", PACKAGE / "maneuver_data" / "roll-reversal.toml"),
    ("rotor", Path(__file__).resolve().parents[2] / "examples" / "data" / "model-rotor.toml"),
]


def _faults(value, schema, root, place="file"):
    """Where `value` is not what `schema` says: types, keys, enumerations. A small reader of what our schemas use."""
    if "$ref" in schema:
        return _faults(value, root["$defs"][schema["$ref"].rsplit("/", 1)[-1]], root, place)
    options = schema.get("anyOf") or schema.get("oneOf")
    if options:
        tried = [_faults(value, each, root, place) for each in options]
        return min(tried, key=len)
    found = []
    kinds = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "boolean": bool}
    names = schema.get("type", [])
    names = [names] if isinstance(names, str) else names
    if names and not any(each != "null" and isinstance(value, kinds[each]) for each in names):
        return [f"{place}: {value!r} is no {names}"]
    if "const" in schema and value != schema["const"]:
        found.append(f"{place}: not {schema['const']}")
    if "enum" in schema and value not in schema["enum"]:
        found.append(f"{place}: {value!r} not in {schema['enum']}")
    if isinstance(value, dict) and "properties" in schema:
        found += [f"{place}: {name} is missing" for name in schema.get("required", []) if name not in value]
        for name, each in value.items():
            if name in schema["properties"]:
                found += _faults(each, schema["properties"][name], root, f"{place}.{name}")
            elif schema.get("additionalProperties") is False:
                found.append(f"{place}: {name} is not allowed")
    elif isinstance(value, dict) and isinstance(schema.get("additionalProperties"), dict):
        for name, each in value.items():
            found += _faults(each, schema["additionalProperties"], root, f"{place}.{name}")
    if isinstance(value, list) and isinstance(schema.get("items"), dict):
        for i, each in enumerate(value):
            found += _faults(each, schema["items"], root, f"{place}[{i}]")
    return found


@pytest.mark.parametrize(("kind", "path"), FILES, ids=lambda each: getattr(each, "stem", each))
def test_files_that_load_are_what_their_schema_says(kind, path):
    schema = wf.file_schema(kind)
    assert _faults(tomllib.loads(path.read_text()), schema, schema) == []


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("radius =", "radious =", "radious is not allowed"),
        ('model = "rigid"', 'model = "stiff"', "stiff"),
        ("[drive]", "[drives]", "drive is missing"),
        ("schema = 2", "schema = 3", "not 2"),
        ('confidence = "C" }        # climb', 'confidence = "Z" }        # climb', "'Z' not in"),
    ],
)
def test_a_schema_finds_what_is_wrong(old, new, named):
    text = FILES[0][1].read_text()
    assert old in text
    schema = wf.file_schema("aircraft")
    assert any(named in each for each in _faults(tomllib.loads(text.replace(old, new, 1)), schema, schema))


def test_the_template_is_written_once_and_flies(tmp_path, capsys):
    path = tmp_path / "mine.toml"
    with pytest.raises(SystemExit) as end:
        cli.main(["new-aircraft", str(path), "--name", "Mine"])
    assert end.value.code == 0
    json.loads((tmp_path / "aircraft.schema.json").read_text())
    aircraft = wf.load_aircraft(path)
    assert aircraft.name == "Mine"
    assert aircraft.warnings == ()
    start = wf.trim(aircraft, inflow="dynamic")
    assert start.warnings == ()
    with pytest.raises(SystemExit) as end:
        cli.main(["new-aircraft", str(path)])
    assert end.value.code == 2
    assert "never written over" in capsys.readouterr().err


def test_kinds_are_named():
    with pytest.raises(wf.InputError, match="did you mean maneuver"):
        wf.file_schema("maneuvers")


RECORDED = """
name = "of the cockpit"
recorded = { file = "sticks.csv", about = "trim", join = "0.4 s" }
duration = { seconds = 3.0 }
"""


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("", "", None),
        ("about =", "around =", "around is not allowed"),
        ("name =", "nam =", "name is missing"),
        ('"0.4 s"', "0.4", "is no ['string']"),
    ],
)
def test_the_schema_of_manoeuvres_knows_recorded_sticks(old, new, named):
    schema = wf.file_schema("maneuver")
    found = _faults(tomllib.loads(RECORDED.replace(old, new, 1)), schema, schema)
    assert found == [] if named is None else any(named in each for each in found), found
