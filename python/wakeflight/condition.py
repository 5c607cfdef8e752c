# SPDX-License-Identifier: MIT OR Apache-2.0
"""Flight condition: how fast, along which path, how high, how heavy, and how trim is to be asked for."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Protocol

from . import regime as regimes
from .arguments import checked
from .errors import InputError, known
from .units import STANDARD_GRAVITY, convert, mass_of_weight, number, quantity, shown

HEADING_FREE_SPEED = convert(60.0, "kt", "m/s")
"""Speed [m/s] from which trim asks for zero bank, heading free."""
ALIGNED_SPEED = convert(50.0, "kt", "m/s")
"""Speed [m/s] up to which trim asks for zero sideslip, bank free; between the two the one passes into the other."""
SLOWEST_FREE = 1.0
"""Least horizontal speed [m/s] at which the heading can be left free."""
COORDINATED_TURN = 0.05
"""Lateral acceleration of a turn over that of gravity from which trim asks for zero sideslip at any speed."""

# SI unit, smallest, largest, unit shown
_RANGES = {
    "speed": ("m/s", 0.0, convert(500.0, "kt", "m/s"), "kt"),
    "flight_path": ("rad", -math.pi / 2, math.pi / 2, "deg"),
    "altitude": ("m", -500.0, 11000.0, "m"),
    "sideslip": ("rad", -math.pi, math.pi, "deg"),
    "turn_rate": ("rad/s", -math.pi / 2, math.pi / 2, "deg/s"),
    "bank": ("rad", -math.radians(85.0), math.radians(85.0), "deg"),
    "height": ("m", 0.0, 1000.0, "m"),
}
_MASS = (10.0, 1e5)
_LOAD_FACTOR = (1.0, 5.0)
TURNS = {"right": 1.0, "left": -1.0}
"""Directions of a turn, each with the sign of its rate."""


_US = {"m": "ft"}


def described(values: dict[str, Any], units: str = "si") -> str:
    """A condition as results keep it (SI, radians), with the units it is given in: `speed 80 kt, flight path -6 deg`.

    units: `us` for feet and pounds in place of metres and kilograms.
    """
    us = units == "us"
    parts = []
    for name, value in values.items():
        if name == "bank_share":
            # the heading says it but for the conditions between
            if value in (0.0, 1.0):
                continue
            value = f"{value:.2f}"
        elif name in _RANGES:
            unit = _RANGES[name][3]
            value = shown(value, _US.get(unit, unit) if us else unit)
        elif name == "load_factor":
            value = f"{value:g}"
        elif name == "gross_mass":
            value = shown(value, "lb" if us else "kg")
        parts.append(f"{name.replace('_', ' ')} {value}")
    return ", ".join(parts)


class Completing(Protocol):
    """What fills in a condition: an aircraft."""

    def default(self, name: str, named: str | None = None) -> Any:
        """A value of its own condition, or of the one it calls `named`."""


@dataclass(frozen=True, init=False)
class FlightCondition:
    """Flight condition, SI and radians inside; what is not given is None until an aircraft completes it.

    speed [m/s]: true airspeed, never negative. flight_path [rad]: climb +. altitude [m]: standard atmosphere.
    gross_mass [kg]: of the weight given as force (lbf, N) or mass (lb, kg), weight = mass x 9.80665 m/s2.
    sideslip [rad]: wind from the right +, 180 deg is rearward flight. turn_rate [rad/s]: to the right +.
    bank [rad]: to the right +. heading: `free` (bank as given or zero, sideslip found by trim) or `aligned`
    (sideslip as given or zero, bank found by trim; in slow, vertical and steep flight the heading against the track is minus
    that sideslip). Not given, `free` at 60 kt and above in straight flight along paths within 30 deg of level.
    bank_share: share of the bank in the lateral convention, 1 free and 0 aligned; not given, it passes from one to the other
    without a jump: between 50 and 60 kt, with paths of 30 to 60 deg, and with turns up to 0.05 g.
    load_factor: resultant of all loads but gravity over the weight, from 1 on, a plain number; trim finds the rate of the turn,
    `turn` = `right` or `left`, in which it is n = sqrt(1 + (turn_rate speed cos(flight_path)/g)^2). In a level turn without
    sideslip it is lift over weight, and 1/cos(bank) but for side forces.
    height [m]: of the main rotor's hub above flat ground where the flight begins, the airframe level; not given, no ground.
    """

    speed: float | None
    flight_path: float | None
    altitude: float | None
    gross_mass: float | None
    sideslip: float | None
    turn_rate: float
    bank: float | None
    heading: str | None
    bank_share: float | None
    load_factor: float | None
    turn: str | None
    height: float | None

    @checked
    def __init__(
        self,
        speed: Any = None,
        flight_path: Any = None,
        altitude: Any = None,
        weight: Any = None,
        sideslip: Any = None,
        turn_rate: Any = None,
        bank: Any = None,
        heading: str | None = None,
        load_factor: float | None = None,
        turn: str | None = None,
        height: Any = None,
    ) -> None:
        """Read and check what is given: text with units, or pint quantities."""
        given = {
            "speed": speed,
            "flight_path": flight_path,
            "altitude": altitude,
            "sideslip": sideslip,
            "turn_rate": turn_rate,
            "bank": bank,
            "height": height,
        }
        for name, value in given.items():
            number = None if value is None else _in_range(name, value)
            object.__setattr__(self, name, 0.0 if name == "turn_rate" and number is None else number)
        mass = None if weight is None else mass_of_weight(weight)
        if mass is not None and not _MASS[0] <= mass <= _MASS[1]:
            allowed = f"must lie between {shown(_MASS[0], 'kg')} and {shown(_MASS[1], 'kg')} (times 9.80665 m/s2)"
            raise InputError.of("weight", weight, allowed)
        object.__setattr__(self, "gross_mass", mass)
        object.__setattr__(self, "load_factor", _load_factor(load_factor, turn_rate))
        object.__setattr__(self, "turn", _turn(turn, load_factor))
        object.__setattr__(self, "heading", _heading(heading, self.sideslip, self.bank))
        named = {"free": 1.0, "aligned": 0.0}
        object.__setattr__(self, "bank_share", None if self.heading is None else named[self.heading])

    @property
    def weight(self) -> float | None:
        """Weight [N]: gross mass times standard gravity."""
        return None if self.gross_mass is None else self.gross_mass * STANDARD_GRAVITY

    @property
    def is_complete(self) -> bool:
        """Whether nothing is left for an aircraft to fill in."""
        return None not in (self.speed, self.flight_path, self.altitude, self.gross_mass, self.heading)

    def regime(self, tip_speed: float) -> str:
        """Regime (`wakeflight.regime`) of a rotor whose shaft stands upright: horizontal speed across it, vertical along it."""
        speed, flight_path = known(self.speed), known(self.flight_path)
        across, up = speed * math.cos(flight_path), speed * math.sin(flight_path)
        return regimes.regime(across, up, tip_speed)

    def completed(self, aircraft: Completing, named: str | None = None) -> CompleteCondition:
        """This condition completed by the aircraft; `named`: one of its alternative conditions."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        for name in ("speed", "flight_path", "altitude", "gross_mass"):
            if values[name] is None:
                values[name] = aircraft.default(name, named)
        if self.load_factor is not None:
            values["turn_rate"] = self._rate_of_turn(
                self.load_factor, values["speed"] * math.cos(values["flight_path"])
            )
        if values["heading"] is None:
            share = _bank_share(values["speed"], values["flight_path"], values["turn_rate"])
            values["heading"], values["bank_share"] = "free" if share == 1.0 else "aligned", share
        elif values["heading"] == "free" and values["speed"] * math.cos(values["flight_path"]) < SLOWEST_FREE:
            allowed = (
                f"at a horizontal speed below {shown(SLOWEST_FREE, 'm/s')} no heading changes the side force; "
                "heading = aligned lets trim find the bank"
            )
            raise InputError.of(
                "heading", "free" if self.bank is None else f"free (bank {shown(self.bank, 'deg')})", allowed
            )
        if values["heading"] == "free":
            values["bank"] = 0.0 if values["bank"] is None else values["bank"]
        else:
            values["sideslip"] = 0.0 if values["sideslip"] is None else values["sideslip"]
        return self._with(values)

    @property
    def turn_side(self) -> float:
        """1 of a turn to the right, -1 of one to the left."""
        return TURNS[self.turn or "right"]

    def _rate_of_turn(self, load_factor: float, horizontal_speed: float) -> float:
        """Rate of turn [rad/s] that gives the load factor."""
        across = math.sqrt(load_factor**2 - 1.0)
        if across > 0.0 and horizontal_speed < SLOWEST_FREE:
            allowed = f"1 at a horizontal speed below {shown(SLOWEST_FREE, 'm/s')}: no turn gives more"
            raise InputError.of("load_factor", load_factor, allowed)
        return self.turn_side * STANDARD_GRAVITY * across / max(horizontal_speed, SLOWEST_FREE)

    def changed(self, **values: float) -> CompleteCondition:
        """This condition with some numbers changed, SI and radians, unchecked: a step of a continuation."""
        return self._with({**{field.name: getattr(self, field.name) for field in fields(self)}, **values})

    @staticmethod
    def _with(values: dict[str, Any]) -> CompleteCondition:
        whole = object.__new__(CompleteCondition)
        for name, value in values.items():
            object.__setattr__(whole, name, value)
        return whole

    def as_attributes(self) -> dict[str, float | str]:
        """What is set, by name, SI and radians, for the attributes of a result."""
        values = {field.name: getattr(self, field.name) for field in fields(self)}
        return {name: value for name, value in values.items() if value is not None}


