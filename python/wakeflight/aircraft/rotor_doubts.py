# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a rotor could have but hardly has: told, not refused. A factor of ten or a wrong sign mostly shows here."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from .span import keys_of

SEA_LEVEL_DENSITY = 1.225
"""Density [kg/m3] at which a file alone is judged."""

LOCK_NUMBERS = (1.0, 30.0)
"""Air forces over inertia of a flapping blade, rho a c R^4 / I: helicopters have 4 to 12, autogiros near 20, stiff models 2."""

STEEL = (2.1e11, 8.1e10)
"""Elastic and shear modulus of steel [N/m2]."""

THICKEST = 0.25
"""Thickness over chord of the solid steel bar that no blade is stiffer than."""

LARGEST_TWIST = math.radians(45.0)
"""Built-in twist [rad] beyond that of any propeller-rotor in use."""

WASH_IN = math.radians(2.0)
"""Pitch [rad] of the tip above the innermost lifting station: blades wash out, to even the inflow."""

DAMPER_SIZE = 0.25
"""Offsets of a lag damper over the radius: it sits at the blade's root."""

LEAST_ARM = 0.001
"""Change of a lag damper's length with lead over the radius [1/rad] below which it does nothing."""


def doubts_of_rotor(group: Any, blade: dict[str, Any], damper: dict[str, Any] | None) -> list[str]:
    """Warnings about blades and their dampers. group: `[rotor]` of a file; blade, damper: as the core is given them, SI."""
    warnings = [*_twist(blade), *_inertia(group, blade), *_stiffness(group, blade), *_damper(damper, blade["radius"])]
    if blade["precone"] < 0.0:
        warnings.append("rotor.blade.precone: below 0; blades are coned up, the way lift bends them")
    warnings += [
        f"{key}.cd_increment: below 0: it takes drag away"
        for key, section in zip(keys_of(group.airfoil), group.airfoil, strict=True)
        if section.increment < 0.0
    ]
    return warnings


def _twist(blade: dict[str, Any]) -> list[str]:
    twist = [y for x, y in zip(blade["twist"]["x"], blade["twist"]["y"], strict=True) if x >= blade["root_cutout"]]
    warnings, steepest = [], max(map(abs, twist))
    if steepest > LARGEST_TWIST:
        warnings.append(f"rotor.blade.geometry: twist of {math.degrees(steepest):.4g} deg, beyond 45 deg")
    if twist[-1] - twist[0] > WASH_IN:
        grows = math.degrees(twist[-1] - twist[0])
        warnings.append(
            f"rotor.blade.geometry: twist grows by {grows:.4g} deg to the tip; blades wash out, to the other side"
        )
    return warnings


def _inertia(group: Any, blade: dict[str, Any]) -> list[str]:
    """Lock number in sea-level air; inertia in torsion of a blade that twists."""
    structure, root, radius = blade["structure"], blade["root_station"], blade["radius"]
    pieces = zip(structure["mass"], structure["r_in"], structure["r_out"], strict=True)
    inertia = sum(mass * ((outer - root) ** 3 - (inner - root) ** 3) / 3.0 for mass, inner, outer in pieces)
    warnings = []
    if inertia > 0.0:
        chord = interpolated(blade["chord"]["x"], blade["chord"]["y"], 0.75 * radius)
        lock = SEA_LEVEL_DENSITY * 2.0 * math.pi * chord * radius**4 / inertia
        low, high = LOCK_NUMBERS
        if not low <= lock <= high:
            warnings.append(
                f"rotor.blade: Lock number {lock:.3g} in sea-level air from a flap inertia of {inertia:.4g} kg m2; rotors have "
                f"{low:g} to {high:g}"
            )
    if group.blade.flexible and not any(structure["i_theta"]):
        warnings.append(
            "rotor.blade.structure: I_theta_cg is zero throughout: a blade that twists has inertia in torsion"
        )
    return warnings


def _stiffness(group: Any, blade: dict[str, Any]) -> list[str]:
    """Stiffness against that of a solid steel bar a quarter of the largest chord thick."""
    if not group.blade.flexible:
        return []
    chord = max(blade["chord"]["y"])
    thick, (elastic, shear) = THICKEST * chord, STEEL
    bars = {
        "ei_flap": ("EI_flap", elastic * chord * thick**3 / 12.0),
        "ei_lag": ("EI_lag", elastic * thick * chord**3 / 12.0),
        "gj": ("GJ", shear * chord * thick**3 / 3.0),
    }
    largest = {key: max(blade["structure"][key]) for key in bars}
    return [
        f"rotor.blade.structure: {column} up to {largest[key]:.3g} N m2, above the {bar:.3g} N m2 of a solid steel bar"
        for key, (column, bar) in bars.items()
        if largest[key] > bar
    ]


def _damper(damper: dict[str, Any] | None, radius: float) -> list[str]:
    """Offsets by the radius, stroke for lead at rest (flap, lead and pitch zero), force that grows with the rate."""
    if damper is None:
        return []
    for letter in "abcdr":
        if abs(damper[letter]) > DAMPER_SIZE * radius:
            return [f"rotor.lag_damper.{letter}: {damper[letter]:.4g} m, beyond a quarter of the radius"]
    if abs(damper_stroke(damper)) < LEAST_ARM * radius:
        return [
            f"rotor.lag_damper: its length changes by {damper_stroke(damper):.2g} m per rad of lead: it damps nothing"
        ]
    rates, forces = damper["force"]["x"], damper["force"]["y"]
    if not any(forces):
        return ["rotor.lag_damper.force: zero at every rate: the damper does nothing"]
    for rate, before, after in zip(rates, forces, forces[1:], strict=False):
        if after < before:
            return [
                f"rotor.lag_damper.force: falls beyond {rate:.3g} m/s, {before:.4g} to {after:.4g} N: it damps less the faster"
            ]
    return []


def damper_stroke(damper: dict[str, Any]) -> float:
    """Change of a damper's length with lead [m/rad] at no flap, lead and pitch, from the drawing's a, b, c, d, r."""
    sin_z, cos_z = math.sin(damper["zeta_geo"]), math.cos(damper["zeta_geo"])
    sin_t, cos_t = math.sin(damper["theta_geo"]), math.cos(damper["theta_geo"])
    arm = damper["b"] * cos_z + damper["d"] * sin_z
    across = damper["d"] * cos_z - damper["b"] * sin_z
    x, y, z = damper["c"] + arm, across - damper["r"] * cos_t, damper["a"] - damper["r"] * sin_t
    length = math.hypot(x, y, z)
    return 0.0 if length == 0.0 else (x * across - y * arm) / length


def in_grid(grid: dict[str, Any], x: float, y: float) -> float:
    """Bilinear, held beyond the edges."""
    return interpolated(grid["x"], [interpolated(grid["y"], row, y) for row in grid["values"]], x)


def interpolated(x: Sequence[float], y: Sequence[float], at: float) -> float:
    """Piecewise linear, held beyond the ends."""
    return float(np.interp(at, x, y))
