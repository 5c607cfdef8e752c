# SPDX-License-Identifier: MIT OR Apache-2.0
"""Collective that moves in time on the stand: blades, circulation and inflow followed step by step."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InputError, NumericalFailure
from ..exchange import Exchange
from ..integrators import FixedIntegrator
from ..monitors import Places, failures, rotor
from ..progress import Progress, Silent
from ..rotor_speed import CONSTANT, Clock, RotorSpeed, shares
from ..rotor_speed import history as speed_history
from ..stepping import Instant, Stepping
from ..units import quantity
from .condition import within
from .model import StandModel
from .solved import Solved

if TYPE_CHECKING:
    import xarray as xr


LONGEST = 1000.0
"""Revolutions that a transient may last at most."""


@dataclass(frozen=True)
class History:
    """Change of collective over time, linear between its points and held after the last; it begins as the stand was.

    time [s], ascending from the start of the transient; collective at the root [rad]; cyclic: theta_1c, theta_1s [rad], held.
    Over a coupling step of `clock`, which has gone `first` steps where the transient begins, the collective is linear: its
    corners are met where steps end.
    """

    time: np.ndarray
    collective: np.ndarray
    cyclic: np.ndarray
    clock: Clock
    first: int

    def collective_after(self, steps: int) -> float:
        """Collective [rad] after `steps` steps of the clock."""
        return float(np.interp(self.clock.time(steps - self.first), self.time, self.collective))

    def at(self, t: float) -> np.ndarray:
        """Collective, cyclic and nothing for a tail rotor (4,) [rad] at time `t` [s]."""
        k, past = self._begun(t)
        collective = self.collective_after(k)
        if past:
            collective += past * self._slope(k)
        return np.array([collective, *self.cyclic, 0.0])

    def rate(self, t: float) -> np.ndarray:
        """Their rates [rad/s] over the step that begins at `t` or holds it."""
        return np.array([self._slope(self._begun(t)[0]), 0.0, 0.0, 0.0])

    def pieces(self, t0: float, t1: float) -> list[tuple[float, float]]:
        """One."""
        return [(t0, t1)]

    def _begun(self, t: float) -> tuple[int, float]:
        """Steps of the clock begun at time `t` [s], and how long the last has gone on [s]; none where one begins."""
        steps = self.clock.steps(0, t)
        whole = round(steps)
        if abs(steps - whole) < 1e-6:
            return whole, 0.0
        return math.floor(steps), t - self.clock.time(math.floor(steps))

    def _slope(self, k: int) -> float:
        """Rate of the collective [rad/s] over the step after `k`."""
        return (self.collective_after(k + 1) - self.collective_after(k)) / self.clock.duration(k)


def history(points: Sequence[Any], x: np.ndarray, run: OnStand) -> History:
    """From pairs (time, collective), text with units; the first point is the stand's own collective at time zero, of `x`."""
    start = float(x[0])
    form = 'must be pairs (time, collective) such as [("0 s", "5 deg"), ("0.035 s", "12 deg")]'
    if isinstance(points, str) or not isinstance(points, Sequence):
        raise InputError.of("collective", points, form)
    time, angle = [0.0], [start]
    for pair in points:
        if isinstance(pair, str) or not isinstance(pair, Sequence) or len(pair) != 2:
            raise InputError.of("collective", pair, form)
        t = quantity(pair[0], "s", "collective time")
        theta = within("collective", pair[1], "rad", -0.5 * np.pi, 0.5 * np.pi, "deg")
        if t < time[-1] or (t == time[-1] and len(time) > 1):
            raise InputError.of("collective time", pair[0], "must ascend from 0 s")
        if t == 0.0 and abs(theta - start) > 1e-9:
            raise InputError.of(
                "collective",
                pair[1],
                f"must be that of the stand, {np.degrees(start):.6g} deg, at 0 s: pitch does not jump",
            )
        if t > 0.0:
            time.append(t)
            angle.append(theta)
    return History(np.array(time), np.array(angle), x[1:3], run.clock, run.first)


class Recorder:
    """What a transient leaves at every step."""

    def __init__(self, stand: Solved, run: OnStand) -> None:
        self.stand, self.run, self.model = stand, run, run.model
        self.rows: dict[str, list[np.ndarray]] = {}

    @property
    def n_recorded(self) -> int:
        """Instants kept."""
        return len(self.rows.get("time", ()))

    def arrays(self) -> dict[str, np.ndarray]:
        """Everything along time first."""
        return {name: np.array(rows) for name, rows in self.rows.items()}

    def record(self, at: Instant) -> None:
        """Keep one instant; end where it is beyond what the motion of the rotor can give."""
        stand, model = self.stand, self.model
        seen = model.core.outputs(at.t, at.y, at.y_dot, at.inputs)
        # on the stand y points to the advancing side, whichever way the rotor turns
        hand = model.rotor["hand"]
        thrust, torque = seen["aero_force"][2], -seen["aero_moment"][2] * hand
        flap, lead = model.core.equivalent_angles(np.ascontiguousarray(model.modal(at.y)[0]))
        check(stand, model, seen, float(at.stick[0]))
        scale = model.dynamic_pressure_area
        kept = {
            "time": self.run.clock.time(at.step - self.run.first),
            "theta_0": at.stick[0],
            "ct": thrust / scale,
            "cq": torque / (scale * stand.radius),
            "thrust": thrust,
            "torque": torque,
            "hub_force": np.array(seen["hub_force"]) * [1.0, hand, 1.0],
            "hub_moment": np.array(seen["hub_moment"]) * [hand, 1.0, hand],
            "flap": flap,
            "lead": lead,
            "beta_0": np.mean(flap),
            "inflow_mean": model.disk_mean(seen["inflow"]),
            **{name: seen[name] for name in ("azimuth", "inflow", "circulation", "cl", "alpha")},
        }
        tips = self.run.exchange.tips(at.step)
        if tips is not None:
            kept["wake"], kept["tip_circulation"] = tips[:2]
        for name, value in kept.items():
            self.rows.setdefault(name, []).append(np.asarray(value))


