# SPDX-License-Identifier: MIT OR Apache-2.0
"""The inflow models of a rotor, as immutable settings: which one, and its options.

The options are those that the physics core declares (`wakeflight.options`); the classes here get their keyword arguments,
defaults, checks and help from them. Defaults are those found to hold the momentum balance and to settle in the baseline.
"""

from __future__ import annotations

import inspect
import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar, Protocol, Self, TypeVar

from . import _core
from .arguments import checked, with_checked_init
from .errors import InputError
from .options import options_of, resolved
from .presets import preset

Kind = TypeVar("Kind", bound="type[Inflow]")


class Flown(Protocol):
    """What an inflow model asks of an aircraft, or of a rotor alone."""

    @property
    def discretisation(self) -> Any:
        """Azimuth step, elements, modes."""

    @property
    def rotor(self) -> Any:
        """Numbers of the rotor: blades, radius, speed, root."""

    @property
    def chord(self) -> float:
        """Reference chord of the blades [m]."""


def check_azimuth_step(step: float, n_blades: int | None = None, field: str = "azimuth_step") -> None:
    """Refuse an azimuth step [rad] that does not divide the angle between blades (a turn, if unknown)."""
    degrees = math.degrees(step)
    between = 360.0 / (n_blades or 1)
    allowed = f"must divide {between:g} deg" + (f" ({n_blades} blades)" if n_blades else "")
    if not math.radians(0.1) <= step <= math.radians(45.0):
        raise InputError.of(field, f"{degrees:.6g} deg", allowed + ", from 0.1 to 45 deg")
    if abs(between / degrees - round(between / degrees)) > 1e-9 * between / degrees:
        finer = math.floor(between / degrees) + 1
        near = " or ".join(f"{between / parts:.12g} deg" for parts in (finer, finer - 1) if 45.0 * parts >= between)
        raise InputError.of(field, f"{degrees:.12g} deg", f"{allowed}: nearest are {near}")


