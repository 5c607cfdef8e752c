# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight new-aircraft`."""

from __future__ import annotations

import json
from importlib import resources
from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError
from .outcome import folder_made


def new_aircraft(
    file: Annotated[Path, typer.Argument(metavar="FILE.toml", help="file to write; it must not be there yet")],
    name: Annotated[str, typer.Option("--name", help="name of the aircraft")] = "My helicopter",
) -> None:
    """Write a commented aircraft file to begin from, which loads and flies as it stands, and its schema for editors."""
    if file.suffix != ".toml":
        raise InputError.of("FILE.toml", str(file), "must end in .toml")
    if file.exists():
        raise InputError.of("FILE.toml", str(file), "is there already; it is never written over")
    if not name.strip() or any(each in name for each in '"\\\n'):
        raise InputError.of("--name", name, "must be text without quotes and backslashes")
    from ..atomic import write_text
    from ..file_schemas import file_schema

    template = (resources.files("wakeflight.aircraft") / "template.toml").read_text(encoding="utf-8")
    folder_made(file.absolute().parent)
    write_text(file, template.replace('name = "My helicopter"', f'name = "{name.strip()}"', 1))
    schema = file.with_name("aircraft.schema.json")
    write_text(schema, json.dumps(file_schema("aircraft"), indent=1) + "\n")
    print(f"wrote {file} and {schema}; try: wakeflight trim --aircraft {file} --inflow dynamic")


def schema(
    kind: Annotated[str, typer.Argument(metavar="KIND", help="aircraft, rotor, maneuver")],
) -> None:
    """Print the JSON schema of a kind of file, for editors that complete and check what is typed."""
    from ..file_schemas import file_schema

    print(json.dumps(file_schema(kind), indent=1))
