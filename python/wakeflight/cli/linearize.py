# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight linearize`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError
from .groups import Blades, Condition, Run, Vehicle, Wake
from .outcome import folder_made
from .request import request


def linearize(
    *,
    inflow: Annotated[str, typer.Option("--inflow", help="dynamic, relaxation, time-marching")] = "dynamic",
    order: Annotated[str, typer.Option("--order", help="states kept: 6, 8, 9, 10, any number, full")] = "full",
    inputs: Annotated[
        str, typer.Option("--inputs", help="by commas: sticks, stabilator, wind_north, wind_east, wind_down")
    ] = "lateral,longitudinal,collective,pedal",
    linear_wake: Annotated[
        str | None,
        typer.Option("--linear-wake", help="dynamic; of a free wake states, identified, quasi-static, frozen"),
    ] = None,
    method: Annotated[
        str, typer.Option("--method", help="harmonic-decomposition, averaging")
    ] = "harmonic-decomposition",
    rotor_speed: Annotated[
        str, typer.Option("--rotor-speed", help="constant about the airframe, constant-over-ground")
    ] = "constant",
    no_figures: Annotated[bool, typer.Option("--no-figures", help="write numbers alone")] = False,
    vehicle: Vehicle,
    given: Condition,
    wake: Wake,
    blades: Blades = None,
    run: Run,
) -> None:
    """Linear model about a trim: print modes, derivatives and handling qualities, write linear.nc and figures."""
    run = replace(run, out=run.out or Path("runs/linearize"))
    asked = request(vehicle, given, inflow, wake, run, blades=blades)
    if order != "full" and not order.isdecimal():
        raise InputError.of("--order", order, "must be a number of states, or full")
    names = tuple(name.strip() for name in inputs.split(",") if name.strip())
    from ..handling import handling_qualities, limits
    from ..linear import check_method
    from ..linear import linearize as solve
    from ..linear.instants import STICKS, check_inputs
    from ..linear.over_ground import check_speed
    from ..linear.wake import check_wake
    from ..plotting import handling as of_handling
    from ..plotting import linear as drawing
    from ..plotting import style
    from ..progress import Progress
    from ..results import save
    from ..trim import trim

    check_method(method)
    check_inputs(names, turning=False)
    check_speed(rotor_speed, check_wake(linear_wake, asked.inflow))
    with Progress() as progress:
        start = trim(asked.aircraft, asked.condition, inflow=asked.inflow, progress=progress)
    kept = "full" if order == "full" else int(order)
    model = solve(start, names, linear_wake, order=kept, method=method, rotor_speed=rotor_speed)
    print(f"{start.aircraft.name}, {model!r}")
    print(model.modes_table())
    print()
    print("derivatives of eight states, 1/s, m, rad, in" if len(model.states) > 10 else "derivatives, 1/s, m, rad, in")
    print(model.derivatives_table())
    folder = folder_made(asked.out)
    save(model.to_dataset(), folder / "linear.nc")
    written = ["linear.nc"]
    if not no_figures:
        style.save(drawing.modes(model.modes()), folder / "modes.png")
        written.append("modes.png")
    if set(STICKS) <= set(names):
        found = handling_qualities(model)
        print()
        print(found.table())
        if not no_figures:
            style.save(of_handling.bandwidth({start.aircraft.name: found.data}, limits()), folder / "bandwidth.png")
            style.save(of_handling.attitudes(found.responses, found.data), folder / "attitudes.png")
            written += ["bandwidth.png", "attitudes.png"]
    print(f"wrote {', '.join(str(folder / name) for name in written)}")
