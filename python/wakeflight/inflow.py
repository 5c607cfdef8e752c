# SPDX-License-Identifier: MIT OR Apache-2.0
"""The three inflow models a rotor can fly with, as immutable settings: which one, and its options.

Defaults are those found to hold the momentum balance and to settle in the baseline. The literal reading of
common practice for the tip vortex is `tip_strength="max"`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, ClassVar, Self

from .errors import InputError
from .regime import BY_REGIME, resolved
from .units import quantity

if TYPE_CHECKING:
    from .aircraft import Aircraft

_CHOICES = {
    "scheme": ("bdf2", "pc2b", "pcc"),
    "predictor": ("same", "central"),
    "evaluation": ("pece", "pec"),
    "summation": ("auto", "direct", "tree"),
    "form": ("displacement", "position"),
    "trailers": ("tip", "full-span"),
    "shed_wake": ("none", "beyond", "all"),
    "far_wake": ("repeat", "cylinder"),
    "tip_strength": ("equivalent", "max", "mean"),
    "inboard_wake": ("none", "sheet"),
    "core_distance": ("line", "segment"),
    "tip_loss": ("prandtl", "none"),
}

# smallest and largest value of each number
_RANGES: dict[str, tuple[float, float]] = {
    "turns": (1, 20),
    "time_filter": (0.0, 0.49),
    "tree_tolerance": (1e-12, 0.1),
    "n_trailers": (0, 201),
    "trailer_core": (0.0, 0.2),
    "tip_strength_inner": (0.0, 0.95),
    "n_sheet": (1, 20),
    "sheet_factor": (0.0, 5.0),
    "core_radius": (0.0, 0.2),
    "core_growth": (0.0, 0.1),
    "near_wake_segments": (1, 60),
    "bound_core": (0.0, 2.0),
    "station_core_floor": (0.0, 2.0),
    "far_wake_turns": (0, 50),
    "n_stations": (5, 200),
    "release_radius": (0.5, 1.0),
    "relaxation": (0.01, 1.0),
    "sweeps": (1, 100),
    "inflow_relaxation": (0.01, 1.0),
    "inflow_tolerance": (1e-12, 0.1),
    "max_loops": (1, 1000),
    "max_loops_response": (1, 1000),
    "convergence_revolutions": (0, 200),
    "recorrect": (0, 3),
}

_WHOLE = {
    "n_trailers",
    "n_sheet",
    "near_wake_segments",
    "far_wake_turns",
    "n_stations",
    "sweeps",
    "max_loops",
    "max_loops_response",
    "convergence_revolutions",
    "recorrect",
}


def check_azimuth_step(step: float, n_blades: int | None = None, field: str = "azimuth_step") -> None:
    """Refuse an azimuth step [rad] that does not divide the angle between blades (a turn, if unknown)."""
    degrees = math.degrees(step)
    between = 360.0 / (n_blades or 1)
    allowed = f"must be positive and divide {between:g} deg" + (f" ({n_blades} blades)" if n_blades else "")
    if not 0.0 < degrees <= 45.0:
        raise InputError.of(field, f"{degrees:.6g} deg", allowed + ", at most 45 deg")
    if abs(between / degrees - round(between / degrees)) > 1e-9 * between / degrees:
        raise InputError.of(field, f"{degrees:.6g} deg", allowed)


class _Inflow:
    """What every inflow model has: a step of azimuth, and options that go into the attributes of a result."""

    azimuth_step: Any

    def step(self, aircraft: Aircraft) -> float:
        """Azimuth step on this aircraft or rotor [rad]; it must divide 360 deg over the number of blades."""
        step = aircraft.discretisation.azimuth_step if self.azimuth_step is None else self.azimuth_step
        check_azimuth_step(step, int(aircraft.rotor.n_blades))
        return step

    def resolved(self, regime: str) -> Self:
        """This model with the number of `regime` for every option left to it; what was given stays."""
        found = resolved({field.name: getattr(self, field.name) for field in fields(self)}, regime)
        return replace(self, **found) if found else self

    def as_attributes(self) -> dict[str, Any]:
        """Options by name, angles [rad], for the attributes of a result."""
        return {field.name: getattr(self, field.name) for field in fields(self)}


@dataclass(frozen=True)
class _Wake(_Inflow):
    """Options common to both free wakes; lengths over the radius or the chord, angles [rad] once made.

    Options that are None "by regime" take the number of the rotor's regime (`wakeflight.regime`) where the model meets a
    condition: in trim, flight and on the stand alike. A number given is never replaced.
    """

    turns: float | None = None
    """Length of the free filaments in turns; by regime: 4 forward, 5 hover and climb, 8 axial descent."""
    azimuth_step: Any = None
    """Step of azimuth and of wake age; None is the aircraft's (10 deg)."""
    form: str = "displacement"
    """What the scheme acts on: displacement from the release point, or position."""
    trailers: str = "tip"
    """What leaves a blade freely: its tip vortex alone, or trailers all over the span joined by shed vortices."""
    n_trailers: int = 0
    """Trailers per blade of a full-span wake; 0 is one at every edge of the bound elements (n_stations + 1)."""
    trailer_core: float = 0.02
    """Core radius at release of the trailers of a full-span wake, over the rotor radius."""
    shed_wake: str = "beyond"
    """Shed vortices of a full-span wake: none, all, or all with those over a blade's own near wake gathered at its end."""
    tip_strength: str = "equivalent"
    """Tip vortex strength: uniform circulation of equal thrust, maximum or mean of the outboard part."""
    tip_strength_inner: float = 0.5
    """Inner end of the part `max` and `mean` look at, over the radius."""
    inboard_wake: str = "none"
    """Nothing, or a sheet of rigid helical filaments that closes the tip vortex inboard."""
    n_sheet: int = 4
    """Filaments per blade of the sheet."""
    sheet_factor: float | None = None
    """Multiple of the momentum inflow that carries the sheet down; by regime: 1 forward, 1.4 hover and climb, 1 axial descent."""
    core_radius: float = 0.02
    """Core radius at release over the rotor radius."""
    core_growth: float = 3e-4
    """Growth of the squared core radius over R^2 for each radian of age."""
    core_stretching: bool = False
    """Whether the core shrinks as a filament stretches, at constant volume."""
    core_distance: str = "line"
    """Distance the core acts on: to the segment's line, or to the segment."""
    curvature_correction: bool = False
    """Whether a marker feels the curvature of its own filament."""
    near_wake_angle: Any = "30 deg"
    """Extent of the near wake behind each blade."""
    near_wake_segments: int = 6
    """Segments along the near wake."""
    bound_core: float = 0.25
    """Core of the bound vortices over the chord."""
    station_core_floor: float = 0.25
    """Smallest core seen by blade stations, over the chord."""
    far_wake: str = "repeat"
    """What goes on behind the free filaments: repeats of the last turn, or, for tip vortices alone in hover and climb, a
    semi-infinite vortex cylinder (`cylinder`) [branlard2014]."""
    far_wake_turns: int | None = None
    """Repeats of the last turn beyond the free filaments; by regime: 0 forward, 2 hover and climb, 0 axial descent; none with a
    `cylinder` or full-span trailers."""
    release_radius: float = 1.0
    """Where the tip vortex leaves the blade, over the radius."""
    n_stations: int = 20
    """Blade stations, at the middles of elements that narrow towards the tip."""
    rates: bool = True
    """Whether the body's rates act on the free filaments (on blades and near wake they always do)."""
    summation: str = "auto"
    """Sum of the vortices at the markers: by the tree where it is faster (large wakes), or always direct or tree."""
    tree_tolerance: float = 1e-3
    """Error allowed of the tree, over the largest induced velocity at the markers."""

    name: ClassVar[str] = ""

    def __post_init__(self) -> None:
        """Check every option; angles become radians. Full-span trailers leave no room for a sheet or a moved tip."""
        _check_options(self)
        if self.n_trailers == 1 or self.n_trailers > self.n_stations + 1:
            raise InputError.of(
                "n_trailers", self.n_trailers, f"must be 0, or from 2 to n_stations + 1 = {self.n_stations + 1}"
            )
        for name, needed in (("inboard_wake", "none"), ("release_radius", 1.0)):
            if self.trailers == "full-span" and getattr(self, name) != needed:
                raise InputError.of(name, getattr(self, name), f"must be {needed} with trailers = full-span")

    @property
    def steps_per_revolution(self) -> int | None:
        """Steps of azimuth in a revolution; None while the step is the aircraft's."""
        return None if self.azimuth_step is None else round(2.0 * math.pi / self.azimuth_step)

    def update_steps(self, aircraft: Aircraft) -> int:
        """Coupling steps between renewals of the inflow held for the flight dynamics."""
        interval = getattr(self, "update_interval", None)
        if interval is None:
            return 1
        steps = interval / self.step(aircraft)
        if abs(steps - round(steps)) > 1e-6:
            allowed = f"must be a whole number of azimuth steps of {math.degrees(self.step(aircraft)):.6g} deg"
            raise InputError.of("update_interval", f"{math.degrees(interval):.6g} deg", allowed)
        return round(steps)

    def core_options(self, aircraft: Aircraft) -> dict[str, Any]:
        """Options as the physics core reads them: those of this model, and this aircraft's rotor in SI.

        core_radius and release_radius stay over R, bound_core and station_core_floor over the chord. What depends on the regime
        must be known: see `resolved`.
        """
        for name in BY_REGIME:
            if getattr(self, name, 0.0) is None:
                raise InputError.of(name, None, "must be a number here: take the model's `resolved(regime)`")
        step = self.step(aircraft)
        self.update_steps(aircraft)
        steps = round(2.0 * math.pi / step)
        for field, length, floor in (
            ("turns", self.turns * steps, steps),
            ("near_wake_angle", self.near_wake_angle / step, 0),
        ):
            if abs(length - round(length)) > 1e-6 or round(length) < floor:
                value = f"{math.degrees(self.near_wake_angle):.6g} deg" if floor == 0 else self.turns
                raise InputError.of(
                    field, value, f"must be a whole number of azimuth steps of {math.degrees(step):.6g} deg"
                )
        rotor = aircraft.rotor
        return {
            "n_blades": int(rotor.n_blades),
            "radius": float(rotor.radius),
            "root_cutout": float(rotor.blade.root_cutout),
            "hinge_offset": float(rotor.blade.root_station),
            "chord": float(aircraft.chord),
            "omega": float(rotor.omega),
            "n_stations": self.n_stations,
            "turns": float(self.turns),
            "steps_per_revolution": steps,
            "scheme": getattr(self, "scheme", "bdf2"),
            "predictor": getattr(self, "predictor", "same"),
            "evaluation": getattr(self, "evaluation", "pece"),
            "summation": self.summation,
            "tree_tolerance": float(self.tree_tolerance),
            "form": self.form,
            "time_filter": float(getattr(self, "time_filter", 0.0)),
            "trailers": self.trailers,
            "n_trailers": self.n_trailers,
            "trailer_core": float(self.trailer_core),
            "shed_wake": self.shed_wake,
            "tip_strength": self.tip_strength,
            "tip_strength_inner": float(self.tip_strength_inner),
            "inboard_wake": self.inboard_wake,
            "n_sheet": self.n_sheet,
            "sheet_factor": float(self.sheet_factor),
            "core_radius": float(self.core_radius),
            "core_growth": float(self.core_growth),
            "core_stretching": self.core_stretching,
            "core_distance": self.core_distance,
            "curvature_correction": self.curvature_correction,
            "rates": self.rates,
            "near_wake_angle": self.near_wake_angle,
            "near_wake_segments": self.near_wake_segments,
            "bound_core": float(self.bound_core),
            "station_core_floor": float(self.station_core_floor),
            "far_wake": self.far_wake,
            "far_wake_turns": self.far_wake_turns,
            "release_radius": float(self.release_radius),
            "relaxation": float(getattr(self, "relaxation", BY_REGIME["relaxation"]["forward"])),
        }


