# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight cockpit`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from ..errors import InputError
from .groups import Blades, Condition, Run, Vehicle, Wake, offered
from .request import inflow_from, request

MODELS = ("time-marching", "dynamic")
"""Inflow models that can be flown live."""


def cockpit(
    *,
    inflow: Annotated[
        str,
        typer.Option("--inflow", help="to begin with: time-marching, dynamic", autocompletion=offered(*MODELS)),
    ] = "time-marching",
    vehicle: Vehicle,
    given: Condition,
    wake: Wake,
    control: Annotated[
        str | None,
        typer.Option(
            "--control",
            metavar="FILE",
            help="controllers and servos, a TOML file, or none",
            show_default="steadying ones",
        ),
    ] = None,
    blades: Blades = None,
    port: Annotated[int, typer.Option("--port", help="of the page on this machine; 0: any that is free")] = 8137,
    ground: Annotated[str, typer.Option("--ground", help="depth of the drawn ground below the start")] = "500 ft",
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="open the page")] = True,
    run: Run,
) -> None:
    """Fly by hand in a browser on this machine, free wake in sight; every flight is kept as a run, by default below runs/cockpit.

    The wake is that of the preset paper unless another is asked for.
    """
    if inflow not in MODELS:
        raise InputError.choice("--inflow", inflow, MODELS)
    if not 0 <= port <= 65535:
        raise InputError.of("--port", port, "must lie between 0 and 65535")
    from ..cockpit import Setup, height_of
    from ..cockpit import cockpit as flown
    from ..cockpit.steady import steady
    from ..progress import Progress
    from ..units import quantity

    height = height_of(quantity(ground, "m", "--ground"))
    typed = wake.wake or []
    if all("=" in each for each in typed):
        wake = replace(wake, wake=["paper", *typed])
    run = replace(run, out=Path("runs") / "cockpit" if run.out is None else run.out)
    # what is typed of a wake is for the free wake; the other model takes what it has
    asked = request(vehicle, given, inflow, wake, run, blades=blades, lenient=inflow == "dynamic", control=control)
    models = {
        inflow: asked.inflow,
        **{name: inflow_from(name, wake, lenient=True) for name in MODELS if name != inflow},
    }
    made = steady() if control is None else asked.control
    print(asked.told(), flush=True)
    with Progress(bars=False) as progress:
        flown(Setup(asked.aircraft, asked.condition, models, asked.out, made, height), port, browser, progress)
