# SPDX-License-Identifier: MIT OR Apache-2.0
"""Physics of an aircraft's numbers: what no helicopter can have is refused, what is doubtful is told."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..errors import InputError, known
from ..units import STANDARD_GRAVITY, shown
from .doubts import doubts_of_aircraft
from .mass import airframe_inertia, blade_mass
from .rotor_checks import SPEED_OF_SOUND, check_rotor
from .rotor_doubts import in_grid, interpolated
from .schema import AircraftFile, Loading
from .sections import LARGEST_COEFFICIENT, PLAUSIBLE_SLOPES, tip_mach_warnings
from .span import check_span, tip_section

STICKS = ("lateral", "longitudinal", "collective", "pedal")
PITCHES = ("theta_1c", "theta_1s", "theta_0", "theta_tr")

RIGGING_SIGNS = (-1.0, 1.0, 1.0, -1.0)
"""Sign of each stick's own pitch (lateral right, longitudinal aft, collective up, pedal right): a rotor that turns
counter-clockwise follows a quarter turn behind its pitch, and its tail rotor's thrust turns the nose to the left. That of a
clockwise one counts azimuth the other way round: what lowers the right side raises it there, and theta_1c changes its sign."""

STEEPEST_PITCH = math.radians(60.0)
"""Largest pitch [rad] that sticks may ask for: blades stall at a third of it."""

POLAR_RANGE = math.radians(30.0)
"""Angle of attack [rad] either way over which a tail rotor's drag polar must not drive."""

LARGEST_WASH = 5.0
"""Largest wash factor on the mean induced velocity: a fully contracted wake has 2, a tip vortex beside it less than 5."""

LARGEST_RATIO = 4.0
"""Largest ratio of dynamic pressures behind the airframe to that of flight: twice the speed."""


def check_aircraft(spec: AircraftFile, parts: dict[str, Any], path: Path) -> list[str]:
    """Warnings about an aircraft; InputError where it is impossible. parts: as the core is given them, SI."""

    def refuse(key: str, value: object, allowed: str) -> InputError:
        return InputError.of(key, value, allowed, file=path)

    def in_rotor(key: str, value: object, allowed: str) -> InputError:
        return refuse(f"rotor.{key}", value, allowed)

    sections = tip_section(parts["airfoil"])
    warnings = check_span(spec.rotor.airfoil, parts["airfoil"], path)
    warnings += check_rotor(spec.rotor, parts["blade"], parts["lag_damper"], sections, in_rotor)
    fastest = float(spec.rotor.omega * spec.rotor.radius + spec.condition.speed) / SPEED_OF_SOUND
    warnings += [
        f"rotor.airfoil: {text}"
        for text in tip_mach_warnings(sections, fastest, "the advancing tip at condition.speed")
    ]
    _masses(spec, parts, refuse)
    _rigging(spec, refuse)
    for name in ("stabilator", "fin"):
        if parts[name] is not None:
            warnings += _surface(name, getattr(spec, name).aerodynamics, parts[name])
    if parts["fuselage"] is not None:
        warnings += _fuselage(spec, parts["fuselage"])
    if spec.tail_rotor is not None:
        warnings += _tail_rotor(spec, refuse)
    _interference(spec, parts["interference"])
    return [*warnings, *doubts_of_aircraft(spec, parts), *_unused(spec)]


def _masses(spec: AircraftFile, parts: dict[str, Any], refuse: Any) -> None:
    """Weights above that of the blades; inertia that a body can have, with the blades and without them."""
    blades = int(spec.rotor.n_blades) * blade_mass(parts["blade"]["structure"])
    weights = {"condition": spec.condition.weight}
    weights |= {f"conditions.{name}": each.weight for name, each in spec.conditions.items()}
    weights |= {"loading": spec.loading.weight}
    weights |= {f"loadings.{name}": each.weight for name, each in spec.loadings.items()}
    for where, weight in weights.items():
        if weight is not None and not float(weight) / STANDARD_GRAVITY > blades:
            given, least = shown(float(weight), "lbf"), shown(blades * STANDARD_GRAVITY, "lbf")
            raise refuse(f"{where}.weight", given, f"must be above the weight of the blades, {least}")
    loadings = {"loading": spec.loading}
    for name, named in spec.loadings.items():
        own = {key: value for key, value in named if value is not None}
        loadings[f"loadings.{name}"] = spec.loading.model_copy(update=own)
    for where, loading in loadings.items():
        _inertia(where, loading, spec, blades, refuse)