@dataclass(frozen=True)
class RelaxationWake(_Wake):
    """Free wake made periodic by relaxation [bagai1995]; in flight renewed once per revolution, or as asked."""

    relaxation: float | None = None
    """Share of a new geometry taken in each sweep; by regime: 0.5 forward, 0.3 hover and climb, 0.3 axial descent."""
    sweeps: int = 2
    """Sweeps in each iteration of inflow and circulation."""
    inflow_relaxation: float = 0.7
    """Share of a new far inflow taken in each iteration of inflow and circulation."""
    inflow_tolerance: float = 1e-4
    """Change of inflow over the tip speed at which inflow and circulation agree."""
    max_loops: int = 30
    """Iterations of inflow and circulation at most, in trim."""
    max_loops_response: int = 10
    """Iterations of inflow and circulation at most, in flight."""
    update_interval: Any = "360 deg"
    """Azimuth between renewals of wake and inflow in flight: a revolution [ribera2004], a quarter of one with "90 deg"."""

    name: ClassVar[str] = "relaxation"

    @property
    def references(self) -> tuple[str, ...]:
        """Keys of references.bib."""
        return ("bagai1995", "leishman2002", "vatistas1991", "squire1965")


@dataclass(frozen=True)
class TimeMarchingWake(_Wake):
    """Free wake advanced in time with the flight [bhagwat2001], exchanged with it at every azimuth step."""

    scheme: str = "bdf2"
    """Corrector: second-order backward at the new level, PC2B at the cell's centre, or five-point central."""
    predictor: str = "same"
    """Predictor: stencil of the corrector, or five-point central."""
    evaluation: str = "pece"
    """Fields of a step: of the predicted and the corrected wake, or of the predicted alone ("pec", half the work)."""
    time_filter: float = 0.0
    """Weight of a second difference in time that damps the odd-even mode of PC2B (0.05)."""
    convergence_revolutions: int = 10
    """Revolutions at frozen states before the flight."""
    recorrect: int = 0
    """Passes after each step in which circulation and far inflow are found again with the wake held (0 to 3)."""
    extrapolate: bool = False
    """Whether the far inflow is carried on linearly in azimuth, half a step for the flight, a whole one for the wake."""
    update_interval: Any = None
    """Azimuth over which the flight dynamics keep a map of the inflow while the wake goes on; None is every step."""

    name: ClassVar[str] = "time-marching"

    def __post_init__(self) -> None:
        """Check every option; a filter acts on displacements only."""
        super().__post_init__()
        if self.time_filter > 0.0 and self.form != "displacement":
            raise InputError.of("time_filter", self.time_filter, "must be 0 unless form is displacement")

    @property
    def references(self) -> tuple[str, ...]:
        """Keys of references.bib."""
        return ("bhagwat2001", "leishman2002", "ribera2004", "vatistas1991", "squire1965")


