# SPDX-License-Identifier: MIT OR Apache-2.0
"""The places of an aircraft that feel a wind, and the wind there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..attitude import body_to_inertial
from ..errors import InputError, NumericalFailure
from ..model import Model
from ..results.frames import body_of_hub
from .kinds import STRONGEST, Wind


@dataclass(frozen=True)
class Air:
    """A wind where an aircraft is, held over a coupling step; velocities in inertial axes [m/s]."""

    origin: np.ndarray
    """At the origin of the body (3,)."""
    at_hub: np.ndarray
    """At the hub of the main rotor (3,)."""
    turn: np.ndarray
    """Rates at which it turns about the airframe (3,) [rad/s], body axes."""
    stations: np.ndarray | None
    """Along the shaft at the blade stations less that at the hub, as inflow, positive down (n_blades, n_stations); None where the
    air is the same everywhere."""

    def on(self, held: np.ndarray | None) -> np.ndarray | None:
        """Held inflow with the gust at the stations in it."""
        if held is None or self.stations is None:
            return held
        lines = held.shape[1] // self.stations.shape[1]
        gusty: np.ndarray = held + np.tile(self.stations, lines)
        return gusty

    def acting(self, dynamic: bool) -> tuple[Any, ...]:
        """As the core takes it; the stations are in the held inflow where there is one."""
        if self.stations is None:
            return (self.origin, None)
        return self.origin, (self.at_hub - self.origin, self.turn, self.stations if dynamic else None)

    def passing(self, y: np.ndarray) -> np.ndarray:
        """States with the velocity against this air in place of that over ground."""
        return passing(y, self.origin)


def passing(y: np.ndarray, wind: np.ndarray) -> np.ndarray:
    """States with the velocity against a `wind` (3,) [m/s] in inertial axes in place of that over ground."""
    moved = np.array(y)
    moved[:3] -= body_to_inertial(y[6:10]).T @ wind
    return moved


class Surroundings:
    """The places of an aircraft that feel a wind: origin of the body, hub, blade stations, tail."""

    def __init__(self, model: Model, wind: Wind):
        self.wind, self.model = wind, model
        rotor = model.data["rotor"]
        self.position = np.array(rotor["position"], dtype=float)
        self.from_hub = body_of_hub(rotor["shaft_tilt_forward"], rotor["shaft_tilt_lateral"])
        tail = model.data["tail_rotor"] or model.data["fin"] or model.data["stabilator"]
        self.tail = np.array(tail["position"], dtype=float) if tail else np.array([-10.0, 0.0, 0.0])
        self._still = np.zeros(3)

    def at(self, t: float, y: np.ndarray, azimuth: float) -> Air:
        """Wind at time `t` [s] in the states `y`, the first blade at `azimuth` [rad]."""
        model = self.model
        if self.wind.uniform:
            (found,) = self._asked(y[None, 10:13], t)
            return Air(found, found, self._still, None)
        to_inertial = body_to_inertial(y[6:10])
        psi = azimuth + 2 * np.pi * np.arange(model.n_blades) / model.n_blades
        # from the hub, blades drawn straight and without their flap
        spokes = np.stack([np.cos(psi), model.hand * np.sin(psi), np.zeros(psi.size)], axis=1)
        blades = (spokes[:, None, :] * model.stations[None, :, None]).reshape(-1, 3) @ self.from_hub.T
        places = np.concatenate([[self._still, self.position, self.tail], self.position + blades])
        points = y[10:13] + places @ to_inertial.T
        found = self._asked(points, t)
        origin, at_hub, tail = found[:3]
        if np.ptp(found, axis=0).max() == 0.0:
            return Air(origin, at_hub, self._still, None)
        shaft = to_inertial @ self.from_hub[:, 2]
        rows = -((found[3:] - at_hub) @ shaft) / model.tip_speed
        # gradients of a line from the origin to the tail: w by x turns as a rate of pitch, v by x as one of yaw
        along = self.tail[0] or 1.0
        _, side, down = to_inertial.T @ (tail - origin) / along
        return Air(origin, at_hub, np.array([0.0, -down, side]), rows.reshape(model.n_blades, -1))

    def _asked(self, points: np.ndarray, t: float) -> np.ndarray:
        found = np.asarray(self.wind(points, t), dtype=float)
        if found.shape != points.shape:
            raise InputError.of(
                "wind", f"an answer of the shape {found.shape}", f"must be {points.shape}, as the points"
            )
        if not np.isfinite(found).all() or np.abs(found).max() > STRONGEST:
            name = self.wind.described().get("name", self.wind.kind)
            raise NumericalFailure(f"wind {name} at t = {t:.4f} s is not finite, or beyond {STRONGEST:g} m/s")
        return found
