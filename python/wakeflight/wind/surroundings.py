# SPDX-License-Identifier: MIT OR Apache-2.0
"""The places of an aircraft that feel a wind, and the wind there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..attitude import axes, turned_back
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

    def against(self, y: np.ndarray) -> tuple[float, float, float]:
        """Velocity against this air in the states `y` [m/s], body axes."""
        return against(y, self.origin)

    def passing(self, y: np.ndarray) -> np.ndarray:
        """States with the velocity against this air in place of that over ground."""
        return passing(y, self.origin)


def passing(y: np.ndarray, wind: np.ndarray) -> np.ndarray:
    """States with the velocity against a `wind` (3,) [m/s] in inertial axes in place of that over ground."""
    moved = np.array(y)
    moved[:3] = against(y, wind)
    return moved


def against(y: np.ndarray, wind: np.ndarray) -> tuple[float, float, float]:
    """Velocity against a `wind` (3,) [m/s] in inertial axes in the states `y` [m/s], body axes."""
    u, v, w, *_ = first = y[:10].tolist()
    along, across, down = turned_back(axes(first[6:]), wind.tolist())
    return u - along, v - across, w - down


class Surroundings:
    """The places of an aircraft that feel a wind: origin of the body, hub, blade stations, tail."""

    def __init__(self, model: Model, wind: Wind):
        self.wind = wind
        self.tip_speed = model.tip_speed
        rotor = model.data["rotor"]
        position = np.array(rotor["position"], dtype=float)
        from_hub = body_of_hub(rotor["shaft_tilt_forward"], rotor["shaft_tilt_lateral"])
        tail = model.data["tail_rotor"] or model.data["fin"] or model.data["stabilator"]
        behind = np.array(tail["position"], dtype=float) if tail else np.array([-10.0, 0.0, 0.0])
        self._still = np.zeros(3)
        # a line from the origin to the tail
        self._along = float(behind[0]) or 1.0
        self._places = np.array([self._still, position, behind])
        # hub axes in the body; y counts in the sense of rotation
        self._hub_axes = from_hub.T * np.array([[1.0], [model.hand], [1.0]])
        self._blades = 2 * np.pi * np.arange(model.n_blades) / model.n_blades
        self._reach = model.stations[None, :, None]
        steady = wind.constant
        self._steady = None if steady is None else Air(steady, steady, self._still, None)

    def at(self, t: float, y: np.ndarray, azimuth: float, ahead: float = 0.0) -> Air:
        """Wind at time `t` [s], `ahead` [s] of the states `y`, the first blade then at `azimuth` [rad]."""
        if self._steady is not None:
            return self._steady
        u, v, w, _, _, _, *attitude, north, east, down = y[:13].tolist()
        rows = axes(attitude)
        x, y_i, z = (a * u + b * v + c * w for a, b, c in rows)
        place = np.array([north + ahead * x, east + ahead * y_i, down + ahead * z])
        if self.wind.uniform:
            (found,) = self._asked(place[None], t)
            return Air(found, found, self._still, None)
        to_inertial = np.array(rows)
        turn = to_inertial.T
        points = self._points(place, turn, azimuth)
        found = self._asked(points, t)
        origin, at_hub, tail = found[:3]
        if (found == origin).all():
            return Air(origin, at_hub, self._still, None)
        felt = (found[3:] - at_hub) @ (to_inertial @ self._hub_axes[2])
        # gradients of the line to the tail: w by x turns as a rate of pitch, v by x as one of yaw
        _, side, fall = (turn @ (tail - origin)).tolist()
        rates = np.array([0.0, -fall / self._along, side / self._along])
        return Air(origin, at_hub, rates, (felt / -self.tip_speed).reshape(self._blades.size, -1))

    def _points(self, place: np.ndarray, turn: np.ndarray, azimuth: float) -> np.ndarray:
        """Origin, hub, tail, and the stations blade by blade (3 + n, 3), inertial axes; blades straight and without flap."""
        psi = azimuth + self._blades
        spokes = np.stack([np.cos(psi), np.sin(psi)], axis=1) @ (self._hub_axes[:2] @ turn)
        fixed = place + self._places @ turn
        stations = fixed[1] + spokes[:, None, :] * self._reach
        return np.concatenate([fixed, stations.reshape(-1, 3)])

    def _asked(self, points: np.ndarray, t: float) -> np.ndarray:
        found = np.asarray(self.wind(points, t), dtype=float)
        if found.shape != points.shape:
            raise InputError.of(
                "wind", f"an answer of the shape {found.shape}", f"must be {points.shape}, as the points"
            )
        # what is not a number is not within either
        if not (found.min() >= -STRONGEST and found.max() <= STRONGEST):
            name = self.wind.described().get("name", self.wind.kind)
            raise NumericalFailure(f"wind {name} at t = {t:.4f} s is not finite, or beyond {STRONGEST:g} m/s")
        return found