@dataclass(frozen=True)
class DynamicInflow(_Inflow):
    """Three-state dynamic inflow [pitt1981]: mean and first harmonics, always in the state."""

    n_stations: int = 20
    """Blade stations, at the middles of elements that narrow towards the tip."""
    azimuth_step: Any = None
    """Step at which results are kept; None is the aircraft's (10 deg)."""

    name: ClassVar[str] = "dynamic"

    def __post_init__(self) -> None:
        """Check every option; angles become radians."""
        _check_options(self)

    @property
    def references(self) -> tuple[str, ...]:
        """Keys of references.bib."""
        return ("pitt1981", "peters1988")


@dataclass(frozen=True)
class AnnularInflow(_Inflow):
    """Momentum of every ring of the disk for itself [leishman2006]: hover and axial climb, on the stand alone."""

    n_stations: int = 20
    """Blade stations, at the middles of elements that narrow towards the tip."""
    azimuth_step: Any = None
    """Step at which results are kept; None is the rotor's (10 deg)."""
    tip_loss: str = "prandtl"
    """Prandtl's loss of momentum towards the tip, or none."""

    name: ClassVar[str] = "annular"

    def __post_init__(self) -> None:
        """Check every option; angles become radians."""
        _check_options(self)

    @property
    def references(self) -> tuple[str, ...]:
        """Keys of references.bib."""
        return ("leishman2006",)


