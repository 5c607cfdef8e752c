# SPDX-License-Identifier: MIT OR Apache-2.0
"""Controllers from a TOML file: a table `[control]`, in a file of its own or in that of a manoeuvre."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..arguments import checked
from ..errors import InputError, one_line
from ..text import read_toml
from .augmentation import Augmentation
from .blocks import AltitudeHold, AttitudeHold, RateDamping, TurnCoordination
from .pitch_bias import PitchBiasActuator
from .servos import Servos

KINDS: dict[str, Any] = {
    "rate_damping": RateDamping,
    "attitude_hold": AttitudeHold,
    "turn_coordination": TurnCoordination,
    "altitude_hold": AltitudeHold,
    "pitch_bias_actuator": PitchBiasActuator,
}
"""Blocks by the name of their table."""


@checked
def load_control(path: str | Path) -> Augmentation:
    """Controllers and servos of a TOML file with a table `[control]`.

    Raises InputError, one line naming file, key, value and what is allowed.
    """
    path = Path(path)
    if not path.is_file():
        raise InputError.of("control", str(path), "no such file; allowed: a TOML file with a table [control]")
    try:
        data = read_toml(path)
    except ValueError as reason:
        raise InputError(one_line(f"{path}: {reason}")) from reason
    for key in data:
        if key != "control":
            raise InputError.of(key, "unknown key", "allowed: control", file=path)
    return from_table(data.get("control", {}), path)


def from_table(table: Any, path: Path) -> Augmentation:
    """Of the table `[control]` of the file `path`: `authority`, `actuators`, and a table, or several, for each block."""
    if not isinstance(table, Mapping) or not table:
        raise InputError.of("control", table, f"must be a table with some of {', '.join(KINDS)}", file=path)
    controllers = []
    for key, given in table.items():
        if key in KINDS:
            tables = given if isinstance(given, list) else [given]
            controllers += [_made(f"control.{key}", KINDS[key], each, path) for each in tables]
        elif key not in ("authority", "actuators"):
            allowed = f"allowed: {', '.join(('authority', 'actuators', *KINDS))}"
            raise InputError.of(f"control.{key}", "unknown key", allowed, file=path)
    actuators = table.get("actuators")
    if isinstance(actuators, Mapping):
        actuators = _made("control.actuators", Servos, actuators, path)
    try:
        return Augmentation(tuple(controllers), table.get("authority"), actuators)
    except InputError as reason:
        raise InputError(f"{path}: {reason}") from None


def _made(key: str, kind: Any, table: Any, path: Path) -> Any:
    """An object of what a table says."""
    if not isinstance(table, Mapping):
        raise InputError.of(key, table, "must be a table", file=path)
    known = inspect.signature(kind).parameters
    for name in table:
        if name not in known:
            raise InputError.of(f"{key}.{name}", "unknown key", f"allowed: {', '.join(known)}", file=path)
    try:
        return kind(**table)
    except InputError as reason:
        raise InputError(f"{path}: {reason}") from None


def from_description(told: Mapping[str, Any]) -> Augmentation:
    """Controllers and servos again from what `Augmentation.described` told; InputError where one is a user's own."""
    by_class = {kind.__qualname__: kind for kind in KINDS.values()}
    controllers = []
    for each in told["controllers"]:
        name = each["controller"]
        if name not in by_class:
            allowed = f"is told by its name alone: give it again by control=; known here: {', '.join(by_class)}"
            raise InputError.of("control", name, allowed)
        known = inspect.signature(by_class[name]).parameters
        controllers.append(by_class[name](**{key: value for key, value in each.items() if key in known}))
    servos = told.get("actuators")
    found = Augmentation(
        tuple(controllers),
        told.get("authority"),
        None if servos is None else Servos(**servos),
        tuple(told.get("scale", (1.0,) * 4)),
    )
    if found.described() != dict(told):
        raise InputError.of(
            "control", ", ".join(by_class), "was made with more than is told of it: give it again by control="
        )
    return found
