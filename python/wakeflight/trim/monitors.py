# SPDX-License-Identifier: MIT OR Apache-2.0
"""The monitors of a trim: its maps, sticks, power and attitude against what models and motion allow."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..limits import stall_along_span, table_end
from ..model import CompiledRotor
from ..monitors import Monitor, Places, airframe, rotor, vortices
from .limits import TAIL_LOADING, tail_flow, tail_in_vortex_ring, tail_loading
from .solved import Solved
from .wake import WakeInTrim


def monitors(start: Solved) -> tuple[Monitor, ...]:
    """Everything that is watched of a trim."""
    model, mean = start.model, start.mean_outputs()
    places = disk_places(model, start.inflow_map.shape[0])
    fields = {"inflow": model.at_stations(start.inflow_map), **start.maps("alpha", "mach")}
    y = start.state()
    velocity = np.asarray(model.core.hub(y)[0]) / model.tip_speed
    mu, mu_z = mean["mu"], -float(velocity[2])
    theta = start.pitch_controls
    cyclic = float(np.hypot(theta["theta_1c"], theta["theta_1s"]))
    pitch = [theta[name] for name in ("theta_0", "theta_1c", "theta_1s")]
    *found, stalled = section_monitors(
        model, fields, velocity, pitch, (np.linalg.norm(y[:3]), np.linalg.norm(y[3:6])), places
    )
    at_75 = theta["theta_0"] + float(np.interp(0.75, model.bounds.station, model.bounds.twist))
    why = (
        f"mu = {mu:.3f}, C_T/sigma = {mean['ct'] / start.aircraft.solidity:.3f}, "
        f"{100 * stalled.values['stalled_share']:.0f} % of the disk beyond stall"
    )
    condition = start.condition
    ring = tail_in_vortex_ring(tail_flow(model, start.problem, start.x))
    found += [
        stalled,
        rotor.pitch({"collective": at_75, "cyclic": cyclic}, float(np.arctan2(-mu_z, 0.75)), why),
        rotor.axial_flow(mu, mu_z, mean["ct"], start.inflow.is_dynamic),
        *airframe.sticks(start.stick, start.aircraft.stick_travel_in),
        airframe.tail_rotor(tail_loading(model, start.problem, start.x), TAIL_LOADING, ring),
        airframe.power(mean["power"], start.aircraft.limits.power),
        *airframe.torque(-model.hand * mean["hub_moment"][2], start.aircraft.limits.torque),
        *airframe.rotor_speed(model.omega, start.aircraft.limits.rotor_speed),
        airframe.attitude(start.roll, start.pitch, condition.bank is not None or condition.turn_rate != 0.0),
        airframe.sideslip(y[:2].tolist(), condition.sideslip is not None),
    ]
    if start.wake is not None:
        found.append(rotor.vortex_distance(closest_vortex(model, start.wake)))
    return tuple(found)


def section_monitors(
    model: CompiledRotor,
    fields: dict[str, np.ndarray],
    velocity: np.ndarray,
    theta: Sequence[float] | np.ndarray,
    motion: tuple[Any, Any],
    places: Places,
    passage: int = 1,
) -> list[Monitor]:
    """Inflow, Mach number, angle of attack and stall of the sections.

    fields: inflow, mach, alpha (..., n_stations). velocity: of the hub over the tip speed (..., 3); theta: theta_0, theta_1c,
    theta_1s (..., 3) [rad]; motion: speed [m/s] and rate [rad/s] of what carries the rotor. passage: samples that a share of the
    disk is a mean over.
    """
    tables = model.rotor_tables["airfoil"]
    usual, bound = (each * model.top_share for each in model.bounds.inflow(velocity, theta))
    section = model.bounds.section(velocity, theta)
    speed, rate = motion
    fastest = model.bounds.mach(speed, rate + model.overspeed, section)
    angles, tip_mach = stall_along_span(tables, model.stations), model.tip_speed / model.speed_of_sound
    return [
        rotor.induced_velocity(fields["inflow"], usual, bound, places),
        rotor.mach_number(fields["mach"], fastest, table_end(tables), places),
        rotor.angle_of_attack(fields["alpha"], places),
        rotor.stall(angles, fields["alpha"], fields["mach"], model.area_weights, tip_mach, places, passage),
    ]


def disk_places(model: CompiledRotor, n_azimuths: int) -> Places:
    """Places of a map of `n_azimuths` on the stations of `model`."""
    return Places(model.stations / model.rotor["radius"], 2 * np.pi * np.arange(n_azimuths) / n_azimuths)


def closest_vortex(model: CompiledRotor, wake: WakeInTrim) -> float:
    """Smallest distance of a tip vortex of a relaxed wake from a blade, in core radii."""
    radius, blade = model.rotor["radius"], model.rotor_tables["blade"]
    step = 2 * np.pi / model.steps_per_revolution
    settings = model.inflow.free_wake
    return vortices.closest(
        wake.relaxation.lattice()[:, -1],
        wake.relaxation.core_radius()[:, -1],
        wake.psi,
        model.n_blades,
        model.rotor["hinge_offset"],
        blade["root_cutout"],
        settings.release_radius * radius,
        radius,
        round(settings.near_wake_angle / step),
    )
