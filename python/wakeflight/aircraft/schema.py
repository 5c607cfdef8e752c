# SPDX-License-Identifier: MIT OR Apache-2.0
# mypy: disable-error-code="valid-type"
# annotations are made by calls (unit, range): types to pydantic, not to mypy
"""What an aircraft file may hold: components, their numbers and the allowed range of each.

Presence is meaning: a group that is not in the file is a part the aircraft does not have. Only the
discretisation and `flexible` have defaults; every other missing number is an error.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

from pydantic import Field, PrivateAttr, ValidationInfo, model_validator

from .blade_file import BladeGroup
from .fields import (
    DEG,
    Angle,
    Area,
    Condition,
    Fraction,
    Group,
    Length,
    Name,
    Position,
    Rate,
    Rotation,
    Source,
    Station,
)
from .number import Noted, Weight, scalar, vector
from .span import Section, along_span
from .tables import Table


class Inertia(Group):
    """Moments of inertia, blades left out (`of` = `airframe`) or included as masses at the hub (`gross`)."""

    of: Literal["airframe", "gross"]
    ixx: scalar("kg m2", above=0.0, high=1e7)
    iyy: scalar("kg m2", above=0.0, high=1e7)
    izz: scalar("kg m2", above=0.0, high=1e7)
    ixz: scalar("kg m2", low=-1e7, high=1e7)


class Loading(Group):
    """Centre of gravity and inertia; in a named loading, what is not given is that of `[loading]`."""

    weight: Weight | None = None
    cg_station: Station | None = None
    cg_buttline: Station | None = None
    cg_waterline: Station | None = None
    inertia: Inertia | None = None


class Blade(BladeGroup):
    """Blade of an aircraft: nothing is left to a default but the kind of blade and what its hinges do not have."""

    root_station: scalar("m", above=0.0, high=20.0)
    straight_tip: bool
    pitch_axis_chord_fraction: Fraction
    delta3: scalar("rad", low=-80 * DEG, high=80 * DEG)
    precone: scalar("rad", low=-20 * DEG, high=20 * DEG)

    @model_validator(mode="after")
    def _moves(self) -> Blade:
        if self.root == "clamped" and not self.flexible:
            raise ValueError("is rigid and clamped: it does not move; in flight blades must flap")
        return self


class Airfoil(Section):
    """Section of an aircraft's blade: nothing is left to a default."""

    cd_increment: scalar("1", low=-0.1, high=0.1)

    @model_validator(mode="after")
    def _moment(self) -> Airfoil:
        if self.cl is not None and self.cm is None:
            raise ValueError("needs the table cm beside cl and cd")
        return self


class LagDamper(Group):
    """Hydraulic lag damper: geometry, force against rate, hinge spring where `use_spring` is true."""

    a: Station
    b: Station
    c: Station
    d: Station
    r: Station
    theta_geo: Angle
    zeta_geo: Angle
    force: Table
    use_spring: bool = False
    spring_rate: scalar("N m/rad", low=0.0, high=1e8) | None = None

    @model_validator(mode="after")
    def _spring(self) -> LagDamper:
        if self.use_spring and self.spring_rate is None:
            raise ValueError("use_spring = true needs a spring_rate")
        return self


class Rotor(Group):
    """Main rotor."""

    name: str = "main"
    hub: Position
    n_blades: scalar("1", low=2, high=8, whole=True)
    radius: Length
    omega: Rate
    rotation: Rotation = "ccw"
    shaft_tilt_forward: scalar("rad", low=-30 * DEG, high=30 * DEG)
    shaft_tilt_lateral: scalar("rad", low=-30 * DEG, high=30 * DEG)
    tip_loss_factor: scalar("1", low=0.8, high=1.0)
    swashplate_phase: Angle
    blade: Blade
    airfoil: along_span(Airfoil)
    lag_damper: LagDamper | None = None


