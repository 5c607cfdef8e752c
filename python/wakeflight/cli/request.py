# SPDX-License-Identifier: MIT OR Apache-2.0
"""What was asked for, read and checked before anything starts."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InputError
from .wake import typed_options

if TYPE_CHECKING:
    from ..aircraft import Aircraft
    from ..condition import FlightCondition
    from ..control import Augmentation
    from ..inflow import InflowModel
    from ..maneuvers import Maneuver
    from .groups import Run, Straight, Vehicle, Wake


@dataclass(frozen=True)
class Request:
    """What was asked for, checked."""

    aircraft: Aircraft
    condition: FlightCondition
    inflow: InflowModel
    out: Path
    maneuver: Maneuver | None = None
    control: Augmentation | None = None


def request(
    vehicle: Vehicle,
    given: Straight,
    inflow: str,
    wake: Wake,
    run: Run,
    maneuver: str | None = None,
    blades: str | None = None,
    lenient: bool = False,
    control: str | None = None,
) -> Request:
    """Everything that was typed, read and checked; nothing is started.

    lenient: leave out wake options the model does not have instead of refusing them.
    """
    from ..aircraft import load_aircraft
    from ..condition import condition_for
    from ..control import Augmentation, load_control
    from ..maneuvers import load_maneuver
    from ..model import flight_regime

    set_threads(run.threads)
    flown = load_maneuver(maneuver) if maneuver is not None else None
    made = None
    if control is not None:
        made = Augmentation() if control == "none" else load_control(control)
    model = inflow_from(inflow, wake, lenient=lenient)
    if blades not in (None, "rigid", "flexible"):
        raise InputError.of("--blades", blades, "allowed: rigid, flexible")
    loaded = load_aircraft(vehicle.aircraft, vehicle.loading)
    if blades == "rigid":
        loaded = loaded.with_rigid_blades()
    elif blades == "flexible" and not loaded.flexible:
        raise InputError.of("--blades", blades, f"the blades of {loaded.name} are rigid in its file")
    complete = condition_for(loaded, named=vehicle.condition, **given.given())
    loaded.core_data(complete)
    model.resolved(flight_regime(loaded, complete)).check_on(loaded)
    if flown is not None:
        flown = flown.for_aircraft(loaded.stick_travel_in, float(loaded.rotor.omega))
        flown.check_span(loaded.stick_travel_in)
        (flown.control or Augmentation() if made is None else made).check_on(loaded)
    folder = writable(run.out if run.out is not None else Path("runs") / (flown.name if flown is not None else "run"))
    return Request(loaded, complete, model, folder, flown, made)


def inflow_from(name: str, wake: Wake, on_stand: bool = False, lenient: bool = False) -> Any:
    """The inflow model `name` with the options that were typed: the only place where arguments become a model.

    lenient: leave out options that other models have instead of refusing them.
    """
    if on_stand:
        from ..tunnel import stand_inflow

        model = stand_inflow(name)
    else:
        from ..inflow import inflow_model

        model = inflow_model(name)
    return replace(model, **typed_options(model.name, wake, lenient))


def check_flight(revolutions: float | None, integrator: str) -> None:
    """Refuse a length of flight or an integrator that there is not."""
    if revolutions is not None and not 0.0 < revolutions <= 10000.0:
        raise InputError.of("--revolutions", revolutions, "must lie above 0 and at most 10000")
    if integrator not in ("ida", "fixed"):
        raise InputError.of("--integrator", integrator, "allowed: ida, fixed")


def set_threads(threads: int | None) -> None:
    """Pass --threads, or check WAKEFLIGHT_THREADS and WAKEFLIGHT_SIMD, which the physics core reads."""
    from .._core import instruction_set

    if threads is not None:
        if not 1 <= threads <= 1024:
            raise InputError.of("--threads", threads, "must lie between 1 and 1024")
        os.environ["WAKEFLIGHT_THREADS"] = str(threads)
    text = os.environ.get("WAKEFLIGHT_THREADS", "1")
    if not (text.isascii() and text.isdigit() and 1 <= int(text) <= 1024):
        raise InputError.of("WAKEFLIGHT_THREADS", text, "must be a whole number between 1 and 1024")
    try:
        instruction_set()
    except ValueError as error:
        raise InputError(str(error)) from None


def writable(folder: Path) -> Path:
    """Refuse a folder for results that cannot be made."""
    existing = next(each for each in (folder, *folder.absolute().parents) if each.exists())
    if not existing.is_dir() or not os.access(existing, os.W_OK):
        raise InputError.of("--out", str(folder), f"must be a folder that can be written to; {existing} is not")
    return folder
