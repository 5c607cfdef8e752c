# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight run`: one file that holds what a command is otherwise told option by option.

The keys of a case file are the options of its command, `flight_path` for `--flight-path`, whatever options that has; groups
are for the reader, but `[inflow]` takes any option of the inflow model, `[outputs]` what is written, and `[maneuver]` may be
the manoeuvre itself. Everything is checked as if it had been typed.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any

import typer

from ..atomic import write_text
from ..errors import InputError
from ..text import file_beside, read_text, read_toml
from .export import FORMATS, export_to
from .request import writable

COMMANDS = {"fly": "run.nc", "compare": None, "trim": "trim.nc", "tunnel": "tunnel.nc"}
"""Commands that a case may run, and the result of each that can be exported."""

GROUPS = ("condition", "inflow", "maneuver", "control", "run", "stand", "outputs")


def case(
    context: typer.Context,
    file: Annotated[Path, typer.Argument(metavar="CASE.toml", help="aircraft, condition, inflow, manoeuvre, outputs")],
) -> None:
    """Run what one file says: aircraft, condition, inflow, manoeuvre, control and outputs."""
    try:
        content = read_toml(file)
    except ValueError as reason:
        raise InputError(f"{file}: {reason}") from reason
    name = content.pop("command", "fly")
    if name not in COMMANDS:
        raise InputError.choice("command", name, COMMANDS, file=file)
    outputs = dict(content.get("outputs", {})) if isinstance(content.get("outputs"), dict) else {}
    folder = writable(Path(outputs.get("folder", Path("runs") / file.stem)))
    wanted = outputs.pop("export", [])
    for each in wanted if isinstance(wanted, list) else [wanted]:
        if each not in FORMATS or COMMANDS[name] is None:
            raise InputError.choice("outputs.export", each, FORMATS if COMMANDS[name] else (), file=file)
    group: Any = context.parent.command if context.parent is not None else None
    command = group.get_command(context, name)
    arguments = list(_arguments({**content, "outputs": outputs}, command, file, folder))
    try:
        command.main([*arguments, "--out", str(folder)], prog_name=f"wakeflight {name}", standalone_mode=False)
    except InputError as reason:
        raise InputError(f"{file}: {reason}") from reason
    for to in wanted if isinstance(wanted, list) else [wanted]:
        print(f"wrote {export_to(folder / str(COMMANDS[name]), to, folder / to)}")


def _arguments(content: dict[str, Any], command: Any, file: Path, folder: Path) -> Iterator[str]:
    """What would be typed for the content of a case file."""
    known = {parameter.name: parameter for parameter in command.params if parameter.name}
    for key, value in content.items():
        if key == "inflow" and isinstance(value, dict):
            yield from _inflow(value, file)
        elif key == "maneuver" and isinstance(value, dict) and "maneuver" in known:
            yield str(_own_maneuver(value, file, folder))
        elif key == "control" and isinstance(value, str | dict) and "control" in known:
            yield from ("--control", _path(value.get("file") if isinstance(value, dict) else value, file))
        elif key == "changes" and isinstance(value, dict) and "changes" in known:
            for name, each in _flat(value):
                yield from ("--set", f"{name}={_toml(each)}")
        elif key in GROUPS and isinstance(value, dict):
            for name, each in value.items():
                if (key, name) != ("outputs", "folder"):
                    yield from _typed(name, each, known, f"{key}.{name}", file)
        else:
            yield from _typed(key, value, known, key, file)


def _typed(name: str, value: Any, known: dict[str, Any], key: str, file: Path) -> Iterator[str]:
    """One key as the option or argument it stands for."""
    if name not in known or name == "out":
        where = f"key of [{key.split('.')[0]}]" if "." in key else "key"
        raise InputError.choice(where, name, sorted(set(known) - {"out", "wake"}), file=file)
    if isinstance(value, bool):
        yield f"--{'' if value else 'no-'}{name.replace('_', '-')}"
        return
    for each in value if isinstance(value, list) else [value]:
        if isinstance(each, dict | list):
            raise InputError.of(key, each, "must be a number, text or a list of them", file=file)
        text = _path(each, file)
        if known[name].param_type_name == "argument":
            yield text
        else:
            yield from (f"--{name.replace('_', '-')}", text)


def _flat(group: dict[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Entries of a group by dotted names, whether its keys were quoted or not."""
    for name, value in group.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{before}{name}.")
        else:
            yield f"{before}{name}", value


def _inflow(options: dict[str, Any], file: Path) -> Iterator[str]:
    """`model`, `preset` and any option of the inflow model."""
    for name, value in options.items():
        if isinstance(value, dict | list):
            raise InputError.of(f"inflow.{name}", value, "must be a number, text, true or false", file=file)
        if name == "model":
            yield from ("--inflow", str(value))
        elif name == "preset":
            yield from ("--wake", str(value))
        else:
            yield from ("--wake", f"{name}={str(value).lower() if isinstance(value, bool) else value}")


def _own_maneuver(content: dict[str, Any], file: Path, folder: Path) -> Path:
    """The manoeuvre that stands in the case file, as a file of its own beside the results, with the sticks that it names."""
    record = content.get("recorded")
    if isinstance(record, dict) and isinstance(record.get("file"), str):
        try:
            text = read_text(file_beside(file.parent, record["file"]))
        except ValueError as reason:
            raise InputError.of("maneuver.recorded.file", record["file"], str(reason), file=file) from reason
        write_text(folder / "sticks.csv", text)
        content = {**content, "recorded": {**record, "file": "sticks.csv"}}
    lines = [f"{json.dumps(key)} = {_toml(value)}" for key, value in {"name": file.stem, **content}.items()]
    return write_text(folder / "maneuver.toml", "\n".join(lines) + "\n")


def _toml(value: Any) -> str:
    """A value as TOML text: numbers, text, lists and small groups, which is what a manoeuvre holds."""
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{json.dumps(key)} = {_toml(each)}" for key, each in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


def _path(value: Any, file: Path) -> str:
    """Text of a value; a file that lies beside the case is found there."""
    beside = file.parent / str(value)
    return str(beside) if str(value).endswith(".toml") and beside.is_file() else str(value)
