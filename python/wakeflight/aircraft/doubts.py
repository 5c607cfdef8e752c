# SPDX-License-Identifier: MIT OR Apache-2.0
"""What an airframe could have but hardly has: told, not refused. A factor of ten or a wrong sign mostly shows here."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ..errors import known
from ..units import STANDARD_GRAVITY
from .rotor_doubts import SEA_LEVEL_DENSITY, in_grid, interpolated
from .schema import AircraftFile, Loading, TailRotor

TAIL_SLOPE = 1.0
"""Lift slope [1/rad] of a wing as wide as two thirds of its chord; shorter ones are no tails."""

PLATE_DRAG = 0.5
"""Drag coefficient at 90 deg that every plate exceeds twice."""

DRAG_AREAS = (0.002, 0.05)
"""Equivalent flat-plate area of the fuselage over disk area: clean helicopters have 0.005, cranes 0.02."""

DEAD_AIR = 0.2
"""Ratio of dynamic pressures at the tail below that of any wake of a fuselage."""

CG_OFFSET = 0.1
"""Horizontal distance of the centre of gravity from the hub over the radius: what tilts the disk by ten degrees and more."""

GYRATION = (0.03, 0.6)
"""Radius of gyration of an airframe over the rotor's radius: a fuselage with its tail reaches 1.2 radii and has 0.1 to 0.35."""

BLADE_LOADINGS = (0.01, 0.2)
"""Weight over blade area and tip speed squared: rotors stall before 0.2, and one below 0.01 carries no helicopter."""

REACH = (2.0, 0.5, 0.6)
"""Distance of a part of the airframe from the centre of gravity in radii: along (a tail rotor turns just outside of the disk),
across and upright."""

TAIL_AREA = 0.1
"""Area of a tail surface over disk area: stabilators and fins have 0.01 to 0.03."""

TAIL_DRAG = (0.002, 0.05)
"""Drag coefficient of a tail rotor's blades without lift: sections have 0.006 to 0.012."""

POWERS = (1.0, 8.0)
"""Limit of power over the ideal power of hover at sea level: below one it does not hover, helicopters have 2 to 3."""

LARGEST_TILT = math.radians(15.0)
"""Tilt of a shaft [rad]: helicopters have 3 to 5 deg."""

LARGEST_PHASE = math.radians(45.0)
"""Phase of a swashplate [rad] beyond which lateral stick acts more fore and aft than sideways."""

LARGEST_INCIDENCE = math.radians(30.0)
"""Fixed incidence of a tail surface [rad], beyond its stall."""


def doubts_of_aircraft(spec: AircraftFile, parts: dict[str, Any]) -> list[str]:
    """Warnings about airframe, loading and limits. parts: as the core is given them, SI."""
    warnings = [*_controls(spec), *_places(spec), *_power(spec)]
    for name, loading in {"loading": spec.loading, **{f"loadings.{k}": v for k, v in spec.loadings.items()}}.items():
        warnings += _loading(name, loading, spec, parts)
    for name in ("stabilator", "fin"):
        if parts[name] is not None:
            warnings += _tail(name, getattr(spec, name).position, parts[name], spec)
    if spec.tail_rotor is not None:
        warnings += _tail_rotor(spec.tail_rotor, spec)
    if parts["fuselage"] is not None:
        warnings += _fuselage(parts["fuselage"], float(spec.rotor.radius))
    wash = parts["interference"]
    if wash is not None and wash["kind"] == "tables":
        for key in ("q_ratio_stabilator", "q_ratio_fin"):
            least = min(wash[key]["y"])
            if least < DEAD_AIR:
                warnings.append(
                    f"interference.{key}: {least:.3g} of the dynamic pressure of flight; the tail is in dead air"
                )
        if not sum(map(sum, wash["ekz_tail"]["values"])) > 0.0:
            warnings.append(
                "interference.rotor_wash: ekz_tail is up in the mean; the wake behind a lifting rotor goes down"
            )
    elif wash is not None:
        warnings += [
            f"interference.{key}: below 0; the wake of a lifting rotor goes down"
            for key in ("fuselage", "stabilator")
            if wash[key] < 0.0
        ]
    structure = spec.rotor.blade.structure
    if spec.rotor.blade.straight_tip and structure is not None and not structure.has("x_cg_straight"):
        warnings.append("rotor.blade.straight_tip: the structure has no column x_cg_straight; x_cg is used")
    return warnings