class OnStand(Stepping):
    """A solved rotor whose collective moves; the stand itself is not changed."""

    model: StandModel

    def __init__(self, stand: Solved, model: StandModel):
        s = stand.solution
        # the clock that azimuths are read from goes on from the wake's
        self.first = 0 if s.march is None else s.march.step_index
        begun, trimmed = model.clock.time(self.first), (s.problem, s.x)
        dynamic = s.march is None
        sections = model.core.trim_sections(*trimmed, begun) if dynamic else None
        self.exchange = Exchange.dynamic(model, sections) if s.march is None else s.march.copy()
        y, _ = model.core.trim_state(*trimmed, begun)
        self._begin(model, FixedIntegrator(model), y, s.x[:3], self.first)


def transient(
    stand: Solved,
    attributes: dict[str, Any],
    collective: Sequence[Any],
    duration: Any,
    progress: Progress | Silent | None = None,
    rotor_speed: RotorSpeed = CONSTANT,
) -> xr.Dataset:
    """See `Tunnel.transient`."""
    from ..results import assemble_transient

    corners = speed_history(rotor_speed)
    if corners and not stand.model.inflow.is_dynamic:
        allowed = f"must be constant on a stand with a free wake (inflow = {stand.model.inflow.name})"
        raise InputError.of("rotor_speed", "a history", allowed)
    solution, model = stand.solution, stand.model.at_speed(corners)
    if solution.march is None and not model.inflow.is_dynamic:
        raise InputError.of("inflow", model.inflow.name, "a transient needs inflow time-marching or dynamic")
    if model.aircraft.discretisation.n_modes and not model.n_harmonics:
        raise InputError.of("n_harmonics", model.n_harmonics, "must be above 0")
    run = OnStand(stand, model)
    step, moved = model.clock.duration(0), history(collective, solution.x, run)
    length = within("duration", duration, "s", step, LONGEST * 2 * np.pi / model.omega, "s")
    n_steps = int(np.ceil(run.clock.steps(0, length) - 1e-9))
    end = run.clock.time(n_steps)
    ends = {"collective time": moved.time[-1], "rotor_speed time": max((t for t, _ in model.rotor_speed), default=0.0)}
    for name, last in ends.items():
        if last > end * (1.0 + 1e-9):
            allowed = f"must not lie after the end of the transient at {end:.6g} s: it would not be reached"
            raise InputError.of(name, f"{last:.12g} s", allowed)
    progress = progress or Silent()
    progress.phase("transient", n_steps)
    kept = Recorder(stand, run)
    failure = ""
    try:
        for _ in range(n_steps):
            run.follow(moved, kept.record)
            progress.advance(1, "")
        kept.record(run.instant(moved, ends=True))
    except ArithmeticError as reason:
        failure = f"transient on the stand, t = {run.clock.time(kept.n_recorded):.4f} s: {reason}"
        if not kept.n_recorded:
            raise NumericalFailure(failure) from reason
    arrays = {**kept.arrays(), "station": model.stations / stand.radius}
    if "wake" in arrays:
        arrays["age"] = 2 * np.pi / model.steps_per_revolution * np.arange(arrays["wake"].shape[2])
    if model.rotor_speed:
        arrays["rotor_speed"] = model.omega * shares(model.rotor_speed, arrays["time"])
    data = assemble_transient(arrays, {**attributes, "failure": failure, "step": step})
    if failure:
        raise NumericalFailure(failure, partial=data)
    return data


def check(stand: Solved, model: StandModel, seen: dict[str, Any], collective: float) -> None:
    """End where an instant of `model` is beyond what the motion of the rotor can give."""
    condition = model.condition
    velocity = np.asarray(condition.velocity) / model.tip_speed
    theta = [collective, stand.theta_1c, stand.theta_1s]
    usual, bound = (each * model.top_share for each in model.bounds.inflow(velocity, theta))
    section = model.bounds.section(velocity, theta)
    speed, rate = np.linalg.norm(condition.velocity), np.linalg.norm(condition.rates) + model.overspeed
    fastest = model.bounds.mach(speed, rate, section)
    places = Places(model.stations / stand.radius, np.asarray(seen["azimuth"]))
    watched = (
        rotor.induced_velocity(seen["inflow"], usual, bound, places),
        rotor.mach_number(seen["mach"], fastest, np.inf, places),
    )
    if failed := failures(watched):
        raise ArithmeticError("; ".join(failed))
