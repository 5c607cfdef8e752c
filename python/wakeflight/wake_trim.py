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
THRUST_TOLERANCE = 1e-3
"""Relative change of thrust in an iteration below which it counts as settled."""
PATIENCE = 10
"""Iterations without a tenth of progress after which smaller steps of the geometry are taken."""
LEAST_RELAXATION = 0.25
"""Least share of the relaxation asked for that is taken."""
SETTLING = 5
"""Iterations of a pass that are not part of its mean."""
PASSES_OF_MEAN = 8
"""Passes whose means are averaged at most: they scatter by several tolerances, the mean of eight moves by an eighth of that."""
CONTROL_TOLERANCE = 1e-3
"""Change of a pitch control [rad] between trims on a free wake at which they rest."""
INFLOW_KNOWN = CONTROL_TOLERANCE / 1.5
"""Uncertainty of the inflow over the tip speed (rms) with which a wake that does not rest can be trimmed on its mean.

C_T = sigma a/2 [theta_75 (1/3 + mu^2/2) - lambda/2] at a thrust that is held: lambda moves the collective by 1.5 times itself in
hover, less in forward flight, so this is what the tolerance of the controls leaves of it."""


class WakeInTrim:
    """Relaxation wake of a trimmed or steady flight, with its periodic circulation."""

    def __init__(self, model: CompiledRotor, inflow_map: np.ndarray, steadied: bool = False):
        self.model = model
        self.steadied = steadied
        # share of the relaxation asked for; the tolerances of what a sweep changes shrink with it
        self.step_share = 1.0
        # a wake that circles: mean far inflow of each of the last passes, its change by the last, the motion about it
        self.pass_means: list[np.ndarray] = []
        self.mean_change = self.wander = np.inf
        self.n = model.steps_per_revolution
        self.psi = 2 * np.pi * np.arange(self.n) / self.n
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
                mean = model.disk_mean(self.inflow_map[:, : model.stations.size])
                self.relaxation = _core.RelaxationWake(model.wake_options, *hub, mean)
            except ValueError as reason:
                raise InputError(f"wake: {reason}") from reason
            # before there is a wake, the map given serves as total inflow
            self._solve_circulation(y, stick, q, q_dot, near_wake_in_far=True)
        else:
            self._solve_circulation(y, stick, q, q_dot)
        thrust = self._thrust()
        self.converged = False
        share, least = options.inflow_relaxation, np.inf
        missing, since = np.inf, 0
        passed: list[np.ndarray] = []
        for iteration in range(max_iterations):
            self.relaxation.set_state(*hub, flap, lead, self.circulation)
            self.relaxation.set_mean_inflow(model.carrying_inflow(self.circulation, hub[0]))
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
            now = max(self.excess().values())
            if now < 1.0:
                self.converged = True
                break
            missing, since = (now, 0) if now < 0.9 * missing else (missing, since + 1)
            if self.steadied and since >= PATIENCE and self.step_share > LEAST_RELAXATION:
                # rolled-up wakes circle about their answer: shorter steps of the geometry bring them to it
                self.step_share = max(0.5 * self.step_share, LEAST_RELAXATION)
                self.relaxation.set_relaxation(self.step_share * options.relaxation)
                missing, since = np.inf, 0
            elif self.steadied and self.step_share == LEAST_RELAXATION and iteration >= SETTLING:
                passed.append(self.lambda_far)
        self.mean_change = self.wander = np.inf
        if len(passed) >= PATIENCE and not self.converged:
            self._take_mean(passed, y, stick, q, q_dot)
        self.counters["wake_segment_evaluations"] = int(self.relaxation.segment_evaluations)
        return self.converged

    def _take_mean(
        self, passed: list[np.ndarray], y: np.ndarray, stick: np.ndarray, q: np.ndarray, q_dot: np.ndarray
    ) -> None:
        """Hold the mean of the far inflows that a pass went through, with the circulation that belongs to it."""
        mean = np.mean(passed, axis=0)
        before = np.mean(self.pass_means, axis=0) if self.pass_means else None
        self.pass_means = [*self.pass_means, mean][-PASSES_OF_MEAN:]

        def rms(change: np.ndarray) -> float:
            return float(np.sqrt(np.mean((change**2) @ self.model.area_weights)))

        self.wander = max(rms(each - mean) for each in passed)
        self.lambda_far = np.mean(self.pass_means, axis=0)
        if before is not None:
            self.mean_change = rms(self.lambda_far - before)
        self._solve_circulation(y, stick, q, q_dot)

    @property
    def rests_in_the_mean(self) -> bool:
        """Whether the wake circles closely about an inflow that no longer moves."""
        return self.mean_unrest() < 1.0

    def forget_means(self) -> None:
        """The motion has changed: means of passes before tell nothing of the inflow to come."""
        self.pass_means = []

    def excess(self) -> dict[str, float]:
        """What the last iteration changed over what is allowed, below one where it has settled.

        Geometry and inflow move in proportion to the step that is taken of the geometry: less of it is no rest.
        """
        allowed = self.allowed()
        return {name: self.last[name] / allowed[name] for name in allowed}

    def missing(self) -> float:
        """How far the wake is from rest, in multiples of what is allowed: by itself, or in the mean where it circles."""
        return min(max(self.excess().values()), self.mean_unrest())

    def mean_unrest(self) -> float:
        """How far the mean of a wake that circles is from being one to trim on, below one where it is."""
        return max(self.mean_change / self.model.inflow.inflow_tolerance, self.wander / INFLOW_KNOWN)

    def unrest(self) -> list[str]:
        """What has not settled, with figures."""
        excess, allowed = self.excess(), self.allowed()
        said = {
            "inflow_change": "inflow changes by {:.1e} of the tip speed an iteration (allowed {:.1e})",
            "thrust_change": "circulation: thrust changes by {:.1e} of itself an iteration (allowed {:.1e})",
            "first_turn_change": "wake geometry: the first turn moves by {:.1e} R a sweep (allowed {:.1e})",
        }
        texts = [text.format(self.last[name], allowed[name]) for name, text in said.items() if excess[name] >= 1.0]
        if np.isfinite(self.wander):
            tolerance = self.model.inflow.inflow_tolerance
            texts.append(
                f"the wake circles: inflow within {self.wander:.1e} of its mean (allowed {INFLOW_KNOWN:.1e}), which "
                f"moves by {self.mean_change:.1e} between passes (allowed {tolerance:.1e})"
            )
        return texts

    def allowed(self) -> dict[str, float]:
        """Largest changes in an iteration that count as rest: inflow over the tip speed, thrust, first turn over R."""
        return {
            "inflow_change": self.step_share * self.model.inflow.inflow_tolerance,
            "thrust_change": THRUST_TOLERANCE,
            "first_turn_change": self.step_share * FIRST_TURN_TOLERANCE,
        }

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
