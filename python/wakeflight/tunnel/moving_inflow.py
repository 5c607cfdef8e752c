# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a transient on the stand takes its inflow from: a marching wake, or the states of dynamic inflow."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from .. import _core
from .model import StandModel
from .solve import Solution

Motion = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Modal coordinates, rates and accelerations (n_blades, n_modes)."""

PARTS = 4
"""Steps of the states of dynamic inflow in one step of azimuth."""


class MovingInflow(Protocol):
    """Inflow of the blades at their present azimuths, carried on step by step."""

    inflow: np.ndarray
    """Held over the next step (n_blades, width)."""

    def psi(self) -> np.ndarray:
        """Azimuths of the blades (n_blades,) [rad]."""

    def advance(self, y: np.ndarray, controls: np.ndarray, rates: np.ndarray, motion: Motion) -> None:
        """The blades have reached the next step with pitch controls that go on at `rates`."""

    def kept(self) -> dict[str, np.ndarray]:
        """What a result keeps of it besides the inflow."""


class MarchedInflow:
    """A copy of the stand's marching wake."""

    def __init__(self, solution: Solution) -> None:
        self.march = solution.march.copy()

    @property
    def inflow(self) -> np.ndarray:
        """Held over the next step (n_blades, width)."""
        return self.march.inflow

    def psi(self) -> np.ndarray:
        """Azimuths of the blades (n_blades,) [rad]."""
        return 2 * np.pi * np.array(self.march.rows(self.march.step_index)) / self.march.n

    def advance(self, y: np.ndarray, controls: np.ndarray, rates: np.ndarray, motion: Motion) -> None:
        """Circulation, wake, inflow and circulation again."""
        self.march.advance(y, controls, rates, motion[:2])

    def kept(self) -> dict[str, np.ndarray]:
        """Tip vortices and their circulation."""
        return {"wake": self.march.position(), "tip_circulation": self.march.marker_circulation()}


class StatesOfInflow:
    """lambda_0, lambda_s, lambda_c from the stand's steady ones, driven by the loads of all blades at the instant."""

    def __init__(self, model: StandModel, solution: Solution) -> None:
        i = model.core.trim_layout(solution.problem).inflow
        self.model = model
        self.states = solution.x[i : i + 3].copy()
        self.n, self.step_index = model.steps_per_revolution, 0

    def psi(self) -> np.ndarray:
        """Azimuths of the blades (n_blades,) [rad]."""
        apart = self.n // self.model.n_blades
        return 2 * np.pi * ((self.step_index + apart * np.arange(self.model.n_blades)) % self.n) / self.n

    @property
    def inflow(self) -> np.ndarray:
        """lambda_0 + (lambda_s sin psi + lambda_c cos psi) r at the stations (n_blades, n_stations)."""
        mean, sine, cosine = self.states
        psi, r = self.psi(), self.model.stations / self.model.rotor["radius"]
        return mean + np.outer(sine * np.sin(psi) + cosine * np.cos(psi), r)

    def advance(self, y: np.ndarray, controls: np.ndarray, rates: np.ndarray, motion: Motion) -> None:
        """The states over the step at the loads of its end, by Runge-Kutta steps of fourth order."""
        model = self.model
        self.step_index += 1
        loads = model.core.blade_passages(y, self.psi(), motion, controls, rates, self.inflow)
        force, moment = loads["aero_force"].sum(axis=0), loads["aero_moment"].sum(axis=0)
        scale, radius = model.dynamic_pressure_area, model.rotor["radius"]
        u, v, w = np.asarray(model.condition.velocity) / model.tip_speed
        disk = [force[2] / scale, -moment[0] / (scale * radius), moment[1] / (scale * radius), -u, v, -w]
        h = 2 * np.pi / model.omega / self.n / PARTS

        def rate(states: np.ndarray) -> np.ndarray:
            return np.array(_core.pitt_peters_rate(states, disk, model.omega))

        for _ in range(PARTS):
            a = rate(self.states)
            b = rate(self.states + 0.5 * h * a)
            c = rate(self.states + 0.5 * h * b)
            d = rate(self.states + h * c)
            self.states = self.states + h / 6 * (a + 2 * b + 2 * c + d)

    def kept(self) -> dict[str, Any]:
        """Nothing: the inflow at the stations is all there is."""
        return {}
