# SPDX-License-Identifier: MIT OR Apache-2.0
"""Files of manoeuvres: those that come with the package, a user's own, and files that name recorded sticks.

A file holds a name, a duration in revolutions or seconds, and for each stick that moves its corner points
(time [s], inches from trim); or in place of the corners the file of `recorded` sticks.
"""

from __future__ import annotations

from dataclasses import replace
from importlib import resources
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from .arguments import checked
from .control import Augmentation, from_table
from .errors import InputError, one_line
from .maneuvers import Maneuver
from .references import known_keys
from .stick_records import read_sticks
from .sticks import STICKS
from .text import file_beside, is_file, read_toml
from .units import quantity

SHIPPED = ("arrested-descent", "roll-reversal", "roll-reversal-augmented")
"""Names of the manoeuvres that come with the package."""

_Real = Annotated[float, Field(strict=True)]
_Points = list[tuple[_Real, _Real]] | None


@checked
def arrested_descent(start: Any = None) -> Maneuver:
    """Arrested descent [ribera2004]: collective up by 3.7 in and back, 12 revolutions.

    start: begin of the first ramp (`"2 s"`); None is the shipped file's 0.4654 s, two revolutions.
    """
    maneuver = _shipped("arrested-descent")
    if start is None:
        return maneuver
    first = quantity(start, "s", "start")
    assert maneuver.rotor_speed is not None, "the shipped file says which rotor speed its revolutions belong to"
    end = maneuver.duration(maneuver.rotor_speed)
    if not 0.0 <= first < end:
        raise InputError.of("start", start, f"must lie between 0 s and the end of the manoeuvre, {end:.4g} s")
    moved = tuple(
        (stick, tuple((first + time - corners[0][0], inches) for time, inches in corners))
        for stick, corners in maneuver.corners_of
    )
    return replace(maneuver, corners_of=moved)


@checked
def roll_reversal() -> Maneuver:
    """Roll reversal [ribera2004]: lateral stick right, left, right and back to trim, 36 revolutions."""
    return _shipped("roll-reversal")


@checked
def load_maneuver(name_or_path: str | Path) -> Maneuver:
    """Manoeuvre from a shipped name (`arrested-descent`, `roll-reversal`, `roll-reversal-augmented`) or the path of a TOML
    file; of sticks that were recorded (CSV) as `wf.recorded_sticks` reads them.

    Raises InputError, one line naming file, key, value and what is allowed.
    """
    if str(name_or_path) in SHIPPED:
        return _shipped(str(name_or_path))
    path = Path(name_or_path)
    if path.suffix.lower() == ".csv" and is_file(path):
        return recorded(path, "first", Maneuver.join, None, None)
    if not is_file(path):
        raise InputError.choice(
            "maneuver",
            str(name_or_path),
            SHIPPED,
            " or the path of a manoeuvre file (.toml) or of recorded sticks (.csv), and there is no such file",
        )
    return _read(path, shipped=False)


class _Duration(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)
    revolutions: _Real | None = None
    seconds: _Real | None = None


class _Controls(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)
    lateral: _Points = None
    longitudinal: _Points = None
    collective: _Points = None
    pedal: _Points = None

    @model_validator(mode="after")
    def _some(self) -> _Controls:
        if all(getattr(self, stick) is None for stick in STICKS):
            raise ValueError(f"must name at least one of {', '.join(STICKS)}")
        return self


class _Recorded(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)
    file: str
    about: str = "first"
    join: str = "0.5 s"


class _File(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)
    name: str
    duration: _Duration
    controls: _Controls
    notes: str = ""
    sources: list[str] = []
    travel: _Real | None = None
    rotor_speed: _Real | None = None
    control: dict[str, Any] | None = None


class _RecordedFile(BaseModel):
    """What a manoeuvre file may hold that names recorded sticks."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    name: str
    recorded: _Recorded
    duration: _Duration | None = None
    notes: str = ""
    sources: list[str] = []
    travel: _Real | None = None
    control: dict[str, Any] | None = None


FILE_MODEL = _File | _RecordedFile
"""What a manoeuvre file may hold: corners, or the name of a file of recorded sticks."""


def _shipped(name: str) -> Maneuver:
    return _read(Path(str(resources.files(__package__))) / "maneuver_data" / f"{name}.toml", shipped=True)


def _read(path: Path, shipped: bool) -> Maneuver:
    try:
        data = read_toml(path)
    except ValueError as reason:
        raise InputError(one_line(f"{path}: {reason}")) from reason
    schema: Any = _RecordedFile if "recorded" in data else _File
    try:
        file = schema.model_validate(data)
    except ValidationError as reason:
        error = reason.errors()[0]
        key = ".".join(str(part) for part in error["loc"])
        message = error["msg"].removeprefix("Value error, ")
        if error["type"] == "extra_forbidden":
            groups: dict[str, Any] = {"controls": _Controls, "duration": _Duration, "recorded": _Recorded}
            group = groups.get(str(error["loc"][0]), schema) if len(error["loc"]) > 1 else schema
            raise InputError.of(key, "unknown key", f"allowed: {', '.join(group.model_fields)}", file=path) from None
        value = "missing" if error["type"] == "missing" else error["input"]
        raise InputError.of(key, value, message, file=path) from None
    control = None if file.control is None else from_table(file.control, path)
    if schema is _RecordedFile:
        return _of_record(path, file, control)
    corners = tuple((stick, tuple(points)) for stick in STICKS if (points := getattr(file.controls, stick)) is not None)
    try:
        return Maneuver(
            name=file.name,
            corners_of=corners,
            revolutions=file.duration.revolutions,
            seconds=file.duration.seconds,
            notes=file.notes.strip(),
            references=_known(file.sources),
            travel_in=file.travel,
            rotor_speed=file.rotor_speed,
            shipped=shipped,
            control=control,
        )
    except InputError as reason:
        raise InputError(f"{path}: {reason}") from None


def _of_record(path: Path, file: _RecordedFile, control: Augmentation | None) -> Maneuver:
    """The manoeuvre of a file that names recorded sticks."""
    try:
        beside = file_beside(path.parent, file.recorded.file)
        found = recorded(
            beside, file.recorded.about, quantity(file.recorded.join, "s", "recorded.join"), None, file.name
        )
        length: dict[str, Any] = {} if file.duration is None else vars(file.duration)
        said: dict[str, Any] = {
            "notes": file.notes.strip(),
            "references": _known(file.sources),
            "travel_in": file.travel,
        }
        return replace(found, control=control, **length, **said)
    except ValueError as reason:
        raise InputError(str(reason) if str(path) in str(reason) else f"{path}: {reason}") from None


def recorded(path: Path, about: str, join: float, seconds: float | None, name: str | None) -> Maneuver:
    """Sticks that were recorded, as `stick_inputs.recorded_sticks` takes them; times [s]."""
    record = read_sticks(path, about)
    length = max(corners[-1][0] for corners in record.values()) if seconds is None else seconds
    absolute = about == "stop"
    try:
        return Maneuver(name or path.stem, tuple(record.items()), seconds=length, absolute=absolute, join=join)
    except InputError as reason:
        raise reason.within(path) from None


def _known(sources: list[str]) -> tuple[str, ...]:
    for key in sources:
        if key not in known_keys():
            raise InputError.of(
                "sources", key, "not in references.bib; leave it out and say in notes where it comes from"
            )
    return tuple(sources)
