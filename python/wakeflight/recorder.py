# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a flight keeps of every step, and the Dataset it becomes."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import NumericalFailure
from .maneuvers import Maneuver
from .model import Model
from .modes import mode_labels
from .monitors import Monitor, Places, rotor, variables
from .rotor_speed import shares

if TYPE_CHECKING:
    import xarray as xr

    from .simulation import ConvergencePhase, Simulation
    from .stepping import Instant

SNAPSHOTS_PER_REVOLUTION = 4
LARGEST_SHEET = 5_000_000  # numbers; larger lattices of full-span wakes are not kept
STATION_FIELDS = ("inflow", "circulation", "cl", "cl_m2", "alpha", "mach")


class Recorder:
    """Arrays of a run, filled step by step."""

    def __init__(self, sim: Simulation, maneuver: Maneuver, n_steps: int):
        self.model, self.start, self.maneuver = sim.model, sim.start, maneuver
        model = sim.model
        self.exchange, self.phase = sim.exchange, sim.phase
        self.n_recorded = 0
        n, blades, stations = n_steps + 1, model.n_blades, model.stations.size
        self.time = np.empty(n)
        self.state = np.empty((n, model.layout["size"]))
        self.stick = np.empty((n, 4))
        self.blade = {name: np.empty((n, blades, stations)) for name in STATION_FIELDS}
        self.azimuth = np.empty((n, blades))
        self.loads = {name: np.empty((n, 3)) for name in ("force", "moment", "hub_force", "hub_moment")}
        self.scalars = {
            name: np.empty(n)
            for name in (
                "ct",
                "beta_1c",
                "beta_1s",
                "power",
                "inflow_mean",
                "odd_even",
                "max_displacement",
                "stabilator",
                "vortex_blade_distance",
                "energy",
                "load_power",
            )
        }
        self.blade_angles = {name: np.empty((n, blades)) for name in ("flap", "lead")}
        self.snapshots: list[np.ndarray] = []
        self.snapshot_circulation: list[np.ndarray] = []
        self.snapshot_core: list[np.ndarray] = []
        self.snapshot_revolution: list[float] = []
        self.sheets: list[tuple[np.ndarray, np.ndarray]] = []
        self.keeps_sheets = keeps_sheets(model, n_steps)

    def record(self, at: Instant) -> None:
        """Keep one instant: the state, its consistent rate, and the inputs that begin there."""
        step, t, y, stick = at.step, at.t, at.y, at.stick
        out = self.model.core.outputs(t, y, at.y_dot, at.inputs)
        self.time[step], self.state[step], self.stick[step] = t, y, stick
        self.azimuth[step] = out["azimuth"]
        for name, values in self.blade.items():
            values[step] = out[name]
        check_sample(self.model, t, y, stick, self.azimuth[step], self.blade["inflow"][step], self.blade["mach"][step])
        for name, values in self.loads.items():
            values[step] = out[name]
        for name in ("ct", "beta_1c", "beta_1s"):
            self.scalars[name][step] = out[name]
        angles = self.model.core.equivalent_angles(self.model.modal(y)[0])
        self.blade_angles["flap"][step], self.blade_angles["lead"][step] = angles
        self.scalars["power"][step] = sum(out["power"])
        self.scalars["stabilator"][step] = at.stabilator
        dynamic = self.model.inflow.is_dynamic
        first = self.model.layout["inflow"][0]
        self.scalars["inflow_mean"][step] = y[first] if dynamic else at.mean_inflow
        monitors = self.exchange.monitors
        self.scalars["odd_even"][step] = monitors["odd_even"]
        self.scalars["max_displacement"][step] = monitors["max_displacement"] * self.model.rotor["radius"]
        self.scalars["vortex_blade_distance"][step] = monitors["vortex_blade_distance"]
        self.scalars["energy"][step], self.scalars["load_power"][step] = out["energy"], out["load_power"]
        if step % (self.model.steps_per_revolution // SNAPSHOTS_PER_REVOLUTION) == 0:
            self._keep_wake(step)
        # a row counts only when it is finite: what cannot be kept ends the flight
        if not np.isfinite(y).all() or not all(map(math.isfinite, out["force"])):
            raise ArithmeticError(f"loads are not finite at t = {t:.4f} s")
        self.n_recorded = step + 1

    def _keep_wake(self, step: int) -> None:
        """Keep the vortices, where there are any."""
        tips = self.exchange.tips(step)
        if tips is None:
            return
        position, circulation, core_radius = tips
        self.snapshots.append(position)
        self.snapshot_circulation.append(circulation)
        self.snapshot_core.append(at_nodes(core_radius))
        if self.keeps_sheets:
            self.sheets.append(self.exchange.lattice(step))
        self.snapshot_revolution.append(step / self.model.steps_per_revolution)

    def dataset(
        self, attributes: dict[str, Any], monitors: tuple[Monitor, ...], warnings: list[str], failure: str | None
    ) -> xr.Dataset:
        """The run's Dataset, whole or up to where it stopped; monitors: what is watched of the whole flight."""
        from .results import assemble

        model, n = self.model, self.n_recorded
        y = self.state[:n]
        roll, pitch, yaw = euler_angles(y[:, 6:10])
        arrays: dict[str, Any] = {
            "time": self.time[:n],
            "station": model.stations / model.rotor["radius"],
            "roll": roll,
            "pitch": pitch,
            "yaw": yaw,
            "azimuth": self.azimuth[:n],
            "modal": self._modal(y),
            "hub_force": self.loads["hub_force"][:n],
            "hub_moment": self.loads["hub_moment"][:n],
        }
        arrays |= dict(zip("uvwpqr", y[:, :6].T, strict=True))
        arrays |= dict(zip(("north", "east", "down"), y[:, 10:13].T, strict=True))
        names = ("lateral", "longitudinal", "collective", "pedal")
        arrays |= dict(zip(names, self.stick[:n].T / 0.0254, strict=True))
        for kind in ("force", "moment"):
            arrays |= dict(zip((f"{kind}_x", f"{kind}_y", f"{kind}_z"), self.loads[kind][:n].T, strict=True))
        arrays |= {name: values[:n] for name, values in self.blade.items()}
        arrays |= {name: values[:n] for name, values in self.scalars.items() if name != "load_power"}
        del arrays["vortex_blade_distance"]
        if model.rotor_speed:
            arrays["rotor_speed"] = self.rotor_speed
        arrays["energy_balance"] = self.energy_balance()
        arrays |= variables(monitors)
        arrays |= {name: values[:n] for name, values in self.blade_angles.items()}
        if not model.inflow.is_dynamic:
            arrays |= self._wake_arrays(self.phase)
        counted = self.counters()
        return assemble(
            arrays,
            {
                **self._describe(),
                **attributes,
                **counted,
                **convergence_attributes(self.phase),
                "warnings": "\n".join(warnings),
                "failure": failure or "",
            },
        )

    def energy_balance(self) -> np.ndarray:
        """Change of the airframe's kinetic and potential energy less the work of all loads on it but gravity (time,) [J].

        The work is the trapezoidal sum of F.v + M.omega over the coupling steps: what the loads the run reports did. It
        vanishes as the step does; a load on the wrong point, a wrong sign or a wrong inertia leaves it growing.
        """
        n = self.n_recorded
        power, time, energy = self.scalars["load_power"][:n], self.time[:n], self.scalars["energy"][:n]
        work = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(time))])
        return energy - energy[0] - work

    @property
    def rotor_speed(self) -> np.ndarray:
        """Speed of the rotor (time,) [rad/s]."""
        return self.model.omega * shares(self.model.rotor_speed, self.time[: self.n_recorded])

    def vortex_distance(self) -> np.ndarray | None:
        """Smallest distance of a tip vortex from a blade (time,), in core radii; None where the wake does not tell it."""
        distance = self.scalars["vortex_blade_distance"][: self.n_recorded].copy()
        if not np.isfinite(distance[1:]).any():
            return None
        if np.isnan(distance[0]):
            # without a convergence phase the wake has not been stepped yet: the first step's stands for the start
            distance[0] = distance[1]
        return distance

    def _modal(self, y: np.ndarray) -> np.ndarray:
        """Modal coordinates (time, blade, mode) as fractions of the tip deflection: angle of the tip in the mode [rad]."""
        scale = np.asarray(self.model.rotor["angle_per_coordinate"])
        blades = [y[:, a:b] * scale for a, b in self.model.layout["modal"]]
        return np.stack(blades, axis=1)

    def _wake_arrays(self, phase: ConvergencePhase) -> dict[str, Any]:
        arrays: dict[str, Any] = {}
        if self.snapshots:
            positions = np.array(self.snapshots)
            arrays["wake"] = positions
            arrays["wake_circulation"] = np.array(self.snapshot_circulation)
            arrays["wake_core"] = np.array(self.snapshot_core)
            arrays["snapshot_revolution"] = np.array(self.snapshot_revolution)
            arrays["age"] = 2 * np.pi * np.arange(positions.shape[2]) / self.model.steps_per_revolution
        if self.sheets:
            arrays["wake_sheet"], arrays["wake_sheet_circulation"] = (
                np.array(each) for each in zip(*self.sheets, strict=True)
            )
        n = self.model.steps_per_revolution
        arrays["psi"] = 2 * np.pi * np.arange(n) / n
        arrays["inflow_trim"] = self.start.inflow_map
        if phase.after is not None:
            arrays["inflow_before"], arrays["inflow_start"] = phase.before, phase.after
        return arrays

    def counters(self) -> dict[str, int]:
        """What the wake has counted so far."""
        counted = self.exchange.counters
        if not counted:
            return {}
        trim = self.start.wake.counters
        return counted | {
            "segment_evaluations_trim": trim["wake_segment_evaluations"],
            "relaxation_iterations_trim": trim["relaxation_iterations"],
        }

    def _describe(self) -> dict[str, Any]:
        start, model = self.start, self.model
        mean = start.mean_outputs()
        configuration = {
            "aircraft": start.aircraft.name,
            "loading": start.aircraft.loading_name or "",
            "condition": start.condition.as_attributes(),
            "inflow": {"model": model.inflow.name, **model.inflow.as_attributes()},
            "discretisation": start.aircraft.discretisation._asdict(),
            "trim_inflow": start.inflow.name,
            **({"rotor_speed": [list(corner) for corner in model.rotor_speed]} if model.rotor_speed else {}),
            "maneuver": {
                "name": self.maneuver.name,
                "adapted": list(self.maneuver.adapted),
                "controls": {
                    stick: [list(corner) for corner in corners] for stick, corners in self.maneuver.corners_of
                },
            },
        }
        return {
            "aircraft": start.aircraft.name,
            "maneuver": self.maneuver.name,
            "maneuver_adapted": "; ".join(self.maneuver.adapted),
            "inflow_model": model.inflow.name,
            "radius": model.rotor["radius"],
            "omega": model.omega,
            "blade_modes": mode_labels(start.aircraft),
            "configuration": configuration,
            "condition": start.condition.as_attributes(),
            "ct": mean["ct"],
            "ct_sigma": mean["ct"] / start.aircraft.solidity,
            "mu": mean["mu"],
            "power": mean["power"],
            "revolutions": (self.n_recorded - 1) / model.steps_per_revolution,
        }