def _inertia(where: str, loading: Loading, spec: AircraftFile, blades: float, refuse: Any) -> None:
    group = known(loading.inertia)
    inertia = [float(group.ixx), float(group.iyy), float(group.izz), float(group.ixz)]
    _body(f"{where}.inertia", inertia, "", refuse)
    if group.of == "gross":
        hub = [
            float(loading.cg_station - spec.rotor.hub[0]),
            float(spec.rotor.hub[1] - loading.cg_buttline),
            float(loading.cg_waterline - spec.rotor.hub[2]),
        ]
        weight = known(loading.weight if loading.weight is not None else spec.condition.weight)
        airframe = airframe_inertia(inertia, float(weight) / STANDARD_GRAVITY, blades, hub)
        _body(f"{where}.inertia", airframe, "without the blades, as masses at the hub, ", refuse)


def _body(key: str, inertia: Sequence[float], what: str, refuse: Any) -> None:
    """Principal moments of a body are positive, and each is at most the sum of the others: they are sums of squares."""
    ixx, iyy, izz, ixz = inertia
    mean, half = 0.5 * (ixx + izz), math.hypot(0.5 * (ixx - izz), ixz)
    principal = (mean - half, iyy, mean + half)
    told = ", ".join(f"{each:.5g}" for each in principal)
    if not min(principal) > 0.0:
        raise refuse(key, f"principal moments {told} kg m2", f"{what}must be positive (ixz^2 below ixx izz)")
    if 2.0 * max(principal) > sum(principal) * (1.0 + 1e-9):
        raise refuse(key, f"principal moments {told} kg m2", f"{what}each must be at most the sum of the other two")


def _rigging(spec: AircraftFile, refuse: Any) -> None:
    rigging = spec.rigging
    for i, (stick, pitch, sign) in enumerate(zip(STICKS, PITCHES, RIGGING_SIGNS, strict=True)):
        if i == 3 and spec.tail_rotor is None:
            continue
        own, where = rigging.matrix[i][i], ""
        if i == 0 and spec.rotor.rotation == "cw":
            sign, where = -sign, " of a clockwise rotor, whose blade at 90 deg is on the left"
        if not own * sign > 0.0:
            way = "raise" if sign > 0.0 else "lower"
            side = ("right", "aft", "up", "right")[i]
            allowed = f"{stick} {side} must {way} {pitch}{where}"
            raise refuse("rigging.matrix", f"{own:g} rad/m from {stick} to {pitch}", allowed)
        swings = [gain * travel for gain, travel in zip(rigging.matrix[i], rigging.stick_travel, strict=True)]
        lowest = rigging.offset[i] + sum(min(swing, 0.0) for swing in swings)
        highest = rigging.offset[i] + sum(max(swing, 0.0) for swing in swings)
        if max(-lowest, highest) > STEEPEST_PITCH:
            given = (
                f"{pitch} from {math.degrees(lowest):.4g} to {math.degrees(highest):.4g} deg over the sticks' travel"
            )
            raise refuse("rigging", given, "must stay within +-60 deg")


