# SPDX-License-Identifier: MIT OR Apache-2.0
"""An aircraft file as the physics core reads it: SI, radians, plain lists."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..errors import known
from ..units import STANDARD_GRAVITY
from . import tables
from .blade_data import blade_data
from .mass import airframe_inertia, blade_mass
from .schema import AircraftFile, InterferenceTables, Loading, Stabilator
from .span import span_data
from .tables import TableFile

_KNOT = 1852.0 / 3600.0

OTHER_WAY = {"ccw": "cw", "cw": "ccw"}
"""Sense of rotation of the mirror image."""

SIDEWARDS = (0, 3)
"""Sticks that go to the sides: lateral, pedal."""


def fixed_parts(spec: AircraftFile, path: Path) -> dict[str, Any]:
    """Everything that does not depend on the loading, tables read and checked for coverage; path: of the file, for messages."""
    return {
        "blade": blade_data(spec.rotor, path),
        "airfoil": span_data(spec.rotor.airfoil, float(spec.rotor.radius), float(spec.rotor.blade.root_cutout), path),
        "lag_damper": lag_damper_data(spec.rotor),
        "fuselage": _fuselage(spec),
        "stabilator": _surface(spec.stabilator, "alpha") if spec.stabilator else None,
        "stabilator_schedule": _schedule(spec.stabilator, spec.rigging.stick_travel[2]) if spec.stabilator else None,
        "fin": _surface(spec.fin, "beta") if spec.fin else None,
        "tail_rotor": _tail_rotor(spec),
        "interference": _interference(spec),
    }


def assembled(spec: AircraftFile, parts: dict[str, Any], loading: Loading, gross_mass: float) -> dict[str, Any]:
    """Whole aircraft at a gross mass [kg]; positions from the nominal gross centre of gravity, body axes."""

    def from_cg(station: Sequence[float]) -> list[float]:
        return [
            float(known(loading.cg_station) - station[0]),
            float(station[1] - known(loading.cg_buttline)),
            float(known(loading.cg_waterline) - station[2]),
        ]

    def placed(name: str, station: Any) -> dict[str, Any] | None:
        return None if parts[name] is None else {"position": from_cg(station), **parts[name]}

    rotor = spec.rotor
    hub = from_cg(rotor.hub)
    given = known(loading.inertia)
    inertia = [float(each) for each in (given.ixx, given.iyy, given.izz)]
    inertia.append(float(given.ixz))
    if given.of == "gross":
        blades = int(rotor.n_blades) * blade_mass(parts["blade"]["structure"])
        # published with a weight, whatever is flown: that of the loading, else that of the file's condition
        weight = known(loading.weight if loading.weight is not None else spec.condition.weight)
        mass = float(weight) / STANDARD_GRAVITY
        inertia = airframe_inertia(inertia, mass, blades, hub)
    whole = {
        "rotor": {
            "n_blades": int(rotor.n_blades),
            "omega": float(rotor.omega),
            "rotation": rotor.rotation,
            "position": hub,
            "shaft_tilt_forward": float(rotor.shaft_tilt_forward),
            "shaft_tilt_lateral": float(rotor.shaft_tilt_lateral),
            "tip_loss_factor": float(rotor.tip_loss_factor),
            "blade": parts["blade"],
            "airfoil": parts["airfoil"],
            "lag_damper": parts["lag_damper"],
        },
        "rigging": {
            "matrix": [list(row) for row in spec.rigging.matrix],
            "offset": list(spec.rigging.offset),
            "phase": float(rotor.swashplate_phase),
        },
        "mass": {"gross_mass": float(gross_mass), "inertia": inertia},
        "fuselage": placed("fuselage", spec.fuselage and spec.fuselage.position),
        "stabilator": placed("stabilator", spec.stabilator and spec.stabilator.position),
        "stabilator_schedule": parts["stabilator_schedule"],
        "fin": placed("fin", spec.fin and spec.fin.position),
        "tail_rotor": placed("tail_rotor", spec.tail_rotor and spec.tail_rotor.hub),
        "interference": parts["interference"],
        "accessory_power": float(spec.drive.accessory_power),
    }
    return mirrored(whole, spec.rigging.stick_travel) if spec.mirrored else whole


def mirrored(whole: dict[str, Any], travel: Sequence[float]) -> dict[str, Any]:
    """The mirror image: the rotor turns the other way with its hub on the other side, the core reflects the airframe's air loads.

    travel (4,) [m]: sticks are those of an aircraft still, lateral and pedal to the right.
    """
    rotor = whole["rotor"]
    x, y, z = rotor["position"]
    image = {
        "rotation": OTHER_WAY[rotor["rotation"]],
        "position": [x, -y, z],
        "shaft_tilt_lateral": -rotor["shaft_tilt_lateral"],
    }
    rigging = other_stops(whole["rigging"], travel)
    return {**whole, "rotor": {**rotor, **image}, "rigging": rigging, "mirrored": True}


def other_stops(rigging: dict[str, Any], travel: Sequence[float]) -> dict[str, Any]:
    """The rigging of the mirror image: what a stick to the left did, one to the right does, in the rotor's own sense.

    With s the stick from its stop, t its travel and M its column: offset + M s = (offset + M t) - M (t - s).
    """
    columns = [[-gain if k in SIDEWARDS else gain for k, gain in enumerate(row)] for row in rigging["matrix"]]
    offset = [
        rest + sum(row[k] * travel[k] for k in SIDEWARDS)
        for rest, row in zip(rigging["offset"], rigging["matrix"], strict=True)
    ]
    return {**rigging, "matrix": columns, "offset": offset}


def lag_damper_data(rotor: Any) -> dict[str, Any] | None:
    """Lag damper of a rotor, None where it has none."""
    damper = rotor.lag_damper
    if damper is None:
        return None
    damper.force.refuse_unused(("rate", "force"))
    force = tables.curve(damper.force, "rate", "m/s", "force", "N")
    if force["x"][0] != 0.0 or force["y"][0] != 0.0:
        raise damper.force.error(
            "rate", f"{force['x'][0]:g} m/s", "must begin with no force at rest: the function is odd"
        )
    return {
        **{letter: float(getattr(damper, letter)) for letter in "abcdr"},
        "theta_geo": float(damper.theta_geo),
        "zeta_geo": float(damper.zeta_geo),
        "force": force,
        "spring_rate": float(damper.spring_rate) if damper.use_spring else 0.0,
    }


def _fuselage(spec: AircraftFile) -> dict[str, Any] | None:
    if spec.fuselage is None:
        return None
    table, right_angle = spec.fuselage.aerodynamics, 0.5 * math.pi
    names = {"drag": "Dq", "lift": "Lq", "side": "Yq", "pitching": "Mq", "rolling": "Rq", "yawing": "Nq"}
    moments = ("pitching", "rolling", "yawing")
    table.refuse_unused(("alpha", "beta", *names.values()))
    loads: dict[str, Any] = {}
    for name, base in names.items():
        loads[name] = tables.grid(table, "alpha", "beta", base, "m3" if name in moments else "m2")
    for axis, name in (("x", "alpha"), ("y", "beta")):
        tables.covering(table, name, loads["drag"][axis], -right_angle, right_angle, "-90 to 90 deg")
    return loads


def _surface(surface: Any, angle: str) -> dict[str, Any]:
    table, right_angle = surface.aerodynamics, 0.5 * math.pi
    table.refuse_unused((angle, "cl", "cd"))
    curves = {name: tables.curve(table, angle, "rad", name, "1") for name in ("cl", "cd")}
    tables.covering(table, angle, curves["cl"]["x"], -right_angle, right_angle, "-90 to 90 deg")
    # a scheduled surface has no incidence of its own: the schedule replaces it
    incidence = 0.0 if surface.incidence is None else float(surface.incidence)
    return {"area": float(surface.area), "incidence": incidence, **curves}


def _schedule(stabilator: Stabilator, collective_travel: float) -> dict[str, Any] | None:
    rule = stabilator.schedule
    if rule is None:
        return None
    deg_per_kt = math.degrees(1.0) * _KNOT
    return {
        "base_deg": math.degrees(rule.base),
        "v1_kt": [each / _KNOT for each in rule.v1],
        "coll_const": float(rule.coll_const) * deg_per_kt,
        "coll_slope": float(rule.coll_slope) * deg_per_kt,
        "coll_breaks_pct": list(rule.coll_breaks),
        "v2": [rule.v2[0] / _KNOT, rule.v2[1] / _KNOT, rule.v2[2] * deg_per_kt],
        "q_gain": float(rule.q_gain),
        "limits": list(known(stabilator.incidence_limits)),
        "rate_limit": float(rule.rate_limit),
        "collective_travel": float(collective_travel),
    }


def _tail_rotor(spec: AircraftFile) -> dict[str, Any] | None:
    tail = spec.tail_rotor
    if tail is None:
        return None
    coning = 0.0 if tail.coning is None else float(tail.coning) * float(known(tail.tan_delta3))
    return {
        "radius": float(tail.radius),
        "omega": float(tail.omega),
        "solidity": float(tail.solidity),
        "cant": float(tail.cant),
        "twist": float(tail.twist),
        "lift_curve_slope": float(tail.lift_curve_slope),
        "tip_loss_factor": float(tail.tip_loss_factor),
        "pitch_bias": float(tail.pitch_bias),
        "pitch_per_thrust": coning,
        "cd_polar": list(tail.cd_polar),
        "fin_blockage": list(tail.fin_blockage),
    }


def _interference(spec: AircraftFile) -> dict[str, Any] | None:
    wash = spec.interference
    if wash is None:
        return None
    if not isinstance(wash, InterferenceTables):
        return {"kind": "factors", "fuselage": float(wash.fuselage), "stabilator": float(wash.stabilator)}

    wash.rotor_wash.refuse_unused(("chi", "a1f", "ekx_fus", "ekz_fus", "ekx_tail", "ekz_tail"))
    wash.fuselage_wash.refuse_unused(("angle", "eps_of_alpha", "sigma_of_psi"))
    wash.q_ratio_stabilator.refuse_unused(("alpha", "q_ratio"))
    wash.q_ratio_fin.refuse_unused(("psi", "q_ratio"))

    def factor(base: str) -> dict[str, list[Any]]:
        return tables.grid(wash.rotor_wash, "chi", "a1f", base, "1")

    def angle(base: str) -> dict[str, list[float]]:
        return tables.curve(wash.fuselage_wash, "angle", "rad", base, "rad")

    def ratio(table: TableFile, base: str) -> dict[str, list[float]]:
        return tables.curve(table, base, "rad", "q_ratio", "1")

    return {
        "kind": "tables",
        "ekx_fuselage": factor("ekx_fus"),
        "ekz_fuselage": factor("ekz_fus"),
        "ekx_tail": factor("ekx_tail"),
        "ekz_tail": factor("ekz_tail"),
        "downwash": angle("eps_of_alpha"),
        "sidewash": angle("sigma_of_psi"),
        "q_ratio_stabilator": ratio(wash.q_ratio_stabilator, "alpha"),
        "q_ratio_fin": ratio(wash.q_ratio_fin, "psi"),
    }
