# SPDX-License-Identifier: MIT OR Apache-2.0
"""The rotor on its stand solved: with dynamic inflow, then on the relaxation wake, then on the marching one.

Each is the start of the next. The blades' periodic motion and the pitch controls follow the inflow once per pass (or
revolution); circulation and near wake are solved together at every step.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from .. import _core
from ..errors import NumericalFailure
from ..exchange import MarchingExchange
from ..inflow import trim_model
from ..progress import Progress, Silent
from ..regime import REVOLUTIONS
from ..trim_equations import inflow_of_states, unmet, without_inflow
from ..trim_newton import Work, newton
from ..wake_trim import WakeInTrim
from .model import StandModel

LINEARISATIONS = 60
"""Newton steps at most."""
CHANGE_TOLERANCE = 1e-4
"""Change of pitch controls and blade harmonics [rad] between passes on the wake: leaves 0.03 % of the power of hover."""
MAX_OUTER = 15
START = {"sweeps": 1, "max_loops": 4}
"""Relaxation that starts a marching full-span wake in axial flow: free sheets do not settle there, time means do."""

SETTLED = 2e-4
"""Change of inflow over its mean per revolution below which a marching wake counts as periodic."""


@dataclass
class Solution:
    """State of a solution: unknowns on an inflow map, with the wake behind it."""

    model: StandModel
    problem: _core.TrimProblem
    x: np.ndarray
    inflow_map: np.ndarray
    circulation: np.ndarray
    wake: WakeInTrim | None = None
    march: MarchingExchange | None = None
    revolutions: list[Revolution] = field(default_factory=list)
    averaged: int = 0
    settled: bool = True
    notes: list[str] = field(default_factory=list)
    history: list[dict[str, float]] = field(default_factory=list)
    snapshots: list[_core.TimeMarchingWake] = field(default_factory=list)


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
        lam = momentum_inflow(ct, mu, mu_z, model.windmill)
        theta_75 = (ct / gain + 0.5 * (lam - mu_z)) / (1 / 3 + mu**2 / 2)
    else:
        theta_75 = wanted["collective"] + twist if "collective" in wanted else np.radians(4.0)
        lam = 0.0
        for _ in range(200):
            ct = gain * (theta_75 * (1 / 3 + mu**2 / 2) - 0.5 * (lam - mu_z))
            lam = 0.8 * lam + 0.2 * momentum_inflow(ct, mu, mu_z, model.windmill)
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


def momentum_inflow(ct: float, mu: float, mu_z: float, least: bool = False) -> float:
    """Root of lambda_0 = C_T/(2 sqrt(mu^2 + (lambda_0 - mu_z)^2)) that dynamic inflow takes: continued from hover, or least."""
    return _core.momentum_inflow(ct, mu * mu, mu_z, least)


def solve_equations(model: StandModel, problem: _core.TrimProblem, x0: np.ndarray) -> np.ndarray:
    """Solve the stand's equations from `x0` by the Newton method of every trim."""
    attempt = newton(model, problem, x0, Work(LINEARISATIONS))
    if attempt.met:
        return attempt.x
    theta = ", ".join(f"{np.degrees(v):.2f}" for v in attempt.x[:3])
    mu, mu_z = model.condition.mu(model.tip_speed), model.condition.mu_z(model.tip_speed)
    branches = model.windmill and mu_z > 0.0 and mu_z > np.sqrt(8.0) * mu
    why = "; momentum theory has no steady answer where the windmill brake state begins" if branches else ""
    raise NumericalFailure(
        f"no steady motion of the rotor found: {unmet(model, problem, attempt.x)}; "
        f"stopped at theta_0, theta_1c, theta_1s = {theta} deg{why}"
    )


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
    return found.x


def with_dynamic_inflow(model: StandModel) -> Solution:
    """The rotor with dynamic inflow: a result of its own, or the start of a free wake."""
    problem = model.problem(None)
    x = solve_equations(model, problem, hybrid(model, problem, first_guess(model, problem)))
    n = model.steps_per_revolution
    turn = model.core.passages(problem, x, 2 * np.pi * np.arange(n) / n, None)
    return Solution(model, problem, x, turn["inflow"], turn["circulation"])


def on_relaxation(model: StandModel, start: Solution, progress: Progress | Silent, passes: int = MAX_OUTER) -> Solution:
    """Blade motion and relaxation wake in turn until both rest, or `passes` times; not resting is a status, not an error."""
    inflow_map = inflow_of_states(start.model, start.problem, start.x, model.steps_per_revolution)
    x = without_inflow(start.model, start.problem, start.x)
    wake = WakeInTrim(model, inflow_map)
    history: list[dict[str, float]] = []
    settled = False
    thrust = None
    for outer in range(passes):
        problem = model.problem(inflow_map)
        before, x = x, solve_equations(model, problem, x)
        change = largest_change(model, problem, before, x)
        if outer > 0 and change < CHANGE_TOLERANCE and wake.converged:
            settled = True
            break
        try:
            wake.converge(problem, x)
        except ArithmeticError as reason:
            raise NumericalFailure(f"relaxation wake, pass {outer + 1}: {reason}") from reason
        inflow_map = wake.inflow_map
        history.append({**wake.last, "change": change})
        progress.advance(1, f"inflow change {wake.last['inflow_change']:.1e}, blades {change:.1e} rad")
        if outer >= 2 and not wake.converged and thrust is not None and _stalled(history):
            break
        thrust = wake.last["thrust_change"]
    else:
        problem = model.problem(inflow_map)
        x = solve_equations(model, problem, x)
    notes = []
    if not settled:
        last = history[-1]
        notes.append(
            f"relaxation did not settle: inflow still changes by {last['inflow_change']:.1e} of the tip speed per "
            f"iteration, the first turn by {last['first_turn_change']:.1e} R, blades and controls by {last['change']:.1e} rad"
        )
    circulation = wake.circulation
    return Solution(
        model,
        problem,
        x,
        inflow_map,
        circulation,
        wake=wake,
        settled=settled,
        notes=notes,
        history=history,
    )


