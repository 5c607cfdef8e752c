# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight fly`."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

import typer

from . import outcome
from .groups import (
    Blades,
    Checkpoint,
    Condition,
    Control,
    Drawing,
    InflowName,
    Integrator,
    ManeuverName,
    Revolutions,
    RotorSpeedName,
    Run,
    Vehicle,
    Wake,
    WindName,
)
from .request import check_flight, perturbed, request, seconds_between, wind_named


def fly(
    maneuver: ManeuverName,
    *,
    inflow: InflowName = "time-marching",
    vehicle: Vehicle,
    given: Condition,
    revolutions: Revolutions = None,
    wake: Wake,
    integrator: Integrator = "ida",
    rotor_speed: RotorSpeedName = "constant",
    wind: WindName = None,
    blades: Blades = None,
    control: Control = None,
    perturb: Annotated[
        list[str] | None,
        typer.Option("--perturb", metavar="STATE=VALUE", help='begin beside the trim, "q=2 deg/s"; repeatable'),
    ] = None,
    checkpoint: Checkpoint = "1 s",
    drawing: Drawing,
    run: Run,
) -> None:
    """Trim, fly a manoeuvre, write run.nc, figures and report.html; what is flown is kept as it is flown."""
    check_flight(revolutions, integrator, rotor_speed)
    blown = wind_named(wind)
    every = seconds_between(checkpoint)
    asked = request(vehicle, given, inflow, wake, run, maneuver, blades, drawing=drawing, control=control)
    asked = replace(asked, perturb=perturbed(perturb))
    print(asked.told(), flush=True)
    from ..progress import Progress

    with Progress() as progress:
        outcome.fly_once(asked, revolutions, integrator, asked.out, progress, every, rotor_speed, blown)
