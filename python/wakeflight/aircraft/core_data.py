# SPDX-License-Identifier: MIT OR Apache-2.0
"""An aircraft file as the physics core reads it: SI, radians, plain lists."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ..units import STANDARD_GRAVITY
from . import tables
from .mass import airframe_inertia, blade_mass
from .schema import AircraftFile, InterferenceTables, Loading, Rotor, Stabilator
from .tables import TableFile

_KNOT = 1852.0 / 3600.0

STRUCTURE_COLUMNS = ("r_in", "r_out", "mass", "EI_flap", "EI_lag", "GJ", "I_theta_cg", "x_cg", "x_cg_straight")
"""Columns of a table of blade structure."""


def fixed_parts(spec: AircraftFile) -> dict[str, Any]:
    """Everything that does not depend on the loading, tables read and checked for coverage."""
    return {
        "blade": {
            **blade_data(spec.rotor, structure_data(spec.rotor)),
            "rigid": not spec.rotor.blade.flexible,
        },
        "airfoil": _airfoil(spec.rotor),
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
            float(loading.cg_station - station[0]),
            float(station[1] - loading.cg_buttline),
            float(loading.cg_waterline - station[2]),
        ]

    def placed(name: str, station: Sequence[float] | None) -> dict[str, Any] | None:
        return None if parts[name] is None else {"position": from_cg(station), **parts[name]}

    rotor = spec.rotor
    hub = from_cg(rotor.hub)
    inertia = [float(each) for each in (loading.inertia.ixx, loading.inertia.iyy, loading.inertia.izz)]
    inertia.append(float(loading.inertia.ixz))
    if loading.inertia.of == "gross":
        blades = int(rotor.n_blades) * blade_mass(parts["blade"]["structure"])
        # published with a weight, whatever is flown: that of the loading, else that of the file's condition
        weight = loading.weight if loading.weight is not None else spec.condition.weight
        mass = float(weight) / STANDARD_GRAVITY
        inertia = airframe_inertia(inertia, mass, blades, hub)
    return {
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


def blade_data(rotor: Any, structure: dict[str, list[float]]) -> dict[str, Any]:
    """Blade of a rotor with its structure, tables checked for coverage."""
    blade, radius = rotor.blade, float(rotor.radius)
    geometry = blade.geometry
    geometry.refuse_unused(("r", "twist", "chord"), zero_is_nothing=True)
    stations = geometry.column("r", "m", radius)
    tables.ascending(geometry, "r", stations)
    root = float(blade.root_station)
    tables.covering(geometry, "r", stations, root, radius, f"the root at {root:.6g} m to the tip at {radius:.6g} m")
    chord = geometry.column("chord", "m")
    for station, value in zip(stations, chord, strict=True):
        if station >= float(blade.root_cutout) and not value > 0.0:
            raise geometry.error("chord", f"{value:g} m at {station:.6g} m", "must be above 0 beyond the root cut-out")
    return {
        "root": blade.root,
        "root_station": root,
        "radius": radius,
        "root_cutout": float(blade.root_cutout),
        "structure": structure,
        "twist": {"x": stations, "y": geometry.column("twist", "rad")},
        "chord": {"x": stations, "y": chord},
        "pitch_axis_chord_fraction": float(blade.pitch_axis_chord_fraction),
        "control_stiffness": float(blade.control_stiffness),
        "km1_over_ktheta": float(blade.km1_over_ktheta),
        "ka_over_ktheta": float(blade.ka_over_ktheta),
        "structural_damping_ratio": float(blade.structural_damping_ratio),
        "delta3": float(blade.delta3),
        "precone": float(blade.precone),
    }


def structure_data(rotor: Any) -> dict[str, list[float]]:
    """Segments from the root to the tip, clipped; at a hinge up to 1 % of the radius may be massless."""
    table, radius = rotor.blade.structure, float(rotor.radius)
    table.refuse_unused(STRUCTURE_COLUMNS, zero_is_nothing=True)
    root = float(rotor.blade.root_station)
    r_in, r_out = table.column("r_in", "m", None), table.column("r_out", "m", None)
    rounding = 1e-4 * radius
    for outer, inner in zip(r_out, r_in[1:], strict=False):
        if abs(outer - inner) > 1e-9:
            raise table.error("r_in", f"{inner:.6g} m after r_out {outer:.6g} m", "segments must join")
    for inner, outer in zip(r_in, r_out, strict=True):
        if not outer > inner:
            raise table.error("r_out", f"{outer:.6g} m", f"must lie beyond r_in, {inner:.6g} m")
    gap = 0.01 * radius if rotor.blade.root == "hinged" else rounding
    if r_in[0] > root + gap or r_out[-1] < radius - rounding:
        span = f"{r_in[0]:.6g} .. {r_out[-1]:.6g} m"
        raise table.error("r_in, r_out", span, f"must cover {root:.6g} m to {radius:.6g} m")
    if abs(r_in[0] - root) < rounding:
        r_in[0] = root
    if abs(r_out[-1] - radius) < rounding:
        r_out[-1] = radius
    x_cg = "x_cg_straight" if rotor.blade.straight_tip and table.has("x_cg_straight") else "x_cg"
    columns = {
        "mass": ("mass", "kg/m", 0.0),
        "ei_flap": ("EI_flap", "N m2", None),
        "ei_lag": ("EI_lag", "N m2", None),
        "gj": ("GJ", "N m2", None),
        "i_theta": ("I_theta_cg", "kg m", 0.0),
        "x_cg": (x_cg, "m", -math.inf),
    }
    if table.has("x_cg_straight"):
        # one of the two is used, both are checked
        table.column("x_cg_straight", "m")
        table.column("x_cg", "m")
    structure: dict[str, list[float]] = {"r_in": r_in, "r_out": r_out}
    for key, (base, unit, low) in columns.items():
        values = table.column(base, unit)
        for value in values:
            if (low is None and not value > 0.0) or (low is not None and value < low):
                raise table.error(
                    base, f"{value:g} {unit}", "must be above 0" if low is None else "must not be negative"
                )
        structure[key] = values
    kept = [i for i in range(len(r_in)) if r_out[i] > root and r_in[i] < radius]
    clipped = {key: [values[i] for i in kept] for key, values in structure.items()}
    clipped["r_in"] = [max(each, root) for each in clipped["r_in"]]
    clipped["r_out"] = [min(each, radius) for each in clipped["r_out"]]
    return clipped


def _airfoil(rotor: Rotor) -> dict[str, Any]:
    airfoil = rotor.airfoil
    return {
        "cl": tables.by_mach(airfoil.cl),
        "cd": tables.by_mach(airfoil.cd),
        "cm": tables.by_mach(airfoil.cm),
        "cd_increment": float(airfoil.cd_increment),
    }


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
        "limits": list(stabilator.incidence_limits),
        "rate_limit": float(rule.rate_limit),
        "collective_travel": float(collective_travel),
    }


def _tail_rotor(spec: AircraftFile) -> dict[str, Any] | None:
    tail = spec.tail_rotor
    if tail is None:
        return None
    coning = 0.0 if tail.coning is None else float(tail.coning) * float(tail.tan_delta3)
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

    def factor(base: str) -> dict[str, list]:
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