def _controls(spec: AircraftFile) -> list[str]:
    """Tilt of the shaft, phase of the swashplate, fixed incidences."""
    rotor = spec.rotor
    angles = {
        "rotor.shaft.forward": (rotor.shaft_tilt_forward, LARGEST_TILT),
        "rotor.shaft.lateral": (rotor.shaft_tilt_lateral, LARGEST_TILT),
        "rotor.swashplate_phase": (rotor.swashplate_phase, LARGEST_PHASE),
        "stabilator.incidence": (spec.stabilator and spec.stabilator.incidence, LARGEST_INCIDENCE),
        "fin.incidence": (spec.fin and spec.fin.incidence, LARGEST_INCIDENCE),
    }
    return [
        f"{key}: {math.degrees(angle):.4g} deg, beyond {math.degrees(bound):.4g}"
        for key, (angle, bound) in angles.items()
        if angle is not None and abs(angle) > bound
    ]


def _places(spec: AircraftFile) -> list[str]:
    """Parts of the airframe by the centre of gravity: stations, buttlines and waterlines from one datum lie within reach."""
    base, radius = spec.loading, float(spec.rotor.radius)
    centre = (base.cg_station, base.cg_buttline, base.cg_waterline)
    places = {"rotor.position": spec.rotor.hub}
    if spec.tail_rotor is not None:
        places["tail_rotor.position"] = spec.tail_rotor.hub
    for name in ("stabilator", "fin", "fuselage"):
        if getattr(spec, name) is not None:
            places[f"{name}.position"] = getattr(spec, name).position
    return [
        f"{key}: {abs(at - origin) / radius:.2g} rotor radii from the centre of gravity in {axis}; parts lie within {reach:g}"
        for key, place in places.items()
        for axis, at, origin, reach in zip(("station", "buttline", "waterline"), place, centre, REACH, strict=True)
        if abs(at - origin) > reach * radius
    ]


def _power(spec: AircraftFile) -> list[str]:
    """Stated limits by what momentum theory asks for in hover, W sqrt(W / (2 rho A)), the least any rotor needs."""
    if spec.limits is None:
        return []
    omega, limits = float(spec.rotor.omega), spec.limits
    warnings = []
    if limits.rotor_speed is not None and not limits.rotor_speed[0] <= omega <= limits.rotor_speed[1]:
        low, high = limits.rotor_speed
        warnings.append(f"limits.rotor_speed: rotor.omega, {omega:.4g} rad/s, lies outside {low:.4g} to {high:.4g}")
    weight, disk = float(known(spec.condition.weight)), math.pi * float(spec.rotor.radius) ** 2
    ideal = weight * math.sqrt(weight / (2.0 * SEA_LEVEL_DENSITY * disk))
    powers = {"power": limits.power, "torque": None if limits.torque is None else limits.torque * omega}
    for key, power in powers.items():
        if power is not None and not POWERS[0] <= power / ideal <= POWERS[1]:
            told = "" if key == "power" else " at rotor.omega"
            warnings.append(
                f"limits.{key}: {power / ideal:.3g} times the ideal power of hover at sea level{told}; helicopters have 2 to 3"
            )
    if limits.power is not None and spec.drive.accessory_power > 0.5 * limits.power:
        warnings.append("drive.accessory_power: more than half of limits.power")
    return warnings


def _loading(name: str, loading: Loading, spec: AircraftFile, parts: dict[str, Any]) -> list[str]:
    """Centre of gravity by the hub, inertia by the radius, weight by what the blades can carry; of a named one what it states."""
    base, rotor = spec.loading, spec.rotor
    radius = float(rotor.radius)
    warnings = []

    def own(key: str) -> Any:
        value = getattr(loading, key)
        return getattr(base, key) if value is None else value

    away = math.hypot(own("cg_station") - rotor.hub[0], own("cg_buttline") - rotor.hub[1]) / radius
    if away > CG_OFFSET:
        warnings.append(f"{name}: centre of gravity {away:.2f} radii beside the hub's station and buttline")
    if not own("cg_waterline") < rotor.hub[2]:
        warnings.append(f"{name}.cg_waterline: not below the hub")
    weight = own("weight")
    weight = float(known(spec.condition.weight) if weight is None else weight)
    inertia, mass = own("inertia"), weight / STANDARD_GRAVITY
    for key in ("ixx", "iyy", "izz"):
        gyration = math.sqrt(float(getattr(inertia, key)) / mass) / radius
        if not GYRATION[0] <= gyration <= GYRATION[1]:
            warnings.append(
                f"{name}.inertia.{key}: radius of gyration {gyration:.2g} rotor radii; airframes have 0.1 to 0.35"
            )
    if inertia.ixx > inertia.iyy:
        warnings.append(f"{name}.inertia: ixx above iyy; airframes are longer than they are wide")
    chord = interpolated(parts["blade"]["chord"]["x"], parts["blade"]["chord"]["y"], 0.75 * radius)
    blades = int(rotor.n_blades) * chord * radius
    carried = weight / (SEA_LEVEL_DENSITY * blades * float(rotor.omega * rotor.radius) ** 2)
    if not BLADE_LOADINGS[0] <= carried <= BLADE_LOADINGS[1]:
        warnings.append(
            f"{name}: weight of {weight:.4g} N asks for CT/sigma {carried:.2g} at sea level; rotors have 0.04 to 0.12"
        )
    return warnings


