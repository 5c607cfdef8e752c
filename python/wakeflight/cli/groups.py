# SPDX-License-Identifier: MIT OR Apache-2.0
"""Options that several commands share, each declared once; a group of them becomes one argument of a command."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Annotated, Any, get_type_hints

import typer

from ..options import choices, described

ManeuverName = Annotated[
    str, typer.Argument(metavar="MANEUVER", help="arrested-descent, roll-reversal, or a TOML file")
]
AircraftName = Annotated[str, typer.Option("--aircraft", metavar="NAME|FILE", help="uh60a, bo105, or an aircraft file")]
InflowName = Annotated[str, typer.Option("--inflow", help="time-marching, relaxation, dynamic")]
Revolutions = Annotated[float | None, typer.Option("--revolutions", help="revolutions to fly; the manoeuvre's own")]
Integrator = Annotated[str, typer.Option("--integrator", help="ida, fixed")]
Blades = Annotated[str | None, typer.Option("--blades", help="rigid, flexible; the aircraft's own")]
Out = Annotated[Path | None, typer.Option("--out", help="folder for results")]


class Group:
    """Options that belong together: a frozen dataclass, every field annotated with its option and given a default."""

    def given(self) -> dict[str, Any]:
        """Those that were typed, by name."""
        values = vars(self)
        return {name: value for name, value in values.items() if value is not None}


@dataclass(frozen=True)
class Vehicle(Group):
    """The aircraft, and what its file names."""

    aircraft: AircraftName = "uh60a"
    loading: Annotated[str | None, typer.Option("--loading", help="named mass and c.g. of the aircraft file")] = None
    condition: Annotated[str | None, typer.Option("--condition", help="named condition of the aircraft file")] = None


@dataclass(frozen=True)
class Straight(Group):
    """Arguments of a FlightCondition: speed, path, altitude, weight."""

    speed: Annotated[str | None, typer.Option("--speed", help='true airspeed, "80 kt"')] = None
    flight_path: Annotated[str | None, typer.Option("--flight-path", help='climb +, "-6 deg"')] = None
    altitude: Annotated[str | None, typer.Option("--altitude", help='standard atmosphere, "5250 ft"')] = None
    weight: Annotated[str | None, typer.Option("--weight", help='"16000 lbf"; lb and kg are masses')] = None


@dataclass(frozen=True)
class Condition(Straight):
    """All arguments of a FlightCondition: sideslip and turns as well."""

    sideslip: Annotated[str | None, typer.Option("--sideslip", help='wind from the right +, "5 deg"')] = None
    turn_rate: Annotated[str | None, typer.Option("--turn-rate", help='to the right +, "3 deg/s"')] = None
    bank: Annotated[str | None, typer.Option("--bank", help='to the right +, "10 deg"')] = None
    load_factor: Annotated[float | None, typer.Option("--load-factor", help="of a turn whose rate is found, 1.5")] = (
        None
    )
    turn: Annotated[str | None, typer.Option("--turn", help="direction of that turn: right, left")] = None


@dataclass(frozen=True)
class Wake(Group):
    """Options of the inflow model; `request.inflow_from` makes the model of them."""

    azimuth_step: Annotated[str | None, typer.Option("--azimuth-step", help='divides 360 deg / blades, "10 deg"')] = (
        None
    )
    wake_turns: Annotated[
        float | None, typer.Option("--wake-turns", help=f"turns of free wake; {described('turns')}")
    ] = None
    wake_scheme: Annotated[str | None, typer.Option("--wake-scheme", help=choices("scheme"))] = None
    wake: Annotated[
        list[str] | None,
        typer.Option(
            "--wake", metavar="PRESET|NAME=VALUE", help="standard, paper, reference, or any option; repeatable"
        ),
    ] = None


@dataclass(frozen=True)
class Run(Group):
    """How it runs and where results go."""

    threads: Annotated[int | None, typer.Option("--threads", help="threads of the physics core")] = None
    out: Out = None


def expanded(command: Callable[..., None]) -> Callable[..., None]:
    """`command` with the options of its groups in its signature, in their place: what the parser reads."""
    hints = get_type_hints(command, include_extras=True)
    groups: dict[str, type[Group]] = {}
    shown = []
    for parameter in inspect.signature(command).parameters.values():
        annotation = hints[parameter.name]
        if not inspect.isclass(annotation) or not issubclass(annotation, Group):
            shown.append(parameter.replace(annotation=annotation))
            continue
        groups[parameter.name] = annotation
        options = get_type_hints(annotation, include_extras=True)
        shown += [
            inspect.Parameter(each.name, parameter.kind, default=each.default, annotation=options[each.name])
            for each in fields(annotation)  # type: ignore[arg-type]
        ]

    @functools.wraps(command)
    def parsed(**typed: Any) -> None:
        made = {
            name: group(**{each.name: typed.pop(each.name) for each in fields(group)})  # type: ignore[arg-type]
            for name, group in groups.items()
        }
        command(**typed, **made)

    parsed.__signature__ = inspect.Signature(shown)  # type: ignore[attr-defined]
    parsed.__annotations__ = {each.name: each.annotation for each in shown}
    del parsed.__wrapped__  # type: ignore[attr-defined]
    return parsed
