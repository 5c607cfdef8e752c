# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a rotor on a stand meets: wind, shaft angle, air, rotor speed; and what its pitch is found from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .. import _core
from .. import regime as regimes
from ..aircraft import Rotor
from ..errors import InputError
from ..units import number, quantity, shown

BLADE_LOADING = 0.07
"""C_T/sigma of a rotor of which nothing is asked and whose file names no weight: that of cruise, well below stall."""

HEADS = ("collective", "thrust", "ct", "torque", "power")
"""What fixes the collective, one of them."""
CYCLICS = ("lateral_cyclic", "longitudinal_cyclic", "flapping", "hub_roll", "hub_pitch")
"""What fixes the cyclic pitch."""

PitchHarmonic = tuple[int, float, float]
"""Order n, cosine and sine [rad] of a higher-harmonic pitch."""


@dataclass(frozen=True)
class StandCondition:
    """Condition on the stand, SI and radians.

    velocity: of the hub through the air, hub axes (x aft, y right, z up along the shaft) [m/s]; rates: of the stand,
    hub axes [rad/s]; controls: three equations (name, value) the pitch controls are found from.
    """

    velocity: tuple[float, float, float]
    rates: tuple[float, float, float]
    density: float
    speed_of_sound: float
    controls: tuple[tuple[str, float], ...]
    higher: tuple[PitchHarmonic, ...]
    as_given: dict[str, Any]
    assumed: tuple[str, ...] = ()
    """What was taken for granted because nothing fixes it, in words."""

    def mu(self, tip_speed: float) -> float:
        """Advance ratio: in-plane speed over tip speed."""
        return math.hypot(self.velocity[0], self.velocity[1]) / tip_speed

    def mu_z(self, tip_speed: float) -> float:
        """Speed of the hub down the shaft over tip speed: descent positive, the air then comes from below."""
        return -self.velocity[2] / tip_speed

    def regime(self, tip_speed: float) -> str:
        """Regime of the rotor, see `wakeflight.regime`."""
        return regimes.regime(math.hypot(self.velocity[0], self.velocity[1]), self.velocity[2], tip_speed)

    @property
    def trimmed(self) -> bool:
        """Whether any pitch control is found from a load or from flapping."""
        given = {"collective", "lateral_cyclic", "longitudinal_cyclic"}
        return any(name not in given for name, _ in self.controls)


def within(field: str, value: Any, si_unit: str, low: float, high: float, unit: str) -> float:
    """`value` in SI, refused outside low..high (SI; shown in `unit`)."""
    found = quantity(value, si_unit, field)
    slack = 1e-12 * max(abs(low), abs(high))
    if not low - slack <= found <= high + slack:
        raise InputError.of(field, value, f"must lie between {shown(low, unit)} and {shown(high, unit)}")
    return found


def hub_velocity(speed: Any, shaft_angle: Any, climb: Any) -> tuple[float, float, float]:
    """Velocity of the hub through the air, hub axes [m/s].

    The wind blows aft at `speed`; the shaft is tilted aft by `shaft_angle`, so that a positive angle has the disk met
    from below; `climb` along the shaft comes on top, up positive.
    """
    v = within("speed", speed, "m/s", 0.0, 300.0, "m/s")
    angle = within("shaft_angle", shaft_angle, "rad", -math.pi / 2, math.pi / 2, "deg")
    up = within("climb", climb, "m/s", -200.0, 200.0, "m/s")
    return (-v * math.cos(angle), 0.0, -v * math.sin(angle) + up)


def air(altitude: Any, density: Any, speed_of_sound: Any) -> tuple[float, float]:
    """Density [kg/m3] and speed of sound [m/s]: as given, the rest of the standard atmosphere at `altitude`."""
    height = within("altitude", altitude, "m", -500.0, 11000.0, "m")
    rho, a, _ = _core.standard_atmosphere(height)
    if density is not None:
        rho = within("density", density, "kg/m3", 1e-3, 100.0, "kg/m3")
    if speed_of_sound is not None:
        a = within("speed_of_sound", speed_of_sound, "m/s", 10.0, 1e6, "m/s")
    return rho, a