class PitchBiasActuator(Group):
    """Actuator in series with the longitudinal stick: shares of its travel, aft positive, for pitch, pitch rate and airspeed."""

    attitude_gain: scalar("1/rad", low=-100.0, high=100.0)
    attitude_limit: scalar("rad", above=0.0, high=math.pi)
    rate_gain: scalar("s/rad", low=-100.0, high=100.0)
    rate_limit: scalar("rad/s", above=0.0, high=10.0)
    airspeed_gain: scalar("s/m", low=-1.0, high=1.0)
    airspeed_from: scalar("m/s", low=0.0, high=500.0)
    airspeed_range: scalar("m/s", low=0.0, high=500.0)
    bias: scalar("1", low=-1.0, high=1.0)
    lag: scalar("s", low=0.0, high=10.0)
    actuator_rate: scalar("1/s", above=0.0, high=100.0)
    authority: scalar("1", above=0.0, high=1.0)


class Rigging(Group):
    """Sticks to blade pitch: pitch = offset + matrix . (lateral, longitudinal, collective, pedal)."""

    stick_travel: vector("m", 4, low=0.01, high=2.0)
    matrix: vector("rad/m", 4, low=-100.0, high=100.0, rows=4)
    offset: vector("rad", 4, low=-math.pi, high=math.pi)
    full_travel_time: scalar("s", above=0.0, high=100.0)
    pitch_bias_actuator: PitchBiasActuator | None = None


class TailRotor(Group):
    """Tail rotor; thrust to the right and up by the cant."""

    name: str = "tail"
    hub: Position
    radius: Length
    solidity: scalar("1", above=0.0, high=1.0)
    omega: Rate
    cant: scalar("rad", low=-90 * DEG, high=90 * DEG)
    twist: Angle
    lift_curve_slope: scalar("1/rad", above=0.0, high=10.0)
    tip_loss_factor: scalar("1", low=0.5, high=1.0)
    pitch_bias: Angle
    coning: scalar("rad/N", low=0.0, high=1.0) | None = None
    tan_delta3: scalar("1", low=-10.0, high=10.0) | None = None
    cd_polar: vector("1", 3, low=-10.0, high=10.0)
    fin_blockage: vector(("1", "1", "m/s"), 3, low=0.0, high=1000.0)

    @model_validator(mode="after")
    def _delta3(self) -> TailRotor:
        if self.coning is not None and self.tan_delta3 is None:
            raise ValueError("coning needs tan_delta3")
        return self


class Schedule(Group):
    """Incidence schedule of a stabilator: degrees, knots equivalent airspeed, collective per cent."""

    base: Angle
    v1: vector("m/s", 2, low=0.0, high=500.0)
    coll_const: scalar("rad s/m", low=-10.0, high=10.0)
    coll_slope: scalar("rad s/m", low=-10.0, high=10.0)
    coll_breaks: vector("1", 4, low=0.0, high=100.0)
    v2: vector(("m/s", "m/s", "rad s/m"), 3, low=-500.0, high=500.0)
    q_gain: scalar("s", low=-100.0, high=100.0)
    rate_limit: scalar("rad/s", above=0.0, high=10.0)


class Stabilator(Group):
    """Horizontal tail: a fixed `incidence`, or a `schedule` with `incidence_limits`."""

    position: Position
    area: Area
    aerodynamics: Table
    incidence: Angle | None = None
    incidence_limits: vector("rad", 2, low=-math.pi, high=math.pi) | None = None
    schedule: Schedule | None = None

    @model_validator(mode="after")
    def _one_rule(self) -> Stabilator:
        if (self.schedule is None) == (self.incidence is None):
            raise ValueError("needs either a fixed incidence or a schedule")
        if self.schedule is not None:
            if self.incidence_limits is None:
                raise ValueError("a schedule needs incidence_limits")
            if not self.incidence_limits[0] < self.incidence_limits[1]:
                raise ValueError("incidence_limits must ascend")
        return self


class Fin(Group):
    """Vertical tail."""

    position: Position
    area: Area
    incidence: Angle
    aerodynamics: Table


class Fuselage(Group):
    """Fuselage loads over dynamic pressure, on a grid of angle of attack and sideslip."""

    position: Position
    aerodynamics: Table


class InterferenceTables(Group):
    """Rotor and fuselage wash by tables."""

    kind: Literal["tables"]
    rotor_wash: Table
    fuselage_wash: Table
    q_ratio_stabilator: Table
    q_ratio_fin: Table


class InterferenceFactors(Group):
    """Downwash as a factor times the mean induced velocity."""

    kind: Literal["factors"]
    fuselage: scalar("1", low=-5.0, high=5.0)
    stabilator: scalar("1", low=-5.0, high=5.0)