def _surface(name: str, table: Any, surface: dict[str, Any]) -> list[str]:
    """A tail surface: bounded coefficients, drag that brakes, lift that grows with the angle at zero."""
    for key in ("cl", "cd"):
        for angle, value in zip(surface[key]["x"], surface[key]["y"], strict=True):
            given = f"{value:g} at {math.degrees(angle):g} deg"
            if not abs(value) <= LARGEST_COEFFICIENT:
                raise table.error(f"{name} {key}", given, f"must lie within +-{LARGEST_COEFFICIENT:g}")
            if key == "cd" and value < 0.0:
                raise table.error(f"{name} cd", given, "drag must not be negative: it would drive the aircraft")
    half = math.radians(8.0)
    curve = surface["cl"]
    low, high = (interpolated(curve["x"], curve["y"], angle) for angle in (-half, half))
    slope = (high - low) / (2.0 * half)
    if not slope > 0.0:
        raise table.error(f"{name} cl", f"{slope:.3g} per rad about 0 deg", "lift slope must be positive")
    if slope > 2.0 * math.pi:
        return [f"{name}: lift slope {slope:.3g} per rad, above that of an endless plate, 2 pi"]
    return []


def _fuselage(spec: AircraftFile, loads: dict[str, Any]) -> list[str]:
    """Drag that brakes at every angle (a body takes energy from no steady stream); loads within those of the whole disk."""
    table = known(spec.fuselage).aerodynamics
    names = {"drag": "Dq", "lift": "Lq", "side": "Yq", "pitching": "Mq", "rolling": "Rq", "yawing": "Nq"}
    radius = float(spec.rotor.radius)
    for name, column in names.items():
        moment = name in ("pitching", "rolling", "yawing")
        largest = math.pi * radius**2 * (radius if moment else 1.0)
        unit, what = ("m3", "disk area times radius") if moment else ("m2", "disk area")
        grid = loads[name]
        for alpha, row in zip(grid["x"], grid["values"], strict=True):
            for beta, value in zip(grid["y"], row, strict=True):
                given = f"{value:g} {unit} at {math.degrees(alpha):g}, {math.degrees(beta):g} deg"
                if name == "drag" and value < 0.0:
                    raise table.error(column, given, "drag must not be negative: it would drive the aircraft")
                if not abs(value) <= largest:
                    raise table.error(column, given, f"must lie within the rotor's {what}, {largest:.4g} {unit}")
    warnings = []
    # a body blown at from below is lifted, from one side pushed to the other: over 10 deg either way of straight ahead
    small = math.radians(10.0)
    lift = [in_grid(loads["lift"], angle, 0.0) for angle in (-small, small)]
    if lift[1] < lift[0]:
        warnings.append(
            f"fuselage: lift falls from {lift[0]:.3g} to {lift[1]:.3g} m2 between -10 and 10 deg of incidence"
        )
    push = [
        in_grid(loads["side"], 0.0, angle) * math.cos(angle) - in_grid(loads["drag"], 0.0, angle) * math.sin(angle)
        for angle in (-small, small)
    ]
    if push[1] > push[0]:
        warnings.append(
            f"fuselage: side force grows from {push[0]:.3g} to {push[1]:.3g} m2 between -10 and 10 deg of sideslip: "
            "it pulls into the wind"
        )
    return warnings


def _tail_rotor(spec: AircraftFile, refuse: Any) -> list[str]:
    tail = spec.tail_rotor
    assert tail is not None
    if not tail.radius < spec.rotor.radius:
        raise refuse(
            "tail_rotor.radius", f"{tail.radius:g} m", f"must be below the main rotor's, {spec.rotor.radius:.4g} m"
        )
    for factor, where in zip(tail.fin_blockage, ("at rest", "in flight"), strict=False):
        if not 0.0 < factor <= 1.0:
            allowed = "must lie above 0 and at most 1: the fin in its way takes thrust away"
            raise refuse("tail_rotor.fin_blockage", f"{factor:g} {where}", allowed)
    tip_mach = tail.omega * tail.radius / SPEED_OF_SOUND
    if not tip_mach < 1.0:
        raise refuse("tail_rotor.omega", f"{tail.omega:g} rad/s", f"tip at Mach {tip_mach:.2f}; must stay below 1")
    d0, d1, d2 = tail.cd_polar
    angles = [-POLAR_RANGE, POLAR_RANGE]
    if d2 > 0.0:
        angles.append(min(max(-d1 / (2.0 * d2), -POLAR_RANGE), POLAR_RANGE))
    least, at = min((d0 + d1 * angle + d2 * angle**2, angle) for angle in angles)
    if least < 0.0:
        given = f"{least:.4g} at {math.degrees(at):.4g} deg"
        raise refuse(
            "tail_rotor.cd_polar", given, "drag must not be negative within +-30 deg: it would drive the rotor"
        )
    low, high = PLAUSIBLE_SLOPES
    if not low <= tail.lift_curve_slope <= high:
        return [f"tail_rotor.lift_curve_slope {tail.lift_curve_slope:.3g} per rad; sections have {low:g} to {high:g}"]
    return []