if TYPE_CHECKING:

    @dataclass(frozen=True, init=False)
    class CompleteCondition(FlightCondition):
        """A flight condition with nothing left to fill in, to whoever checks types; when the program runs there is one class."""

        speed: float
        flight_path: float
        altitude: float
        gross_mass: float
        heading: str
        bank_share: float

        @property
        def weight(self) -> float:
            """Weight [N]: gross mass times standard gravity."""

else:
    CompleteCondition = FlightCondition


@checked
def condition_for(
    aircraft: Completing, condition: FlightCondition | None = None, named: str | None = None, **given: Any
) -> CompleteCondition:
    """Complete condition: `condition`, or one made of `given` (text with units); the rest from the aircraft.

    named: an alternative condition of the file to take the rest from.
    """
    if condition is not None and given:
        raise InputError.of("condition", ", ".join(given), "give either a condition or its values, not both")
    return (condition or FlightCondition(**given)).completed(aircraft, named)


def _in_range(name: str, value: Any) -> float:
    si_unit, low, high, unit = _RANGES[name]
    number = quantity(value, si_unit, name)
    slack = 1e-12 * max(abs(low), abs(high))
    if not low - slack <= number <= high + slack:
        raise InputError.of(name, value, f"must lie between {shown(low, unit)} and {shown(high, unit)}")
    return number


