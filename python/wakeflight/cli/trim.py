# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight trim`."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from . import outcome
from .groups import Blades, Condition, InflowName, Run, Vehicle, Wake
from .request import request


def trim(
    *,
    inflow: InflowName = "time-marching",
    vehicle: Vehicle,
    given: Condition,
    wake: Wake,
    blades: Blades = None,
    run: Run,
) -> None:
    """Trim the aircraft, print a table, write trim.nc."""
    run = replace(run, out=run.out or Path("runs/trim"))
    asked = request(vehicle, given, inflow, wake, run, blades=blades)
    from ..progress import Progress
    from ..trim import trim as solve

    solve = outcome.keeping(solve, lambda found: outcome.save_trim(found, asked.out))
    with Progress() as progress:
        start = solve(asked.aircraft, asked.condition, inflow=asked.inflow, progress=progress)
    print(start.table())
    outcome.save_trim(start, asked.out)
