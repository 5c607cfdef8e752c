# SPDX-License-Identifier: MIT OR Apache-2.0
"""The monitors of a rotor on a stand: the passages its means are made of, its pitch and its wake."""

from __future__ import annotations

import numpy as np

from ..monitors import Monitor, Places, rotor
from ..trim.monitors import closest_vortex, section_monitors
from .solved import Solved


def monitors(stand: Solved) -> tuple[Monitor, ...]:
    """Everything that is watched of a stand: every passage that went into its means, not the means."""
    model, solution, condition = stand.model, stand.solution, stand.model.condition
    names = ("alpha", "mach", "inflow")
    psi, fields = stand.passed(*names)
    places = Places(model.stations / stand.radius, psi)
    velocity = np.asarray(condition.velocity) / model.tip_speed
    theta = [stand.theta_0, stand.theta_1c, stand.theta_1s]
    motion = (np.linalg.norm(condition.velocity), np.linalg.norm(condition.rates))
    *found, stalled = section_monitors(model, dict(zip(names, fields, strict=True)), velocity, theta, motion, places)
    mu, mu_z = condition.mu(model.tip_speed), condition.mu_z(model.tip_speed)
    found += [
        stalled,
        rotor.pitch(found_pitch(stand), float(np.arctan2(-mu_z, 0.75)), _why(stand, mu, stalled)),
        _axial(stand, mu, mu_z),
    ]
    if solution.wake is not None:
        if stand.turns_kept:
            turns = stand.turns_kept
            found.append(rotor.vortex_distance(min(turn.vortex_blade_distance for turn in turns)))
            step = stand.radius * max(turn.max_displacement for turn in turns)
            found.append(rotor.node_motion(step, stand.radius))
        else:
            found.append(rotor.vortex_distance(closest_vortex(model, solution.wake)))
    return tuple(found)


def found_pitch(stand: Solved) -> dict[str, float]:
    """Pitch that was found and not given [rad]: collective at three quarters of the radius, amplitude of the cyclic."""
    given = {name for name, _ in stand.model.condition.controls}
    found = {}
    if "collective" not in given:
        found["collective"] = stand.theta_0 + stand.model.aircraft.twist(0.75 * stand.radius)
    if not {"lateral_cyclic", "longitudinal_cyclic"} <= given:
        found["cyclic"] = float(np.hypot(stand.theta_1c, stand.theta_1s))
    return found


def _why(stand: Solved, mu: float, stalled: Monitor) -> str:
    """What else is known of a stand whose pitch is out of reach."""
    return (
        f"theta_0, 1c, 1s = {', '.join(f'{np.degrees(each):.0f}' for each in stand.x[:3])} deg at mu = {mu:.3f}, C_T/sigma = "
        f"{stand.ct / stand.model.aircraft.solidity:.3f}, {100 * stalled.values['stalled_share']:.0f} % of the disk beyond "
        f"stall, {100 * stalled.values['reversed_share']:.0f} % in reversed flow"
    )


def _axial(stand: Solved, mu: float, mu_z: float) -> Monitor:
    """Axial flow; the stand's Dataset has mu_z of its own."""
    momentum = stand.model.inflow.is_dynamic or stand.model.inflow.is_annular
    return rotor.axial_flow(mu, mu_z, stand.ct, momentum)
