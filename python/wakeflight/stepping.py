# SPDX-License-Identifier: MIT OR Apache-2.0
"""One coupling step of what carries a rotor: inflow given, states integrated, exchange with the air [ribera2004, Fig. 2]."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from . import _core
from .exchange import Exchange
from .integrators import Integrator
from .model import CompiledRotor
from .sticks import StickPath
from .wind import Air


@dataclass(frozen=True)
class Instant:
    """Where a coupling step begins: state, its consistent rate, and the inputs that begin there; sticks that reach the blades."""

    step: int
    t: float
    y: np.ndarray
    y_dot: np.ndarray
    inputs: _core.Inputs
    stick: np.ndarray
    mean_inflow: float
    stabilator: float
    air: Air | None
    """Wind over the step; None in still air."""


class Observer(Protocol):
    """What hangs on a simulation and cannot change it: a recorder, a monitor, a live view."""

    def __call__(self, instant: Instant, /) -> None:
        """A coupling step begins."""


class Stepping:
    """A rotor and what carries it, stepped through time: inflow over a coupling step, states integrated over it, exchange.

    Owns states, exchange with the air, memory of the integrator, controls, servo and clock. An aircraft flies so (`Simulation`),
    and so moves a rotor on a stand.
    """

    stabilator = "held"
    _engine: tuple[float, float] | None = None
    """Torque of the engines [N m] and share of the fuel over the step that begins, where the speed of the rotor is a state."""
    _air: Air | None = None
    """Wind over that step; none in still air."""

    def _begin(self, model: CompiledRotor, solver: Integrator, y: np.ndarray, stick: np.ndarray, step: int = 0) -> None:
        """At the states `y` after `step` steps; the exchange comes by itself."""
        self.model, self.solver = model, solver
        self.clock = model.clock.own()
        self.seconds = {"wake": 0.0, "dynamics": 0.0}
        self.exchange: Exchange
        self._y, self._step, self._stick, self._incidence = y, step, stick, 0.0

    @property
    def t(self) -> float:
        """Time since the start [s], that of the steps flown by the clock, never a sum."""
        return self.clock.time(self._step)

    @property
    def delta_t(self) -> float:
        """Length of the coupling step that begins [s]."""
        return self.clock.duration(self._step)

    @property
    def steps(self) -> int:
        """Coupling steps flown."""
        return self._step

    @property
    def y(self) -> np.ndarray:
        """A copy of the states; names and units are those of `model.core.state_names()`."""
        return np.array(self._y)

    @property
    def wake(self) -> np.ndarray | None:
        """Tip vortices (n_blades, n_ages, 3) [m], hub axes; None without a wake."""
        tips = self.exchange.tips(self._step)
        return None if tips is None else tips[0]

    def follow(self, sticks: StickPath, observer: Observer | None = None) -> None:
        """Fly one coupling step along `sticks`; `observer` sees where it begins."""
        t, end = self.t, self.clock.time(self._step + 1)
        pieces = self.clock.cut(self._pieces(sticks, t, end))
        path = self._commanded(sticks, pieces[0], self._y)
        begin = self.instant(path)
        if observer is not None:
            observer(begin)

        clock = time.perf_counter()
        if not self.solver.begun:
            self.solver.start(t, self._y, begin.y_dot)
        inputs = begin.inputs
        for t0, t1 in pieces:
            if t0 > t:
                path = self._commanded(sticks, (t0, t1), self.solver.state)
                inputs = self._inputs(t0, path.at(t0), path.rate(t0))[0]
            self.solver.advance_to(t1, inputs)
        self._y = self.solver.state
        self.seconds["dynamics"] += time.perf_counter() - clock

        self._step += 1
        self._stick = path.at(end)
        self._turned(end)
        clock = time.perf_counter()
        self.exchange.reach(self._step, self._y, self._stick, path.rate(end), flown=(end, t, inputs), air=self._air)
        self.seconds["wake"] += time.perf_counter() - clock

    def _pieces(self, sticks: StickPath, t0: float, t1: float) -> list[tuple[float, float]]:
        """The coupling step t0..t1 cut where what reaches the blades has a corner."""
        return sticks.pieces(t0, t1)

    def _commanded(self, sticks: StickPath, piece: tuple[float, float], y: np.ndarray) -> StickPath:
        """Sticks that reach the blades over a piece that begins at the states `y`: those of the hands if nothing is between."""
        return sticks

    def instant(self, sticks: StickPath, ends: bool = False) -> Instant:
        """Where the next coupling step along `sticks` begins; `ends`: no step follows, the servo rests."""
        t = self.t
        if self.solver.restarts(self._step):
            self.solver.restart()
        stick = sticks.at(t)
        if self.stabilator == "scheduled" and self._step > 0 and not ends:
            follow = self.model.core.followed_incidence
            moving = self._y if self._air is None else self._air.passing(self._y)
            self._incidence = follow(self._incidence, moving, float(stick[2]), self.clock.duration(self._step - 1))
        inputs, mean = self._inputs(t, stick, sticks.rate(t))
        clock = time.perf_counter()
        y_dot = self.solver.consistent(t, self._y, inputs)
        self.seconds["dynamics"] += time.perf_counter() - clock
        return Instant(self._step, t, self._y, y_dot, inputs, stick, mean, self._incidence, self._air)

    def _turned(self, t: float) -> None:
        """The step has ended at `t`: what a rotor has whose speed is a state."""

    def _inputs(self, t: float, stick: np.ndarray, rate: np.ndarray) -> tuple[_core.Inputs, float]:
        """Sticks from `t` on; inflow, memory of the sections, stabilator, engines and wind held."""
        held, mean, change = self.exchange.held(self._step)
        inputs = _core.Inputs(stick, rate, t, held, mean, self._incidence)
        if change is not None:
            inputs = inputs.carried(change, self.t, self.delta_t)
        if self._engine is not None or self._air is not None:
            inputs = inputs.under(self._engine, self._air)
        return self.exchange.remembering(self.exchange.washing(inputs), self.t), mean
