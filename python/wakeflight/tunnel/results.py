# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a rotor on a stand gives: coefficients, loads, flapping, maps, the path of the tip vortices; Dataset and table."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InputError
from ..modes import mode_labels
from ..monitors import Monitor, failures, lines, variables, warnings
from ..trim_results import HORSEPOWER
from .solve import Revolution, Solution, by_azimuth

if TYPE_CHECKING:
    from collections.abc import Sequence

    import xarray as xr

    from ..progress import Progress, Silent

SECTION_FIELDS = ("cl", "cd", "cm", "alpha", "mach")


class Tunnel:
    """A solved rotor on a stand: `.ct`, `.cq`, `.data` and the rest, SI and radians.

    Means over the revolution; with a marching wake over the last `.averaged` revolutions, with their scatter.
    """

    def __init__(self, solution: Solution, seconds: float = 0.0) -> None:
        """Keep the solution; everything else follows from it when asked for."""
        self.solution = solution
        self.model = solution.model
        self.seconds = seconds

    def __repr__(self) -> str:
        """Rotor and coefficients."""
        return f"Tunnel({self.model.aircraft.name!r}, ct={self.ct:.6f}, cq={self.cq:.7f})"

    # --- passages -------------------------------------------------------------------------------------------

    @property
    def averaged(self) -> int:
        """Marched revolutions in the means; 0 where the solution is periodic by construction."""
        return self.solution.averaged

    @property
    def settled(self) -> bool:
        """Whether inflow, circulation and blade motion rest; if not, `.notes` says what still changes."""
        return self.solution.settled

    @property
    def notes(self) -> list[str]:
        """What must be said about this solution: what does not rest, and every warning."""
        return [*self.solution.notes, *self.warnings]

    @property
    def assumed(self) -> tuple[str, ...]:
        """What was taken for granted because nothing in the request fixes it, in words."""
        return self.model.condition.assumed

    @cached_property
    def monitors(self) -> tuple[Monitor, ...]:
        """What is watched of this stand, each with its values and what it says."""
        from .monitors import monitors

        return monitors(self)

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is doubtful in the rotor's data, and what lies beyond a limit of the model."""
        return (*self.model.aircraft.warnings, *warnings(self.monitors))

    @property
    def failures(self) -> tuple[str, ...]:
        """What lies beyond physics: a stand that has any is raised in a `NumericalFailure`, not returned."""
        return failures(self.monitors)

    @cached_property
    def turns_kept(self) -> list[Revolution]:
        """Marched revolutions in the means; none where the solution is periodic by construction."""
        return self.solution.revolutions[-self.averaged :] if self.averaged else []

    @cached_property
    def _periodic(self) -> dict[str, np.ndarray]:
        """Passages of the periodic solution by azimuth (n, ...); empty with a marching wake."""
        s = self.solution
        # dynamic inflow acts at the deflected blade: it is part of the solution, not of the map
        inflow = None if self.model.is_dynamic else s.inflow_map
        return self.model.core.passages(s.problem, s.x, self.azimuth, inflow)

    def passed(self, *names: str) -> tuple[np.ndarray, list[np.ndarray]]:
        """Azimuths (n,) [rad] of every passage in the means, and the quantities `names` there (n, n_stations)."""
        if not self.turns_kept:
            return self.azimuth, [self._periodic[name] for name in names]
        found = [self._passages(name) for name in names]
        return self.azimuth[found[0][0].ravel()], [values.reshape(-1, values.shape[-1]) for _, values in found]

    def _by_azimuth(self, name: str) -> np.ndarray:
        """Mean of a quantity by azimuth (n, ...)."""
        if not self.turns_kept:
            return self._periodic[name]
        rows, values = self._passages(name)
        return by_azimuth(rows, values, len(self.azimuth))

    def _passages(self, name: str) -> tuple[np.ndarray, np.ndarray]:
        rows = np.concatenate([turn.rows for turn in self.turns_kept])
        values = np.concatenate([turn.passages[name] for turn in self.turns_kept])
        return rows, values

    def _spread(self, name: str) -> np.ndarray:
        """Standard deviation over the passages of each azimuth."""
        mean = self._by_azimuth(name)
        if not self.turns_kept:
            return np.zeros_like(mean)
        rows, values = self._passages(name)
        return np.sqrt(by_azimuth(rows, (values - mean[rows]) ** 2, len(self.azimuth)))

    def _mean_load(self, name: str) -> np.ndarray:
        """Mean of a load of all blades (3,)."""
        return self.model.n_blades * self._by_azimuth(name).mean(axis=0)

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
    def _scale(self) -> float:
        return self.model.dynamic_pressure_area

    @property
    def radius(self) -> float:
        """Rotor radius [m]."""
        return self.model.rotor["radius"]

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
        return self.thrust / self._scale

    @property
    def cq(self) -> float:
        """Torque coefficient Q/(rho pi R^3 (Omega R)^2)."""
        return self.torque / (self._scale * self.radius)

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
        modes, _ = self.model.core.trim_layout(self.solution.problem)
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
        return self.model.first_harmonics(self._by_azimuth("inflow"))

    # --- wake -----------------------------------------------------------------------------------------------

    def wake_velocity(self, points: Any) -> np.ndarray:
        """Velocity (n, 3) [m/s] induced at `points` (n, 3) [m], hub axes (x aft, y right, z up), mean over a revolution.

        Bound vortices, tip vortices and what else is free; near-wake trailers not: for points away from the blades.
        With a marching wake the mean is over its last revolution.
        """
        at = np.atleast_2d(np.asarray(points, dtype=float))
        if at.ndim != 2 or at.shape[1] != 3 or not np.all(np.isfinite(at)):
            raise InputError.of("points", np.shape(points), "must be finite numbers of shape (n, 3)")
        s = self.solution
        if s.wake is None:
            raise InputError.of("inflow", self.model.inflow.name, "has no wake to ask; use relaxation or time-marching")
        if s.march is not None:
            return np.mean([wake.wake_velocity(at) for wake in s.snapshots], axis=0)
        passage = range(self.model.steps_per_revolution // self.model.n_blades)
        return np.mean([s.wake.relaxation.wake_velocity(at, k) for k in passage], axis=0)

    def transient(
        self, collective: Sequence[Any], duration: Any, progress: Progress | Silent | None = None
    ) -> xr.Dataset:
        """Move the collective in time from here on and follow rotor and wake: a Dataset over time.

        collective: pairs (time, collective at the root), text with units, linear between them and held after the last, from
        the stand's own collective of its last revolution at 0 s: a ramp of 200 deg/s is `[("0.035 s", "12 deg")]` from 5 deg.
        duration: text.

        Every azimuth step the blades move by their own equations under the inflow held (Radau IIA), then circulation, wake
        and inflow are exchanged as in flight, or the states of dynamic inflow carried on by the loads of the instant; cyclic,
        wind and rotor speed stay. The stand itself is not changed. Needs inflow time-marching or dynamic.

        Raises `InputError`, or `NumericalFailure` with what was computed in `.partial`.
        """
        from .transient import transient

        return transient(self, collective, duration, progress)

    def _path(self) -> tuple[np.ndarray, np.ndarray] | None:
        """Mean tip vortex by azimuth (n, n_ages, 3) [m] and the RMS distance from it (n, n_ages)."""
        s = self.solution
        if s.wake is None:
            return None
        if not self.turns_kept:
            position = s.wake.relaxation.position()
            return position, np.zeros(position.shape[:2])
        rows = np.concatenate([turn.rows for turn in self.turns_kept])
        path = np.concatenate([turn.path for turn in self.turns_kept])
        mean = by_azimuth(rows, path, len(self.azimuth))
        squared = np.sum((path - mean[rows]) ** 2, axis=-1)
        return mean, np.sqrt(by_azimuth(rows, squared, len(self.azimuth)))

    def _wake_arrays(self) -> dict[str, np.ndarray]:
        found = self._path()
        if found is None:
            return {}
        path, spread = found
        s, radius = self.solution, self.radius
        n = len(self.azimuth)
        if s.march is not None:
            wake, strength = s.march.position(), s.march.marker_circulation().mean(axis=0)
        else:
            rows = [b * n // self.model.n_blades for b in range(self.model.n_blades)]
            wake = path[rows]
            strength = np.full(path.shape[1], np.mean(s.wake.relaxation.tip_circulation()))
        return {
            "age": 2 * np.pi / n * np.arange(path.shape[1]),
            "wake": wake,
            "wake_path": path,
            "wake_path_std": spread,
            "tip_vortex_radius": np.hypot(path[..., 0], path[..., 1]).mean(axis=0) / radius,
            "tip_vortex_height": (path[..., 2] - _released(path)[..., 2]).mean(axis=0) / radius,
            "tip_vortex_circulation": strength,
        }

    # --- dataset --------------------------------------------------------------------------------------------

    @cached_property
    def data(self) -> xr.Dataset:
        """Everything as an xarray Dataset, SI and radians, every variable with its unit and meaning."""
        from ..results import assemble_tunnel

        arrays = {**self._scalars(), **self._maps(), **self._motion(), **self._wake_arrays(), **self._histories()}
        arrays |= variables(self.monitors)
        return assemble_tunnel({name: np.asarray(value) for name, value in arrays.items()}, self.attributes())

    def save(self, path: str | Path) -> Path:
        """Write `.data` as NetCDF."""
        from ..results import save

        return save(self.data, path)

    def _scalars(self) -> dict[str, Any]:
        m, c = self.model, self.model.condition
        names = ("ct", "cq", "cp", "figure_of_merit", "thrust", "torque", "power", "beta_0", "beta_1c", "beta_1s")
        names += ("theta_0", "theta_1c", "theta_1s", "hub_force", "hub_moment", "aero_force", "aero_moment")
        lam = self.inflow_harmonics()
        std = [float(np.std(each)) if len(each) else 0.0 for each in self._per_revolution(self.turns_kept)]
        return {
            **{name: getattr(self, name) for name in names},
            "ct_sigma": self.ct / m.aircraft.solidity,
            "mu": c.mu(m.tip_speed),
            "mu_z": c.mu_z(m.tip_speed),
            "h_force": self.aero_force[0],
            "side_force": self.aero_force[1],
            "theta_75": self.theta_0 + m.aircraft.twist(0.75 * self.radius),
            "inflow_mean": lam[0],
            "inflow_1c": lam[1],
            "inflow_1s": lam[2],
            "ct_std": std[0],
            "cq_std": std[1],
            "velocity": np.asarray(c.velocity),
        }

    def _per_revolution(self, revolutions: list) -> tuple[list[float], list[float]]:
        """C_T and C_Q of each revolution."""
        thrust = [turn.passages["aero_force"][..., 2].sum(axis=1).mean() / self._scale for turn in revolutions]
        torque = [
            -turn.passages["aero_moment"][..., 2].sum(axis=1).mean() / (self._scale * self.radius)
            for turn in revolutions
        ]
        return thrust, torque

    def _histories(self) -> dict[str, Any]:
        turns = self.solution.revolutions
        if not turns:
            return {}
        ct, cq = self._per_revolution(turns)
        return {"ct_history": ct, "cq_history": cq, "theta_0_history": [turn.x[0] for turn in turns]}

    def _maps(self) -> dict[str, Any]:
        fields = {name: self._by_azimuth(name) for name in (*SECTION_FIELDS, "circulation", "inflow")}
        cn = fields["cl"] * np.cos(fields["alpha"]) + fields["cd"] * np.sin(fields["alpha"])
        m2 = fields["mach"] ** 2
        radial = {f"radial_{name}": fields[name].mean(axis=0) for name in ("cl", "circulation", "inflow", "alpha")}
        return {
            "azimuth": self.azimuth,
            "station": self.model.stations / self.radius,
            **fields,
            "cn": cn,
            "cl_m2": fields["cl"] * m2,
            "cn_m2": cn * m2,
            "cm_m2": fields["cm"] * m2,
            "cl_std": self._spread("cl"),
            "inflow_std": self._spread("inflow"),
            **radial,
            "chord": self.model.rotor["chords"],
            "width": self.model.rotor["widths"],
        }

    def _motion(self) -> dict[str, Any]:
        core, rotor, psi = self.model.core, self.model.rotor, self.azimuth
        q, _ = core.trim_motion(self.solution.problem, self.x, len(psi))
        flap, lead = core.equivalent_angles(q)
        theta = self.theta_0 + self.theta_1c * np.cos(psi) + self.theta_1s * np.sin(psi)
        for order, cosine, sine in self.model.condition.higher:
            theta = theta + cosine * np.cos(order * psi) + sine * np.sin(order * psi)
        tips = {f"tip_{name}": q @ np.asarray(rotor[f"tip_{name}"]) for name in ("flap", "lead", "twist")}
        modal = {"modal": q * np.asarray(rotor["angle_per_coordinate"])} if q.shape[1] else {}
        return {"theta": theta, "flap": flap, "lead": lead, **tips, **modal}

    def attributes(self) -> dict[str, Any]:
        """Attributes of the Dataset: rotor, condition, inflow, and what was counted."""
        m, s, c = self.model, self.solution, self.model.condition
        wake = s.march or s.wake
        evaluations = 0
        if wake is not None:
            evaluations = s.march.segment_evaluations if s.march else s.wake.counters["wake_segment_evaluations"]
        return {
            "aircraft": m.aircraft.name,
            "inflow_model": m.inflow.name,
            "regime": c.regime(m.tip_speed),
            "radius": self.radius,
            "omega": m.omega,
            "n_blades": m.n_blades,
            "solidity": m.aircraft.solidity,
            "density": c.density,
            "speed_of_sound": c.speed_of_sound,
            "blade_model": m.blade_model.removesuffix("-incompressible"),
            "prandtl_glauert": int(m.blade_model == "weissinger"),
            "blades": "flexible" if m.aircraft.flexible else "rigid",
            "n_modes": m.aircraft.discretisation.n_modes,
            "blade_modes": mode_labels(m.aircraft),
            "blade_frequencies_per_rev": [f / m.omega for f in m.rotor["frequencies"]],
            "revolutions": len(s.revolutions),
            "averaged": self.averaged,
            "settled": int(self.settled),
            "assumed": "; ".join(self.assumed),
            "notes": "; ".join(self.notes),
            "warnings": "\n".join(self.warnings),
            "failure": "; ".join(self.failures),
            "residual": self.residual,
            "seconds_total": self.seconds,
            "segment_evaluations": evaluations,
            "configuration": {
                "rotor": m.aircraft.name,
                "condition": c.as_given,
                "inflow": {"model": m.inflow.name, **m.inflow.as_attributes()},
                "discretisation": m.aircraft.discretisation._asdict(),
                "n_harmonics": m.n_harmonics,
            },
        }

    def table(self) -> str:
        """The result as a table to print."""
        m, deg = self.model, np.degrees
        c, lam = m.condition, self.inflow_harmonics()
        std = self._scalars()
        scatter = f" (+- {std['ct_std']:.6f} over {self.averaged} revolutions)" if self.averaged > 1 else ""
        sigma = m.aircraft.solidity
        velocity = c.velocity
        rows = [
            ("rotor", f"{m.aircraft.name}, {m.n_blades} blades, R = {self.radius:.4g} m, solidity {sigma:.4f}"),
            (
                "condition",
                f"{c.regime(m.tip_speed)}, mu = {c.mu(m.tip_speed):.4f}, mu_z = {c.mu_z(m.tip_speed):+.4f} (descent +), "
                f"{np.linalg.norm(velocity):.2f} m/s, {m.omega * 30 / np.pi:.1f} rpm, {c.density:.4f} kg/m3",
            ),
            (
                "inflow, blade model",
                f"{m.inflow.name}, {m.blade_model}",
            ),
            *(("assumed", text) for text in self.assumed),
            ("theta_0, 1c, 1s", f"{deg(self.theta_0):.3f}, {deg(self.theta_1c):.3f}, {deg(self.theta_1s):.3f} deg"),
            ("C_T, C_T/sigma", f"{self.ct:.6f}, {self.ct / sigma:.4f}{scatter}"),
            ("C_Q, figure of merit", f"{self.cq:.7f}, {self.figure_of_merit:.4f}"),
            ("thrust, torque", f"{self.thrust:.5g} N, {self.torque:.5g} N m"),
            ("power", f"{self.power / 1e3:.4g} kW ({self.power / HORSEPOWER:.1f} hp)"),
            ("H force, side force", f"{self.aero_force[0]:.4g} N aft, {self.aero_force[1]:.4g} N right"),
            (
                "hub moments",
                f"{-self.hub_moment[0]:.4g} N m right side down, {self.hub_moment[1]:.4g} N m nose up",
            ),
            ("coning, beta_1c, 1s", f"{deg(self.beta_0):.3f}, {deg(self.beta_1c):.3f}, {deg(self.beta_1s):.3f} deg"),
            ("lambda_0, 1c, 1s", ", ".join(f"{v:.5f}" for v in lam)),
            ("residual", f"{self.residual:.1e}"),
            *lines(self.monitors),
            *(("note", note) for note in self.solution.notes),
            *(("warning", text) for text in self.warnings),
        ]
        width = max(len(name) for name, _ in rows)
        return "\n".join(f"{name:<{width}}  {value}" for name, value in rows)


def _released(path: np.ndarray) -> np.ndarray:
    """Where each marker of a path (n, n_ages, 3) was released: the blade at the azimuth of its age."""
    n, ages = path.shape[:2]
    rows = (np.arange(n)[:, None] - np.arange(ages)[None, :]) % n
    return path[rows, 0]
