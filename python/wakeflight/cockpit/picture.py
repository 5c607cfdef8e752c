# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a page is shown: once for every run what it needs to draw, then thirty times a second numbers of one instant.

A frame is little-endian: number of the run (u4), then f4: the scalars of `SCALARS` in order; azimuth, flap, lead of every blade
[rad]; mean, sine and cosine of the inflow over the disk; and with a wake its nodes (blade, age, xyz) over the radius, in hub axes
(x aft, y right, z up), and their circulation (blade, age) [m2/s].
"""

from __future__ import annotations

import json
from collections import deque
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..attitude import euler_angles
from ..flight_by_hand import FlyingByHand
from ..recorder import Recorder
from ..stepping import Instant
from ..sticks import INCH, STICKS
from ..transfer import harmonics
from ..units import STANDARD_GRAVITY

SCALARS = {
    "time": "s",
    "pace": "",
    "exchange_median": "ms",
    "exchange_p99": "ms",
    "exchange_max": "ms",
    "exchange_length": "ms",
    "speed": "m/s",
    "climb_rate": "m/s",
    "altitude": "m",
    "height": "m",
    "north": "m",
    "east": "m",
    "down": "m",
    "roll": "rad",
    "pitch": "rad",
    "yaw": "rad",
    "sideslip": "rad",
    "p": "rad/s",
    "q": "rad/s",
    "r": "rad/s",
    "load_factor": "",
    "power": "W",
    "torque": "N m",
    "thrust": "N",
    "inflow_mean": "",
    "induced_velocity": "m/s",
    "beta_0": "rad",
    "beta_1c": "rad",
    "beta_1s": "rad",
    **dict.fromkeys(STICKS, "of travel"),
    **{f"{name}_blades": "of travel" for name in STICKS},
}
"""Numbers of a frame and their units. load_factor, power, torque, thrust and flapping are means over a revolution. height: above
the ground that is drawn. *_blades: the stick that stands for where the blades are put, behind controllers."""


@dataclass(frozen=True)
class Shown:
    """What pages are shown: a run by number, what is said of it once, what has been said since, the frame."""

    run: int
    opening: str
    version: int
    status: str
    frame: bytes


class Painter:
    """Frames of one run. Looking changes nothing: it reads what the recorder has kept of the instant."""

    def __init__(self, flying: FlyingByHand, run: int, height: float):
        """height: of the start above the ground that is drawn [m]."""
        self.flying, self.run, self.height = flying, run, height
        model = flying.sim.model
        self.tip_speed = model.omega * float(model.rotor["radius"])
        # numbers that swing with the blades, over the last revolution
        self._means: deque[tuple[float, ...]] = deque(maxlen=model.steps_per_revolution)
        self.fits: deque[np.ndarray] = deque(maxlen=model.steps_per_revolution)
        """Mean, sine and cosine of the inflow at every step of the last revolution."""

    def opening(self) -> str:
        """What a page needs once: JSON."""
        flying, model = self.flying, self.flying.sim.model
        aircraft, mass = flying.start.aircraft, flying.start.condition.gross_mass
        assert mass is not None, "the condition of a trim is complete"
        shape, radius = aircraft.geometry, float(model.rotor["radius"])
        tips = flying.sim.exchange.tips(flying.sim.steps)
        told: dict[str, Any] = {
            "run": self.run,
            "aircraft": aircraft.name,
            "inflow": model.inflow.name,
            "radius": radius,
            "hub": [each / radius for each in shape["hub"]],
            "shaft_tilt": shape["shaft_tilt"],
            "rotation": shape["rotation"],
            "rotor": {name: shape[name] / radius for name in ("hinge_offset", "root_cutout", "chord")},
            "blades": model.n_blades,
            "ages": 0 if tips is None else int(tips[0].shape[1]),
            "per_revolution": model.steps_per_revolution,
            "continued": flying.given.plan.begin is not None,
            "trim": dict(zip(STICKS, (flying.trim_in / flying.travel_in).tolist(), strict=True)),
            "travel": dict(zip(STICKS, flying.travel_in.tolist(), strict=True)),
            "weight": float(mass) * STANDARD_GRAVITY,
            "trim_power": float(flying.start.mean_outputs()["power"]),
            "scalars": list(SCALARS),
        }
        return json.dumps({"opening": told}, allow_nan=False)

    def see(self, instant: Instant, recorder: Recorder) -> None:
        """An instant has been kept: what is averaged."""
        y, y_dot, model = instant.y, instant.y_dot, self.flying.sim.model
        u, v, _, p, q, _ = y[:6].tolist()
        e0, e1, e2, e3 = y[6:10].tolist()
        # the share of gravity along body z, cos(roll) cos(pitch), from the quaternion of the attitude
        down = (e0 * e0 - e1 * e1 - e2 * e2 + e3 * e3) / (e0 * e0 + e1 * e1 + e2 * e2 + e3 * e3)
        factor = down - (float(y_dot[2]) + p * v - q * u) / STANDARD_GRAVITY
        power = float(recorder.latest("power"))
        flap = recorder.latest("flap")
        angles = recorder.latest("beta_1c"), recorder.latest("beta_1s")
        thrust = float(recorder.latest("hub_force")[2])
        self._means.append((factor, power, thrust, float(np.mean(flap)), *(float(each) for each in angles)))
        if model.inflow.is_dynamic:
            self.fits.append(y[slice(*model.layout["inflow"])].copy())
        elif len(self.fits) == 0 or instant.step % 6 == 0:
            self.fits.append(harmonics(self.flying.sim, recorder.latest("azimuth"), recorder.latest("inflow")))

    def frame(self, instant: Instant, recorder: Recorder, pace: float, spent: np.ndarray) -> bytes:
        """The frame of an instant; spent: time that exchanges took [s]."""
        flying, y = self.flying, instant.y
        sim, model = flying.sim, flying.sim.model
        roll, pitch, yaw = (float(each[0]) for each in euler_angles(y[None, 6:10]))
        u, v, w, p, q, r = y[:6].tolist()
        north, east, down = y[10:13].tolist()
        speed = float(np.sqrt(u * u + v * v + w * w))
        climb = u * np.sin(pitch) - np.cos(pitch) * (v * np.sin(roll) + w * np.cos(roll))
        factor, power, thrust, beta_0, beta_1c, beta_1s = np.mean(self._means, axis=0).tolist()
        mean = float(recorder.latest("inflow_mean"))
        percentiles = (1e3 * np.percentile(spent, (50, 99, 100))).tolist() if spent.size else [0.0, 0.0, 0.0]
        pilot = (flying.trim_in + flying.now) / flying.travel_in
        blades = instant.stick / INCH / flying.travel_in
        scalars = [
            instant.t,
            pace,
            *percentiles,
            1e3 * sim.delta_t,
            speed,
            climb,
            flying.start.condition.altitude - down,
            self.height - down,
            north,
            east,
            down,
            roll,
            pitch,
            yaw,
            float(np.arcsin(v / speed)) if speed > 1.0 else 0.0,
            p,
            q,
            r,
            factor,
            power,
            power / model.omega,
            thrust,
            mean,
            mean * self.tip_speed,
            beta_0,
            beta_1c,
            beta_1s,
            *pilot.tolist(),
            *blades.tolist(),
        ]
        motion = np.stack([recorder.latest(name) for name in ("azimuth", "flap", "lead")], axis=1)
        parts = [np.array(scalars), motion.ravel(), np.mean(self.fits, axis=0)]
        tips = sim.exchange.tips(instant.step)
        if tips is not None:
            parts += [tips[0].ravel() / float(model.rotor["radius"]), tips[1].ravel()]
        found: bytes = np.uint32(self.run).astype("<u4").tobytes() + np.concatenate(parts).astype("<f4").tobytes()
        return found
