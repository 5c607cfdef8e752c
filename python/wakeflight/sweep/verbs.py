# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a sweep can run: the verbs of the package with all their arguments by name, and any function of a case.

A case of a verb names arguments of the verb itself, of `FlightCondition`, and beside them `aircraft` (name, path or loaded),
`loading`, `blades` (rigid, flexible), `condition` (a named one of the file), `inflow` with `preset` and `inflow.NAME` for an
option of the model, and `aircraft.NAME` for a number of the aircraft's file.
"""

from __future__ import annotations

import hashlib
import inspect
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import lru_cache
from pathlib import Path
from typing import Any

from ..aircraft import Aircraft, Rotor, load_aircraft, load_rotor
from ..aircraft.bundle import Bundle
from ..condition import CompleteCondition, FlightCondition, condition_for, target
from ..control import augmentation
from ..errors import InputError
from ..flight import fly
from ..handling import handling_qualities
from ..inflow import MODELS, STAND_MODELS, inflow_model, trim_model
from ..linear import check_method, linearize
from ..linear.instants import check_inputs
from ..linear.over_ground import check_speed
from ..linear.wake import check_wake
from ..maneuver_files import load_maneuver
from ..model import flight_regime
from ..perturbation import offsets_of
from ..results.schema import COORDINATES, RUN, TRIM, TUNNEL, Variable
from ..rotor_speed import CONSTANT
from ..trim import trim
from ..tunnel import check as check_stand
from ..tunnel import tunnel
from .outcome import Kept
from .verb import Case, Verb, kept_of, plain

OF_CONDITION = tuple(name for name in inspect.signature(FlightCondition.__init__).parameters if name != "self")
OF_AIRCRAFT = ("aircraft", "loading", "blades", "condition")
OF_INFLOW = ("inflow", "preset")


def built_in(given: Any) -> Verb | None:
    """The verb of that name or function, None where there is none."""
    return next((made for name, (function, made) in VERBS.items() if given == name or given is function), None)


def own_arguments(function: Callable[..., Any], *others: str) -> tuple[str, ...]:
    """Names of the arguments of a verb but those that a case gives otherwise."""
    return tuple(name for name in inspect.signature(function).parameters if name not in ("progress", "out", *others))


@lru_cache(maxsize=8)
def _loaded(name: str, loading: str | None) -> Aircraft:
    return load_aircraft(name, loading)


def _dotted(case: Case, group: str) -> dict[str, Any]:
    """Arguments `group.NAME` of a case, by NAME."""
    return {name.removeprefix(f"{group}."): value for name, value in case.items() if name.startswith(f"{group}.")}


def aircraft_of(case: Case) -> Aircraft:
    """The aircraft of a case."""
    given, loading = case.get("aircraft", "uh60a"), case.get("loading")
    if isinstance(given, str | Path):
        loaded = _loaded(str(given), loading)
    elif not {"with_", "core_data"} <= set(dir(given)):
        raise InputError.of("aircraft", given, "must be a name, a path, or an Aircraft (wf.load_aircraft)")
    elif loading is not None:
        raise InputError.of("loading", loading, "belongs to an aircraft that is given by its name or path")
    else:
        loaded = given
    changes = _dotted(case, "aircraft")
    loaded = loaded.with_(changes) if changes else loaded
    return _bladed(loaded, case.get("blades"))


def _bladed(loaded: Aircraft, blades: Any) -> Aircraft:
    if blades not in (None, "rigid", "flexible"):
        raise InputError.choice("blades", blades, ("rigid", "flexible"))
    if blades == "flexible" and not loaded.flexible:
        raise InputError.of("blades", blades, f"the blades of {loaded.name} are rigid in its file")
    return loaded.with_rigid_blades() if blades == "rigid" else loaded


def inflow_of(case: Case, default: str, known: Mapping[str, Any] = MODELS) -> Any:
    """The inflow model of a case."""
    given, options = case.get("inflow", default), _dotted(case, "inflow")
    if isinstance(given, str):
        model = inflow_model(given, known)
        return known[model.name].preset(case["preset"], **options) if "preset" in case else replace(model, **options)
    if "preset" in case:
        raise InputError.of("preset", case["preset"], "belongs to an inflow model that is given by its name")
    return replace(inflow_model(given, known), **options)


def _check_types(function: Any, given: Mapping[str, Any]) -> None:
    """Refuse arguments that do not fit the annotations of a verb."""
    kinds = function.__checked__()
    for name, value in given.items():
        if name in kinds and not kinds[name].fits(value):
            raise InputError.of(name, value, f"must be {kinds[name].words}")


@dataclass(frozen=True)
class OfFlight:
    """A verb that begins with a trim of an aircraft: what else it takes, what it checks, what it does then."""

    name: str
    own: tuple[str, ...]
    inflow: str
    """Inflow model where a case has none."""
    checks: Callable[[Mapping[str, Any], Any, Any, Any], None]
    then: Callable[[Any, Mapping[str, Any], Any], Any]
    dims: tuple[str, ...] | None = None
    """Dimensions of variables that are kept unless something else is asked for; None: any."""
    table: tuple[Variable, ...] = ()
    """What its results may hold, where that is known before."""

    @property
    def sent(self) -> str:
        """Its name."""
        return self.name

    @property
    def arguments(self) -> tuple[str, ...]:
        """All names that a case may have."""
        return tuple(dict.fromkeys((*OF_AIRCRAFT, *OF_CONDITION, *OF_INFLOW, *OF_TRIM, *self.own)))

    def _prepared(self, case: Case) -> tuple[Aircraft, CompleteCondition, Any, dict[str, Any]]:
        check_names(case, self.arguments)
        aircraft = aircraft_of(case)
        named = case.get("condition")
        given = {name: case[name] for name in OF_CONDITION if name in case}
        if named is None or isinstance(named, str):
            condition = condition_for(aircraft, named=named, **given)
        else:
            condition = condition_for(aircraft, named, **given)
        own = {name: case[name] for name in (*OF_TRIM, *self.own) if name in case}
        beside = _dotted(case, "perturb")
        if beside:
            own["perturb"] = {**own.get("perturb", {}), **beside}
        return aircraft, condition, inflow_of(case, self.inflow), own

    def check(self, case: Case) -> None:
        """Refuse a case that the verb would refuse."""
        aircraft, condition, inflow, given = self._prepared(case)
        aircraft.core_data(condition)
        inflow.resolved(flight_regime(aircraft, condition)).check_on(aircraft)
        of_trim = {name: given[name] for name in OF_TRIM if name in given}
        _check_types(trim, of_trim)
        target(condition, **{name: of_trim[name] for name in ("power", "collective", "free") if name in of_trim})
        self.checks({name: given[name] for name in self.own if name in given}, aircraft, condition, inflow)

    def run(self, case: Case) -> Any:
        """Trim, and what comes then."""
        aircraft, condition, inflow, given = self._prepared(case)
        of_trim = {name: given.pop(name) for name in OF_TRIM if name in given}
        start = trim(aircraft, condition, trim_model(inflow) if "maneuver" in self.own else inflow, **of_trim)
        return self.then(start, given, inflow)

    def told(self, case: Case) -> dict[str, Any]:
        """The case, and the files of its aircraft."""
        files = json.dumps(Bundle.of(aircraft_of(case)).as_dict(), sort_keys=True, default=str)
        return {"case": plain(dict(case)), "aircraft": hashlib.sha256(files.encode()).hexdigest()}

    def kept(self, keep: Any) -> Kept:
        """Numbers and histories; maps of the disk, blades and wakes where they are asked for."""
        return kept_of(keep, self.dims, names_of(self.table))


def names_of(table: tuple[Variable, ...]) -> tuple[str, ...]:
    """Names of the variables of a table, and of the coordinates they may have; none of none."""
    return (*(variable.name for variable in table), *COORDINATES) if table else ()


def check_names(case: Case, allowed: tuple[str, ...]) -> None:
    """Refuse names that a verb does not take."""
    for name, value in case.items():
        dotted = name.partition(".")[0] in ("aircraft", "inflow", "perturb") and name.partition(".")[0] in (
            *allowed,
            "aircraft",
        )
        if name not in allowed and not ("." in name and dotted):
            near = get_close_matches(name, allowed, n=1)
            meant = f"did you mean {near[0]}? " if near else ""
            raise InputError.of(name, value, f"{meant}allowed: {', '.join(allowed)}, aircraft.NAME, inflow.NAME")


def _check_nothing(given: Mapping[str, Any], aircraft: Any, condition: Any, inflow: Any) -> None:
    """A trim has no more arguments."""


def _check_flight(given: Mapping[str, Any], aircraft: Any, condition: Any, inflow: Any) -> None:
    if "maneuver" not in given:
        raise InputError.of("maneuver", "missing", "must be given: a name, a path, or a wf.Maneuver")
    maneuver = _maneuver(given).for_aircraft(aircraft.stick_travel_in, float(aircraft.rotor.omega))
    maneuver.check_span(aircraft.stick_travel_in)
    _check_types(fly, {name: value for name, value in given.items() if name != "maneuver"})
    offsets_of(given.get("perturb"))
    made = augmentation(maneuver.control if given.get("control") is None else given["control"], given.get("actuators"))
    made.check_on(aircraft)


def _maneuver(given: Mapping[str, Any]) -> Any:
    maneuver = given["maneuver"]
    return load_maneuver(maneuver) if isinstance(maneuver, str | Path) else maneuver


def _fly(start: Any, given: Mapping[str, Any], inflow: Any) -> Any:
    own = {name: value for name, value in given.items() if name != "maneuver"}
    return fly(start, _maneuver(given), inflow, **own).data


def _check_linear(given: Mapping[str, Any], aircraft: Any, condition: Any, inflow: Any) -> None:
    _check_types(linearize, given)
    check_speed(given.get("rotor_speed", CONSTANT), check_wake(given.get("wake"), inflow))
    if "method" in given:
        check_method(given["method"])
    if "inputs" in given:
        inputs = given["inputs"]
        check_inputs((inputs,) if isinstance(inputs, str) else tuple(inputs), condition.turn_rate != 0.0)


def _linear(start: Any, given: Mapping[str, Any], inflow: Any) -> Any:
    return linearize(start, **given).to_dataset()


def _handling(start: Any, given: Mapping[str, Any], inflow: Any) -> Any:
    return handling_qualities(linearize(start, **given)).data


def _trimmed(start: Any, given: Mapping[str, Any], inflow: Any) -> Any:
    return start.to_dataset()


@dataclass(frozen=True)
class OnStand:
    """An isolated rotor on a stand."""

    name: str = "tunnel"

    @property
    def sent(self) -> str:
        """Its name."""
        return self.name

    def _prepared(self, case: Case) -> tuple[Rotor, Any, dict[str, Any]]:
        check_names(case, (*OF_INFLOW, "aircraft", *ON_STAND))
        given = case.get("aircraft", "uh60a")
        changes = _dotted(case, "aircraft")
        rotor = load_rotor(
            aircraft_of({"aircraft": given, **{f"aircraft.{n}": v for n, v in changes.items()}}) if changes else given
        )
        model = inflow_of(case, "time-marching", STAND_MODELS)
        return rotor, model, {name: case[name] for name in ON_STAND if name in case}

    def check(self, case: Case) -> None:
        """Refuse a case that the stand would refuse."""
        rotor, model, given = self._prepared(case)
        _check_types(tunnel, given)
        check_stand(rotor, model, **given)

    def run(self, case: Case) -> Any:
        """The rotor on the stand."""
        rotor, model, given = self._prepared(case)
        return tunnel(rotor, inflow=model, **given).data

    def told(self, case: Case) -> dict[str, Any]:
        """The case, and the numbers of its rotor."""
        return {"case": plain(dict(case)), "rotor": plain(self._prepared(case)[0].data)}

    def kept(self, keep: Any) -> Kept:
        """Means; maps and histories where they are asked for."""
        return kept_of(keep, ("xyz",), names_of(TUNNEL))


OF_TRIM = own_arguments(trim, "aircraft", "condition", "inflow")
ON_STAND = own_arguments(tunnel, "aircraft", "inflow")
LINEAR = own_arguments(linearize, "start", "blades")
"""`blades` of a case are those of the aircraft; tables are of multiblade coordinates."""
VERBS: dict[str, tuple[Callable[..., Any], Verb]] = {
    "trim": (trim, OfFlight("trim", (), "relaxation", _check_nothing, _trimmed, ("xyz",), TRIM)),
    "fly": (
        fly,
        OfFlight(
            "fly", own_arguments(fly, "start", "inflow"), "time-marching", _check_flight, _fly, ("time", "xyz"), RUN
        ),
    ),
    "linearize": (linearize, OfFlight("linearize", LINEAR, "dynamic", _check_linear, _linear)),
    "handling_qualities": (
        handling_qualities,
        OfFlight("handling_qualities", LINEAR, "dynamic", _check_linear, _handling),
    ),
    "tunnel": (tunnel, OnStand()),
}
"""Verbs by name: the function, and what a sweep does with it."""