def _stalled(history: list[dict[str, float]]) -> bool:
    """Whether the last pass brought nothing: the inflow changes no less than three passes before."""
    recent = [each["inflow_change"] for each in history[-3:]]
    return len(recent) == 3 and recent[-1] > 0.5 * recent[0]


def largest_change(model: StandModel, problem: _core.TrimProblem, before: np.ndarray, after: np.ndarray) -> float:
    """Largest change of a pitch control or a blade harmonic, as an angle [rad]."""
    modes = model.core.trim_layout(problem).modes
    scale = np.ones(after.size)
    for i, angle in enumerate(model.rotor["angle_per_coordinate"]):
        scale[modes[i] : modes[i + 1]] = angle
    return float(np.max(np.abs(after - before) * scale))


def on_marching(
    model: StandModel,
    start: Solution,
    progress: Progress | Silent,
    revolutions: int | None = None,
    averaged: int | None = None,
) -> Solution:
    """The rotor with a marching wake: revolution after revolution, blade motion and controls renewed on its inflow.

    The inflow they are renewed on is the mean of the last revolution's and of the one used before, so that the
    unsteadiness of an axial wake is not taken for a change of condition. Ends early where the wake is periodic.
    """
    n_rev, n_mean = REVOLUTIONS[model.condition.regime(model.tip_speed)]
    n_rev = revolutions or max(n_rev, (averaged or 0) + 2)
    n_mean = min(averaged or n_mean, n_rev)
    march = MarchingExchange(model, start.wake)
    problem, x, held = start.problem, start.x, start.inflow_map
    run = Solution(model, problem, x, held, start.circulation, start.wake, march, notes=list(start.notes))
    run.history = start.history
    run.settled = False
    progress.phase("marching wake", n_rev)
    last_map = start.inflow_map
    for revolution in range(n_rev):
        try:
            turned = march_revolution(model, march, problem, x, run.snapshots)
        except ArithmeticError as reason:
            raise _diverged(run, revolution, reason) from reason
        run.revolutions.append(turned)
        new_map = by_azimuth(turned.rows, turned.inflow, march.n)
        held = new_map if revolution == 0 else 0.5 * (held + new_map)
        run.problem, run.x, run.inflow_map = problem, x, new_map
        run.circulation = by_azimuth(turned.rows, turned.passages["circulation"], march.n)
        run.averaged = min(n_mean, len(run.revolutions))
        # a Weissinger blade holds a second inflow behind that of the stations
        change = (new_map - last_map)[:, : model.stations.size]
        rms = float(np.sqrt(np.mean((change**2) @ model.area_weights)))
        relative = rms / max(abs(model.disk_mean(new_map[:, : model.stations.size])), 1e-6)
        last_map = new_map
        before = x
        problem = model.problem(held)
        x = solve_equations(model, problem, x)
        change = largest_change(model, problem, before, x)
        progress.advance(1, f"inflow change {relative:.1e} of its mean, blades {change:.1e} rad")
        run.history.append({"inflow_change_per_revolution": relative, "change": change})
        if revolution >= 3 and relative < SETTLED and change < 1e-5:
            run.settled, run.averaged = True, min(run.averaged, 2)
            break
    if not run.settled:
        run.notes.append(
            f"the marching wake is not periodic: inflow changes by {100 * relative:.2g} % of its mean per revolution; "
            f"means over the last {run.averaged} of {len(run.revolutions)} revolutions"
        )
    return run


def _diverged(run: Solution, revolution: int, reason: Exception) -> NumericalFailure:
    partial = run if run.revolutions else None
    return NumericalFailure(f"marching wake on the stand, revolution {revolution + 1}: {reason}", partial=partial)


def march_revolution(
    model: StandModel,
    march: MarchingExchange,
    problem: _core.TrimProblem,
    x: np.ndarray,
    snapshots: list[_core.TimeMarchingWake],
) -> Revolution:
    """One revolution at the motion and pitch of `x`; `snapshots` then holds the wake of each of its steps."""
    rows, inflow, path, watched = [], [], [], []
    snapshots.clear()
    for _ in range(march.n):
        row, lam, _ = march.frozen_step(problem, x)
        rows.append(row)
        inflow.append(lam)
        path.append(march.position())
        watched.append(march.monitors)
        snapshots.append(march.wake())
    rows, inflow = np.array(rows), np.array(inflow)
    psi = 2 * np.pi * rows.ravel() / march.n
    passages = model.core.passages(problem, x, psi, inflow.reshape(psi.size, -1))
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
    simple: StandModel, model: StandModel | None, options: dict[str, Any], progress: Progress | Silent
) -> Solution:
    """The rotor solved with `simple` (dynamic inflow), then with `model` where a free wake is asked for."""
    start = with_dynamic_inflow(simple)
    progress.advance(1, "dynamic inflow")
    if model is None:
        return start
    if not model.is_marching:
        return on_relaxation(model, start, progress)
    relaxation = trim_model(model.inflow)
    tumbling = model.condition.regime(model.tip_speed) != "forward" and model.inflow.trailers == "full-span"
    if tumbling:
        relaxation = replace(relaxation, **START)
    relaxed = StandModel.build(model.aircraft, model.condition, relaxation, model.n_harmonics, model.blade_model)
    found = on_relaxation(relaxed, start, progress, passes=1 if tumbling else MAX_OUTER)
    if tumbling:
        # no result, only a start
        found.notes.clear()
    return on_marching(model, found, progress, **options)
