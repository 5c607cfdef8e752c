# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a solved rotor on a stand is: its passages, coefficients, loads, flapping and wake."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from ..errors import InputError
from .solve import Revolution, Solution, by_azimuth


class Solved:
    """A solved rotor on a stand: `.ct`, `.cq` and the rest, SI and radians.

    Means over the revolution; with a marching wake over the last `.averaged` revolutions, with their scatter.
    """

    def __init__(self, solution: Solution, seconds: float = 0.0) -> None:
        """Keep the solution; everything else follows from it when asked for."""
        self.solution = solution
        self.model = solution.model
        self.seconds = seconds

    # --- passages -------------------------------------------------------------------------------------------

    @property
    def averaged(self) -> int:
        """Marched revolutions in the means; 0 where the solution is periodic by construction."""
        return self.solution.averaged

    @property
    def settled(self) -> bool:
        """Whether inflow, circulation and blade motion rest; if not, `.notes` says what still changes."""
        return self.solution.settled

    @cached_property
    def turns_kept(self) -> list[Revolution]:
        """Marched revolutions in the means; none where the solution is periodic by construction."""
        return self.solution.revolutions[-self.averaged :] if self.averaged else []

    @cached_property
    def _periodic(self) -> dict[str, np.ndarray]:
        """Passages of the periodic solution by azimuth (n, ...); empty with a marching wake."""
        s = self.solution
        # dynamic inflow acts at the deflected blade: it is part of the solution, not of the map
        inflow = None if self.model.inflow.is_dynamic else s.inflow_map
        return self.model.core.passages(s.problem, s.x, self.azimuth, inflow)

    def passed(self, *names: str) -> tuple[np.ndarray, list[np.ndarray]]:
        """Azimuths (n,) [rad] of every passage in the means, and the quantities `names` there (n, n_stations)."""
        if not self.turns_kept:
            return self.azimuth, [self._periodic[name] for name in names]
        found = [self._passages(name) for name in names]
        return self.azimuth[found[0][0].ravel()], [values.reshape(-1, values.shape[-1]) for _, values in found]

    def mean_by_azimuth(self, name: str) -> np.ndarray:
        """Mean of a quantity by azimuth (n, ...)."""
        if not self.turns_kept:
            return self._periodic[name]
        rows, values = self._passages(name)
        return by_azimuth(rows, values, len(self.azimuth))

    def _passages(self, name: str) -> tuple[np.ndarray, np.ndarray]:
        rows = np.concatenate([turn.rows for turn in self.turns_kept])
        values = np.concatenate([turn.passages[name] for turn in self.turns_kept])
        return rows, values

    def spread_by_azimuth(self, name: str) -> np.ndarray:
        """Standard deviation over the passages of each azimuth."""
        mean = self.mean_by_azimuth(name)
        if not self.turns_kept:
            return np.zeros_like(mean)
        rows, values = self._passages(name)
        found: np.ndarray = np.sqrt(by_azimuth(rows, (values - mean[rows]) ** 2, len(self.azimuth)))
        return found

    def _mean_load(self, name: str) -> np.ndarray:
        """Mean of a load of all blades (3,)."""
        found: np.ndarray = self.model.n_blades * self.mean_by_azimuth(name).mean(axis=0)
        return found

    @cached_property
    def azimuth(self) -> np.ndarray:
        """Azimuths of the maps [rad]."""
        n = self.model.steps_per_revolution
        return 2 * np.pi * np.arange(n) / n

    @cached_property
    def x(self) -> np.ndarray:
        """Pitch controls and blade harmonics, means over the revolutions averaged."""
        return np.mean([turn.x for turn in self.turns_kept], axis=0) if self.turns_kept else self.solution.x

    # --- coefficients and loads -----------------------------------------------------------------------------

    @cached_property
    def aero_force(self) -> np.ndarray:
        """Mean force of the air on the blades [N], hub axes (x aft, y right, z up)."""
        return self._mean_load("aero_force")

    @cached_property
    def aero_moment(self) -> np.ndarray:
        """Mean moment of the air about the hub centre [N m], hub axes."""
        return self._mean_load("aero_moment")

    @cached_property
    def hub_force(self) -> np.ndarray:
        """Mean force on the hub [N], inertia and weight of the blades included, hub axes."""
        return self._mean_load("force")

    @cached_property
    def hub_moment(self) -> np.ndarray:
        """Mean moment on the hub [N m], hub axes."""
        return self._mean_load("moment")

    @property
    def thrust_scale(self) -> float:
        """Dynamic pressure of the tip times the disk area [N]."""
        return self.model.dynamic_pressure_area

    @property
    def radius(self) -> float:
        """Rotor radius [m]."""
        return float(self.model.rotor["radius"])

    @property
    def thrust(self) -> float:
        """Aerodynamic thrust along the shaft [N]."""
        return float(self.aero_force[2])

    @property
    def torque(self) -> float:
        """Aerodynamic torque about the shaft that the drive must supply [N m]."""
        return float(-self.aero_moment[2])

    @property
    def power(self) -> float:
        """Shaft power [W]."""
        return self.torque * self.model.omega

    @property
    def ct(self) -> float:
        """Thrust coefficient T/(rho pi R^2 (Omega R)^2)."""
        return self.thrust / self.thrust_scale

    @property
    def cq(self) -> float:
        """Torque coefficient Q/(rho pi R^3 (Omega R)^2)."""
        return self.torque / (self.thrust_scale * self.radius)

    @property
    def cp(self) -> float:
        """Power coefficient, equal to `cq`."""
        return self.cq

    @property
    def figure_of_merit(self) -> float:
        """C_T^1.5/(sqrt(2) C_P) of hover; 0 where thrust or power is not positive."""
        return self.ct**1.5 / (np.sqrt(2.0) * self.cp) if self.ct > 0.0 and self.cp > 0.0 else 0.0

    @property
    def theta_0(self) -> float:
        """Collective at the root [rad]."""
        return float(self.x[0])

    @property
    def theta_1c(self) -> float:
        """Lateral cyclic [rad]."""
        return float(self.x[1])

    @property
    def theta_1s(self) -> float:
        """Longitudinal cyclic [rad]."""
        return float(self.x[2])

    @cached_property
    def flapping(self) -> tuple[float, float, float]:
        """beta_0, beta_1c, beta_1s of the first flap mode [rad]."""
        modes = self.model.core.trim_layout(self.solution.problem).modes
        if len(modes) == 1:
            return 0.0, 0.0, 0.0
        start, scale = modes[self.model.rotor["flap_mode"]], self.model.rotor["flap_per_coordinate"]
        beta = self.x[start : start + 3] * scale
        mean, cosine, sine = (*beta, 0.0, 0.0)[:3] if self.model.n_harmonics else (beta[0], 0.0, 0.0)
        return float(mean), float(cosine), float(sine)

    @property
    def beta_0(self) -> float:
        """Coning of the first flap mode [rad], precone not included."""
        return self.flapping[0]

    @property
    def beta_1c(self) -> float:
        """Cosine of the first flap mode [rad], > 0 is disk forward-down."""
        return self.flapping[1]

    @property
    def beta_1s(self) -> float:
        """Sine of the first flap mode [rad], > 0 is advancing side up."""
        return self.flapping[2]

    @cached_property
    def residual(self) -> float:
        """Largest residual of the rotor's equations (angle [rad], blade loading, inflow ratio)."""
        s = self.solution
        return float(np.max(np.abs(self.model.core.trim_residual(s.problem, s.x))))

    def inflow_harmonics(self) -> tuple[float, float, float]:
        """lambda_0, lambda_1c, lambda_1s of the inflow: see `disk.first_harmonics`."""
        return self.model.first_harmonics(self.mean_by_azimuth("inflow"))

    # --- wake -----------------------------------------------------------------------------------------------

    def wake_velocity(self, points: Any) -> np.ndarray:
        """Velocity (n, 3) [m/s] induced at `points` (n, 3) [m], hub axes (x aft, y right, z up), mean over a revolution.

        Bound vortices, tip vortices and what else is free; near-wake trailers not: for points away from the blades.
        With a marching wake the mean is over its last revolution.
        """
        try:
            at = np.atleast_2d(np.asarray(points, dtype=float))
        except (TypeError, ValueError) as reason:
            raise InputError.of("points", points, "must be finite numbers of shape (n, 3)") from reason
        if at.ndim != 2 or at.shape[1] != 3 or not np.all(np.isfinite(at)):
            raise InputError.of("points", np.shape(points), "must be finite numbers of shape (n, 3)")
        s = self.solution
        if s.wake is None:
            raise InputError.of("inflow", self.model.inflow.name, "has no wake to ask; use relaxation or time-marching")
        if s.march is not None:
            velocities = [wake.wake_velocity(at) for wake in s.snapshots]
        else:
            passage = range(self.model.steps_per_revolution // self.model.n_blades)
            velocities = [s.wake.relaxation.wake_velocity(at, k) for k in passage]
        found: np.ndarray = np.mean(velocities, axis=0)
        return found