class Inflow:
    """What every inflow model has and answers: its options, a step of azimuth, and what kind it is."""

    name: ClassVar[str]
    """Name that `inflow=` and the command line take."""
    references: ClassVar[tuple[str, ...]]
    """Keys of references.bib."""
    is_dynamic: ClassVar[bool] = False
    """Whether the inflow has states of its own: no map of it is held."""
    is_annular: ClassVar[bool] = False
    """Whether every ring of the disk has its own momentum; on the stand alone."""
    is_free_wake: ClassVar[bool] = False
    """Whether there is a free wake."""
    is_relaxed: ClassVar[bool] = False
    """Whether the wake is made periodic by relaxation."""
    is_marching: ClassVar[bool] = False
    """Whether the wake marches in time with the flight."""

    azimuth_step: Any
    n_stations: int
    unsteady: str

    @property
    def free_wake(self) -> FreeWake:
        """This model as that of a free wake, which it is."""
        raise InputError.of("inflow", self.name, "has no free wake")

    @property
    def relaxed(self) -> RelaxationWake:
        """This model as that of a relaxation wake, which it is."""
        raise InputError.of("inflow", self.name, "is no relaxation wake")

    @property
    def marching(self) -> TimeMarchingWake:
        """This model as that of a time-marching wake, which it is."""
        raise InputError.of("inflow", self.name, "is no time-marching wake")

    @property
    def annular(self) -> AnnularInflow:
        """This model as that of rings, which it is."""
        raise InputError.of("inflow", self.name, "has no rings")

    @property
    def sections(self) -> dict[str, Any]:
        """What it says of the sections of the blades."""
        return {name: getattr(self, name) for name in ("unsteady", "yawed_drag") if name in options_of(self.name)}

    @property
    def remembers(self) -> bool:
        """Whether blade sections have states of their own."""
        return self.sections.get("unsteady", "quasi-steady") != "quasi-steady"

    @property
    def is_full_span(self) -> bool:
        """Whether trailers all over the span are free."""
        return False

    @property
    def washes_airframe(self) -> bool:
        """Whether the parts of the airframe feel the wake itself."""
        return False

    @property
    def is_second_order(self) -> bool:
        """Whether sections meet the air behind their bound line."""
        return False

    def check_first_order(self, verb: str) -> None:
        """Refuse sections that meet the air behind their bound line where `verb` knows none."""
        if self.is_second_order:
            raise InputError.of("blade_model", "second-order", f"must be lifting-line for {verb}")

    def __post_init__(self) -> None:
        """Check every option and that they go together; angles become radians."""
        for option in options_of(self.name).values():
            object.__setattr__(self, option.name, option.checked(getattr(self, option.name)))
        own = {field.name: getattr(self, field.name) for field in fields(self)}
        _checked(_grouped(self.name, {**own, **resolved(own, "forward")}))

    def __repr__(self) -> str:
        """The options that differ from their defaults, as they are typed."""
        given = [
            f"{option.name}={option.shown(value)!r}"
            for option in options_of(self.name).values()
            if (value := getattr(self, option.name)) != option.default
        ]
        return f"{type(self).__name__}({', '.join(given)})"

    @classmethod
    @checked
    def preset(cls, name: str = "standard", **given: Any) -> Self:
        """The model with the options of a preset (`standard`, `paper`, `reference`), single ones replaced by those given."""
        return cls(**{**preset(cls.name, name), **given})

    def step(self, aircraft: Flown) -> float:
        """Azimuth step on this aircraft or rotor [rad]; it must divide 360 deg over the number of blades."""
        step = aircraft.discretisation.azimuth_step if self.azimuth_step is None else self.azimuth_step
        check_azimuth_step(step, int(aircraft.rotor.n_blades))
        return step

    def resolved(self, regime: str) -> Self:
        """This model with the number of `regime` for every option left to it; what was given stays."""
        found = resolved({field.name: getattr(self, field.name) for field in fields(self)}, regime)
        return replace(self, **found) if found else self

    def above_ground(self) -> Self:
        """This model near the ground."""
        return self

    def on_stand(self) -> Self:
        """This model on a stand."""
        return self

    def as_attributes(self) -> dict[str, Any]:
        """Options by name, angles [rad], for the attributes of a result."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def check_on(self, aircraft: Flown) -> None:
        """Refuse options that do not go with this aircraft or rotor; what depends on the regime must be known."""
        self.step(aircraft)

    def trim_model(self) -> Inflow:
        """Model to trim with before a flight with this one."""
        return self

    def update_steps(self, aircraft: Flown) -> int:
        """Coupling steps between renewals of the inflow held for the flight dynamics."""
        return 1

    def _groups(self) -> dict[str, dict[str, Any]]:
        """Options by the group the core reads them in; those that are None left out."""
        return _grouped(self.name, {field.name: getattr(self, field.name) for field in fields(self)})


class FreeWake(Inflow):
    """What both free wakes have in common.

    Options that are None "by regime" take the number of the rotor's regime (`wakeflight.regime`) where the model meets a
    condition: in trim, flight and on the stand alike. A number given is never replaced.
    """

    is_free_wake: ClassVar[bool] = True
    trailers: Any
    n_trailers: int
    turns: Any
    far_wake_turns: int | None
    near_wake_angle: Any
    release_radius: float
    wash: str
    blade_model: str
    fuselage_upwash: str
    update_interval: Any
    precision: str

    @property
    def free_wake(self) -> FreeWake:
        """Itself."""
        return self

    @property
    def is_full_span(self) -> bool:
        """Whether trailers all over the span are free."""
        return self.trailers == "full-span"

    @property
    def washes_airframe(self) -> bool:
        """Whether the parts of the airframe feel the wake itself."""
        return self.wash == "wake"

    @property
    def is_second_order(self) -> bool:
        """Whether sections meet the air behind their bound line."""
        return self.blade_model == "second-order"

    def on_stand(self) -> Self:
        """This model on a stand, where there is no airframe."""
        for name in ("wash", "fuselage_upwash"):
            option = options_of(self.name)[name]
            value = getattr(self, name)
            if value != option.default:
                raise InputError.of(name, value, f"must be {option.default} on a stand, which has no airframe")
        if self.is_second_order:
            raise InputError.of(
                "blade_model", self.blade_model, "is an argument of the stand itself, not of its inflow"
            )
        return self

    @property
    def steps_per_revolution(self) -> int | None:
        """Steps of azimuth in a revolution; None while the step is the aircraft's."""
        return None if self.azimuth_step is None else round(2.0 * math.pi / self.azimuth_step)

    def update_steps(self, aircraft: Flown) -> int:
        """Coupling steps between renewals of the inflow held for the flight dynamics."""
        if self.update_interval is None:
            return 1
        steps = self.update_interval / self.step(aircraft)
        if abs(steps - round(steps)) > 1e-6:
            allowed = f"must be a whole number of azimuth steps of {math.degrees(self.step(aircraft)):.6g} deg"
            raise InputError.of("update_interval", f"{math.degrees(self.update_interval):.6g} deg", allowed)
        return round(steps)

    def check_on(self, aircraft: Flown) -> None:
        """Refuse options that do not go with this aircraft or rotor; what depends on the regime must be known."""
        self.core_options(aircraft)

    def unlike(self, other: FreeWake, aircraft: Flown) -> list[tuple[str, Any, Any]]:
        """Options that all free wakes share and that differ: name, value of the other, own value, as they are typed."""
        own, others = (wake.core_options(aircraft)["wake"] for wake in (self, other))
        told = options_of(self.name)
        return [(n, told[n].shown(others[n]), told[n].shown(own[n])) for n in sorted(own) if own[n] != others[n]]

    def core_options(self, aircraft: Flown) -> dict[str, dict[str, Any]]:
        """Options as the physics core reads them: the groups of this model, and under `rotor` this aircraft's rotor in SI.

        What depends on the regime must be known: see `resolved`.
        """
        for option in options_of(self.name).values():
            if option.by_regime and getattr(self, option.name) is None:
                raise InputError.of(option.name, None, "must be a number here: take the model's `resolved(regime)`")
        given, rotor = self._groups(), aircraft.rotor
        given["wake"]["azimuth_step"] = self.step(aircraft)
        self.update_steps(aircraft)
        given["rotor"] = {
            "n_blades": int(rotor.n_blades),
            "radius": float(rotor.radius),
            "root_cutout": float(rotor.blade.root_cutout),
            "hinge_offset": float(rotor.blade.root_station),
            "chord": float(aircraft.chord),
            "omega": float(rotor.omega),
        }
        return _checked(given)

    def above_ground(self) -> Self:
        """This model near the ground, which a far wake of repeated turns ends in and a cylinder would pass."""
        if self.far_wake != "repeat":
            raise InputError.of("far_wake", self.far_wake, "must be repeat above ground")
        return self