def _load_factor(value: Any, turn_rate: Any) -> float | None:
    """Load factor as a number in its range, None where none is given."""
    if value is None:
        return None
    if turn_rate is not None:
        raise InputError.of("turn_rate", turn_rate, "trim finds it where a load factor is given")
    low, high = _LOAD_FACTOR
    return number("load_factor", value, low, high)


def _turn(turn: Any, load_factor: Any) -> str | None:
    """Direction of a turn that is given by its load factor."""
    if turn is None:
        return None
    if turn not in TURNS:
        raise InputError.choice("turn", turn, TURNS)
    if load_factor is None:
        raise InputError.of("turn", turn, "belongs to a load factor, and none is given")
    return str(turn)


def _bank_share(speed: float, flight_path: float, turn_rate: float) -> float:
    """Share of zero bank in the lateral convention where none is named: of fast, flat and straight flight."""
    fast = (speed - ALIGNED_SPEED) / (HEADING_FREE_SPEED * (1.0 - 1e-9) - ALIGNED_SPEED)
    flat = 2.0 * math.cos(flight_path) ** 2 - 0.5
    turning = abs(turn_rate) * speed * math.cos(flight_path) / (COORDINATED_TURN * STANDARD_GRAVITY)
    return smooth_step(fast) * smooth_step(flat + 1e-9) * (1.0 - smooth_step(turning))


def smooth_step(x: float) -> float:
    """0 up to 0, 1 from 1 on, with continuous slope."""
    x = min(max(x, 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


def _heading(heading: str | None, sideslip: float | None, bank: float | None) -> str | None:
    """Convention of trim from what is given; sideslip and bank together would ask for too much."""
    if heading not in (None, "free", "aligned"):
        raise InputError.of("heading", heading, "allowed: free (bank given or zero), aligned (sideslip given or zero)")
    if sideslip is not None and (bank is not None or heading == "free"):
        raise InputError.of("sideslip", shown(sideslip, "deg"), "trim finds it where bank is given or heading is free")
    if bank is not None and heading == "aligned":
        raise InputError.of("bank", shown(bank, "deg"), "trim finds it where heading is aligned")
    if sideslip is not None:
        return "aligned"
    return "free" if bank is not None else heading


FREE = ("flight_path", "speed")
"""What of the path can be left free, the first where nothing is said."""
UNITS = {"power": ("W", "hp"), "collective": ("rad", "deg")}
"""SI unit of what can be asked for, and the one it is shown in."""


@dataclass(frozen=True)
class Target:
    """A value that a trim meets with a part of its path left free, SI."""

    name: str
    value: float
    free: str

    def at(self, value: float) -> Target:
        """The same asked for another value."""
        return Target(self.name, value, self.free)

    def shown(self, value: float) -> str:
        """A value of what is asked for, with its unit."""
        return shown(value, UNITS[self.name][1])


def target(
    condition: CompleteCondition, power: Any = None, collective: Any = None, free: str | None = None
) -> Target | None:
    """The target of a trim in a complete condition, from text with units or pint quantities; None where nothing is asked."""
    if free is not None and free not in FREE:
        raise InputError.choice("free", free, FREE)
    given = {name: value for name, value in (("power", power), ("collective", collective)) if value is not None}
    if not given:
        if free is not None:
            raise InputError.of("free", free, "needs a power or a collective that it is left free for")
        return None
    if len(given) > 1:
        raise InputError.of("collective", collective, "give either power or collective")
    ((name, value),) = given.items()
    found = Target(name, quantity(value, UNITS[name][0], name), free or FREE[0])
    if condition.speed < SLOWEST_FREE:
        allowed = f"a speed of {shown(SLOWEST_FREE, 'm/s')} and more: at rest there is no path to leave free for {name}"
        raise InputError.of("speed", shown(condition.speed, "kt"), allowed)
    return found