class Drive(Group):
    """Drive train: what turns with the rotor, at its speed, and the engines' governor; needed where the speed is a state."""

    accessory_power: scalar("W", low=0.0, high=1e7)
    inertia_engines: scalar("kg m2", low=0.0, high=1e7) | None = None
    inertia_tail_rotor: scalar("kg m2", low=0.0, high=1e7) | None = None
    # the hub without its blades: the only part that turns about the shaft itself
    inertia_hub: scalar("kg m2", low=0.0, high=1e7) | None = None
    inertia_gearbox: scalar("kg m2", low=0.0, high=1e7) | None = None
    inertia_accessories: scalar("kg m2", low=0.0, high=1e7) | None = None
    engine_lag: scalar("s", above=0.0, high=100.0) | None = None
    power_per_fuel_flow: scalar("W s/kg", above=0.0, high=1e9) | None = None
    # fuel flow taken off by excess of speed, by its integral, by its rate
    governor_proportional: scalar("kg/rad", low=0.0, high=1e3) | None = None
    governor_integral: scalar("kg/s/rad", above=0.0, high=1e3) | None = None
    governor_derivative: scalar("kg s/rad", low=0.0, high=1e3) | None = None


class Limits(Group):
    """What the aircraft may be flown to: told where a run goes beyond it, not enforced."""

    power: scalar("W", above=0.0, high=1e8) | None = None
    torque: scalar("N m", above=0.0, high=1e7) | None = None
    rotor_speed: vector("rad/s", 2, low=0.0, high=10000.0) | None = None

    @model_validator(mode="after")
    def _ascending(self) -> Limits:
        if self.rotor_speed is not None and not self.rotor_speed[0] < self.rotor_speed[1]:
            raise ValueError("rotor_speed must ascend: the lowest, then the highest")
        return self


class Discretisation(Group):
    """How finely to compute: the only group with defaults."""

    n_modes: Annotated[int, Field(ge=1, le=30)] = 5
    n_elements: Annotated[int, Field(ge=1, le=100)] = 4
    # eight quadrature points per element: the equations of motion have the eigenproblem's frequencies within 2e-5
    n_gauss: Annotated[int, Field(ge=2, le=40)] = 8
    azimuth_step: str | None = None
    reference_pitch: str | None = None


class AircraftFile(Group):
    """A whole aircraft file."""

    name: Name
    notes: str = ""
    # the aircraft is the mirror image of what the file says
    mirrored: bool = False
    sources: dict[str, Source]
    condition: Condition
    conditions: dict[str, Condition] = Field(default_factory=dict)
    loading: Loading
    loadings: dict[str, Loading] = Field(default_factory=dict)
    rotor: Rotor
    rigging: Rigging
    tail_rotor: TailRotor | None = None
    stabilator: Stabilator | None = None
    fin: Fin | None = None
    fuselage: Fuselage | None = None
    interference: Annotated[InterferenceTables | InterferenceFactors, Field(discriminator="kind")] | None = None
    drive: Drive
    limits: Limits | None = None
    discretisation: Discretisation = Discretisation()
    comparison: dict[str, Noted] = Field(default_factory=dict)
    _contents: dict[str, str] = PrivateAttr(default_factory=dict)
    _changes: list[dict[str, Any]] = PrivateAttr(default_factory=list)

    @property
    def contents(self) -> dict[str, str]:
        """Text of the file and of every table it names, by their names, as they were read."""
        return self._contents

    @property
    def changes(self) -> list[dict[str, Any]]:
        """What was given in place of the file's numbers, by dotted names, one step after the other."""
        return self._changes

    @model_validator(mode="after")
    def _complete(self, info: ValidationInfo) -> AircraftFile:
        self._contents = (info.context or {}).get("contents", {})
        for group, keys in (
            ("condition", ("speed", "flight_path", "altitude", "weight")),
            ("loading", ("cg_station", "cg_buttline", "cg_waterline", "inertia")),
        ):
            for key in keys:
                if getattr(getattr(self, group), key) is None:
                    raise ValueError(f"{group}.{key} is missing")
        if not self.rotor.blade.root_station < self.rotor.blade.root_cutout < self.rotor.radius:
            raise ValueError("rotor.blade: root_station, root_cutout and the radius must ascend")
        return self