def rotor_speed(rotor: Rotor, omega: Any, rpm: Any) -> float:
    """Rotor speed [rad/s]: text with a unit, a number of revolutions per minute, or the rotor's own."""
    if omega is not None and rpm is not None:
        raise InputError.of("rpm", rpm, "give either omega or rpm")
    if rpm is not None:
        if not 1e-3 <= number("rpm", rpm) <= 1e5:
            raise InputError.of("rpm", rpm, "must be a number of revolutions per minute from 0.001 to 100000")
        return float(rpm) * math.pi / 30.0
    if omega is not None:
        return within("omega", omega, "rad/s", 1e-3, 1e4, "rad/s")
    return rotor.omega


def higher_harmonics(given: Sequence[Any], n_blade_harmonics: int) -> tuple[PitchHarmonic, ...]:
    """Higher-harmonic pitch from (order, cosine, sine) or {order, amplitude, phase}; amplitude cos(order psi - phase)."""
    harmonics = []
    if isinstance(given, dict):
        given = [given]
    if isinstance(given, tuple) and len(given) == 3 and isinstance(given[0], int):
        given = [given]
    for entry in given:
        form = "must be (order, cosine, sine) or {'order', 'amplitude', 'phase'}, angles as text with units"
        if isinstance(entry, dict):
            if set(entry) != {"order", "amplitude", "phase"}:
                raise InputError.of("higher_harmonics", entry, form)
            order = entry["order"]
            amplitude = within("higher_harmonics amplitude", entry["amplitude"], "rad", 0.0, 0.5, "deg")
            phase = within("higher_harmonics phase", entry["phase"], "rad", -4 * math.pi, 4 * math.pi, "deg")
            cosine, sine = amplitude * math.cos(phase), amplitude * math.sin(phase)
        elif isinstance(entry, Sequence) and not isinstance(entry, str) and len(entry) == 3:
            order = entry[0]
            cosine = within("higher_harmonics cosine", entry[1], "rad", -0.5, 0.5, "deg")
            sine = within("higher_harmonics sine", entry[2], "rad", -0.5, 0.5, "deg")
        else:
            raise InputError.of("higher_harmonics", entry, form)
        if isinstance(order, bool) or not isinstance(order, int) or not 2 <= order <= n_blade_harmonics:
            raise InputError.of(
                "higher_harmonics order", order, f"must be a whole number from 2 to n_harmonics = {n_blade_harmonics}"
            )
        harmonics.append((order, cosine, sine))
    return tuple(harmonics)


def filled(
    rotor: Rotor, in_plane: float, density: float, asked: dict[str, Any]
) -> tuple[dict[str, Any], tuple[str, ...]]:
    """`asked` (see `control_equations`) with what it leaves open, and what was assumed, in words.

    Without a collective or a load: the weight that the file names as thrust, else the blade loading `BLADE_LOADING`. If cyclic
    pitch, flapping and hub moments are open as well and the rotor moves in its plane at all (in_plane [m/s]): no flapping, or,
    where clamped rigid blades cannot flap, no hub moments.
    """
    if any(asked[name] is not None for name in HEADS):
        return asked, ()
    whole, words = dict(asked), []
    if rotor.weight is not None:
        whole["thrust"] = f"{rotor.weight!r} N"
        words.append(f"thrust = {shown(rotor.weight, 'N')}, the weight that the file of {rotor.name} names")
    else:
        tip_speed = rotor.omega * rotor.radius
        thrust = BLADE_LOADING * rotor.solidity * density * math.pi * rotor.radius**2 * tip_speed**2
        whole["thrust"] = f"{thrust!r} N"
        words.append(f"C_T/sigma = {BLADE_LOADING:g}, as the file of {rotor.name} names no weight")
    if in_plane > 0.0 and all(asked[name] is None for name in CYCLICS):
        if rotor.discretisation.n_modes > 0:
            whole["flapping"] = "zero"
            words.append("no first-harmonic flapping")
        else:
            whole |= {"hub_roll": "zero", "hub_pitch": "zero"}
            words.append("no hub moments: the blades do not flap")
    return whole, tuple(words)


