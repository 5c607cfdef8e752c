# SPDX-License-Identifier: MIT OR Apache-2.0
"""The places of an aircraft that feel a wind, and the wind there."""

from __future__ import annotations

import numpy as np

from .. import _core
from .._core import Air
from ..attitude import axes, turned_back
from ..errors import InputError, NumericalFailure
from ..model import Model
from .kinds import STRONGEST, Wind


def passing(y: np.ndarray, wind: np.ndarray) -> np.ndarray:
    """States with the velocity against a `wind` (3,) [m/s] in inertial axes in place of that over ground."""
    u, v, w, *_ = first = y[:10].tolist()
    along, across, down = turned_back(axes(first[6:]), wind.tolist())
    moved = np.array(y)
    moved[:3] = u - along, v - across, w - down
    return moved


class Surroundings:
    """The places of an aircraft that feel a wind: origin of the body, hub, blade stations, tail."""

    def __init__(self, model: Model, wind: Wind):
        self.wind, self._closed = wind, wind.closed
        data = model.data
        tail = data["tail_rotor"] or data["fin"] or data["stabilator"]
        x, y, z = tail["position"] if tail else (-10.0, 0.0, 0.0)
        # parts of a mirrored aircraft stand where its file has them; the core reflects their loads
        self._places = _core.WindPlaces(model.core, (x, model.side * y, z))
        steady = wind.constant
        self._steady = None if steady is None else Air(steady)

    def at(self, t: float, y: np.ndarray, azimuth: float, ahead: float = 0.0) -> Air:
        """Wind at time `t` [s], `ahead` [s] of the states `y`, the first blade then at `azimuth` [rad]."""
        if self._steady is not None:
            return self._steady
        if self._closed is not None:
            air = self._places.blown(self._closed, t, y, azimuth, ahead)
        else:
            points = self._places.points(y, azimuth, ahead)
            air = Air(self._asked(points[:1], t)[0]) if self.wind.uniform else self._felt(points, t, y)
        # what is not a number is not within either
        if not air.largest <= STRONGEST:
            name = self.wind.described().get("name", self.wind.kind)
            raise NumericalFailure(f"wind {name} at t = {t:.4f} s is not finite, or beyond {STRONGEST:g} m/s")
        return air

    def _felt(self, points: np.ndarray, t: float, y: np.ndarray) -> Air:
        return self._places.felt(y, self._asked(points, t))

    def _asked(self, points: np.ndarray, t: float) -> np.ndarray:
        """What a wind in no closed form is there."""
        found = np.asarray(self.wind(points, t), dtype=float)
        if found.shape != points.shape:
            raise InputError.of(
                "wind", f"an answer of the shape {found.shape}", f"must be {points.shape}, as the points"
            )
        return found
