# SPDX-License-Identifier: MIT OR Apache-2.0
"""An aircraft trimmed on a free wake: when its pitch controls and the wake rest, and what is said where they do not.

A wake that rolls up may have no rest of its own: it circles, or varies from turn to turn. Where it does so closely about an
inflow that is known, that mean is what the aircraft is trimmed on, and a note says so. What does not rest is named.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .. import _core
from ..errors import NumericalFailure, known
from ..exchange import Exchange
from ..model import Model
from ..progress import Progress, Silent
from .equations import unmet
from .limits import limiting
from .on_wake import Solution, TrimOnWake
from .wake import CONTROL_TOLERANCE, INFLOW_KNOWN, WakeInTrim

MAX_SWEEPS = 900
"""Sweeps of the relaxation wake at most."""
HOPELESS = 8
"""Passes without progress after which a trim is given up."""
DIRECT_REVOLUTIONS = 10
"""Revolutions of a marching wake that are each trimmed on; after them means are."""
MEANS_END = (16, 22, 28, 34, 49, 64, 90, 128)
"""Revolutions after which the mean of those since the controls last moved is trimmed on."""
PERIODIC = 3e-4
"""Change of the inflow of a marching wake from turn to turn, over the tip speed, at which it is periodic."""


class AircraftOnWake(TrimOnWake[Model, WakeInTrim]):
    """Trims of an aircraft on a free wake; its pitch controls must rest.

    start_only: the start of a marching wake, which comes to rest by itself; passes until no more is gained are enough.
    """

    passes = 30
    where = "trim on the "
    moving = "controls"

    def __init__(
        self,
        model: Model,
        progress: Progress | Silent,
        tolerance: float = CONTROL_TOLERANCE,
        start_only: bool = False,
    ):
        super().__init__(model, progress, tolerance)
        self.start_only = start_only
        self.mixing = 1.0
        self.moves: list[np.ndarray] = []
        self.best, self.since = np.inf, 0

    def none_found(self, problem: _core.TrimProblem, x: np.ndarray, inflow_map: np.ndarray | None) -> str:
        """The limits that are near."""
        limits = "; ".join(limiting(self.model, problem, x, inflow_map)) or "no stick, stall or inflow limit is near"
        return f"no trim found on the inflow of the wake: {limits} [{unmet(self.model, problem, x)}]"

    def moved(self, problem: _core.TrimProblem, before: np.ndarray, after: np.ndarray) -> np.ndarray:
        """Changes of the pitch controls [rad]."""
        found: np.ndarray = self.model.pitch_controls(after[:4]) - self.model.pitch_controls(before[:4])
        return found

    def rests(self, wake: WakeInTrim, change: float) -> bool:
        """Whether trim and wake agree, the wake by itself or in the mean."""
        return change < self.mixing * self.tolerance and (wake.converged or wake.rests_in_the_mean)

    def follow(self, wake: WakeInTrim, problem: _core.TrimProblem, x: np.ndarray, change: float) -> None:
        """The wake goes to the trimmed motion."""
        if change > 2.0 * self.tolerance:
            wake.forget_means()
        wake.converge(problem, x)

    def taken(self, held: np.ndarray, wake: WakeInTrim, moved: np.ndarray) -> np.ndarray:
        """The inflow of the wake; of controls that swing back and forth half of each change."""
        self.moves.append(moved)
        if len(self.moves) > 3:
            last = self.moves[-2]
            if moved @ last < -0.5 * (last @ last):
                self.mixing = max(0.5 * self.mixing, 0.25)
        given = wake.inflow_map
        found = held + self.mixing * (given - held) if held.shape == given.shape else given
        now, before = wake.wash, self.wash
        self.wash = now if now is None or before is None else before + self.mixing * (now - before)
        return found

    def hopeless(self, wake: WakeInTrim, history: list[dict[str, float]]) -> bool:
        """Whether several passes brought nothing, or the wake has had its sweeps."""
        change = history[-1]["control_change"]
        missing = max(change / self.tolerance, wake.missing()) if len(history) > 1 else np.inf
        better = missing < 0.9 * self.best
        self.best, self.since = (missing, 0) if better else (self.best, self.since + 1)
        return self.since >= HOPELESS or wake.counters["relaxation_iterations"] > MAX_SWEEPS

    def ended(self, found: Solution) -> Solution:
        """Enough for a start; else a failure that says what does not rest."""
        if self.start_only:
            return found
        wake, change, allowed = known(found.wake), found.history[-1]["control_change"], self.mixing * self.tolerance
        unrest = wake.unrest()
        if change >= allowed:
            unrest.append(f"pitch controls move by {change:.1e} rad between trims (allowed {allowed:g})")
        limits = limiting(self.model, found.problem, found.x, found.inflow_map)
        raise NumericalFailure(
            f"trim on the relaxation wake did not settle in {len(found.history)} passes, "
            f"{wake.counters['relaxation_iterations']} sweeps: {'; '.join([*unrest, *limits])}"
        )


def on_relaxation(trimming: AircraftOnWake, wake: WakeInTrim, x: np.ndarray, inflow_map: np.ndarray) -> Solution:
    """Trim and relaxation wake in turn until the pitch controls and the wake rest."""
    found = trimming.on_periodic(wake, x, inflow_map)
    if wake.converged or not found.settled:
        return found
    note = (
        f"the relaxation wake circles about its answer: inflow within {wake.wander:.1e} of the tip speed (rms) of the mean "
        f"that is trimmed on"
    )
    return replace(found, notes=(note,))


def on_marching(
    model: Model, start: Solution, progress: Progress | Silent, tolerance: float = CONTROL_TOLERANCE
) -> Solution:
    """Trim on the time-marching wake that starts from the relaxed one of `start`."""
    return AircraftOnWake(model, progress, tolerance).on_turns(Means(model, start, tolerance), start)


class Means:
    """The inflow of a marching wake that an aircraft is trimmed on: of each revolution, later means of several.

    A wake that is not periodic is trimmed on the mean of several revolutions, held over the next ones, until that mean rests.
    """

    longest = MEANS_END[-1]
    told = "marching wake: "

    def __init__(self, model: Model, start: Solution, tolerance: float):
        self.model, self.start, self.tolerance = model, start, tolerance
        self.wake = known(start.wake)
        self.march = Exchange.marching(model, self.wake)
        self.turns: list[tuple[np.ndarray, np.ndarray]] = []
        self.recent: list[tuple[np.ndarray, np.ndarray]] = []
        self.washes: list[np.ndarray | None] = []
        self.wash: np.ndarray | None = None
        self.inflow_map: np.ndarray | None = None
        self.mean: np.ndarray | None = None
        self.since, self.change = DIRECT_REVOLUTIONS, np.inf
        self.varied = self.moved = self.chance = self.wander = self.uncertainty = np.inf

    @property
    def direct(self) -> bool:
        """Whether the last revolution itself is trimmed on."""
        return len(self.turns) <= DIRECT_REVOLUTIONS

    def turn(self, revolution: int, problem: _core.TrimProblem, x: np.ndarray) -> np.ndarray | None:
        """March one revolution: its inflow, later at times the mean of those since the last mean, else None."""
        turns = self.turns
        inflow, circulation = self.march.turn(problem, x)
        turns.append((self.as_held(inflow), circulation))
        self.washes.append(self.march.wash_of_turn)
        if self.direct:
            self.inflow_map, self.circulation = turns[-1]
            self.wash = self.washes[-1]
            self.varied = self.rms(turns[-1][0] - turns[-2][0]) if revolution > 1 else np.inf
        elif revolution in MEANS_END:
            # turns at controls that have moved since tell of another motion
            if self.change >= self.tolerance:
                self.since = max(end for end in (DIRECT_REVOLUTIONS, *MEANS_END) if end < revolution)
            recent = turns[self.since :]
            self.inflow_map, self.circulation = (np.mean([each[k] for each in recent], axis=0) for k in (0, 1))
            washes = [each for each in self.washes[self.since :] if each is not None]
            self.wash = np.mean(washes, axis=0) if washes else None
            # a mean of n turns that vary independently is known to their scatter over the root of n
            self.wander = float(np.sqrt(np.mean([self.rms(each[0] - self.inflow_map) ** 2 for each in recent])))
            before, self.uncertainty = self.uncertainty, self.wander / np.sqrt(len(recent))
            self.moved = np.inf if self.mean is None else self.rms(self.inflow_map - self.mean)
            self.mean, self.recent = self.inflow_map, recent
            self.chance = PERIODIC + float(np.hypot(before, self.uncertainty))
        else:
            return None
        return self.inflow_map

    def as_held(self, inflow: np.ndarray) -> np.ndarray:
        """A map by azimuth as a flight has it there: in the mean of what is held over the steps before and after.

        A step that holds the inflow that is found where it begins feels it half a step of azimuth late. Inflow that goes on
        over the step (extrapolate), or a map that is held for several of them (update_interval), is not late.
        """
        own = self.model.inflow.marching
        if own.extrapolate or own.update_interval is not None:
            return inflow
        held: np.ndarray = 0.5 * (inflow + np.roll(inflow, 1, axis=0))
        return held

    def diverged(self, revolution: int, reason: ArithmeticError) -> NumericalFailure:
        """Where, and why."""
        return NumericalFailure(f"trim on the time-marching wake, revolution {revolution}: {reason}")

    def trimmed(self, problem: _core.TrimProblem, x: np.ndarray, change: float) -> bool:
        """Whether the wake is periodic, or its mean known and at rest, and the controls with it."""
        self.problem, self.x, self.change = problem, x, change
        if self.direct:
            return len(self.turns) > 3 and change < 0.1 * self.tolerance and self.varied < PERIODIC
        return change < self.tolerance and self.moved < self.chance and self.uncertainty < INFLOW_KNOWN

    def found(self, rests: bool) -> Solution:
        """The trim, with a note where it is one on a mean; a failure with figures where nothing rests."""
        start = self.start
        if rests:
            self.wake.counters["wake_segment_evaluations"] += self.march.segment_evaluations
            notes = () if self.direct or self.wander < PERIODIC else (varying(self.wander, len(self.recent)),)
            maps = (known(self.inflow_map), self.circulation)
            return Solution(self.model, self.problem, self.x, *maps, self.wake, start.history, notes)
        limits = limiting(self.model, self.problem, self.x, self.inflow_map)
        raise NumericalFailure(
            f"trim on the time-marching wake did not settle in {self.longest} revolutions: pitch controls move by "
            f"{self.change:.1e} rad between trims on means of revolutions (allowed {self.tolerance:g}), the mean inflow by "
            f"{self.moved:.1e} of the tip speed (by chance {self.chance:.1e}); it is known to {self.uncertainty:.1e} (allowed "
            f"{INFLOW_KNOWN:g}), turns vary by {self.wander:.1e}{''.join(f'; {each}' for each in limits)}"
        )

    def rms(self, change: np.ndarray) -> float:
        """Root mean square over the disk of a map (n_azimuths, n_stations)."""
        return self.model.disk_rms(change)


def varying(wander: float, turns: int) -> str:
    """What is said of a marching wake that is not periodic."""
    return (
        f"the time-marching wake varies from turn to turn: inflow by {wander:.1e} of the tip speed (rms) about the mean of "
        f"{turns} revolutions that is trimmed on"
    )
