# SPDX-License-Identifier: MIT OR Apache-2.0
"""What was asked for, read and checked before anything starts."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Self, TypeVar

from ..errors import InputError
from ..text import slug
from ..units import STANDARD_GRAVITY, shown
from .groups import ROTOR_SPEEDS, Drawing
from .wake import typed_options

if TYPE_CHECKING:
    from ..aircraft import Aircraft
    from ..condition import FlightCondition
    from ..control import Augmentation
    from ..inflow import InflowModel
    from ..maneuvers import Maneuver
    from ..perturbation import Perturbation
    from .groups import Run, Straight, Vehicle, Wake


@dataclass(frozen=True)
class Request:
    """What was asked for, checked."""

    aircraft: Aircraft
    condition: FlightCondition
    inflow: InflowModel
    out: Path
    drawing: Drawing
    maneuver: Maneuver | None = None
    typed: Mapping[str, Any] = field(default_factory=dict)
    control: Augmentation | None = None
    perturb: Perturbation = ()

    def told(self) -> str:
        """The condition that is flown: what was given, as typed, then what the aircraft's file gives, in units of pilots."""
        from ..condition import described

        condition: dict[str, Any] = self.condition.as_attributes()
        values = {
            "speed": shown(condition.pop("speed"), "kt"),
            "flight_path": shown(condition.pop("flight_path"), "deg"),
            "altitude": shown(condition.pop("altitude"), "ft"),
            "weight": shown(condition.pop("gross_mass") * STANDARD_GRAVITY, "lbf"),
        }
        values |= {name: " ".join(str(self.typed[name]).split()) for name in values if name in self.typed}
        parts = {
            source: ", ".join(
                f"{name.replace('_', ' ')} {value}" for name, value in values.items() if (name in self.typed) == given
            )
            for source, given in (("", True), ("of its file: ", False))
        }
        rest = described({name: value for name, value in condition.items() if value not in (0.0, "free")})
        return f"{self.aircraft.name}: {'; '.join(s + text for s, text in (*parts.items(), ('', rest)) if text)}"


def request(
    vehicle: Vehicle,
    given: Straight,
    inflow: str,
    wake: Wake,
    run: Run,
    maneuver: str | None = None,
    blades: str | None = None,
    lenient: bool = False,
    drawing: Drawing | None = None,
    control: str | None = None,
) -> Request:
    """Everything that was typed, read and checked; nothing is started.

    lenient: leave out wake options the model does not have instead of refusing them.
    """
    from ..aircraft import load_aircraft
    from ..condition import condition_for
    from ..control import Augmentation, load_control
    from ..maneuver_files import load_maneuver
    from ..model import flight_regime

    drawing = check_drawing(drawing or Drawing())
    set_threads(run.threads)
    flown = load_maneuver(maneuver) if maneuver is not None else None
    made = None
    if control is not None:
        made = Augmentation() if control == "none" else load_control(control)
    model = inflow_from(inflow, wake, lenient=lenient)
    if blades not in (None, "rigid", "flexible"):
        raise InputError.choice("--blades", blades, ("rigid", "flexible"))
    loaded = changed(load_aircraft(vehicle.aircraft, vehicle.loading, vehicle.allow_outside), vehicle.changes)
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
    folder = writable(
        run.out if run.out is not None else Path("runs") / slug(flown.name if flown is not None else "run")
    )
    return Request(loaded, complete, model, folder, drawing, flown, given.given(), made)


class Varied(Protocol):
    """What has a file whose numbers can be replaced."""

    def with_(self, changes: Any) -> Self:
        """With some of them replaced."""


Loaded = TypeVar("Loaded", bound=Varied)


def changed(aircraft: Loaded, typed: Sequence[str] | None) -> Loaded:
    """The aircraft, or the rotor, with what was typed in place of numbers of its file."""
    changes: dict[str, Any] = {}
    for each in typed or ():
        name, found, value = each.partition("=")
        if not found or not name.strip():
            raise InputError.of("--set", each, "must be NAME=VALUE, rotor.omega=26 rad/s")
        changes[name.strip()] = typed_value(value.strip())
    return aircraft.with_(changes) if changes else aircraft


