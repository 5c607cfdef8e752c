# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a controller may know of the flight at one moment."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from .._core import Air, Sensed
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


class Sensors(Sensed):
    """The flight at one moment, exact, SI and radians; attributes by the names of `SIGNALS`.

    u, v, w over ground [m/s], p, q, r [rad/s]: body axes. roll, pitch, yaw [rad]: 3-2-1 angles. north, east, down [m] from there.
    airspeed [m/s], sideslip [rad]: through the air; climb_rate [m/s], altitude [m] above sea level, rotor_speed [rad/s].
    ax, ay, az [m/s2]: what accelerometers at the origin of the body axes show, -9.81 along z in level flight; load_factor: -az
    over standard gravity; torque [N m] of the main rotor's shaft. These five cost one solution of the equations of motion, once.
    """

    _measure: Measure

    def __new__(
        cls, y: np.ndarray, ground: float, rotor_speed: float, measure: Measure, air: Air | None = None
    ) -> Sensors:
        """Of states `y` over ground at an altitude [m], with the speed of the rotor [rad/s] and the air, where it moves."""
        found: Sensors = super().__new__(cls, y, ground, rotor_speed, air)
        found._measure = measure
        return found

    @cached_property
    def _measured(self) -> tuple[np.ndarray, dict[str, Any]]:
        return self._measure()

    @property
    def ax(self) -> float:
        """Specific force forward [m/s2]."""
        rate, _ = self._measured
        return float(rate[0] + self.q * self.w - self.r * self.v - STANDARD_GRAVITY * self.earth[0])

    @property
    def ay(self) -> float:
        """Specific force to the right [m/s2]."""
        rate, _ = self._measured
        return float(rate[1] + self.r * self.u - self.p * self.w - STANDARD_GRAVITY * self.earth[1])

    @property
    def az(self) -> float:
        """Specific force down [m/s2]."""
        rate, _ = self._measured
        return float(rate[2] + self.p * self.v - self.q * self.u - STANDARD_GRAVITY * self.earth[2])

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
