# SPDX-License-Identifier: MIT OR Apache-2.0
"""Blade elements on annular momentum: every ring of the disk for itself, in hover and axial climb [leishman2006]."""

from __future__ import annotations

import numpy as np

from .. import _core
from ..errors import InputError, NumericalFailure
from ..progress import Progress, Silent
from ..trim import on_wake
from ..trim.equations import inflow_of_states, without_inflow
from .condition import StandCondition
from .model import StandModel
from .solve import Solution, StandOnWake

REST = 1e-10
"""Change of inflow, pitch controls and blade harmonics between passes at which the two agree."""
MAX_PASSES = 100
BISECTIONS = 60


def check_axial(condition: StandCondition, tip_speed: float) -> None:
    """Refuse what rings cannot have: a wind across the shaft, descent, a stand that turns."""
    across, down = condition.mu(tip_speed), condition.mu_z(tip_speed)
    if across > 1e-6 or down > 1e-6 or any(condition.rates):
        what = f"mu = {across:.4g}, mu_z = {down:.4g} (descent +)" if not any(condition.rates) else "a stand that turns"
        raise InputError.of("inflow", "annular", f"holds in hover and axial climb on a stand at rest, not with {what}")


class Rings:
    """Inflow of the rings of the disk: each carries the lift of its blade elements."""

    def __init__(self, model: StandModel, inflow_map: np.ndarray):
        self.model, self.inflow_map = model, inflow_map
        self.circulation = np.zeros_like(inflow_map)
        self.last = {"inflow_change": np.inf}

    @property
    def in_trim(self) -> None:
        """No free wake."""
        return None

    @property
    def converged(self) -> bool:
        """Whether the last pass found them at rest."""
        return self.last["inflow_change"] < REST

    def converge(self, problem: _core.TrimProblem, x: np.ndarray) -> np.ndarray:
        """The inflow (n, n_stations) that belongs to the motion of `x`."""
        rings = inflow_of_rings(self.model, problem, x)
        self.last = {"inflow_change": float(np.abs(rings - self.inflow_map[0]).max())}
        self.inflow_map = np.tile(rings, (self.model.steps_per_revolution, 1))
        return self.inflow_map


class OnRings(StandOnWake["Rings"]):
    """Trims of a rotor on its stand in the inflow of its rings."""

    def hopeless(self, wake: Rings, history: list[dict[str, float]]) -> bool:
        """Not before the passes are at their end."""
        return False

    def ended(self, found: on_wake.Solution) -> on_wake.Solution:
        """No answer."""
        change = found.history[-1]["inflow_change"]
        raise NumericalFailure(f"annular inflow: blades and rings do not agree, inflow still changes by {change:.1e}")


def on_annuli(model: StandModel, start: Solution, progress: Progress | Silent) -> Solution:
    """Blade motion and the inflow of the rings in turn until both rest, from the solution with dynamic inflow."""
    n = model.steps_per_revolution
    inflow_map = inflow_of_states(start.model, start.problem, start.x, n)
    x = without_inflow(start.model, start.problem, start.x)
    found = OnRings(model, progress, REST, MAX_PASSES).on_periodic(Rings(model, inflow_map), x, inflow_map)
    passed = model.core.passages(found.problem, found.x, 2 * np.pi * np.arange(n) / n, found.inflow_map)
    return Solution(model, found.problem, found.x, found.inflow_map, passed["circulation"])


def inflow_of_rings(model: StandModel, problem: _core.TrimProblem, x: np.ndarray) -> np.ndarray:
    """Induced inflow lambda (n_stations,) at which each ring carries the lift of its blade elements.

    N_b Omega Gamma = 4 pi F lambda |lambda + lambda_c| (Omega R)^2, Gamma the mean circulation over the revolution at the
    present motion, lambda_c the climb; drag does not push the air. F = 2/pi acos(exp(-N_b (1 - r)/(2 |lambda + lambda_c|)))
    (Prandtl), or 1. A ring that lifts has the root above zero, one that is pushed up that of a windmill, or, where there is
    none, that of a flow reversed; a stalled element may have several, of which bisection finds one.
    """
    core, condition, tip_speed = model.core, model.condition, model.tip_speed
    n = model.steps_per_revolution
    q, q_dot = core.trim_motion(problem, x, n)
    psi = 2 * np.pi * np.arange(n) / n
    climb = -condition.mu_z(tip_speed)
    hub = (list(condition.velocity), list(condition.rates))
    r = model.stations / model.rotor["radius"]

    def excess(lam: np.ndarray) -> np.ndarray:
        passages = zip(psi, q, q_dot, strict=True)
        lift = [core.section_circulation(hub, x[:3], (p, a, b), lam) for p, a, b in passages]
        through = np.abs(lam + climb)
        momentum = 4 * np.pi * tip_loss(model, r, through) * lam * through * tip_speed**2
        found: np.ndarray = momentum - model.n_blades * model.omega * np.mean(lift, axis=0)
        return found

    lifts = excess(np.zeros_like(r)) <= 0.0
    windmill = excess(np.full_like(r, -0.5 * climb)) <= 0.0
    low = np.where(lifts, 0.0, np.where(windmill, -0.5 * climb, -1.0))
    high = np.where(lifts, 1.0, np.where(windmill, 0.0, -climb))
    lost = (excess(low) > 0.0) | (excess(high) < 0.0)
    if np.any(lost):
        at = r[np.argmax(lost)]
        raise NumericalFailure(f"annular inflow: momentum theory has no answer for the ring at r/R = {at:.3f}")
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        above = excess(middle) > 0.0
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return 0.5 * (low + high)


def tip_loss(model: StandModel, r: np.ndarray, through: np.ndarray) -> np.ndarray:
    """Prandtl's share F of the momentum that a ring of finitely many blades passes on; 1 without tip loss."""
    if model.inflow.annular.tip_loss == "none":
        return np.ones_like(r)
    with np.errstate(divide="ignore"):
        found: np.ndarray = 2 / np.pi * np.arccos(np.exp(-0.5 * model.n_blades * (1.0 - r) / through))
        return found
