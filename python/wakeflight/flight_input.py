# SPDX-License-Identifier: MIT OR Apache-2.0
"""The whole input of a flight, by value: what a run's file carries, and what it is flown from again."""

from __future__ import annotations

import base64
import binascii
import json
import platform
import sys
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from datetime import UTC, datetime
from functools import cached_property
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from ._core import build_commit, instruction_set, threads
from .aircraft import Aircraft
from .aircraft.bundle import Bundle
from .condition import FlightCondition, Target
from .control import Augmentation, from_description
from .engine import Engine, engine_of, told
from .errors import InputError
from .inflow import MODELS, InflowModel, inflow_model
from .integrators import RTOL
from .maneuvers import Maneuver
from .options import Radians, options_of
from .perturbation import Perturbation
from .progress import Progress, Silent
from .rotor_speed import CONSTANT, RotorSpeed
from .snapshot import Snapshot
from .trim import Trim, trim
from .wind import Wind, wind_of_table

VERSION = 1


@dataclass(frozen=True)
class Plan:
    """What is flown from a trim: arguments of `fly`.

    begin: the moment of this flight at which another one was left for it, in place of the trim. lattice: whether a full-span
    wake may be kept whole, where the flight is short enough.
    """

    maneuver: Maneuver
    inflow: InflowModel | str | None = None
    revolutions: float | None = None
    integrator: str = "ida"
    rtol: float = RTOL
    stabilator: str = "held"
    rotor_speed: RotorSpeed | Engine = CONSTANT
    control: Augmentation | None = None
    begin: Snapshot | None = None
    lattice: bool = True
    wind: Wind | None = None
    perturb: Perturbation = ()
    wakes_per_revolution: int = 4


@dataclass(frozen=True)
class Asked:
    """What is trimmed: arguments of `trim`."""

    condition: FlightCondition
    inflow: InflowModel
    target: Target | None = None
    n_harmonics: int = 8
    control_tolerance: float | None = None

    @classmethod
    def of(cls, start: Trim) -> Asked:
        """What a trim was asked."""
        condition = start.condition if start.asked is None else start.asked
        return cls(condition, start.inflow, start.model.target, start.model.n_harmonics, start.control_tolerance)

    def trim(self, aircraft: Aircraft, progress: Progress | Silent) -> Trim:
        """The trim."""
        given: dict[str, Any] = {}
        if self.target is not None:
            unit = {"power": "W", "collective": "rad"}[self.target.name]
            given = {self.target.name: f"{self.target.value!r} {unit}", "free": self.target.free}
        if self.control_tolerance is not None:
            given["control_tolerance"] = self.control_tolerance
        return trim(aircraft, self.condition, self.inflow, progress, self.n_harmonics, **given)


