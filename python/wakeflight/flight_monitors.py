# SPDX-License-Identifier: MIT OR Apache-2.0
"""The monitors of a flight, of all that was recorded."""

from __future__ import annotations

import numpy as np

from .monitors import Monitor, Places, airframe, hinges, rotor
from .recorder import Recorder
from .sticks import INCH, STICKS
from .trim.monitors import section_monitors
from .wind import passing


def monitors(run: Recorder) -> tuple[Monitor, ...]:
    """Everything that is watched of a flight, over all that was recorded."""
    n, model, aircraft = run.n_recorded, run.model, run.start.aircraft
    if n == 0:
        return ()
    time, y, stick = run.time[:n], run.state[:n], run.stick[:n]
    places = Places(model.bounds.station, run.azimuth[:n], time)
    fields = {name: run.blade[name][:n] for name in ("inflow", "mach", "alpha")}
    flown = y if run.wind is None else np.array([passing(*row) for row in zip(y, run.wind[:n], strict=True)])
    velocity = np.array([model.core.hub(row)[0] for row in flown]) / model.tip_speed
    mu, mu_z = np.hypot(velocity[:, 0], velocity[:, 1]), -velocity[:, 2]
    theta = np.array([model.pitch_controls(row) for row in stick])[:, [2, 0, 1]]
    motion = (np.linalg.norm(flown[:, :3], axis=1), np.linalg.norm(y[:, 3:6], axis=1))
    passage = model.steps_per_revolution // model.n_blades
    inches = dict(zip(STICKS, run.log.pilot(n, stick).T / INCH, strict=True))
    engine = rotor.over_passage(run.scalars["power"][:n], passage)
    shaft = rotor.over_passage(-model.hand * run.loads["hub_moment"][:n, 2], passage)
    found = [
        *section_monitors(model, fields, velocity, theta, motion, places, passage),
        rotor.axial_flow(mu, mu_z, run.scalars["ct"][:n], model.inflow.is_dynamic, time),
        *airframe.sticks(inches, aircraft.stick_travel_in, time),
        airframe.power(engine, aircraft.limits.power, time),
        *airframe.torque(shaft, aircraft.limits.torque, time),
        *airframe.rotor_speed(run.rotor_speed, aircraft.limits.rotor_speed),
        airframe.ground(y[:, 12], run.start.condition.altitude, time),
    ]
    return (*found, *_of_hinges(run, time), *_of_wake(run, time))


def _of_wake(run: Recorder, time: np.ndarray) -> list[Monitor]:
    """What a free wake adds: its vortices, its nodes, its inner solves."""
    if run.model.inflow.is_dynamic:
        return []
    n, counted = run.n_recorded, run.counters()
    found: list[Monitor] = []
    distance = run.vortex_distance()
    if distance is not None:
        found.append(rotor.vortex_distance(distance))
        found.append(rotor.node_motion(run.scalars["max_displacement"][:n], run.model.rotor["radius"], time))
    if run.model.inflow.is_relaxed:
        found.append(rotor.unrenewed(counted["unconverged_revolutions"], counted["relaxation_updates"]))
    share = run.share_below_ground()
    if share is not None and share.size:
        found.append(hinges.below_ground(share))
    return found


def _of_hinges(run: Recorder, time: np.ndarray) -> list[Monitor]:
    """What the stops of the hinges have met, where the aircraft's file has them."""
    model, n = run.model, run.n_recorded
    given = [(name, model.data["rotor"]["blade"].get(f"{name}_stops")) for name in ("flap", "lag")]
    if all(stop is None for _, stop in given):
        return []
    parts = [np.ascontiguousarray(run.state[:n, a:b]) for a, b in model.layout["modal"]]
    angles = zip(*(model.core.hinge_angles(part) for part in parts), strict=True)
    return [
        hinges.stops(name, np.stack(angle, axis=1), stop, time)
        for (name, stop), angle in zip(given, angles, strict=True)
        if stop is not None
    ]