InflowModel = TimeMarchingWake | RelaxationWake | DynamicInflow
"""Any of the three that a helicopter can fly with."""

MODELS: dict[str, type[InflowModel]] = {
    model.name: model for model in (TimeMarchingWake, RelaxationWake, DynamicInflow)
}
"""Models by the name the command line uses; the first is the default."""


def inflow_model(inflow: str | InflowModel = "time-marching") -> InflowModel:
    """Model from its name, or the configured model itself."""
    if isinstance(inflow, tuple(MODELS.values())):
        return inflow
    if isinstance(inflow, str) and inflow in MODELS:
        return MODELS[inflow]()
    raise InputError.of("inflow", inflow, f"allowed: {', '.join(MODELS)}, or a configured model")


def trim_model(model: InflowModel) -> InflowModel:
    """Model to trim with before a flight with `model`: relaxation for a time-marching wake."""
    if not isinstance(model, TimeMarchingWake):
        return model
    return like(RelaxationWake, model)


def like(kind: type[InflowModel], model: InflowModel) -> InflowModel:
    """A free wake of another kind with the options that both kinds share."""
    return kind(**{field.name: getattr(model, field.name) for field in fields(_Wake)})


def _check_options(model: InflowModel) -> None:
    """Type and range of every option of `model`; angles given as text become radians."""
    for field in fields(model):
        name, value = field.name, getattr(model, field.name)
        if name in ("azimuth_step", "near_wake_angle", "update_interval"):
            if value is None:
                continue
            # a number is what an instance copied by dataclasses.replace holds: radians already
            radians = value if isinstance(value, _Radians) else _Radians(quantity(value, "rad", name))
            if name == "azimuth_step":
                check_azimuth_step(radians)
            elif name == "update_interval":
                if not 0.0 < radians <= 20.0 * math.pi + 1e-9:
                    raise InputError.of(name, value, "must lie above 0 deg and at most 3600 deg")
            elif not 0.0 <= radians <= 0.5 * math.pi:
                raise InputError.of(name, value, "must lie between 0 deg and 90 deg")
            object.__setattr__(model, name, radians)
        elif name in _CHOICES:
            if value not in _CHOICES[name]:
                raise InputError.of(name, value, f"allowed: {', '.join(_CHOICES[name])}")
        elif name in BY_REGIME and value is None:
            continue
        elif name in _RANGES:
            low, high = _RANGES[name]
            kind = int if name in _WHOLE else (int, float)
            text = "a whole number" if name in _WHOLE else "a number"
            if isinstance(value, bool) or not isinstance(value, kind) or not low <= value <= high:
                raise InputError.of(name, value, f"must be {text} between {low:g} and {high:g}")
        elif not isinstance(value, bool):
            raise InputError.of(name, value, "must be True or False")


class _Radians(float):
    """An angle that was checked and is in radians."""