def check_sample(
    model: Model, t: float, y: np.ndarray, stick: np.ndarray, azimuth: np.ndarray, inflow: np.ndarray, mach: np.ndarray
) -> None:
    """End the flight at a sample that the motion of the rotor cannot give; inflow and mach (n_blades, n_stations)."""
    bounds = model.bounds
    u, v, w, p, q, r = y[:6].tolist()
    speed, rate = math.sqrt(u * u + v * v + w * w), math.sqrt(p * p + q * q + r * r)
    largest = max(inflow.max(), -inflow.min())
    # within these in any motion: no need to look closer
    if largest <= bounds.least_inflow and mach.max() <= bounds.least_mach(speed, rate):
        return
    places = Places(bounds.station, azimuth[None], np.array([t]))
    velocity = np.asarray(model.core.hub(y)[0]) / model.tip_speed
    theta = model.pitch_controls(stick)[[2, 0, 1]]
    _, bound = bounds.inflow(velocity, theta)
    bound = bound * model.top_share
    fastest = bounds.mach(speed, rate + model.overspeed, bounds.section(velocity, theta))
    if largest > bound:
        raise NumericalFailure(rotor.beyond_motion(largest, bound, places.of(np.abs(inflow)[None])))
    if mach.max() > fastest:
        raise NumericalFailure(rotor.faster_than_motion(mach.max(), fastest, places.of(mach[None])))


