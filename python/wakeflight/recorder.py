# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a flight keeps of every step, and the Dataset it becomes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from .attitude import body_to_inertial, euler_angles
from .control import ControlLog
from .errors import NumericalFailure, known
from .maneuvers import Maneuver
from .model import Model
from .monitors import Monitor, Places, rotor, variables
from .results.frames import body_of_hub
from .run_attributes import convergence_attributes, described
from .runlog import MemoryRows, MemoryWakes

if TYPE_CHECKING:
    import xarray as xr

    from .flight_start import ConvergencePhase
    from .simulation import Simulation
    from .stepping import Instant

LARGEST_SHEET = 5_000_000  # numbers; larger lattices of full-span wakes are not kept
SOMETIMES = ("load_power", "vortex_blade_distance", "rotor_speed", "torque")
"""Numbers of every instant that a run does not keep, or not always."""
STATION_FIELDS = ("inflow", "circulation", "cl", "cl_m2", "alpha", "mach")


LOADS = ("force", "moment", "hub_force", "hub_moment")
SCALARS = (
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
    "rotor_speed",
    "torque",
)
BLADE_ANGLES = ("flap", "lead")


def fields_of(sim: Simulation) -> dict[str, tuple[int, ...]]:
    """What is kept of every coupling step, and its shape."""
    model = sim.model
    blades, stations = model.n_blades, model.stations.size
    return {
        "time": (),
        "state": (model.layout["size"],),
        "stick": (4,),
        "azimuth": (blades,),
        **dict.fromkeys(STATION_FIELDS, (blades, stations)),
        **dict.fromkeys(LOADS, (3,)),
        **dict.fromkeys(SCALARS, ()),
        **dict.fromkeys(BLADE_ANGLES, (blades,)),
        **({} if sim.wind is None else {"wind": (3,)}),
        **({"wash": (4, 3)} if model.inflow.washes_airframe else {}),
        **ControlLog(sim.chain).fields,
    }


class Rows(Protocol):
    """Where rows go: memory, or a log."""

    window: Any
    """Arrays by the names of the fields, of which one place is being filled."""

    def place(self) -> int:
        """Which."""

    def done(self, step: int) -> None:
        """The row of `step` is complete there."""

    def whole(self) -> Mapping[str, np.ndarray]:
        """All rows by name."""


