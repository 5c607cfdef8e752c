# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a trimmed flight is: sticks, attitude, path, blade pitch, states and inputs, loads averaged over a revolution."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import _core
from ..aircraft import Aircraft
from ..condition import CompleteCondition
from ..inflow import InflowModel
from ..model import Model
from ..sticks import STICKS
from ..units import STANDARD_GRAVITY
from .equations import INCH, residual_norms
from .on_wake import Solution
from .revolution import inputs, instants
from .wake import CONTROL_TOLERANCE

PITCH_CONTROLS = ("theta_1c", "theta_1s", "theta_0", "theta_tr")


@dataclass(frozen=True, repr=False)
class Solved(Solution):
    """A trimmed flight; angles in rad, SI, sticks in inches from the stop."""

    model: Model
    seconds: float = 0.0
    """Wall clock of the trim."""
    asked: CompleteCondition | None = None
    """The condition as it was asked for, before what was left free of its path was found."""
    control_tolerance: float = CONTROL_TOLERANCE
    """Change of a pitch control [rad] at which it rested."""

    def __getstate__(self) -> dict[str, Any]:
        """The equations by value; monitors are found again."""
        state = {name: value for name, value in self.__dict__.items() if name != "monitors"}
        return state | {"problem": self.problem.to_bytes()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """The equations made again."""
        self.__dict__.update(state | {"problem": _core.TrimProblem.from_bytes(state["problem"])})

    @property
    def aircraft(self) -> Aircraft:
        """The aircraft."""
        return self.model.aircraft

    @property
    def condition(self) -> CompleteCondition:
        """The condition."""
        return self.model.condition

    @property
    def inflow(self) -> InflowModel:
        """The inflow model."""
        return self.model.inflow

    @property
    def stick_si(self) -> np.ndarray:
        """Lateral, longitudinal, collective, pedal [m from the stop]."""
        return self.x[:4].copy()

    @property
    def stick(self) -> dict[str, float]:
        """Sticks by name [inches from the stop]."""
        return dict(zip(STICKS, (self.x[:4] / INCH).tolist(), strict=True))

    @property
    def roll(self) -> float:
        """Bank, right side down positive [rad]."""
        return float(self.x[4])

    @property
    def pitch(self) -> float:
        """Pitch attitude, nose up positive [rad]."""
        return float(self.x[5])

    @property
    def yaw(self) -> float:
        """Heading against the track, nose right positive [rad]."""
        return float(self.x[6])

    @property
    def speed(self) -> float:
        """True airspeed [m/s], as given or found."""
        return self.condition.speed

    @property
    def flight_path(self) -> float:
        """Flight-path angle, climb positive [rad], as given or found."""
        return self.condition.flight_path

    @property
    def rate_of_descent(self) -> float:
        """Rate of descent [m/s], negative in climb."""
        return float(-self.speed * np.sin(self.flight_path))

    @property
    def turn_rate(self) -> float:
        """Rate of turn, to the right positive [rad/s], as given or found."""
        return self.condition.turn_rate

    @property
    def load_factor(self) -> float:
        """Resultant of all loads but gravity over the weight: sqrt(1 + (turn rate x horizontal speed/g)^2)."""
        return float(np.hypot(1.0, self.turn_rate * self.speed * np.cos(self.flight_path) / STANDARD_GRAVITY))

    @property
    def pitch_controls(self) -> dict[str, float]:
        """Blade pitch theta_1c, theta_1s, theta_0 and tail-rotor pitch theta_tr [rad]."""
        return dict(zip(PITCH_CONTROLS, self.model.pitch_controls(self.x[:4]).tolist(), strict=True))

    @property
    def theta_1c(self) -> float:
        """Lateral cyclic [rad]."""
        return self.pitch_controls["theta_1c"]

    @property
    def theta_1s(self) -> float:
        """Longitudinal cyclic [rad]."""
        return self.pitch_controls["theta_1s"]

    @property
    def theta_0(self) -> float:
        """Collective pitch at the root [rad]."""
        return self.pitch_controls["theta_0"]

    @property
    def theta_tr(self) -> float:
        """Tail-rotor pitch without bias [rad]."""
        return self.pitch_controls["theta_tr"]

    @property
    def residuals(self) -> dict[str, float]:
        """Largest residual of each kind: linear [m/s2], angular [rad/s2], blade harmonics [rad], inflow [-]."""
        return residual_norms(self.model, self.problem, self.x)

    @property
    def stabilator_incidence(self) -> float:
        """Incidence of the stabilator, trailing edge down positive [rad]."""
        return self.model.core.trim_stabilator(self.problem, self.x)

    def state(self, t: float = 0.0) -> np.ndarray:
        """State y of the trimmed revolution at time `t` [s]."""
        return self.model.core.trim_state(self.problem, self.x, t)[0]

    def inputs(self, t: float = 0.0) -> _core.Inputs:
        """Sticks and inflow that hold the trim at `t` [s]: the map at each blade's azimuth, or the inflow states."""
        return inputs(self.model, self.problem, self.x, self._held, t)

    @property
    def _held(self) -> np.ndarray | None:
        """The inflow map; None where inflow is in the state."""
        return None if self.inflow.is_dynamic else self.inflow_map

    @property
    def counters(self) -> dict[str, int]:
        """Counted work of the wake."""
        return {} if self.wake is None else dict(self.wake.counters)

    def instants(self) -> list[tuple[list[int], dict[str, Any]]]:
        """Outputs over the angle between two blades: every azimuth is passed once; with the azimuth index of every blade."""
        return instants(self.model, self.problem, self.x, self._held)

    def maps(self, *names: str) -> dict[str, np.ndarray]:
        """Section quantities `names` of the outputs by azimuth and station, like `inflow_map`."""
        found = {name: np.empty_like(self.circulation) for name in names}
        for rows, out in self.instants():
            for name, values in found.items():
                values[rows] = out[name]
        return found

    def mean_outputs(self) -> dict[str, Any]:
        """Averages over a revolution: ct, advance ratio, power [W], hub and airframe loads, flapping [rad], mean inflow."""
        model, records = self.model, [out for _, out in self.instants()]
        numbers, loads = ("ct", "beta_1c", "beta_1s"), ("force", "moment", "hub_force", "hub_moment")
        mean = {name: np.mean([out[name] for out in records], axis=0) for name in (*loads, *numbers, "power")}
        hub_velocity, _ = model.core.hub(self.state())
        modes = model.core.trim_layout(self.problem).modes
        return {
            **{name: mean[name] for name in loads},
            **{name: float(mean[name]) for name in numbers},
            "beta_0": float(self.x[modes[model.rotor["flap_mode"]]] * model.rotor["flap_per_coordinate"]),
            "power_main": float(mean["power"][0]),
            "power_tail": float(mean["power"][1]),
            "power": float(mean["power"].sum()),
            "mu": float(np.hypot(hub_velocity[0], hub_velocity[1]) / model.tip_speed),
            "inflow_mean": model.disk_mean(self.inflow_map),
        }

    def inflow_harmonics(self) -> tuple[float, float, float]:
        """lambda_0, lambda_1c, lambda_1s of the inflow map: see `disk.first_harmonics`."""
        return self.model.first_harmonics(self.inflow_map)
