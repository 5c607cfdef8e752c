# SPDX-License-Identifier: MIT OR Apache-2.0
"""`wakeflight converge`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import typer

from ..errors import InputError, NumericalFailure
from .groups import Condition, Group, InflowName, Integrator, Revolutions, Run, Vehicle, Wake
from .outcome import folder_made
from .request import check_flight, inflow_from, request, set_threads, writable


@dataclass(frozen=True)
class Stand(Group):
    """The run tunnel: how the stand is set, as for tunnel."""

    collective: Annotated[str | None, typer.Option("--collective", help="tunnel: as for tunnel")] = None
    shaft_angle: Annotated[str | None, typer.Option("--shaft-angle", help="tunnel: as for tunnel")] = None
    climb: Annotated[str | None, typer.Option("--climb", help="tunnel: as for tunnel")] = None
    thrust: Annotated[str | None, typer.Option("--thrust", help="tunnel: as for tunnel")] = None


def converge(
    repeated: Annotated[str, typer.Argument(metavar="RUN", help="trim, modes, tunnel, or a manoeuvre as for fly")],
    *,
    vary: Annotated[
        str, typer.Option("--vary", metavar="NAME", help="azimuth-step, wake-turns, modes, tolerance, ...")
    ],
    values: Annotated[str, typer.Option("--values", metavar="LIST", help='"15 deg, 10 deg, 5 deg", "5, 8, 10"')],
    inflow: InflowName = "time-marching",
    vehicle: Vehicle,
    given: Condition,
    rotor: Annotated[str | None, typer.Option("--rotor", metavar="FILE", help="tunnel: a rotor file")] = None,
    stand: Stand,
    revolutions: Revolutions = None,
    wake: Wake,
    integrator: Integrator = "ida",
    run: Run,
) -> None:
    """Repeat a run at several settings of one discretisation; print error estimate and cost of each."""
    check_flight(revolutions, integrator)
    folder = run.out or Path("runs/converge")
    from ..plotting import convergence, style
    from ..progress import Progress
    from ..studies.converge import converge as study_of

    flown: Any
    base: dict[str, Any]
    if repeated == "tunnel":
        set_threads(run.threads)
        told = f"rotor on the stand: {rotor or vehicle.aircraft}"
        flown, base = _on_stand(rotor or vehicle.aircraft, vehicle.allow_outside, given, stand, inflow, wake)
        writable(folder)
    else:
        foreign = ", ".join(stand.given()) or ("rotor" if rotor else "")
        if foreign:
            raise InputError.of("run", repeated, f"{foreign} belongs to the run tunnel")
        asked = request(vehicle, given, inflow, wake, replace(run, out=folder))
        told = asked.told()
        flown, base = asked.aircraft, {"condition": asked.condition, "inflow": asked.inflow}
    with Progress() as progress:
        study = study_of(
            flown,
            repeated,
            vary=vary,
            values=values,
            revolutions=revolutions,
            integrator=integrator,
            progress=progress,
            **base,
        )
    print(f"{told}\n{study.table()}")
    study.save(folder_made(folder))
    style.save(convergence.figure(study.data), folder / "converge.png")
    print(f"wrote converge.nc, .csv, .md and .png in {folder}")
    if study.failures:
        raise NumericalFailure("; ".join(study.failures))


def _on_stand(
    rotor: str, allow_outside: bool, given: Condition, stand: Stand, inflow: str, wake: Wake
) -> tuple[Any, dict[str, Any]]:
    """The rotor, and what its runs on the stand start from."""
    from ..aircraft import load_rotor

    flight = given.given()
    known = {name: flight.pop(name) for name in ("speed", "altitude") if name in flight}
    if flight:
        raise InputError.of(next(iter(flight)), next(iter(flight.values())), "not an option of a rotor on a stand")
    model = inflow_from(inflow, wake, on_stand=True)
    return load_rotor(rotor, allow_outside), {"inflow": model, "stand": stand.given() | known}