def _interference(spec: AircraftFile, wash: dict[str, Any] | None) -> None:
    if wash is None or wash["kind"] != "tables":
        return
    group: Any = spec.interference
    columns = {"ekx_fuselage": "ekx_fus", "ekz_fuselage": "ekz_fus", "ekx_tail": "ekx_tail", "ekz_tail": "ekz_tail"}
    right_angle = 0.5 * math.pi
    for name, column in columns.items():
        grid = wash[name]
        if grid["x"][0] > 1e-9 or grid["x"][-1] < right_angle - 1e-9:
            raise group.rotor_wash.error("chi", f"to {math.degrees(grid['x'][-1]):g} deg", "must cover 0 to 90 deg")
        for value in (each for row in grid["values"] for each in row):
            if not abs(value) <= LARGEST_WASH:
                raise group.rotor_wash.error(column, f"{value:g}", f"must lie within +-{LARGEST_WASH:g}")
    # in hover the fuselage stands in the wake, which goes down
    if min(wash["ekz_fuselage"]["values"][0]) < 0.0:
        given = f"{min(wash['ekz_fuselage']['values'][0]):g} at 0 deg"
        raise group.rotor_wash.error(
            "ekz_fus", given, "must not be negative: in hover the wake goes down on the fuselage"
        )
    for name, column in (("downwash", "eps_of_alpha"), ("sidewash", "sigma_of_psi")):
        curve = wash[name]
        _covers(group.fuselage_wash, "angle", curve["x"])
        for value in curve["y"]:
            if not abs(value) <= right_angle:
                raise group.fuselage_wash.error(column, f"{math.degrees(value):g} deg", "must lie within +-90 deg")
    for name, axis in (("q_ratio_stabilator", "alpha"), ("q_ratio_fin", "psi")):
        curve, table = wash[name], getattr(group, name)
        _covers(table, axis, curve["x"])
        for value in curve["y"]:
            if not 0.0 <= value <= LARGEST_RATIO:
                raise table.error(
                    "q_ratio", f"{value:g}", f"must lie between 0 and {LARGEST_RATIO:g}: a ratio of squares"
                )


def _covers(table: Any, name: str, angles: Sequence[float]) -> None:
    """Ordinary flight takes place within 20 deg; beyond its ends a table is held."""
    if math.degrees(angles[0]) > -20.0 + 1e-9 or math.degrees(angles[-1]) < 20.0 - 1e-9:
        given = f"{math.degrees(angles[0]):.4g} .. {math.degrees(angles[-1]):.4g} deg"
        raise table.error(name, given, "must cover -20 to 20 deg; held beyond its ends")


def _unused(spec: AircraftFile) -> list[str]:
    """Keys that say something to a part that is switched off."""
    given = []
    if (
        spec.stabilator is not None
        and spec.stabilator.schedule is None
        and spec.stabilator.incidence_limits is not None
    ):
        given.append("stabilator.incidence_limits: not used with a fixed incidence")
    if spec.tail_rotor is not None and spec.tail_rotor.coning is None and spec.tail_rotor.tan_delta3 is not None:
        given.append("tail_rotor.tan_delta3: not used without tail_rotor.coning")
    return given
