# SPDX-License-Identifier: MIT OR Apache-2.0
"""The compiled aircraft of one condition, and the few numbers of it that the verbs need."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from . import _core
from .aircraft import Aircraft
from .condition import CompleteCondition, Target
from .errors import InputError
from .inflow import Flown, Inflow, InflowModel, RelaxationWake
from .monitors import Bounds, bounds
from .results import disk
from .rotor_speed import SHARES, Clock, Corners, FreeClock, clock_of
from .units import STANDARD_GRAVITY

ROLL, PITCH, YAW = 4, 5, 6
"""Places of the attitude among the unknowns of a trim of an aircraft."""
BALANCES: Equations = tuple(
    (name, ()) for name in ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")
)

Equations = tuple[tuple[str, tuple[float, ...]], ...]
"""Name and numbers of every equation asked for, SI."""


@dataclass(frozen=True)
class Question:
    """What is asked of a trim: path (speed, flight path, turn rate), its free parts, the equations."""

    equations: Equations
    path: tuple[float, float, float] = (0.0, 0.0, 0.0)
    free: tuple[str, ...] = ()


class CompiledRotor:
    """What the exchanges with a wake ask of a compiled model: the rotor's constants, its grid, the wake's options."""

    # of frozen dataclasses: read alone
    if TYPE_CHECKING:

        @property
        def aircraft(self) -> Flown:
            """Aircraft or rotor."""

        @property
        def inflow(self) -> Inflow:
            """The inflow model."""

        @property
        def core(self) -> _core.System:
            """The compiled system."""

        @property
        def speed_of_sound(self) -> float:
            """Speed of sound [m/s]."""

        @property
        def rotor_speed(self) -> Corners:
            """Time [s] and share of the nominal rotor speed."""

        @property
        def n_harmonics(self) -> int:
            """Harmonics of the blades' periodic motion in its trims."""

    n_controls: ClassVar[int]
    """How many controls stand at the head of the unknowns."""

    @cached_property
    def rotor(self) -> dict[str, Any]:
        """Constants of the rotor (SI): omega, radius, stations, widths, modal tip deflections ..."""
        return self.core.rotor()

    @property
    def omega(self) -> float:
        """Nominal rotor speed [rad/s]."""
        return float(self.rotor["omega"])

    @cached_property
    def clock(self) -> Clock:
        """When the coupling steps are, before a flight; it has its own."""
        if self.has_free_speed:
            return FreeClock(self.omega, 2 * np.pi / self.steps_per_revolution)
        return clock_of(self.core, self.omega, self.steps_per_revolution, self.rotor_speed)

    @property
    def tip_speed(self) -> float:
        """Nominal tip speed [m/s]."""
        return float(self.rotor["omega"] * self.rotor["radius"])

    @property
    def has_free_speed(self) -> bool:
        """Whether azimuth and speed of the rotor are states."""
        return False

    @property
    def top_share(self) -> float:
        """Highest speed of the rotor over its nominal one, at least 1: what its motion can give grows with it."""
        if self.has_free_speed:
            return SHARES[1]
        return max((1.0, *(share for _, share in self.rotor_speed)))

    @property
    def overspeed(self) -> float:
        """How far the rotor's speed goes above the nominal one [rad/s]."""
        return (self.top_share - 1.0) * self.omega

    @property
    def n_blades(self) -> int:
        """Number of blades."""
        return int(self.rotor["n_blades"])

    @property
    def hand(self) -> float:
        """1 of rotors whose results are in hub axes as they are; -1 where the core has them in those of the mirror image."""
        return 1.0

    @property
    def flexible(self) -> bool:
        """Whether blades bend: the rates of rigid ones are had in closed form."""
        return not self.rotor["rigid"]

    @cached_property
    def stations(self) -> np.ndarray:
        """Stations of the air loads (n_stations,) [m]."""
        return np.asarray(self.rotor["stations"])

    @cached_property
    def area_weights(self) -> np.ndarray:
        """Shares of the disk's area between root cutout and tip that the stations stand for (n_stations,), summing to one."""
        return np.asarray(self.rotor["area_weights"])

    @cached_property
    def steps_per_revolution(self) -> int:
        """Coupling steps in a revolution."""
        return round(2 * np.pi / self.inflow.step(self.aircraft))

    @cached_property
    def wake_options(self) -> str:
        """Options of the free wake as the core reads them (JSON)."""
        return json.dumps(self.inflow.free_wake.core_options(self.aircraft))

    @property
    def rotor_tables(self) -> dict[str, Any]:
        """Blade and airfoil as the core was given them."""
        raise NotImplementedError

    @property
    def question(self) -> Question:
        """What is asked of its trim."""
        raise NotImplementedError

    def normalised(self, x: np.ndarray) -> np.ndarray:
        """Unknowns of a trim with angles that mean the same brought to one of them."""
        return x

    def is_answer(self, problem: _core.TrimProblem, x: np.ndarray) -> bool:
        """Whether unknowns that meet the equations are what was asked for."""
        return True

    @property
    def remembers(self) -> bool:
        """Whether the sections of the blades have states: see the option `unsteady`."""
        return self.inflow.remembers

    @property
    def has_thin_sections(self) -> bool:
        """Whether the blades lift as thin sections without stall instead of by their tables."""
        return False

    @cached_property
    def bounds(self) -> Bounds:
        """What the motion of this rotor can give at most; without a wake its vortices have the cores of a default one."""
        wake = self.inflow.free_wake if self.inflow.is_free_wake else RelaxationWake()
        return bounds(self.rotor, self.rotor_tables, self.speed_of_sound, wake, self.has_thin_sections)

    @cached_property
    def layout(self) -> dict[str, Any]:
        """Where the parts of y start."""
        return self.core.layout()

    def modal(self, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Modal coordinates and rates of all blades, (n_blades, n_modes) each."""
        q, q_dot = self._modal_places
        return y[q], y[q_dot]

    @cached_property
    def _modal_places(self) -> tuple[np.ndarray, np.ndarray]:
        q, q_dot = (np.array([range(a, b) for a, b in self.layout[part]], int) for part in ("modal", "modal_rate"))
        return q, q_dot

    def at_stations(self, inflow: np.ndarray) -> np.ndarray:
        """Inflow at the quarter chord of the stations (..., n_stations) of a map that may hold that of another line behind it."""
        return inflow[..., : self.stations.size]

    def disk_mean(self, inflow: np.ndarray) -> float:
        """Area mean of an inflow map (..., n_stations)."""
        return disk.disk_mean(self.at_stations(inflow), self.area_weights)

    def disk_rms(self, inflow: np.ndarray) -> float:
        """Root mean square over the disk of an inflow map (n_azimuths, n_stations)."""
        return float(np.sqrt(np.mean(self.at_stations(inflow) ** 2 @ self.area_weights)))

    def first_harmonics(self, inflow: np.ndarray) -> tuple[float, float, float]:
        """Area mean and first harmonics of an inflow map (n_azimuths, n_stations), the first azimuth being zero."""
        psi = 2 * np.pi * np.arange(inflow.shape[0]) / inflow.shape[0]
        return disk.first_harmonics(
            self.at_stations(inflow), psi, self.stations / self.rotor["radius"], self.area_weights
        )


def resolution(discretisation: Any, n_stations: int) -> dict[str, Any]:
    """How finely blades are resolved, as the core reads it."""
    names = ("n_elements", "n_modes", "n_gauss", "reference_pitch")
    return {**{name: getattr(discretisation, name) for name in names}, "n_stations": n_stations}


def setting(
    air: tuple[float, float], free_wake: bool, resolved: dict[str, Any], gravity: float = STANDARD_GRAVITY, **other: Any
) -> str:
    """What the core is built for besides the data, JSON.

    Density [kg/m3] and speed of sound [m/s], gravity [m/s2], whether a free wake gives the inflow, discretisation; other: lift of
    thin sections, `Inflow.sections`.
    """
    whole = {
        "air": {"density": air[0], "speed_of_sound": air[1]},
        "gravity": gravity,
        "free_wake": free_wake,
        "discretisation": resolved,
        "lift": None,
        "unsteady": "quasi-steady",
        "yawed_drag": False,
    }
    return json.dumps(whole | other)


def flight_regime(aircraft: Aircraft, condition: CompleteCondition) -> str:
    """Regime of the main rotor in a flight condition, known before the trim: see `FlightCondition.regime`."""
    return condition.regime(float(aircraft.rotor.omega) * float(aircraft.rotor.radius))


def turning_core(model: CompiledRotor, corners: Corners) -> _core.System:
    """The system of `model` with its rotor at the speed of `corners`."""
    return model.core.with_rotor_speed([(t, share * model.omega) for t, share in corners])


def _check_clearance(core: _core.System, height: float) -> None:
    """Refuse a hub so low that its airframe, level, is in the ground."""
    level = np.zeros(len(core.state_names()))
    # the quaternion of no rotation
    level[6] = 1.0
    least = core.least_height(level)
    if least is not None and least <= 0.0:
        allowed = f"must be above {height - least:.4g} m, by which the hub is above the lowest place of the airframe that counts"
        raise InputError.of("height", f"{height:g} m", allowed)


@dataclass(frozen=True)
class Model(CompiledRotor):
    """Aircraft, condition and inflow model compiled into F(y_dot, y, u; t) = 0."""

    aircraft: Aircraft
    condition: CompleteCondition
    inflow: InflowModel
    core: _core.System
    data: dict[str, Any]
    density: float
    speed_of_sound: float
    target: Target | None = None
    """What a trim meets with a part of the condition's path left free."""
    n_harmonics: int = 8
    rotor_speed: Corners = ()
    """Time [s] and share of the nominal rotor speed; none at constant speed."""
    drive: str = ""
    """Drive train of a rotor that engines turn, as the core reads it (JSON); empty where none do."""
    is_over_ground: bool = False
    """Whether the rotor keeps its speed over the ground: azimuth and speed about the airframe are then states."""
    n_controls: ClassVar[int] = 4

    @classmethod
    def build(
        cls,
        aircraft: Aircraft,
        condition: CompleteCondition,
        inflow: InflowModel,
        target: Target | None = None,
        n_harmonics: int = 8,
    ) -> Model:
        """Compile; the tip loss is off and the inflow states are out of y with a free wake.

        Options of the wake that depend on the regime take the numbers of the condition's.
        """
        density, speed_of_sound, _ = _core.standard_atmosphere(condition.altitude)
        data = aircraft.core_data(condition)
        if condition.height is not None:
            inflow = inflow.above_ground()
        inflow = inflow.resolved(flight_regime(aircraft, condition))
        inflow.step(aircraft)
        resolved = resolution(aircraft.discretisation, inflow.n_stations)
        lift = "tables" if inflow.is_second_order else None
        chosen = setting((density, speed_of_sound), not inflow.is_dynamic, resolved, lift=lift, **inflow.sections)
        core = _core.System.aircraft(json.dumps(data), chosen)
        if condition.height is not None:
            core = core.above_ground(condition.height)
            _check_clearance(core, condition.height)
        return cls(aircraft, condition, inflow, core, data, density, speed_of_sound, target, n_harmonics)

    @property
    def hand(self) -> float:
        """-1 of a clockwise rotor, which the core computes as its mirror image."""
        return float(self.rotor["hand"])

    @property
    def side(self) -> float:
        """-1 of an aircraft that is the mirror image of its file: its tail rotor pushes the other way."""
        return -1.0 if self.data.get("mirrored") else 1.0

    @property
    def question(self) -> Question:
        """The condition: balances, lateral convention, and what is met with parts of the path left free."""
        c = self.condition
        equations: list[tuple[str, tuple[float, ...]]] = [
            *BALANCES,
            ("convention", (c.bank or 0.0, c.sideslip or 0.0, c.bank_share)),
        ]
        free = []
        if self.target is not None:
            equations.append((self.target.name, (self.target.value,)))
            free.append(self.target.free)
        if c.load_factor is not None:
            equations.append(("load_factor", (c.load_factor, c.turn_side)))
            free.append("turn_rate")
        return Question(tuple(equations), (c.speed, c.flight_path, c.turn_rate), tuple(free))

    def flown(self, problem: _core.TrimProblem, x: np.ndarray) -> Model:
        """This model with what was found of the path in its condition."""
        if not self.question.free:
            return self
        speed, flight_path, turn_rate = self.core.trim_path(problem, x)
        condition = self.condition.changed(speed=speed, flight_path=flight_path, turn_rate=turn_rate)
        return replace(self, condition=condition)

    def normalised(self, x: np.ndarray) -> np.ndarray:
        """`x` with roll and heading in (-pi, pi]."""
        x = x.copy()
        for i in (ROLL, YAW):
            # rounding at -pi does not turn a heading about
            turned = np.remainder(x[i] + np.pi - 1e-9, 2 * np.pi) - np.pi + 1e-9
            x[i] = min(turned, np.pi)
        return x

    def is_answer(self, problem: _core.TrimProblem, x: np.ndarray) -> bool:
        """Whether it is the flight asked for: not looping, not backwards along its path or where the heading is left free."""
        free = self.condition.bank_share > 0.5
        speed, flight_path, _ = self.core.trim_path(problem, x)
        along = speed >= 0.0 and abs(flight_path) <= 0.5 * np.pi
        return along and abs(x[PITCH]) < 0.5 * np.pi and not (free and abs(x[YAW]) > 0.5 * np.pi)

    def __reduce__(self) -> tuple[Any, ...]:
        """Compiled anew where it is needed."""
        built = (self.aircraft, self.condition, self.inflow, self.target, self.n_harmonics)
        return _rebuilt, (built, self.rotor_speed, self.drive, self.is_over_ground)

    def at_speed(self, corners: Corners) -> Model:
        """This model with a rotor speed in time."""
        return self if not corners else replace(self, core=turning_core(self, corners), rotor_speed=corners)

    @property
    def has_free_speed(self) -> bool:
        """Whether azimuth and speed of the rotor are states."""
        return bool(self.drive) or self.is_over_ground

    def over_ground(self) -> Model:
        """This model with its rotor constant in speed over the ground."""
        return replace(self, core=self.core.over_ground(), is_over_ground=True)

    def driven(self, power: float, governed: bool) -> Model:
        """This model with azimuth and speed as states, engines in balance at `power` [W], held by the governor or not."""
        inertia, of_hub = self.aircraft.drive_inertia
        gains, lag = self.aircraft.governor if governed else ((), 0.0)
        governor = {"power": power, "gains": gains, "lag": lag} if governed else None
        return self._driven_by(json.dumps({"inertia": inertia, "hub_inertia": of_hub, "governor": governor}))

    def _driven_by(self, drive: str) -> Model:
        if not drive:
            return self
        return replace(self, core=self.core.with_drive(drive), drive=drive)

    @property
    def rotor_tables(self) -> dict[str, Any]:
        """Blade and airfoil as the core was given them."""
        found: dict[str, Any] = self.data["rotor"]
        return found

    def linearised(self) -> _core.Linearised:
        """Room for the derivatives of F."""
        return _core.Linearised(self.core)

    def pitch_controls(self, stick: np.ndarray) -> np.ndarray:
        """theta_1c, theta_1s, theta_0, theta_tr [rad] for sticks [m]."""
        rigging = self.data["rigging"]
        found: np.ndarray = np.asarray(rigging["offset"]) + np.asarray(rigging["matrix"]) @ stick
        return found

    @property
    def accessory_power(self) -> float:
        """Power of accessories [W]."""
        return float(self.data["accessory_power"])


def _rebuilt(built: tuple[Any, ...], corners: Corners, drive: str, over_ground: bool = False) -> Model:
    """A model compiled anew of what `Model.build` takes."""
    model = Model.build(*built).at_speed(corners)._driven_by(drive)
    return model.over_ground() if over_ground else model
