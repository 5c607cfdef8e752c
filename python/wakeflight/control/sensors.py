# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a controller may know of the flight at one moment."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from ..errors import InputError
from ..units import STANDARD_GRAVITY

Measure = Callable[[], tuple[np.ndarray, dict[str, Any]]]
"""Rates of the states and loads at that moment, found when they are asked for."""

SIGNALS = (
    *("u", "v", "w", "p", "q", "r", "roll", "pitch", "yaw", "north", "east", "down"),
    *("airspeed", "sideslip", "climb_rate", "altitude", "rotor_speed"),
    *("ax", "ay", "az", "load_factor", "torque"),
)
"""Names of all of them."""


class Sensors:
    """The flight at one moment, exact, SI and radians; attributes by the names of `SIGNALS`.

    u, v, w over ground [m/s], p, q, r [rad/s]: body axes. roll, pitch, yaw [rad]: 3-2-1 angles. north, east, down [m] from there.
    airspeed [m/s], sideslip [rad]: through the air; climb_rate [m/s], altitude [m] above sea level, rotor_speed [rad/s].
    ax, ay, az [m/s2]: what accelerometers at the origin of the body axes show, -9.81 along z in level flight; load_factor: -az
    over standard gravity; torque [N m] of the main rotor's shaft. These five cost one solution of the equations of motion, once.
    """

    def __init__(
        self,
        y: np.ndarray,
        ground: float,
        rotor_speed: float,
        measure: Measure,
        through_air: tuple[float, float, float] | None = None,
    ):
        # plain numbers: arrays of one attitude would take five times as long, at every step
        seen = y[:13].tolist()
        self.u, self.v, self.w, self.p, self.q, self.r, a, b, c, d, self.north, self.east, self.down = seen
        size = math.sqrt(a * a + b * b + c * c + d * d)
        a, b, c, d = a / size, b / size, c / size, d / size
        self._quaternion = a, b, c, d
        # z of the earth in body axes
        self._down = (2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c))
        self.altitude = ground - self.down
        self.rotor_speed = rotor_speed
        self._measure = measure
        # against the air, where it moves
        self._through = (self.u, self.v, self.w) if through_air is None else through_air

    @property
    def roll(self) -> float:
        """Bank, right side down positive [rad]."""
        a, b, c, d = self._quaternion
        return math.atan2(2 * (a * b + c * d), 1 - 2 * (b * b + c * c))

    @property
    def pitch(self) -> float:
        """Pitch attitude, nose up positive [rad]."""
        a, b, c, d = self._quaternion
        return math.asin(min(1.0, max(-1.0, 2 * (a * c - d * b))))

    @property
    def yaw(self) -> float:
        """Heading, nose right positive [rad]."""
        a, b, c, d = self._quaternion
        return math.atan2(2 * (a * d + b * c), 1 - 2 * (c * c + d * d))

    @property
    def airspeed(self) -> float:
        """Speed through the air [m/s]."""
        u, v, w = self._through
        return math.sqrt(u**2 + v**2 + w**2)

    @property
    def sideslip(self) -> float:
        """Angle of the velocity through the air out of the plane of symmetry, from the right positive [rad]."""
        return math.atan2(self._through[1], self._through[0])

    @property
    def climb_rate(self) -> float:
        """Speed upward [m/s]."""
        x, y, z = self._down
        return float(-(self.u * x + self.v * y + self.w * z))

    @cached_property
    def _measured(self) -> tuple[np.ndarray, dict[str, Any]]:
        return self._measure()

    @property
    def ax(self) -> float:
        """Specific force forward [m/s2]."""
        rate, _ = self._measured
        return float(rate[0] + self.q * self.w - self.r * self.v - STANDARD_GRAVITY * self._down[0])

    @property
    def ay(self) -> float:
        """Specific force to the right [m/s2]."""
        rate, _ = self._measured
        return float(rate[1] + self.r * self.u - self.p * self.w - STANDARD_GRAVITY * self._down[1])

    @property
    def az(self) -> float:
        """Specific force down [m/s2]."""
        rate, _ = self._measured
        return float(rate[2] + self.p * self.v - self.q * self.u - STANDARD_GRAVITY * self._down[2])

    @property
    def load_factor(self) -> float:
        """n_z: specific force up over standard gravity."""
        return -self.az / STANDARD_GRAVITY

    @property
    def torque(self) -> float:
        """Torque of the main rotor's shaft [N m], positive where the engine drives."""
        _, out = self._measured
        return float(out["torque"])

    def __getitem__(self, name: str) -> float:
        """A signal by its name."""
        if name not in SIGNALS:
            raise InputError.of("signal", name, f"allowed: {', '.join(SIGNALS)}")
        value: float = getattr(self, name)
        return value