def keeps_sheets(model: Model, n_steps: int) -> bool:
    """Whether the run is short enough to keep the whole lattice of a full-span wake."""
    if not model.inflow.is_full_span:
        return False
    n = model.steps_per_revolution
    snapshots = 1 + SNAPSHOTS_PER_REVOLUTION * n_steps // n
    trailers = model.inflow.n_trailers or model.stations.size + 1
    return 4 * snapshots * model.n_blades * trailers * (1 + n * model.inflow.turns) <= LARGEST_SHEET


def at_nodes(of_segments: np.ndarray) -> np.ndarray:
    """Core radii at the nodes (n_blades, n_ages) from those of the segments between them: mean of the squares."""
    squared = of_segments**2
    ends = np.concatenate([squared[:, :1], squared, squared[:, -1:]], axis=1)
    return np.sqrt((ends[:, 1:] + ends[:, :-1]) / 2)


def convergence_attributes(phase: ConvergencePhase) -> dict[str, Any]:
    """Figures of the convergence phase: change per revolution, drift of the lift."""
    if not phase.change:
        return {}
    return {
        "convergence_change": [round(c, 12) for c in phase.change],
        "segment_evaluations_convergence": phase.segment_evaluations,
        "convergence_lift_drift": phase.circulation_lift[-1] / phase.circulation_lift[0] - 1.0,
    }


def euler_angles(quaternion: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Roll, pitch, yaw (3-2-1) [rad] of quaternions (n, 4), body to inertial; roll and yaw without jumps."""
    w, x, y, z = (quaternion / np.linalg.norm(quaternion, axis=1, keepdims=True)).T
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1, 1))
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return np.unwrap(roll), pitch, np.unwrap(yaw)
