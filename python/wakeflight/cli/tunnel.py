# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight tunnel`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import typer

from ..errors import InputError
from .groups import AircraftName, AllowOutside, Changes, Drawing, Group, Run, Wake, offered
from .outcome import folder_made, keeping
from .request import changed, check_drawing, inflow_from, set_threads, writable


@dataclass(frozen=True)
class Setting(Group):
    """Arguments of `wf.tunnel`: collective and wind."""

    collective: Annotated[str | None, typer.Option("--collective", help='"8 deg"; else a load, else the weight')] = None
    speed: Annotated[str, typer.Option("--speed", help='wind from the front, "80 kt"')] = "0 kt"
    shaft_angle: Annotated[
        str, typer.Option("--shaft-angle", help="tilt of the shaft, aft + (disk met from below)")
    ] = "0 deg"
    climb: Annotated[str, typer.Option("--climb", help='up the shaft, descent -, "-5 m/s"')] = "0 m/s"


@dataclass(frozen=True)
class Stand(Group):
    """Arguments of `wf.tunnel`: what is held and what is asked for, the air, the blades, the length of the run."""

    collective_at: Annotated[
        str, typer.Option("--collective-at", help='where the collective is meant: root, "0.75 R"')
    ] = "root"
    lateral_cyclic: Annotated[str | None, typer.Option("--lateral-cyclic", help="theta_1c")] = None
    longitudinal_cyclic: Annotated[str | None, typer.Option("--longitudinal-cyclic", help="theta_1s")] = None
    higher_harmonics: Annotated[
        list[str] | None, typer.Option("--higher-harmonic", help='"3, 0.8 deg, 300 deg": order, amplitude, phase')
    ] = None
    thrust: Annotated[str | None, typer.Option("--thrust", help='find the collective for it, "3300 N"')] = None
    ct: Annotated[float | None, typer.Option("--ct", help="the same as a coefficient")] = None
    torque: Annotated[str | None, typer.Option("--torque", help="find the collective for it; zero: autorotation")] = (
        None
    )
    power: Annotated[str | None, typer.Option("--power", help='find the collective for shaft power, "1000 hp"')] = None
    flapping: Annotated[str | None, typer.Option("--flapping", help='find both cyclics: zero, "1.5 deg, -0.6 deg"')] = (
        None
    )
    hub_roll: Annotated[str | None, typer.Option("--hub-roll", help="find both cyclics for it, right side down +")] = (
        None
    )
    hub_pitch: Annotated[str | None, typer.Option("--hub-pitch", help="find both cyclics for it, nose up +")] = None
    omega: Annotated[str | None, typer.Option("--omega", help='rotor speed, "1250 rpm"')] = None
    altitude: Annotated[str, typer.Option("--altitude", help="standard atmosphere")] = "0 m"
    density: Annotated[str | None, typer.Option("--density", help='"1.19 kg/m3"')] = None
    speed_of_sound: Annotated[str | None, typer.Option("--speed-of-sound", help='"342 m/s"')] = None
    blades: Annotated[str | None, typer.Option("--blades", help="rigid, flexible; the file's own")] = None
    blade_model: Annotated[str, typer.Option("--blade-model", help="lifting-line, second-order, weissinger")] = (
        "lifting-line"
    )
    revolutions: Annotated[int | None, typer.Option("--revolutions", help="revolutions of the marching wake")] = None
    averaged: Annotated[int | None, typer.Option("--averaged", help="of them, the last ones averaged")] = None

    def arguments(self) -> dict[str, Any]:
        """As `wf.tunnel` takes them."""
        pair: Any = self.flapping
        if pair and "," in pair:
            pair = [each.strip() for each in pair.split(",")]
        harmonics = [_harmonic(each) for each in self.higher_harmonics or []]
        return {**vars(self), "flapping": pair, "higher_harmonics": harmonics}


def tunnel(
    aircraft: AircraftName = "uh60a",
    rotor: Annotated[
        str | None, typer.Option("--rotor", metavar="FILE", help="a rotor file, in place of --aircraft")
    ] = None,
    *,
    setting: Setting,
    allow_outside: AllowOutside = False,
    changes: Changes = None,
    inflow: Annotated[
        str,
        typer.Option(
            "--inflow",
            help="time-marching, relaxation, dynamic, annular (hover, axial climb)",
            autocompletion=offered("time-marching", "relaxation", "dynamic", "annular"),
        ),
    ] = "time-marching",
    stand: Stand,
    then: Annotated[
        list[str] | None, typer.Option("--then", help='then move the collective: "0.035 s, 12 deg", time and angle')
    ] = None,
    duration: Annotated[str | None, typer.Option("--duration", help='how long to follow that, "2 s"')] = None,
    wake: Wake,
    drawing: Drawing,
    run: Run,
) -> None:
    """Put an isolated rotor on a stand, print a table, write tunnel.nc and figures."""
    check_drawing(drawing)
    set_threads(run.threads)
    folder = writable(run.out or Path("runs/tunnel"))
    from ..aircraft import load_rotor
    from ..plotting import tunnel as figures
    from ..progress import Progress
    from ..results import save
    from ..tunnel import tunnel as solve

    turned = changed(load_rotor(rotor or aircraft, allow_outside), changes)
    solve = keeping(solve, lambda partial: partial.save(folder_made(folder) / "tunnel.nc"))
    model = inflow_from(inflow, wake, on_stand=True)
    arguments = vars(setting) | stand.arguments()
    if bool(then) != (duration is not None):
        raise InputError.of("--then, --duration", then or duration, "one needs the other")
    moved = [tuple(part.strip() for part in each.split(",")) for each in then or []]
    with Progress() as progress:
        result = solve(turned, inflow=model, progress=progress, **arguments)
        print(result.table())
        result.save(folder_made(folder) / "tunnel.nc")
        written = [folder / "tunnel.nc"]
        if drawing.figures:
            written += figures.write(result.data, folder, drawing.figure_format)
        if duration is not None:
            followed = keeping(result.transient, lambda data: save(data, folder / "transient.nc"))
            data = followed(moved, duration, progress)
            written.append(save(data, folder / "transient.nc"))
            if drawing.figures:
                written.append(figures.write_transient(data, folder, drawing.figure_format))
    print(f"wrote {', '.join([str(written[0]), *(each.name for each in written[1:])])}")


def _harmonic(text: str) -> dict[str, Any]:
    """Order, amplitude and phase of a higher-harmonic pitch from "3, 0.8 deg, 300 deg"."""
    parts = [each.strip() for each in text.split(",")]
    if len(parts) != 3 or not parts[0].isdecimal():
        raise InputError.of(
            "--higher-harmonic", text, 'must be order, amplitude, phase, for example "3, 0.8 deg, 300 deg"'
        )
    return {"order": int(parts[0]), "amplitude": parts[1], "phase": parts[2]}