def perturbed(typed: Sequence[str] | None) -> Perturbation:
    """States that a flight begins with beside its trim."""
    from ..perturbation import offsets_of

    found: dict[str, Any] = {}
    for each in typed or ():
        name, stated, value = each.partition("=")
        if not stated or not name.strip():
            raise InputError.of("--perturb", each, 'must be STATE=VALUE, "q=2 deg/s"')
        found[name.strip()] = typed_value(value.strip())
    return offsets_of(found)


def typed_value(text: str) -> Any:
    """A value as TOML writes it: a number, a truth value, a list; anything else is text."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except (ValueError, RecursionError):
        return text


def check_drawing(drawing: Drawing) -> Drawing:
    """Refuse a format of figures that there is not."""
    if drawing.figure_format not in ("png", "svg", "pdf"):
        raise InputError.choice("--figure-format", drawing.figure_format, ("png", "svg", "pdf"))
    if drawing.units not in ("si", "us"):
        raise InputError.choice("--units", drawing.units, ("si", "us"))
    return drawing


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


def check_flight(revolutions: float | None, integrator: str, rotor_speed: str = "constant") -> None:
    """Refuse a length of flight, an integrator or a way to turn the rotor that there is not."""
    from ..sticks import LONGEST_FLIGHT

    if revolutions is not None and not 0.0 < revolutions <= LONGEST_FLIGHT:
        raise InputError.of("--revolutions", revolutions, f"must lie above 0 and at most {LONGEST_FLIGHT}")
    if integrator not in ("ida", "fixed"):
        raise InputError.choice("--integrator", integrator, ("ida", "fixed"))
    if rotor_speed not in ROTOR_SPEEDS:
        raise InputError.choice("--rotor-speed", rotor_speed, ROTOR_SPEEDS)


def wind_named(text: str | None) -> Any:
    """The wind that was typed; none where nothing was."""
    if text is None:
        return None
    from ..wind import wind_from_text

    return wind_from_text(text)


def seconds_between(checkpoint: str) -> float:
    """Seconds of wall clock between checkpoints."""
    from ..units import quantity

    seconds = quantity(checkpoint, "s", "--checkpoint")
    if not 0.0 <= seconds <= 86400.0:
        raise InputError.of("--checkpoint", checkpoint, "must lie between 0 s and a day")
    return seconds


def set_threads(threads: int | None) -> None:
    """Pass --threads, or check WAKEFLIGHT_THREADS and WAKEFLIGHT_SIMD, which the physics core reads."""
    from .._core import instruction_set
    from .._core import threads as used

    if threads is not None:
        if not 1 <= threads <= 1024:
            raise InputError.of("--threads", threads, "must lie between 1 and 1024")
        os.environ["WAKEFLIGHT_THREADS"] = str(threads)
    try:
        used()
        instruction_set()
    except ValueError as error:
        raise InputError(str(error)) from None


def _is_there(path: Path) -> bool:
    """Whether there is a file or folder; OSError where that cannot be known, which `Path.exists` tells or hides by version."""
    try:
        path.stat()
    except (FileNotFoundError, NotADirectoryError):
        return False
    return True


def writable(folder: Path) -> Path:
    """Refuse a folder for results that cannot be made."""
    try:
        existing = next(each for each in (folder, *folder.absolute().parents) if _is_there(each))
    except OSError as reason:
        # a name that no file can have, a folder that must not be looked into
        raise InputError.of(
            "--out", str(folder), f"must be a folder that can be written to: {reason.strerror}"
        ) from None
    if not existing.is_dir() or not os.access(existing, os.W_OK):
        raise InputError.of("--out", str(folder), f"must be a folder that can be written to; {existing} is not")
    return folder
