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


def offered(*words: str) -> Callable[[str], list[str]]:
    """What a shell completes for an option: those of `words` that begin as what is typed."""
    return lambda incomplete: [word for word in words if word.startswith(incomplete)]


def told(flag: str, text: str, default: str) -> Any:
    """An option whose default is told in words: that of the aircraft, the manoeuvre, the regime."""
    return typer.Option(flag, help=text, show_default=default)


OF_AIRCRAFT = "the aircraft's own"
ManeuverName = Annotated[
    str,
    typer.Argument(
        metavar="MANEUVER",
        help="arrested-descent, roll-reversal, roll-reversal-augmented, or a TOML file",
        autocompletion=offered("arrested-descent", "roll-reversal", "roll-reversal-augmented"),
    ),
]
AircraftName = Annotated[
    str,
    typer.Option(
        "--aircraft",
        metavar="NAME|FILE",
        help="uh60a, bo105, or an aircraft file",
        autocompletion=offered("uh60a", "bo105"),
    ),
]
InflowName = Annotated[
    str,
    typer.Option(
        "--inflow",
        help="time-marching, relaxation, dynamic",
        autocompletion=offered("time-marching", "relaxation", "dynamic"),
    ),
]
Revolutions = Annotated[float | None, told("--revolutions", "revolutions to fly", "the manoeuvre's own")]
Integrator = Annotated[str, typer.Option("--integrator", help="ida, fixed", autocompletion=offered("ida", "fixed"))]
Control = Annotated[
    str | None,
    typer.Option(
        "--control",
        metavar="FILE",
        help="controllers and servos, a TOML file, or none",
        show_default="the manoeuvre's own",
    ),
]
Blades = Annotated[
    str | None,
    typer.Option(
        "--blades",
        help="rigid, flexible",
        show_default=OF_AIRCRAFT,
        autocompletion=offered("rigid", "flexible"),
    ),
]
Out = Annotated[Path | None, told("--out", "folder for results", "runs/ and a name")]


DrawnUnits = Annotated[
    str,
    typer.Option(
        "--units",
        help="si or us (kt, ft, lbf, hp): units of figures and report",
        autocompletion=offered("si", "us"),
    ),
]
FigureFormat = Annotated[
    str,
    typer.Option(
        "--figure-format",
        help="png, svg, pdf: files of this format too",
        autocompletion=offered("png", "svg", "pdf"),
    ),
]
Threads = Annotated[
    int | None,
    told("--threads", "threads of the physics core", "WAKEFLIGHT_THREADS or all processors"),
]
Folder = Annotated[Path, typer.Argument(metavar="DIR", help="folder of a flight")]
Checkpoint = Annotated[str, typer.Option("--checkpoint", help="wall clock between checkpoints")]
AllowOutside = Annotated[
    bool, typer.Option("--allow-outside", help="read tables elsewhere than beside the aircraft or rotor file, or below")
]
ROTOR_SPEEDS = ("constant", "constant-over-ground", "governed", "free")
RotorSpeedName = Annotated[
    str,
    typer.Option(
        "--rotor-speed",
        help="constant about the airframe, constant-over-ground, governed by the engines, free with the torque of the trim",
        autocompletion=offered(*ROTOR_SPEEDS),
    ),
]

WindName = Annotated[
    str | None,
    typer.Option("--wind", metavar="TEXT|FILE", help='"10 kt from 270 deg", or a TOML file', show_default="none"),
]


Changes = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="NAME=VALUE",
        help="another number for the aircraft's file, rotor.omega=26 rad/s; repeatable",
        show_default="the file's",
    ),
]


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
    loading: Annotated[str | None, told("--loading", "named mass and c.g. of the aircraft file", OF_AIRCRAFT)] = None
    condition: Annotated[str | None, told("--condition", "named condition of the aircraft file", OF_AIRCRAFT)] = None
    allow_outside: AllowOutside = False
    changes: Changes = None


@dataclass(frozen=True)
class Straight(Group):
    """Arguments of a FlightCondition: speed, path, altitude, weight."""

    speed: Annotated[str | None, told("--speed", 'true airspeed, "80 kt"', OF_AIRCRAFT)] = None
    flight_path: Annotated[str | None, told("--flight-path", 'climb +, "-6 deg"', OF_AIRCRAFT)] = None
    altitude: Annotated[str | None, told("--altitude", 'standard atmosphere, "5250 ft"', OF_AIRCRAFT)] = None
    weight: Annotated[str | None, told("--weight", '"16000 lbf"; lb and kg are masses', OF_AIRCRAFT)] = None


@dataclass(frozen=True)
class Condition(Straight):
    """All arguments of a FlightCondition: sideslip and turns as well."""

    sideslip: Annotated[str | None, told("--sideslip", 'wind from the right +, "5 deg"', "found by trim or 0")] = None
    turn_rate: Annotated[str | None, told("--turn-rate", 'to the right +, "3 deg/s"', "0 deg/s")] = None
    bank: Annotated[str | None, told("--bank", 'to the right +, "10 deg"', "0 or found by trim")] = None
    load_factor: Annotated[float | None, typer.Option("--load-factor", help="of a turn whose rate is found, 1.5")] = (
        None
    )
    turn: Annotated[str | None, told("--turn", "direction of that turn: right, left", "right")] = None
    height: Annotated[str | None, told("--height", 'of the hub above flat ground, "30 ft"', "no ground")] = None


@dataclass(frozen=True)
class Wake(Group):
    """Options of the inflow model; `request.inflow_from` makes the model of them."""

    azimuth_step: Annotated[
        str | None,
        typer.Option(
            "--azimuth-step", help='divides 360 deg / blades, "10 deg"', show_default=described("azimuth_step")
        ),
    ] = None
    wake_turns: Annotated[float | None, told("--wake-turns", "turns of free wake", described("turns"))] = None
    wake_scheme: Annotated[str | None, told("--wake-scheme", choices("scheme"), described("scheme"))] = None
    wake: Annotated[
        list[str] | None,
        typer.Option(
            "--wake",
            metavar="PRESET|NAME=VALUE",
            help="standard, paper, reference, or any option; repeatable",
            show_default="standard",
            autocompletion=offered("standard", "paper", "reference"),
        ),
    ] = None


@dataclass(frozen=True)
class Run(Group):
    """How it runs and where results go."""

    threads: Threads = None
    out: Out = None


@dataclass(frozen=True)
class Drawing(Group):
    """Whether figures and report are made, and in which format figures are written."""

    figures: Annotated[bool, typer.Option("--figures/--no-figures", help="draw figures and write the report")] = True
    figure_format: FigureFormat = "png"
    units: DrawnUnits = "si"


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
    del parsed.__wrapped__
    return parsed