def _grouped(model: str, values: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Values of the options of `model` by the group the core reads them in; those that are None left out."""
    groups: dict[str, dict[str, Any]] = {}
    for option in options_of(model).values():
        group = groups.setdefault(option.group, {})
        if values[option.name] is not None:
            group[option.name] = values[option.name]
    return groups


def _checked(groups: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """`groups`, if the core takes them."""
    try:
        _core.check_options(json.dumps(groups))
    except ValueError as reason:
        raise InputError(str(reason)) from reason
    return groups


def _with_options(kind: Kind) -> Kind:
    """`kind` with a keyword argument for each option that the core declares for it, told by its help."""
    told = options_of(kind.name)
    kind.__annotations__ = {**inspect.get_annotations(kind), **dict.fromkeys(told, "Any")}
    for option in told.values():
        setattr(kind, option.name, option.default)
    lines = []
    for option in told.values():
        unit = f" [{option.unit}]" if option.unit and not option.is_angle else ""
        lines.append(f"    {option.name} : {option.allowed}{unit}; default {option.default_in_words}")
        lines.append(f"        {option.meaning}")
        lines += [f"        {word}: {meaning}" for word, meaning in option.words.items()]
    kind.__doc__ = "\n".join([f"{kind.__doc__}", "", "    Options", "    -------", *lines])
    made: Callable[[Kind], Kind] = dataclass(frozen=True, kw_only=True, repr=False)
    return with_checked_init(made(kind))


@_with_options
class RelaxationWake(FreeWake):
    """Free wake made periodic by relaxation [bagai1995]; in flight renewed once per revolution, or as asked."""

    name: ClassVar[str] = "relaxation"
    is_relaxed: ClassVar[bool] = True
    references: ClassVar[tuple[str, ...]] = ("bagai1995", "leishman2002", "vatistas1991", "squire1965")

    @property
    def relaxed(self) -> RelaxationWake:
        """Itself."""
        return self


@_with_options
class TimeMarchingWake(FreeWake):
    """Free wake advanced in time with the flight [bhagwat2001], exchanged with it at every azimuth step."""

    name: ClassVar[str] = "time-marching"
    is_marching: ClassVar[bool] = True
    references: ClassVar[tuple[str, ...]] = (
        "bhagwat2001",
        "leishman2002",
        "ribera2004",
        "vatistas1991",
        "squire1965",
    )

    @property
    def marching(self) -> TimeMarchingWake:
        """Itself."""
        return self

    def trim_model(self) -> RelaxationWake:
        """A relaxation wake of the options that both kinds share: a marching wake is trimmed with it."""
        return like(RelaxationWake, self)


@_with_options
class DynamicInflow(Inflow):
    """Three-state dynamic inflow [pitt1981]: mean and first harmonics, always in the state."""

    name: ClassVar[str] = "dynamic"
    is_dynamic: ClassVar[bool] = True
    references: ClassVar[tuple[str, ...]] = ("pitt1981", "peters1988")


@_with_options
class AnnularInflow(Inflow):
    """Momentum of every ring of the disk for itself [leishman2006]: hover and axial climb, on the stand alone."""

    name: ClassVar[str] = "annular"
    is_annular: ClassVar[bool] = True
    references: ClassVar[tuple[str, ...]] = ("leishman2006",)

    @property
    def annular(self) -> AnnularInflow:
        """Itself."""
        return self


InflowModel = TimeMarchingWake | RelaxationWake | DynamicInflow
"""Any of the three that a helicopter can fly with."""

MODELS: dict[str, type[InflowModel]] = {
    model.name: model for model in (TimeMarchingWake, RelaxationWake, DynamicInflow)
}
"""Models by the name the command line uses; the first is the default."""


STAND_MODELS: dict[str, type[Inflow]] = {**MODELS, AnnularInflow.name: AnnularInflow}
"""Models of a rotor on a stand."""


@checked
def inflow_model(inflow: Any = "time-marching", known: Mapping[str, type[Inflow]] = MODELS) -> Any:
    """Model from its name, or the configured model itself; one of those `known`."""
    if isinstance(inflow, tuple(known.values())):
        return inflow
    if isinstance(inflow, str) and inflow in known:
        return known[inflow]()
    raise InputError.choice("inflow", inflow, known, ", or a configured model")


def trim_model(model: InflowModel) -> InflowModel:
    """Model to trim with before a flight with `model`."""
    return model.trim_model()


def like(kind: type[InflowModel], model: InflowModel) -> InflowModel:
    """A free wake of another kind with the options that both kinds share."""
    shared = (option.name for option in options_of(kind.name).values() if option.group == "wake")
    return kind(**{name: getattr(model, name) for name in shared})
