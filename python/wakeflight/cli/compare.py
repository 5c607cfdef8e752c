# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight compare`."""

from __future__ import annotations

from typing import Any

from ..errors import NumericalFailure
from . import outcome
from .groups import Control, Drawing, Integrator, ManeuverName, Revolutions, Run, Straight, Vehicle, Wake
from .request import check_flight, request


def compare(
    maneuver: ManeuverName,
    *,
    vehicle: Vehicle,
    given: Straight,
    revolutions: Revolutions = None,
    wake: Wake,
    integrator: Integrator = "ida",
    control: Control = None,
    drawing: Drawing,
    run: Run,
) -> None:
    """Fly the same manoeuvre with all three inflow models and state the cost of each."""
    from ..inflow import MODELS
    from ..progress import Progress

    check_flight(revolutions, integrator)
    requests = [
        request(vehicle, given, name, wake, run, maneuver, lenient=True, drawing=drawing, control=control)
        for name in MODELS
    ]
    print(requests[0].told(), flush=True)
    runs: dict[str, Any] = {}
    failures, lines = [], [f"{'inflow':<15}{'trim s':>9}{'flight s':>10}{'total s':>9}"]
    with Progress() as progress:
        for asked in requests:
            name = asked.inflow.name
            try:
                flight = outcome.fly_once(asked, revolutions, integrator, asked.out / name, progress)
            except NumericalFailure as failure:
                failures.append(f"{name}: {failure}")
                continue
            runs[name] = flight.data
            attributes = flight.data.attrs
            in_flight = attributes.get("seconds_wake", 0.0) + attributes.get("seconds_dynamics", 0.0)
            lines.append(
                f"{name:<15}{attributes.get('seconds_trim', 0.0):>9.1f}{in_flight:>10.1f}"
                f"{attributes.get('seconds_total', 0.0):>9.1f}"
            )
    print("\n".join(lines))
    if len(runs) > 1 and drawing.figures:
        from .. import report as reports

        form, units = drawing.figure_format, drawing.units
        folder = outcome.folder_made(requests[0].out)
        page = reports.write(runs, folder, figure_format=form, units=units)
        print(f"wrote {page}, the models side by side")
    if failures:
        raise NumericalFailure("; ".join(failures))
