# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight trim`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import typer

from . import outcome
from .groups import Blades, Condition, Group, InflowName, Run, Vehicle, Wake
from .request import request


@dataclass(frozen=True)
class Target(Group):
    """What is met with a part of the path left free, as `wf.trim` takes it."""

    power: Annotated[str | None, typer.Option("--power", help='of the engines; "0 hp" is autorotation')] = None
    collective: Annotated[str | None, typer.Option("--collective", help='blade pitch at the root, "14 deg"')] = None
    free: Annotated[str | None, typer.Option("--free", help="what is found for them: flight_path, speed")] = None


def trim(
    *,
    inflow: InflowName = "time-marching",
    vehicle: Vehicle,
    given: Condition,
    target: Target,
    wake: Wake,
    blades: Blades = None,
    run: Run,
) -> None:
    """Trim the aircraft, print a table, write trim.nc."""
    run = replace(run, out=run.out or Path("runs/trim"))
    asked = request(vehicle, given, inflow, wake, run, blades=blades)
    print(asked.told(), flush=True)
    from ..progress import Progress
    from ..trim import trim as solve

    solve = outcome.keeping(solve, lambda found: outcome.save_trim(found, asked.out))
    with Progress() as progress:
        start = solve(asked.aircraft, asked.condition, inflow=asked.inflow, progress=progress, **target.given())
    print(start.table())
    outcome.save_trim(start, asked.out)
