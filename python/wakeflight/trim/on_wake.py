# SPDX-License-Identifier: MIT OR Apache-2.0
"""A rotor and its free wake brought into agreement, on whatever carries it: a trim for given inflow inside a loop that moves the
inflow, until both rest.

The loops are these; what differs between an aircraft and a stand is told by the carrier: what must rest and how closely, how the
inflow of the wake is taken over, when a run is given up, and what is said of one that does not rest.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import ClassVar, Generic, Protocol, TypeVar

import numpy as np

from .. import _core
from ..errors import NumericalFailure
from ..model import CompiledRotor
from ..progress import Progress, Silent
from .equations import trim_problem
from .newton import Work, newton
from .wake import WakeInTrim

BUDGET = 200
"""Linearisations of one trim at most, 10 ms each of an aircraft."""
FOLLOWED = 14
"""Newton steps of a point on a path at most: a path in reach needs four to six."""
LEAST_ADVANCE = 1.0 / 64.0
"""Shortest piece of a path that is tried."""


@dataclass(frozen=True)
class Solution:
    """A trim: equations, unknowns, inflow (positive down) and circulation [m2/s] by azimuth and station, the wake behind them,
    what happened on the way, what is to be said of it."""

    model: CompiledRotor
    problem: _core.TrimProblem
    x: np.ndarray
    inflow_map: np.ndarray
    circulation: np.ndarray
    wake: WakeInTrim | None = None
    history: list[dict[str, float]] = field(default_factory=list)
    notes: tuple[str, ...] = ()
    settled: bool = True


class PeriodicWake(Protocol):
    """What answers a periodic motion with an inflow: a relaxation wake, or rings of the disk."""

    @property
    def in_trim(self) -> WakeInTrim | None:
        """The free wake of the trim, None of rings."""

    @property
    def inflow_map(self) -> np.ndarray:
        """Inflow (n_azimuths, n_stations)."""

    @property
    def circulation(self) -> np.ndarray:
        """Bound circulation (n_azimuths, n_stations) [m2/s]."""

    @property
    def converged(self) -> bool:
        """Whether it rests."""

    @property
    def last(self) -> dict[str, float]:
        """Changes of the last iteration."""

    def converge(self, problem: _core.TrimProblem, x: np.ndarray) -> np.ndarray:
        """Follow the motion of `x`."""


Rotor = TypeVar("Rotor", bound=CompiledRotor)
Wake = TypeVar("Wake", bound=PeriodicWake)
Found = TypeVar("Found", bound=Solution, covariant=True)


class Turns(Protocol[Found]):
    """A wake that marches, and what is made of its revolutions."""

    @property
    def longest(self) -> int:
        """Revolutions at most."""

    @property
    def told(self) -> str:
        """Opens the line of progress."""

    def turn(self, revolution: int, problem: _core.TrimProblem, x: np.ndarray) -> np.ndarray | None:
        """March one revolution at the motion of `x`: the inflow to be trimmed on, None to go on without."""

    @property
    def wash(self) -> np.ndarray | None:
        """Air at the parts of the airframe that goes with that inflow (4, 3) [m/s]; None where they do not feel the wake."""

    def diverged(self, revolution: int, reason: ArithmeticError) -> NumericalFailure:
        """What is said of a wake that leaves the numbers."""

    def trimmed(self, problem: _core.TrimProblem, x: np.ndarray, change: float) -> bool:
        """The trim on that inflow, with the change [rad] it brought: whether both rest."""

    def found(self, rests: bool) -> Found:
        """What was found, or why there is nothing."""


class TrimOnWake(ABC, Generic[Rotor, Wake]):
    """Trims of one compiled rotor on the inflow that its wake gives."""

    passes: int
    """Passes of trim and wake at most."""
    where: ClassVar[str]
    """Opens what is said of a wake that fails."""
    moving: ClassVar[str]
    """What must rest, in a word."""

    def __init__(self, model: Rotor, progress: Progress | Silent, tolerance: float):
        self.model, self.progress = model, progress
        self.tolerance = tolerance
        """Change [rad] between trims at which the rotor rests."""
        self.wash: np.ndarray | None = None
        """Air of the wake at the parts of the airframe (4, 3) [m/s], body axes; None where they do not feel it, or not yet."""

    @abstractmethod
    def none_found(self, problem: _core.TrimProblem, x: np.ndarray, inflow_map: np.ndarray | None) -> str:
        """What is said where there is no trim on an inflow; x: where the search ended."""

    @abstractmethod
    def moved(self, problem: _core.TrimProblem, before: np.ndarray, after: np.ndarray) -> np.ndarray:
        """Changes of what must rest [rad]."""

    def rests(self, wake: Wake, change: float) -> bool:
        """Whether trim and wake agree."""
        return change < self.tolerance and wake.converged

    def taken(self, held: np.ndarray, wake: Wake, moved: np.ndarray) -> np.ndarray:
        """The inflow to be trimmed on next."""
        return wake.inflow_map

    @abstractmethod
    def hopeless(self, wake: Wake, history: list[dict[str, float]]) -> bool:
        """Whether the last pass of `history` is the last worth its cost."""

    @abstractmethod
    def ended(self, found: Solution) -> Solution:
        """What is made of an end without rest."""

    def solve(
        self, inflow_map: np.ndarray | None, x: np.ndarray, before: np.ndarray | None = None
    ) -> tuple[_core.TrimProblem, np.ndarray]:
        """Trim on a held inflow map (n_azimuths, n_stations), None for dynamic inflow, from the unknowns `x`.

        before: the map that `x` is a trim on; where Newton's method finds none at once, the map is changed piece by piece.
        """
        model, work = self.model, Work(BUDGET)
        problem = trim_problem(model, inflow_map, self.wash)
        attempt = newton(model, problem, x, work)
        share, advance = 0.0, 0.5
        if before is not None and inflow_map is not None and before.shape != inflow_map.shape:
            # the first map has no inflow of its own behind the bound line
            before = np.tile(before, inflow_map.shape[1] // before.shape[1])
        while not attempt.met and before is not None and work.left > 0 and advance >= LEAST_ADVANCE:
            part = min(1.0, share + advance)
            partly = trim_problem(model, before + part * (inflow_map - before), self.wash)
            piece = newton(model, partly, x, work, FOLLOWED)
            if piece.met:
                share, x, advance = part, piece.x, 1.5 * advance
                attempt = piece if share == 1.0 else attempt
            else:
                advance *= 0.5
        if attempt.met:
            return problem, attempt.x
        raise NumericalFailure(self.none_found(problem, attempt.x, inflow_map))

    def on_periodic(self, wake: Wake, x: np.ndarray, inflow_map: np.ndarray) -> Solution:
        """Trim on the inflow, wake at the trimmed motion, in turn until both rest; from `x` and the inflow it belongs to."""
        history: list[dict[str, float]] = []
        before: np.ndarray | None = None
        for outer in range(self.passes):
            last = x
            problem, x = self.solve(inflow_map, last, before)
            moved = self.moved(problem, last, x)
            change = float(np.max(np.abs(moved)))
            # the first trim is on the inflow it was started with: its rest says nothing
            if outer > 0 and self.rests(wake, change):
                history[-1]["control_change"] = change
                return Solution(self.model, problem, x, inflow_map, wake.circulation, wake.in_trim, history)
            try:
                self.follow(wake, problem, x, change)
            except ArithmeticError as reason:
                raise NumericalFailure(f"{self.where}relaxation wake, pass {outer + 1}: {reason}") from reason
            before, inflow_map = inflow_map, self.taken(inflow_map, wake, moved)
            history.append({**wake.last, "control_change": change})
            self.progress.advance(1, f"inflow change {wake.last['inflow_change']:.1e}, {self.moving} {change:.1e} rad")
            if self.hopeless(wake, history):
                break
        maps = (inflow_map, wake.circulation)
        return self.ended(Solution(self.model, problem, x, *maps, wake.in_trim, history, settled=False))

    def follow(self, wake: Wake, problem: _core.TrimProblem, x: np.ndarray, change: float) -> None:
        """The wake goes to the trimmed motion, which is another by `change` [rad]."""
        wake.converge(problem, x)

    def on_turns(self, turns: Turns[Found], start: Solution) -> Found:
        """March a revolution at the trimmed motion, trim on its inflow, until both rest; from a trim on a periodic wake."""
        problem, x, held = start.problem, start.x, start.inflow_map
        for revolution in range(1, turns.longest + 1):
            try:
                inflow_map = turns.turn(revolution, problem, x)
            except ArithmeticError as reason:
                raise turns.diverged(revolution, reason) from reason
            if inflow_map is None:
                continue
            last, self.wash = x, turns.wash
            problem, x = self.solve(inflow_map, last, held)
            held = inflow_map
            change = float(np.max(np.abs(self.moved(problem, last, x))))
            self.progress.advance(1, f"{turns.told}{self.moving} {change:.1e} rad")
            if turns.trimmed(problem, x, change):
                return turns.found(rests=True)
        return turns.found(rests=False)