def control_equations(
    rotor: Rotor, density: float, omega: float, asked: dict[str, Any]
) -> tuple[tuple[str, float], ...]:
    """The three equations (name, SI value) that the pitch controls are found from.

    asked: collective, collective_at, lateral_cyclic, longitudinal_cyclic, thrust, ct, torque, power, flapping, hub_roll,
    hub_pitch.
    """
    limit = math.radians(90.0)
    heads = [name for name in HEADS if asked[name] is not None]
    if len(heads) > 1:
        raise InputError.of(heads[1], asked[heads[1]], f"give one of {', '.join(HEADS)}; {heads[0]} is given")
    if asked["collective"] is None and asked["collective_at"] != "root":
        raise InputError.of("collective_at", asked["collective_at"], "belongs to a collective, and none is given")
    area = math.pi * rotor.radius**2
    dynamic = density * area * (omega * rotor.radius) ** 2
    if asked["thrust"] is not None:
        newtons = quantity(asked["thrust"], "N", "thrust")
        first = ("thrust", newtons)
    elif asked["ct"] is not None:
        first = ("thrust", number("ct", asked["ct"], -0.1, 0.1) * dynamic)
    elif asked["torque"] is not None:
        text = asked["torque"]
        first = ("torque", 0.0 if text == "zero" else quantity(text, "N m", "torque"))
    elif asked["power"] is not None:
        first = ("torque", quantity(asked["power"], "W", "power") / omega)
    else:
        pitch = within("collective", asked["collective"], "rad", -limit, limit, "deg")
        first = ("collective", pitch - _reference_twist(rotor, asked["collective_at"]))

    cyclic = [name for name in ("lateral_cyclic", "longitudinal_cyclic") if asked[name] is not None]
    moments = [name for name in ("hub_roll", "hub_pitch") if asked[name] is not None]
    kinds = [bool(cyclic), asked["flapping"] is not None, bool(moments)]
    if sum(kinds) > 1:
        raise InputError.of(
            "flapping" if kinds[1] else "hub_roll, hub_pitch",
            "given with another",
            "give cyclic pitch, flapping or hub moments, not two of them",
        )
    if asked["flapping"] is not None:
        return (first, *_flapping(rotor, asked["flapping"]))
    if moments:
        return (first, *((name, _moment(name, asked[name])) for name in ("hub_roll", "hub_pitch")))
    angles = (
        (name, 0.0 if asked[name] is None else within(name, asked[name], "rad", -limit, limit, "deg"))
        for name in ("lateral_cyclic", "longitudinal_cyclic")
    )
    return (first, *angles)


def _reference_twist(rotor: Rotor, at: Any) -> float:
    """Twist [rad] at the radius the collective is stated for: `root` (none), or a share of the radius such as "0.75 R"."""
    if at == "root":
        return 0.0
    share = at.strip().removesuffix("R").strip() if isinstance(at, str) and at.strip().endswith("R") else None
    try:
        value = float(share) if share is not None else -1.0
    except ValueError:
        value = -1.0
    if not 0.0 < value <= 1.0:
        raise InputError.of(
            "collective_at", at, "must be 'root' (twist of the file added) or a radius such as '0.75 R'"
        )
    return rotor.twist(value * rotor.radius)


def _flapping(rotor: Rotor, flapping: Any) -> tuple[tuple[str, float], ...]:
    if rotor.discretisation.n_modes == 0:
        raise InputError.of("flapping", flapping, "the blades of this rotor do not flap: clamped and rigid")
    if isinstance(flapping, str) and flapping == "zero":
        values: tuple[float, ...] = (0.0, 0.0)
    elif isinstance(flapping, Sequence) and not isinstance(flapping, str) and len(flapping) == 2:
        values = tuple(within("flapping", each, "rad", -0.5, 0.5, "deg") for each in flapping)
    else:
        raise InputError.of("flapping", flapping, "must be 'zero' or a pair (beta_1c, beta_1s) of texts with units")
    return ("beta_1c", values[0]), ("beta_1s", values[1])


def _moment(field: str, value: Any) -> float:
    return 0.0 if value is None or (isinstance(value, str) and value == "zero") else quantity(value, "N m", field)