@dataclass(frozen=True)
class FlightInput:
    """Aircraft, what is trimmed, what is flown; and what it was made with: program, command, machine, date."""

    aircraft: Aircraft
    asked: Asked
    plan: Plan
    made: Mapping[str, Any]

    @classmethod
    def of(cls, aircraft: Aircraft, asked: Asked, plan: Plan) -> FlightInput:
        """Of a flight that begins here and now."""
        return cls(aircraft, asked, plan, _made())

    @cached_property
    def text(self) -> str:
        """All of it as JSON; of one that was read, as it was read."""
        plan = self.plan
        whole = {
            "version": VERSION,
            "made": dict(self.made),
            "aircraft": Bundle.of(self.aircraft).as_dict(),
            "trim": {
                "condition": self.asked.condition.as_attributes(),
                "inflow": _told(self.asked.inflow),
                "target": None if self.asked.target is None else vars(self.asked.target),
                "n_harmonics": self.asked.n_harmonics,
                "control_tolerance": self.asked.control_tolerance,
            },
            "flight": dict(_held(plan))
            | {"maneuver": {name: value for name, value in _held(plan.maneuver) if name != "control"}}
            | {"inflow": _told(plan.inflow), "rotor_speed": told(plan.rotor_speed)}
            | {"control": None if plan.control is None else plan.control.described()}
            | {
                "begin": None if plan.begin is None else base64.b64encode(plan.begin.to_bytes()).decode("ascii"),
                "wind": None if plan.wind is None else plan.wind.described(),
            },
        }
        return json.dumps(whole, allow_nan=False, ensure_ascii=False, default=_number)

    @classmethod
    def from_text(cls, text: str, file: object = None, control: Augmentation | None = None) -> FlightInput:
        """From `text`; InputError where it is not one. control: in place of what is written down of it."""
        try:
            whole = json.loads(text)
            if whole["version"] != VERSION:
                raise InputError.of("input version", whole["version"], f"allowed: {VERSION}", file)
            asked, plan = whole["trim"], whole["flight"]
            asked["condition"] = FlightCondition().changed(**asked["condition"])
            asked["inflow"] = _model(asked["inflow"])
            asked["target"] = None if asked["target"] is None else Target(**asked["target"])
            plan["maneuver"] = Maneuver(**{name: _fixed(value) for name, value in plan["maneuver"].items()})
            plan["inflow"] = _model(plan["inflow"])
            plan["rotor_speed"] = _turning(plan["rotor_speed"])
            plan["perturb"] = _fixed(plan.get("perturb", ()))
            if control is not None:
                plan["control"] = control
            elif plan["control"] is not None:
                plan["control"] = from_description(plan["control"])
            if plan.get("begin") is not None:
                plan["begin"] = Snapshot.from_bytes(base64.b64decode(plan["begin"]))
            # an input of an earlier version says nothing of wind
            if plan.get("wind") is not None:
                plan["wind"] = wind_of_table(plan["wind"])
            aircraft = Bundle.from_dict(whole["aircraft"]).aircraft()
            found = cls(aircraft, Asked(**asked), Plan(**plan), whole["made"])
            vars(found)["text"] = text
            return found
        except (KeyError, TypeError, AttributeError, json.JSONDecodeError, binascii.Error) as reason:
            said = f"must be the whole input of a flight as this program writes it: {type(reason).__name__}: {reason}"
            raise InputError.of("input", text[:20], said, file) from reason

    def with_plan(self, **changed: Any) -> FlightInput:
        """This input, made here and now, with some of the plan changed."""
        return FlightInput.of(self.aircraft, self.asked, replace(self.plan, **changed))


def _made() -> dict[str, Any]:
    """Program and build, command, machine, date: what is told and not compared."""
    try:
        program = version("wakeflight")
    except PackageNotFoundError:
        program = "unknown"
    return {
        "program_version": program,
        "commit": build_commit(),
        "command": sys.argv,
        "python": platform.python_version(),
        "machine": {
            "name": platform.node(),
            "system": platform.platform(),
            "processor": platform.processor() or platform.machine(),
            "instruction_set": instruction_set(),
            "threads": str(threads()),
        },
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
    }


def _told(model: InflowModel | str | None) -> Any:
    """An inflow model with every option; a name as it is."""
    if model is None or model in MODELS:
        return model
    chosen = inflow_model(model)
    return {"model": chosen.name, **chosen.as_attributes()}


def _model(told: Any) -> Any:
    """The inflow model again."""
    if told in (None, *MODELS):
        return told
    name = told.pop("model")
    if name not in MODELS:
        raise InputError.of("inflow", name, f"allowed: {', '.join(MODELS)}")
    angles = {option.name for option in options_of(name).values() if option.is_angle}
    made: Any = MODELS[name]
    return made(
        **{key: Radians(value) if key in angles and value is not None else value for key, value in told.items()}
    )


def _turning(told: Any) -> Any:
    """The rotor speed again."""
    match told:
        case {"engine": _}:
            return engine_of(told)
    return _fixed(told)


def _number(value: Any) -> Any:
    """A number of numpy as a plain one."""
    try:
        return value.item()
    except AttributeError as reason:
        raise InputError.of("input", type(value).__name__, "must be numbers, text, or lists of them") from reason


def _held(given: Any) -> list[tuple[str, Any]]:
    """Fields of a dataclass by name."""
    return [(field.name, getattr(given, field.name)) for field in fields(given)]


def _fixed(value: Any) -> Any:
    """Lists of JSON as the tuples they were."""
    return tuple(map(_fixed, value)) if isinstance(value, list) else value
