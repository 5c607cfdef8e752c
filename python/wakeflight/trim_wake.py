# SPDX-License-Identifier: MIT OR Apache-2.0
"""Trim on a free wake: trim on the inflow of the wake, wake at the trimmed motion, in turn until both rest.

A wake that rolls up may have no rest of its own: it circles, or varies from turn to turn. Where it does so closely about an
inflow that no longer moves, that mean is what the aircraft is trimmed on, and a note says so. What does not rest is named.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from . import _core
from .errors import NumericalFailure
from .model import Model
from .progress import Progress, Silent
from .trim_limits import limiting
from .trim_solve import solve_on_map
from .wake_trim import CONTROL_TOLERANCE, INFLOW_KNOWN, WakeInTrim, marching_map

MAX_OUTER = 30
"""Passes of trim and relaxation wake at most; the last halve the change of the controls."""
MAX_SWEEPS = 900
"""Sweeps of the relaxation wake at most."""
HOPELESS = 8
"""Passes without progress after which a trim is given up."""
DIRECT_REVOLUTIONS = 10
"""Revolutions of a marching wake that are each trimmed on; after them means are."""
MEANS_END = (16, 22, 28, 34, 49, 64)
"""Revolutions after which the mean since the last of them is trimmed on."""
PERIODIC = 3e-4
"""Change of the inflow of a marching wake from turn to turn, over the tip speed, at which it is periodic."""


@dataclass
class OnWake:
    """A trim on a free wake: equations, unknowns, inflow and circulation maps, what happened on the way, what is to be said."""

    problem: _core.TrimProblem
    x: np.ndarray
    inflow_map: np.ndarray
    circulation: np.ndarray
    history: list[dict[str, float]] = field(default_factory=list)
    notes: tuple[str, ...] = ()


def on_relaxation(
    model: Model,
    wake: WakeInTrim,
    x: np.ndarray,
    inflow_map: np.ndarray,
    n_harmonics: int,
    progress: Progress | Silent,
    control_tolerance: float = CONTROL_TOLERANCE,
    start_only: bool = False,
) -> OnWake:
    """Trim and relaxation wake in turn until the pitch controls and the wake rest.

    start_only: the start of a marching wake, which comes to rest by itself; passes until no more is gained are enough.
    """
    history: list[dict[str, float]] = []
    before, mixing, best, since = None, 1.0, np.inf, 0
    step = np.zeros(4)
    for outer in range(MAX_OUTER):
        controls = model.pitch_controls(x[:4])
        problem, x = solve_on_map(model, inflow_map, x, n_harmonics, before)
        last, step = step, model.pitch_controls(x[:4]) - controls
        change = float(np.max(np.abs(step)))
        if outer > 0 and change < mixing * control_tolerance and (wake.converged or wake.rests_in_the_mean):
            history[-1]["control_change"] = change
            notes = () if wake.converged else (circling(wake),)
            return OnWake(problem, x, inflow_map, wake.circulation, history, notes)
        if outer > 2 and step @ last < -0.5 * (last @ last):
            # controls that swing back and forth: half of each change of the inflow
            mixing = max(0.5 * mixing, 0.25)
        if change > 2.0 * control_tolerance:
            wake.forget_means()
        try:
            wake.converge(problem, x)
        except ArithmeticError as reason:
            raise NumericalFailure(f"trim on the relaxation wake, pass {outer + 1}: {reason}") from reason
        before, inflow_map = inflow_map, inflow_map + mixing * (wake.inflow_map - inflow_map)
        history.append({**wake.last, "control_change": change})
        progress.advance(1, f"inflow change {wake.last['inflow_change']:.1e}, controls {change:.1e} rad")
        # the first trim is on the inflow it was started with: its rest says nothing
        missing = max(change / control_tolerance, wake.missing()) if outer > 0 else np.inf
        best, since = (missing, 0) if missing < 0.9 * best else (best, since + 1)
        if since >= HOPELESS or wake.counters["relaxation_iterations"] > MAX_SWEEPS:
            break
    if start_only:
        return OnWake(problem, x, inflow_map, wake.circulation, history)
    unrest = wake.unrest()
    if change >= mixing * control_tolerance:
        unrest.append(f"pitch controls move by {change:.1e} rad between trims (allowed {mixing * control_tolerance:g})")
    limits = limiting(model, problem, x, inflow_map)
    raise NumericalFailure(
        f"trim on the relaxation wake did not settle in {len(history)} passes, {wake.counters['relaxation_iterations']} "
        f"sweeps: {'; '.join(unrest)}{''.join(f'; {each}' for each in limits)}"
    )


def circling(wake: WakeInTrim) -> str:
    """What is said of a relaxation wake that rests in the mean."""
    return (
        f"the relaxation wake circles about its answer: inflow within {wake.wander:.1e} of the tip speed (rms) of the mean "
        f"that is trimmed on"
    )


def on_marching(
    model: Model,
    start: OnWake,
    wake: WakeInTrim,
    n_harmonics: int,
    progress: Progress | Silent,
    control_tolerance: float = CONTROL_TOLERANCE,
) -> OnWake:
    """Trim on the time-marching wake: march a revolution at the trimmed motion, trim on its inflow, until controls rest.

    A wake that is not periodic is trimmed on the mean of several revolutions, held over the next ones, until that mean rests.
    """
    march = wake.marching(model)
    problem, x = start.problem, start.x
    held, mean = start.inflow_map, None
    turns: list[tuple[np.ndarray, np.ndarray]] = []
    moved = chance = wander = uncertainty = np.inf
    for revolution in range(1, MEANS_END[-1] + 1):
        try:
            turns.append(marching_map(march, problem, x))
        except ArithmeticError as reason:
            raise NumericalFailure(f"trim on the time-marching wake, revolution {revolution}: {reason}") from reason
        direct = revolution <= DIRECT_REVOLUTIONS
        if direct:
            inflow_map, circulation = turns[-1]
            varied = rms(model, turns[-1][0] - turns[-2][0]) if revolution > 1 else np.inf
        elif revolution in MEANS_END:
            recent = turns[max(end for end in (DIRECT_REVOLUTIONS, *MEANS_END) if end < revolution) :]
            inflow_map, circulation = (np.mean([each[k] for each in recent], axis=0) for k in (0, 1))
            # a mean of n turns that vary independently is known to their scatter over the root of n
            wander = float(np.sqrt(np.mean([rms(model, each[0] - inflow_map) ** 2 for each in recent])))
            before, uncertainty = uncertainty, wander / np.sqrt(len(recent))
            moved, mean = (np.inf if mean is None else rms(model, inflow_map - mean)), inflow_map
            chance = PERIODIC + float(np.hypot(before, uncertainty))
        else:
            continue
        controls = model.pitch_controls(x[:4])
        problem, x = solve_on_map(model, inflow_map, x, n_harmonics, held)
        held = inflow_map
        change = float(np.max(np.abs(model.pitch_controls(x[:4]) - controls)))
        progress.advance(1, f"marching wake: controls {change:.1e} rad")
        periodic = direct and revolution > 3 and change < 0.1 * control_tolerance and varied < PERIODIC
        steady_mean = change < control_tolerance and moved < chance and uncertainty < INFLOW_KNOWN
        if periodic or (not direct and steady_mean):
            wake.counters["wake_segment_evaluations"] += march.segment_evaluations
            notes = () if periodic or wander < PERIODIC else (varying(wander, len(recent)),)
            return OnWake(problem, x, inflow_map, circulation, start.history, notes)
    limits = limiting(model, problem, x, held)
    raise NumericalFailure(
        f"trim on the time-marching wake did not settle in {MEANS_END[-1]} revolutions: pitch controls move by {change:.1e} rad "
        f"between trims on means of revolutions (allowed {control_tolerance:g}), the mean inflow by {moved:.1e} of the tip speed "
        f"(by chance {chance:.1e}); it is known to {uncertainty:.1e} (allowed {INFLOW_KNOWN:g}), turns vary by {wander:.1e}"
        f"{''.join(f'; {each}' for each in limits)}"
    )


def varying(wander: float, turns: int) -> str:
    """What is said of a marching wake that is not periodic."""
    return (
        f"the time-marching wake varies from turn to turn: inflow by {wander:.1e} of the tip speed (rms) about the mean of "
        f"{turns} revolutions that is trimmed on"
    )


def rms(model: Model, change: np.ndarray) -> float:
    """Root mean square over the disk of a map (n_azimuths, n_stations)."""
    return float(np.sqrt(np.mean((change**2) @ model.area_weights)))
