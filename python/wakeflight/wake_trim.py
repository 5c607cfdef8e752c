# SPDX-License-Identifier: MIT OR Apache-2.0
"""The free wake in trim: inflow and circulation brought into agreement at the trimmed motion.

Circulation and near wake are solved together at every azimuth; the inflow of everything else is relaxed:
lambda_far <- lambda_far + omega_lambda (lambda_far of the wake - lambda_far) [ribera2004].
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core
from .errors import InputError, NumericalFailure
from .exchange import MarchingExchange
from .model import CompiledRotor

DIVERGING = 2.0
"""Growth of the change of inflow over its least, at which a smaller share of each change is taken."""
LEAST_SHARE = 0.05
"""Least share of a change of inflow that is taken."""
FIRST_TURN_TOLERANCE = 1e-3
"""Change of the first turn's geometry over R in a sweep below which it counts as settled."""
PERIODIC = 2e-4
"""Change of inflow over its mean per revolution below which a marching wake in axial flow counts as periodic."""


class WakeInTrim:
    """Relaxation wake of a trimmed or steady flight, with its periodic circulation."""

    def __init__(self, model: CompiledRotor, inflow_map: np.ndarray):
        self.model = model
        self.n = model.steps_per_revolution
        self.psi = 2 * np.pi * np.arange(self.n) / self.n
        self.mean_inflow = model.disk_mean(inflow_map)
        self.lambda_far = inflow_map.copy()
        self.circulation = np.zeros_like(inflow_map)
        self.inflow_map = inflow_map
        self.relaxation: _core.RelaxationWake | None = None
        self.converged = False
        self.last: dict[str, float] = {}
        self.counters = {
            "relaxation_iterations": 0,
            "wake_segment_evaluations": 0,
            "circulation_followed": 0,
        }

    def converge(self, problem: _core.TrimProblem, x: np.ndarray) -> np.ndarray:
        """Iterate wake and circulation at the trimmed motion; returns the total inflow map (n, n_stations)."""
        core = self.model.core
        q, q_dot = core.trim_motion(problem, x, self.n)
        y, _ = core.trim_state(problem, x, 0.0)
        self.converge_motion(y, x[: self.model.n_controls], q, q_dot, self.model.inflow.max_loops)
        return self.inflow_map

    def converge_motion(
        self, y: np.ndarray, stick: np.ndarray, q: np.ndarray, q_dot: np.ndarray, max_iterations: int
    ) -> bool:
        """Iterate wake and circulation for a periodic blade motion q(psi) (n, n_modes) taken as steady."""
        model, options = self.model, self.model.inflow
        core = model.core
        hub = core.hub(y)
        flap, lead = core.equivalent_angles(q)
        stick = np.asarray(stick)
        if self.relaxation is None:
            try:
                self.relaxation = _core.RelaxationWake(model.wake_options, *hub, self.mean_inflow)
            except ValueError as reason:
                raise InputError(f"wake: {reason}") from reason
            # before there is a wake, the map given serves as total inflow
            self._solve_circulation(y, stick, q, q_dot, near_wake_in_far=True)
        else:
            self._solve_circulation(y, stick, q, q_dot)
        thrust = self._thrust()
        self.converged = False
        share, least = options.inflow_relaxation, np.inf
        for iteration in range(max_iterations):
            self.relaxation.set_state(*hub, flap, lead, self.circulation)
            norms = self.relaxation.sweep(options.sweeps)
            far = self.relaxation.inflow_far()
            change = far - self.lambda_far
            rms = float(np.sqrt(np.mean((change**2) @ model.area_weights)))
            # a wake at low thrust stays in the disk, and inflow and circulation overshoot: take less of each change
            if rms > DIVERGING * least:
                share, least = max(0.5 * share, LEAST_SHARE), rms
            least = min(least, rms)
            self.lambda_far = self.lambda_far + share * change
            self._solve_circulation(y, stick, q, q_dot)
            before, thrust = thrust, self._thrust()
            thrust_change = abs(thrust - before) / max(abs(thrust), 1e-6 * model.tip_speed * model.rotor["radius"] ** 2)
            self.counters["relaxation_iterations"] += options.sweeps
            self.last = {
                "inflow_change": rms,
                "thrust_change": thrust_change,
                "geometry_change": float(norms[-1, 0]),
                "first_turn_change": float(norms[-1, 1]),
                "iterations": iteration + 1,
            }
            if (
                rms < options.inflow_tolerance
                and thrust_change < 1e-3
                and self.last["first_turn_change"] < FIRST_TURN_TOLERANCE
            ):
                self.converged = True
                break
        self.counters["wake_segment_evaluations"] = int(self.relaxation.segment_evaluations)
        return self.converged

    def _solve_circulation(
        self,
        y: np.ndarray,
        stick: np.ndarray,
        q: np.ndarray,
        q_dot: np.ndarray,
        near_wake_in_far: bool = False,
    ) -> None:
        start = self.circulation
        if near_wake_in_far:
            # the first circulation has no near wake: sections at the inflow of the map
            hub = self.model.core.hub(y)
            rows = [
                self.model.core.section_circulation(*hub, stick, self.psi[k], q[k], q_dot[k], self.lambda_far[k])[0]
                for k in range(self.n)
            ]
            self.circulation, self.inflow_map = np.array(rows), self.lambda_far
            return
        try:
            self.circulation, self.inflow_map, _, followed = self.model.core.solve_circulation(
                self.model.wake_options, y, stick, np.zeros(len(stick)), self.psi, q, q_dot, self.lambda_far, start
            )
        except ArithmeticError as reason:
            raise NumericalFailure(str(reason)) from reason
        self.counters["circulation_followed"] += followed

    def _thrust(self) -> float:
        """Thrust but for constant factors: integral of circulation times radius."""
        widths = np.asarray(self.model.rotor["widths"])
        return float(np.mean(self.circulation @ (self.model.stations * widths)))

    def marching(self, model: CompiledRotor) -> MarchingExchange:
        """A time-marching wake of `model` started from this one."""
        return MarchingExchange(model, self)


def marching_map(march: MarchingExchange, problem: Any, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Inflow and circulation maps (n, n_stations) of one revolution marched at the trimmed motion."""
    records = [march.frozen_step(problem, x) for _ in range(march.model.steps_per_revolution)]
    return march.periodic_map(records)
