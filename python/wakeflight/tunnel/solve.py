# SPDX-License-Identifier: MIT OR Apache-2.0
"""The rotor on its stand solved: with dynamic inflow, then on the relaxation wake, then on the marching one.

Each is the start of the next. The blades' periodic motion and the pitch controls follow the inflow once per pass (or
revolution); circulation and near wake are solved together at every step.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from .. import _core
from ..errors import NumericalFailure, known
from ..exchange import Exchange
from ..progress import Progress, Silent
from ..regime import AXIAL, REVOLUTIONS
from ..trim import on_wake
from ..trim.equations import inflow_of_states, trim_problem, unmet, without_inflow
from ..trim.on_wake import TrimOnWake, Wake
from ..trim.wake import WakeInTrim
from .model import StandModel

CHANGE_TOLERANCE = 1e-4
"""Change of pitch controls and blade harmonics [rad] between passes on the wake: leaves 0.03 % of the power of hover."""
PASSES = 15
"""Passes of blades and relaxation wake at most."""
START_SWEEPS, START_LOOPS = 1, 4
"""Relaxation that starts a marching full-span wake in axial flow: free sheets do not settle there, time means do."""

SETTLED = 2e-4
"""Change of inflow over its mean per revolution below which a marching wake counts as periodic."""


@dataclass(frozen=True)
class Solution(on_wake.Solution):
    """A trim of the rotor on its stand, with the revolutions of a marching wake behind it."""

    model: StandModel
    march: Exchange | None = None
    revolutions: list[Revolution] = field(default_factory=list)
    averaged: int = 0
    snapshots: list[_core.TimeMarchingWake] = field(default_factory=list)
    """The wake at every step of the last revolution."""


@dataclass(frozen=True)
class Revolution:
    """One marched revolution: passages of all blades step by step (n_steps, n_blades, ...), wake, unknowns."""

    rows: np.ndarray
    passages: dict[str, np.ndarray]
    inflow: np.ndarray
    path: np.ndarray
    x: np.ndarray
    vortex_blade_distance: float
    """Smallest distance of a tip vortex from a blade, in core radii."""
    max_displacement: float
    """Largest motion of a wake node in a step, over R."""


def first_guess(model: StandModel, problem: _core.TrimProblem) -> np.ndarray:
    """Start: momentum inflow and linear blade-element thrust, C_T = sigma a/2 [theta_75 (1/3 + mu^2/2) - lambda/2]."""
    layout = model.core.trim_layout(problem)
    modes, inflow = layout.modes, layout.inflow
    rotor, condition = model.aircraft, model.condition
    x = np.zeros(modes[-1])
    mu, mu_z = condition.mu(model.tip_speed), condition.mu_z(model.tip_speed)
    sigma, slope = model.rotor["solidity"], 5.7
    twist = rotor.twist(0.75 * rotor.radius)
    wanted = dict(condition.controls)
    gain = 0.5 * sigma * slope
    if "thrust" in wanted:
        ct = wanted["thrust"] / model.dynamic_pressure_area
        lam = _core.descent_inflow(ct, mu * mu, mu_z)
        theta_75 = (ct / gain + 0.5 * (lam - mu_z)) / (1 / 3 + mu**2 / 2)
    else:
        theta_75 = wanted["collective"] + twist if "collective" in wanted else np.radians(4.0)
        lam = 0.0
        for _ in range(200):
            ct = gain * (theta_75 * (1 / 3 + mu**2 / 2) - 0.5 * (lam - mu_z))
            lam = 0.8 * lam + 0.2 * _core.descent_inflow(ct, mu * mu, mu_z)
    x[0] = wanted.get("collective", theta_75 - twist)
    tilt = -mu * (8 / 3 * theta_75 - 2 * (lam - mu_z)) / (1 - mu**2 / 2)
    found = "longitudinal_cyclic" not in wanted
    x[1] = wanted.get("lateral_cyclic", 0.0)
    x[2] = tilt - wanted.get("beta_1c", 0.0) if found else wanted["longitudinal_cyclic"]
    if inflow < modes[0]:
        x[inflow] = lam
    per_coordinate = model.rotor["flap_per_coordinate"]
    if len(modes) > 1 and per_coordinate != 0.0:
        x[modes[model.rotor["flap_mode"]]] = np.sign(ct) * np.radians(3.0) / per_coordinate
    return x


def hybrid(model: StandModel, problem: _core.TrimProblem, x0: np.ndarray) -> np.ndarray:
    """Where MINPACK's hybrid method comes to rest from the closed-form start `x0`, with dynamic inflow.

    At no thrust the mass flow of momentum theory ends in a root: any lambda_0 then meets its equation, and Newton's longer steps
    find such an answer of rotors that carry next to nothing.
    """
    from scipy.optimize import root

    core = model.core
    found = root(
        lambda x: core.trim_residual(problem, x),
        x0,
        jac=lambda x: core.trim_jacobian(problem, x),
        method="hybr",
        options={"xtol": 1e-12, "maxfev": 400},
    )
    result: np.ndarray = found.x
    return result


class StandOnWake(TrimOnWake[StandModel, Wake]):
    """Trims of a rotor on its stand; its pitch controls and blade harmonics must rest. Not resting is a status, not an error."""

    where = ""
    moving = "blades"

    def __init__(
        self, model: StandModel, progress: Progress | Silent, tolerance: float = CHANGE_TOLERANCE, passes: int = PASSES
    ):
        super().__init__(model, progress, tolerance)
        self.passes = passes

    def none_found(self, problem: _core.TrimProblem, x: np.ndarray, inflow_map: np.ndarray | None) -> str:
        """Where the search stopped."""
        theta = ", ".join(f"{np.degrees(v):.2f}" for v in x[:3])
        return (
            f"no steady motion of the rotor found: {unmet(self.model, problem, x)}; "
            f"stopped at theta_0, theta_1c, theta_1s = {theta} deg"
        )

    def moved(self, problem: _core.TrimProblem, before: np.ndarray, after: np.ndarray) -> np.ndarray:
        """Changes of pitch controls and blade harmonics, as angles [rad]."""
        modes = self.model.core.trim_layout(problem).modes
        scale = np.ones(after.size)
        for i, angle in enumerate(self.model.rotor["angle_per_coordinate"]):
            scale[modes[i] : modes[i + 1]] = angle
        found: np.ndarray = (after - before) * scale
        return found

    def hopeless(self, wake: Wake, history: list[dict[str, float]]) -> bool:
        """Whether the last pass brought nothing: the inflow changes no less than three passes before."""
        recent = [each["inflow_change"] for each in history[-3:]]
        return not wake.converged and len(recent) == 3 and recent[-1] > 0.5 * recent[0]

    def ended(self, found: on_wake.Solution) -> on_wake.Solution:
        """The rotor on the last inflow of the wake, with a note."""
        problem, x = self.solve(found.inflow_map, found.x)
        last = found.history[-1]
        note = (
            f"relaxation did not settle: inflow still changes by {last['inflow_change']:.1e} of the tip speed per "
            f"iteration, the first turn by {last['first_turn_change']:.1e} R, blades and controls by "
            f"{last['control_change']:.1e} rad"
        )
        return replace(found, problem=problem, x=x, notes=(note,))


def with_dynamic_inflow(model: StandModel, progress: Progress | Silent) -> Solution:
    """The rotor with dynamic inflow: a result of its own, or the start of a free wake."""
    problem = trim_problem(model, None)
    start = hybrid(model, problem, first_guess(model, problem))
    problem, x = StandOnWake[WakeInTrim](model, progress).solve(None, start)
    n = model.steps_per_revolution
    turn = model.core.passages(problem, x, 2 * np.pi * np.arange(n) / n, None)
    return Solution(model, problem, x, turn["inflow"], turn["circulation"])


def on_relaxation(model: StandModel, start: Solution, trimming: StandOnWake[WakeInTrim]) -> Solution:
    """Blade motion and relaxation wake in turn, from the solution with dynamic inflow."""
    inflow_map = inflow_of_states(start.model, start.problem, start.x, model.steps_per_revolution)
    wake = WakeInTrim(model, inflow_map)
    found = trimming.on_periodic(wake, without_inflow(start.model, start.problem, start.x), inflow_map)
    return Solution(**vars(found))


class Revolutions:
    """A marching wake under the rotor on its stand, every passage of its blades kept.

    The inflow that blade motion and controls are renewed on is the mean of the last revolution's and of the one used before, so
    that the unsteadiness of an axial wake is not taken for a change of condition. Ends early where the wake is periodic.
    """

    wash = None

    def __init__(self, model: StandModel, start: Solution, revolutions: int | None, averaged: int | None):
        usual, means = REVOLUTIONS[model.condition.regime(model.tip_speed)]
        self.longest = revolutions or max(usual, (averaged or 0) + 2)
        self.averaged = min(averaged or means, self.longest)
        self.model, self.held = model, start.inflow_map
        self.march = Exchange.marching(model, known(start.wake))
        self.run = replace(start, model=model, march=self.march, history=list(start.history), settled=False)

    def turn(self, revolution: int, problem: _core.TrimProblem, x: np.ndarray) -> np.ndarray:
        """March one revolution: the inflow to be trimmed on."""
        model, march, before = self.model, self.march, self.run.inflow_map
        turned = march_revolution(model, march, problem, x, self.run.snapshots)
        self.run.revolutions.append(turned)
        inflow_map = by_azimuth(turned.rows, turned.inflow, march.n)
        self.held = inflow_map if revolution == 1 else 0.5 * (self.held + inflow_map)
        circulation = by_azimuth(turned.rows, turned.passages["circulation"], march.n)
        averaged = min(self.averaged, len(self.run.revolutions))
        self.run = replace(
            self.run, problem=problem, x=x, inflow_map=inflow_map, circulation=circulation, averaged=averaged
        )
        # a Weissinger blade holds a second inflow behind that of the stations
        change, mean = ((inflow_map - before)[:, : model.stations.size], inflow_map[:, : model.stations.size])
        rms = float(np.sqrt(np.mean((change**2) @ model.area_weights)))
        self.relative = rms / max(abs(model.disk_mean(mean)), 1e-6)
        return self.held

    @property
    def told(self) -> str:
        """Opens the line of progress."""
        return f"inflow change {self.relative:.1e} of its mean, "

    def diverged(self, revolution: int, reason: ArithmeticError) -> NumericalFailure:
        """Where and why, with the revolutions before."""
        partial = self.run if self.run.revolutions else None
        return NumericalFailure(f"marching wake on the stand, revolution {revolution}: {reason}", partial=partial)

    def trimmed(self, problem: _core.TrimProblem, x: np.ndarray, change: float) -> bool:
        """Whether the wake is periodic and the rotor at rest."""
        self.run.history.append({"inflow_change_per_revolution": self.relative, "control_change": change})
        return len(self.run.revolutions) > 3 and self.relative < SETTLED and change < 1e-5

    def found(self, rests: bool) -> Solution:
        """The run; where it does not rest with a note."""
        if rests:
            return replace(self.run, settled=True, averaged=min(self.run.averaged, 2))
        note = (
            f"the marching wake is not periodic: inflow changes by {100 * self.relative:.2g} % of its mean per revolution; "
            f"means over the last {self.run.averaged} of {len(self.run.revolutions)} revolutions"
        )
        return replace(self.run, notes=(*self.run.notes, note))


def march_revolution(
    model: StandModel,
    march: Exchange,
    problem: _core.TrimProblem,
    x: np.ndarray,
    snapshots: list[_core.TimeMarchingWake],
) -> Revolution:
    """One revolution at the motion and pitch of `x`; `snapshots` then holds the wake of each of its steps."""
    taken, inflows, path, watched, remembered = [], [], [], [], []
    snapshots.clear()
    for _ in range(march.n):
        row, lam, _ = march.frozen_step(problem, x)
        taken.append(row)
        inflows.append(lam)
        remembered.append(march.core.sections)
        path.append(march.position())
        watched.append(march.monitors)
        snapshots.append(march.wake())
    rows, inflow = np.array(taken), np.array(inflows)
    psi = 2 * np.pi * rows.ravel() / march.n
    sections = [known(each) for each in remembered] if model.remembers else None
    passages = model.core.passages(problem, x, psi, inflow.reshape(psi.size, -1), sections)
    shape = (march.n, model.n_blades, -1)
    passages = {name: values.reshape(shape) for name, values in passages.items()}
    return Revolution(
        rows,
        passages,
        inflow,
        np.array(path),
        x,
        vortex_blade_distance=min(each["vortex_blade_distance"] for each in watched),
        max_displacement=max(each["max_displacement"] for each in watched),
    )


def by_azimuth(rows: np.ndarray, values: np.ndarray, n: int) -> np.ndarray:
    """Means over all passages of each of `n` azimuths of values (n_steps, n_blades, ...)."""
    flat = values.reshape(rows.size, *values.shape[2:])
    total = np.zeros((n, *values.shape[2:]))
    np.add.at(total, rows.ravel(), flat)
    count = np.bincount(rows.ravel(), minlength=n).reshape(-1, *([1] * (values.ndim - 2)))
    return total / count


def solution(
    simple: StandModel, model: StandModel | None, turns: dict[str, int | None], progress: Progress | Silent
) -> Solution:
    """The rotor solved with `simple` (dynamic inflow), then with `model` where a free wake is asked for."""
    start = with_dynamic_inflow(simple, progress)
    progress.advance(1, "dynamic inflow")
    if model is None:
        return start
    if not model.inflow.is_marching:
        return on_relaxation(model, start, StandOnWake(model, progress))
    relaxation = model.inflow.marching.trim_model()
    tumbling = model.condition.regime(model.tip_speed) in AXIAL and model.inflow.is_full_span
    if tumbling:
        relaxation = replace(relaxation, sweeps=START_SWEEPS, max_loops=START_LOOPS)
    relaxed = StandModel.build(model.aircraft, model.condition, relaxation, model.n_harmonics, model.blade_model)
    trimming = StandOnWake[WakeInTrim](relaxed, progress, passes=1 if tumbling else PASSES)
    found = on_relaxation(relaxed, start, trimming)
    if tumbling:
        # no result, only a start
        found = replace(found, notes=())
    run = Revolutions(model, found, **turns)
    progress.phase("marching wake", run.longest)
    return StandOnWake[WakeInTrim](model, progress).on_turns(run, found)