class Wakes(Protocol):
    """Where wakes go."""

    def append(self, step: int, arrays: dict[str, np.ndarray]) -> None:
        """Keep the wake of a step."""

    def whole(self) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Steps, and arrays by name over them."""


class Recorder:
    """Rows of a run, filled step by step; `stick` is what reaches the blades.

    rows, wakes: where they go, memory by default; n_recorded: how many there are already; lattice: as in a plan. While the flight
    lasts the arrays here are a window of the rows, `read` makes them all of them.
    """

    def __init__(
        self,
        sim: Simulation,
        maneuver: Maneuver,
        n_steps: int,
        rows: Rows | None = None,
        wakes: Wakes | None = None,
        n_recorded: int = 0,
        lattice: bool = True,
    ):
        self.model, self.start, self.maneuver = sim.model, sim.start, maneuver
        self.exchange, self.phase = sim.exchange, sim.phase
        self.log, self.control = ControlLog(sim.chain), sim.control
        self.turning, self.wind_told = sim.turning.name, sim.wind_told
        self.n_recorded = n_recorded
        self.wake_steps = sim.wake_steps
        self.keeps_sheets = lattice and keeps_sheets(sim.model, n_steps, sim.wake_steps)
        self._latest = 0
        self._rows = rows or MemoryRows(fields_of(sim), n_steps + 1)
        self._wakes = wakes or MemoryWakes()
        self._bind(self._rows.window)

    def _bind(self, arrays: Any) -> None:
        """The arrays here are these."""
        self.log.bind(arrays)
        self.time, self.state, self.stick, self.azimuth = (
            arrays[name] for name in ("time", "state", "stick", "azimuth")
        )
        self.wind = None if self.wind_told is None else arrays["wind"]
        self.wash = arrays["wash"] if self.model.inflow.washes_airframe else None
        self.blade = {name: arrays[name] for name in STATION_FIELDS}
        self.loads = {name: arrays[name] for name in LOADS}
        self.scalars = {name: arrays[name] for name in SCALARS}
        self.blade_angles = {name: arrays[name] for name in BLADE_ANGLES}

    def read(self) -> None:
        """The flight has ended: the arrays are all rows, for monitors and Dataset."""
        self._bind(self._rows.whole())

    def record(self, at: Instant) -> None:
        """Keep one instant: the state, its consistent rate, and the inputs that begin there."""
        step, t, y, stick = at.step, at.t, at.y, at.stick
        k = self._rows.place()
        out = self.model.core.outputs(t, y, at.y_dot, at.inputs)
        self.time[k], self.state[k], self.stick[k] = t, y, stick
        self.log.record(k)
        self.azimuth[k] = out["azimuth"]
        for name, values in self.blade.items():
            values[k] = out[name]
        through_air = y
        if self.wind is not None:
            air = known(at.air)
            self.wind[k], through_air = air.origin, air.passing(y)
        if self.wash is not None:
            self.wash[k] = known(self.exchange.wash)
        sample = self.azimuth[k], self.blade["inflow"][k], self.blade["mach"][k]
        check_sample(self.model, t, through_air, stick, *sample)
        for name, values in self.loads.items():
            values[k] = out[name]
        for name in ("ct", "beta_1c", "beta_1s"):
            self.scalars[name][k] = out[name]
        angles = self.model.core.equivalent_angles(self.model.modal(y)[0])
        self.blade_angles["flap"][k], self.blade_angles["lead"][k] = angles
        self.scalars["power"][k] = sum(out["power"])
        self.scalars["stabilator"][k] = at.stabilator
        dynamic = self.model.inflow.is_dynamic
        first = self.model.layout["inflow"][0]
        self.scalars["inflow_mean"][k] = y[first] if dynamic else at.mean_inflow
        monitors = self.exchange.monitors
        self.scalars["odd_even"][k] = monitors["odd_even"]
        self.scalars["max_displacement"][k] = monitors["max_displacement"] * self.model.rotor["radius"]
        self.scalars["vortex_blade_distance"][k] = monitors["vortex_blade_distance"]
        self.scalars["rotor_speed"][k], self.scalars["torque"][k] = out["rotor_speed"], out["engine_torque"]
        self.scalars["energy"][k], self.scalars["load_power"][k] = out["energy"], out["load_power"]
        if step % self.wake_steps == 0:
            self._keep_wake(step)
        # a row counts only when it is finite: what cannot be kept ends the flight
        if not np.isfinite(y).all() or not all(map(math.isfinite, out["force"])):
            raise ArithmeticError(f"loads are not finite at t = {t:.4f} s")
        self._rows.done(step)
        self._latest = k
        self.n_recorded = step + 1

    def latest(self, name: str) -> np.ndarray:
        """A field of the instant that was kept last; to be looked at before the next one is kept."""
        found: np.ndarray = self._rows.window[name][self._latest]
        return found

    def _keep_wake(self, step: int) -> None:
        """Keep the vortices, where there are any."""
        tips = self.exchange.tips(step)
        if tips is None:
            return
        position, circulation, core_radius = tips
        arrays = {"wake": position, "wake_circulation": circulation, "wake_core": at_nodes(core_radius)}
        if self.keeps_sheets:
            arrays["wake_sheet"], arrays["wake_sheet_circulation"] = known(self.exchange.lattice(step))
        self._wakes.append(step, arrays)

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
            "bank": roll,
            "pitch": pitch,
            "yaw": yaw,
            "azimuth": self.azimuth[:n],
            "modal": self._modal(y),
            "hub_force": self.loads["hub_force"][:n],
            "hub_moment": self.loads["hub_moment"][:n],
        }
        arrays |= dict(zip("uvwpqr", y[:, :6].T, strict=True))
        arrays |= dict(zip(("north", "east", "down"), y[:, 10:13].T, strict=True))
        arrays |= self.log.arrays(n, self.stick[:n])
        for kind in ("force", "moment"):
            arrays |= dict(zip((f"{kind}_x", f"{kind}_y", f"{kind}_z"), self.loads[kind][:n].T, strict=True))
        arrays |= {name: values[:n] for name, values in self.blade.items()}
        arrays |= {name: values[:n] for name, values in self.scalars.items() if name not in SOMETIMES}
        if model.rotor_speed or model.has_free_speed:
            arrays["rotor_speed"] = self.rotor_speed
        if self.wind is not None:
            arrays["wind"] = self.wind[:n]
        if self.wash is not None:
            arrays["wash"] = self.wash[:n]
        if model.has_free_speed:
            arrays["torque"] = self.scalars["torque"][:n]
            arrays["power_engine"] = arrays["torque"] * self.rotor_speed
        arrays["energy_balance"] = self.energy_balance()
        arrays |= variables(monitors)
        arrays |= {name: values[:n] for name, values in self.blade_angles.items()}
        if not model.inflow.is_dynamic:
            arrays |= self._wake_arrays(self.phase)
        counted = self.counters()
        return assemble(
            arrays,
            {
                **described(
                    *(self.start, model, self.maneuver, self.control, self.turning, self.wind_told),
                    revolutions=(n - 1) / model.steps_per_revolution,
                ),
                **attributes,
                **counted,
                **self.log.attributes(),
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
        found: np.ndarray = energy - energy[0] - work
        return found

    @property
    def rotor_speed(self) -> np.ndarray:
        """Speed of the rotor (time,) [rad/s]."""
        found: np.ndarray = self.scalars["rotor_speed"][: self.n_recorded]
        return found

    def vortex_distance(self) -> np.ndarray | None:
        """Smallest distance of a tip vortex from a blade (time,), in core radii; None where the wake does not tell it."""
        distance: np.ndarray = self.scalars["vortex_blade_distance"][: self.n_recorded].copy()
        if not np.isfinite(distance[1:]).any():
            return None
        if np.isnan(distance[0]):
            # without a convergence phase the wake has not been stepped yet: the first step's stands for the start
            distance[0] = distance[1]
        return distance

    def share_below_ground(self) -> np.ndarray | None:
        """Share of the nodes of the tip vortices below the ground in every wake kept (n_snapshots,); None without ground."""
        height = self.start.condition.height
        steps, kept = self._wakes.whole()
        if height is None or not kept:
            return None
        rotor = self.model.data["rotor"]
        hub = np.array(rotor["position"], dtype=float)
        from_hub = body_of_hub(rotor["shaft_tilt_forward"], rotor["shaft_tilt_lateral"])
        found = []
        for step, wake in zip(steps, kept["wake"], strict=True):
            if step < self.n_recorded:
                y = self.state[step]
                # down in body axes; the ground is as far below the start as the hub is above it there
                down = body_to_inertial(y[6:10])[2]
                depth = y[12] + down @ hub + wake @ (down @ from_hub)
                found.append(float(np.mean(depth > height + hub[2])))
        return np.array(found)

    def _modal(self, y: np.ndarray) -> np.ndarray:
        """Modal coordinates (time, blade, mode) as fractions of the tip deflection: angle of the tip in the mode [rad]."""
        scale = np.asarray(self.model.rotor["angle_per_coordinate"])
        blades = [y[:, a:b] * scale for a, b in self.model.layout["modal"]]
        return np.stack(blades, axis=1)

    def _wake_arrays(self, phase: ConvergencePhase) -> dict[str, Any]:
        arrays: dict[str, Any] = {}
        steps, kept = self._wakes.whole()
        if kept:
            # the wake of a row is kept before the row counts
            n = int(np.searchsorted(steps, self.n_recorded))
            arrays |= {name: values[:n] for name, values in kept.items()}
            arrays["snapshot_revolution"] = steps[:n] / self.model.steps_per_revolution
            arrays["age"] = 2 * np.pi * np.arange(kept["wake"].shape[2]) / self.model.steps_per_revolution
        n = self.model.steps_per_revolution
        arrays["psi"] = 2 * np.pi * np.arange(n) / n
        arrays["inflow_trim"] = self.model.at_stations(self.start.inflow_map)
        if phase.after is not None:
            before, after = (self.model.at_stations(known(each)) for each in (phase.before, phase.after))
            arrays["inflow_before"], arrays["inflow_start"] = before, after
        return arrays

    def counters(self) -> dict[str, int]:
        """What the wake has counted so far."""
        counted = self.exchange.counters
        if not counted:
            return {}
        trim = known(self.start.wake).counters
        return counted | {
            "segment_evaluations_trim": trim["wake_segment_evaluations"],
            "relaxation_iterations_trim": trim["relaxation_iterations"],
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


def keeps_sheets(model: Model, n_steps: int, wake_steps: int) -> bool:
    """Whether the run is short enough to keep the whole lattice of a full-span wake, at every so many steps."""
    if not model.inflow.is_full_span:
        return False
    n = model.steps_per_revolution
    snapshots = 1 + n_steps // wake_steps
    wake = model.inflow.free_wake
    trailers = wake.n_trailers or model.stations.size + 1
    return bool(4 * snapshots * model.n_blades * trailers * (1 + n * wake.turns) <= LARGEST_SHEET)


def at_nodes(of_segments: np.ndarray) -> np.ndarray:
    """Core radii at the nodes (n_blades, n_ages) from those of the segments between them: mean of the squares."""
    squared = of_segments**2
    ends = np.concatenate([squared[:, :1], squared, squared[:, -1:]], axis=1)
    found: np.ndarray = np.sqrt((ends[:, 1:] + ends[:, :-1]) / 2)
    return found
