# SPDX-License-Identifier: MIT OR Apache-2.0
"""A blade as the physics core reads it: SI, radians, plain lists; for aircraft and rotor files alike."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from ..errors import InputError
from . import tables
from .blade_file import BladeGroup

STRUCTURE_COLUMNS = ("r_in", "r_out", "mass", "EI_flap", "EI_lag", "GJ", "I_theta_cg", "x_cg", "x_cg_straight")
"""Columns of a table of blade structure."""


ELASTIC_COLUMNS = ("EI_flap", "EI_lag", "GJ")
"""Those that a rigid blade does without."""

HINGE_WIDTH = 1e-3
"""Length over which each of the two masses of a blade given by its moments is spread, over that of the blade."""

WITHOUT = {
    "pitch_axis_chord_fraction": 0.25,
    "control_stiffness": 1.0,
    "km1_over_ktheta": 0.0,
    "ka_over_ktheta": 0.0,
    "structural_damping_ratio": 0.0,
    "delta3": 0.0,
    "precone": 0.0,
    "flap_spring": 0.0,
    "lag_spring": 0.0,
}
"""What a number of a blade means where its file does not give it; a rigid blade is given no stiffness to feel."""

STOPS = ("flap_stops", "lag_stops")
"""Keys of a blade without which nothing stops it at its hinges."""


def blade_data(rotor: Any, path: Path) -> dict[str, Any]:
    """Blade of `[rotor]` of the file at `path` with its structure, tables checked for coverage."""
    blade, radius = rotor.blade, float(rotor.radius)
    structure = _structure(rotor, path)
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
    given = {key: float(value) for key, value in blade if key in WITHOUT and value is not None}
    return {
        "root": blade.root,
        "root_station": root,
        "radius": radius,
        "root_cutout": float(blade.root_cutout),
        "structure": structure,
        "twist": {"x": stations, "y": geometry.column("twist", "rad")},
        "chord": {"x": stations, "y": chord},
        **WITHOUT,
        **given,
        "rigid": not blade.flexible,
        **{key: getattr(blade, key).data for key in blade.given(STOPS)},
    }


def _structure(rotor: Any, path: Path) -> dict[str, list[float]]:
    """Structure by segments; of a rigid blade without stiffness that of a number that it does not feel."""
    blade: BladeGroup = rotor.blade
    table = blade.structure
    if table is not None and (blade.flexible or all(table.has(column) for column in ELASTIC_COLUMNS)):
        return _elastic_structure(rotor)
    if table is not None:
        columns = _rigid_structure(rotor)
    elif blade.blade_mass is not None:
        columns = _about_hinge(rotor, path)
    else:
        columns = _uniform(rotor)
    n = len(columns["mass"])
    nothing = {"x_cg": [0.0] * n, "i_theta": [0.0] * n}
    return {**nothing, **columns, "ei_flap": [1.0] * n, "ei_lag": [1.0] * n, "gj": [1.0] * n}


def _elastic_structure(rotor: Any) -> dict[str, list[float]]:
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
    gap = rounding if rotor.blade.root == "clamped" else 0.01 * radius
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


def _rigid_structure(rotor: Any) -> dict[str, list[float]]:
    """Mass along a rigid blade whose table has no stiffness."""
    table, radius, root = rotor.blade.structure, float(rotor.radius), float(rotor.blade.root_station)
    table.refuse_unused(STRUCTURE_COLUMNS, zero_is_nothing=True)
    r_in, r_out = table.column("r_in", "m", radius), table.column("r_out", "m", radius)
    tables.ascending(table, "r_in", r_in)
    mass = table.column("mass", "kg/m")
    x_cg = table.column("x_cg", "m") if table.has("x_cg") else [0.0] * len(mass)
    i_theta = table.column("I_theta_cg", "kg m") if table.has("I_theta_cg") else [0.0] * len(mass)
    if min(mass) < 0.0 or min(i_theta) < 0.0:
        raise table.error("mass", f"{min(mass):g} kg/m", "must not be negative")
    r_in[0], r_out[-1] = min(r_in[0], root), max(r_out[-1], radius)
    kept = [i for i in range(len(r_in)) if r_out[i] > root and r_in[i] < radius]
    columns = {"r_in": r_in, "r_out": r_out, "mass": mass, "x_cg": x_cg, "i_theta": i_theta}
    columns = {key: [values[i] for i in kept] for key, values in columns.items()}
    columns["r_in"] = [max(each, root) for each in columns["r_in"]]
    columns["r_out"] = [min(each, radius) for each in columns["r_out"]]
    return columns


def _uniform(rotor: Any) -> dict[str, list[float]]:
    """A uniform blade of `mass` per length or of `flap_inertia` about its hinge."""
    blade, radius = rotor.blade, float(rotor.radius)
    root, mass = float(blade.root_station), float(blade.mass or 0.0)
    if blade.flap_inertia is not None:
        mass = 3.0 * float(blade.flap_inertia) / (radius - root) ** 3
    return {"r_in": [root], "r_out": [radius], "mass": [mass]}


def _about_hinge(rotor: Any, path: Path) -> dict[str, list[float]]:
    """A slender rigid blade of given mass, first moment and inertia about its hinge: all that its motion knows of it.

    Two masses of equal width w have them: one at the hinge, its middle at w/2, and one whose middle is u further out. About
    w/2, S' = S - m w/2 and I' = I - w S + m w^2/4; m1 u = S', m1 u^2 = I' - m w^2/12.
    """
    blade, radius = rotor.blade, float(rotor.radius)
    root = float(blade.root_station)
    length = radius - root
    mass, first, inertia = float(blade.blade_mass), float(blade.first_moment), float(blade.flap_inertia)
    width = HINGE_WIDTH * length
    moment = first - 0.5 * mass * width
    second = inertia - width * first + 0.25 * mass * width**2 - mass * width**2 / 12.0
    arm = second / moment if moment > 0.0 else 0.0
    outer = moment / arm if arm > 0.0 else math.inf
    if not (outer <= mass and width <= arm <= length - width):
        given = f"{mass:g} kg, {first:g} kg m, {inertia:g} kg m2"
        allowed = f"no mass between the hinge and the tip, {length:.4g} m, has them: S^2/m <= I <= S L is needed"
        raise InputError.of("rotor.blade: blade_mass, first_moment, flap_inertia", given, allowed, file=path)
    inner_end, outer_start = root + width, root + arm
    return {
        "r_in": [root, inner_end, outer_start, outer_start + width],
        "r_out": [inner_end, outer_start, outer_start + width, radius],
        "mass": [(mass - outer) / width, 0.0, outer / width, 0.0],
    }
