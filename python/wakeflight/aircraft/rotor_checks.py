# SPDX-License-Identifier: MIT OR Apache-2.0
"""Physics of a rotor's numbers: what no rotor can have is refused, what is doubtful is told."""

from __future__ import annotations

import math
from typing import Any

from .mass import blade_mass
from .rotor_doubts import doubts_of_rotor
from .sections import Grid, Refuse, tip_mach_warnings

SPEED_OF_SOUND = 340.294
"""Speed of sound [m/s] of the standard atmosphere at sea level, for what a file alone can say of Mach numbers."""

SLOWEST_TIP = 0.1
"""Least tip speed [m/s] of a rotor that is flown or tested."""

STEEPEST_TWIST = 0.5 * math.pi
"""Largest built-in twist [rad] either way: beyond it the trailing edge leads."""


def check_rotor(
    group: Any, blade: dict[str, Any], damper: dict[str, Any] | None, sections: dict[str, Grid], refuse: Refuse
) -> list[str]:
    """Warnings about a rotor; InputError where it is impossible.

    group: `[rotor]` of a file; blade, damper, sections: as the core is given them, SI; refuse: error about a key of `[rotor]`.
    """
    n_blades, radius, omega = int(group.n_blades), float(group.radius), float(group.omega)
    tip_mach = omega * radius / SPEED_OF_SOUND
    if not tip_mach < 1.0:
        given = f"{omega:g} rad/s"
        raise refuse("omega", given, f"the tip would move at Mach {tip_mach:.2f} in sea-level air; must stay below 1")
    if not omega * radius >= SLOWEST_TIP:
        raise refuse("omega", f"{omega:g} rad/s", f"the tip must move at {SLOWEST_TIP:g} m/s or more")
    warnings = _geometry(group, blade, n_blades, radius)
    warnings += _structure(group, blade, omega, damper)
    if n_blades == 1:
        warnings.append("rotor.n_blades = 1: a single blade, without the counterweight it needs")
    warnings += doubts_of_rotor(group, blade, damper)
    return warnings + tip_mach_warnings(sections, tip_mach, "the tip at rest in sea-level air")


def _geometry(group: Any, blade: dict[str, Any], n_blades: int, radius: float) -> list[str]:
    table, cutout = group.blade.geometry, blade["root_cutout"]
    widest = 0.0
    for station, chord, twist in zip(blade["chord"]["x"], blade["chord"]["y"], blade["twist"]["y"], strict=True):
        if not 0.0 <= chord < radius:
            raise table.error(
                "chord", f"{chord:g} m at {station:.6g} m", f"must lie between 0 and the radius, {radius:.6g} m"
            )
        if not abs(twist) <= STEEPEST_TWIST:
            raise table.error("twist", f"{math.degrees(twist):g} deg at {station:.6g} m", "must lie within +-90 deg")
        if station >= cutout:
            widest = max(widest, chord)
    # blades side by side cover the disk: more than that they would lie upon one another
    solidity = n_blades * widest / (math.pi * radius)
    if not solidity < 1.0:
        raise table.error(
            "chord", f"{widest:g} m", f"{n_blades} such blades have {solidity:.2f} of the disk's area; must be below 1"
        )
    if solidity > 0.3:
        return [f"solidity {solidity:.2f}: blades influence one another as a cascade, which section tables do not know"]
    return []


def _structure(group: Any, blade: dict[str, Any], omega: float, damper: dict[str, Any] | None) -> list[str]:
    structure, table = blade["structure"], group.blade.structure
    widest = max(blade["chord"]["y"])
    if table is not None:
        for mass, inertia, offset in zip(structure["mass"], structure["i_theta"], structure["x_cg"], strict=True):
            # the mass lies within the section: neither its centre nor its radius of gyration is beyond the chord
            if not abs(offset) <= widest:
                raise table.error("x_cg", f"{offset:g} m", f"must lie within the chord, +-{widest:g} m")
            if not inertia <= mass * widest**2:
                allowed = f"must be at most mass times chord squared, {mass * widest**2:.4g} kg m"
                raise table.error("I_theta_cg", f"{inertia:g} kg m", allowed)
        if group.blade.root != "clamped" and not blade_mass(structure) > 0.0:
            raise table.error("mass", "0 kg/m", "must be above 0 somewhere: a blade with hinges moves by its mass")
    if damper is None:
        return []
    pull = omega**2 * sum(
        mass * (outer**2 - inner**2) / 2.0
        for mass, inner, outer in zip(structure["mass"], structure["r_in"], structure["r_out"], strict=True)
    )
    for rate, force in zip(damper["force"]["x"], damper["force"]["y"], strict=True):
        given = f"{force:g} N at {rate:g} m/s"
        if force < 0.0:
            raise group.lag_damper.force.error(
                "force", given, "must oppose the rate (not be negative): it would drive the blade"
            )
        if force > pull:
            raise group.lag_damper.force.error(
                "force", given, f"must stay below the blade's centrifugal force, {pull:.4g} N"
            )
    return []


def unused_on_a_stand(group: Any, condition: Any) -> list[str]:
    """Keys of a rotor file that a rotor on a stand has no use for."""
    keys = ["hub", "shaft_tilt_forward", "shaft_tilt_lateral", "swashplate_phase"]
    given = [f"rotor.{key}" for key in keys if getattr(group, key) is not None]
    if not group.blade.flexible:
        of_elastic = ["control_stiffness", "km1_over_ktheta", "ka_over_ktheta", "structural_damping_ratio"]
        given += [f"rotor.blade.{key}" for key in of_elastic if getattr(group.blade, key) is not None]
    if condition is not None:
        # the weight is the thrust of a stand of which nothing is asked
        unused = ("speed", "flight_path", "altitude")
        given += [f"condition.{key}" for key in unused if getattr(condition, key) is not None]
    where = "on a stand" if group.blade.flexible else "on a stand with rigid blades"
    return [f"{', '.join(given)}: not used {where}"] if given else []