def _tail(name: str, position: Sequence[float], surface: dict[str, Any], spec: AircraftFile) -> list[str]:
    warnings, half = [], math.radians(8.0)
    low, high = (interpolated(surface["cl"]["x"], surface["cl"]["y"], angle) for angle in (-half, half))
    slope = (high - low) / (2.0 * half)
    if slope < TAIL_SLOPE:
        warnings.append(f"{name}: lift slope {slope:.3g} per rad, below {TAIL_SLOPE:g}: no tail is that stubby")
    across = min(
        interpolated(surface["cd"]["x"], surface["cd"]["y"], angle) for angle in (-0.5 * math.pi, 0.5 * math.pi)
    )
    if across < PLATE_DRAG:
        warnings.append(f"{name}: cd {across:.3g} at 90 deg; a plate across the stream has 1.1 to 2")
    if not position[0] > spec.rotor.hub[0]:
        warnings.append(f"{name}.position: not behind the hub")
    share = surface["area"] / (math.pi * float(spec.rotor.radius) ** 2)
    if share > TAIL_AREA:
        warnings.append(f"{name}.area: {share:.2g} of the disk; tails have 0.01 to 0.03")
    return warnings


def _tail_rotor(tail: TailRotor, spec: AircraftFile) -> list[str]:
    warnings = []
    if not tail.hub[0] > spec.rotor.hub[0]:
        warnings.append(
            "tail_rotor.position: not behind the hub, where its thrust to the right would add to the torque"
        )
    low, high = TAIL_DRAG
    if not low <= tail.cd_polar[0] <= high:
        warnings.append(f"tail_rotor.cd_polar: {tail.cd_polar[0]:.3g} without lift; sections have 0.006 to 0.012")
    return warnings


def _fuselage(loads: dict[str, Any], radius: float) -> list[str]:
    """Drag area against the disk, end on against broadside; lift, side force and moments against the drag broadside."""
    drag, right_angle = loads["drag"], 0.5 * math.pi
    ahead = in_grid(drag, 0.0, 0.0)
    broadside = {
        "alpha": min(in_grid(drag, angle, 0.0) for angle in (-right_angle, right_angle)),
        "beta": min(in_grid(drag, 0.0, angle) for angle in (-right_angle, right_angle)),
    }
    warnings, share = [], ahead / (math.pi * radius**2)
    if not DRAG_AREAS[0] <= share <= DRAG_AREAS[1]:
        warnings.append(
            f"fuselage: Dq {ahead:.3g} m2 straight ahead, {share:.2g} of the disk; helicopters have 0.005 to 0.02"
        )
    warnings += [
        f"fuselage: Dq {value:.3g} m2 at {angle} of 90 deg, below that straight ahead, {ahead:.3g} m2"
        for angle, value in broadside.items()
        if value < ahead
    ]
    largest = max(value for row in drag["values"] for value in row)
    for name, column, bound in (
        ("lift", "Lq", largest),
        ("side", "Yq", largest),
        ("pitching", "Mq", largest * radius),
        ("rolling", "Rq", largest * radius),
        ("yawing", "Nq", largest * radius),
    ):
        reached = max(abs(value) for row in loads[name]["values"] for value in row)
        if reached > bound:
            what = "the largest drag" if bound == largest else "the largest drag at the tip's distance"
            warnings.append(f"fuselage: {column} up to {reached:.3g}, above {what}, {bound:.3g}")
    return warnings
