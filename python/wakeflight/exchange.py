# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a flight or a stand gets from its inflow model at every exchange, and what it gives: one door to the core's state."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

from . import _core
from .errors import known
from .model import CompiledRotor
from .wind import Air


class Trimmed(Protocol):
    """The wake of a trim."""

    core: _core.SteadyWake


class Exchange:
    """An inflow model in flight. Maps by azimuth, far inflow, convection of the sheet, the wake itself are the core's.

    A time-marching wake is exchanged every coupling step [ribera2004, bhagwat2001], in one call of the core: circulation from
    states and held far inflow, wake one step, far inflow anew, circulation again; `recorrect`, `extrapolate` and
    `update_interval` of the model go beyond it. What only such a wake has stands below the line.
    """

    def __init__(self, model: CompiledRotor, core: _core.Exchange):
        self.model, self.core = model, core
        self.n = model.steps_per_revolution
        self._frozen: tuple[Any, tuple[np.ndarray, np.ndarray], np.ndarray] | None = None

    @classmethod
    def dynamic(cls, model: CompiledRotor, sections: _core.SectionMemory | None = None) -> Exchange:
        """Dynamic inflow, which is in the state; `sections`: what those of a trim remember at its start."""
        return cls(model, _core.Exchange.dynamic(model.core, model.steps_per_revolution, sections))

    @classmethod
    def relaxation(cls, model: CompiledRotor, trimmed: Trimmed, motion: tuple[np.ndarray, np.ndarray]) -> Exchange:
        """The relaxation wake of a trim in flight; periodic motion (n, n_modes) of its blades."""
        return cls(model, _core.Exchange.relaxation(model.core, trimmed.core, motion, model.wake_options))

    @classmethod
    def marching(cls, model: CompiledRotor, trimmed: Trimmed) -> Exchange:
        """A marching wake with the options of `model` from the periodic one of a trim."""
        return cls(model, _core.Exchange.marching(model.core, trimmed.core, model.wake_options))

    @classmethod
    def unpacked(cls, model: CompiledRotor, packed: bytes) -> Exchange:
        """The exchange of `model` as it was when the core packed it."""
        return cls(model, _core.Exchange.from_bytes(packed))

    def rows(self, step: int) -> list[int]:
        """Azimuth index of every blade after `step` steps."""
        return [(step + b * self.n // self.model.n_blades) % self.n for b in range(self.model.n_blades)]

    def held(self, step: int) -> tuple[np.ndarray | None, float, np.ndarray | None]:
        """Inflow (n_blades, n_stations) where a step begins, None where it is in the state; disk mean; change over the step.

        A marching wake's mean is that of the latest passage of every azimuth: over the blades' present azimuths alone it would
        swing by n per revolution. The change is that of a map by azimuth, or the one that the blade before had there; None where
        the inflow stays as it is.
        """
        return self.core.held(step)

    def reach(
        self,
        step: int,
        y: np.ndarray,
        stick: np.ndarray,
        stick_rate: np.ndarray,
        motion: tuple[np.ndarray, np.ndarray] | None = None,
        flown: tuple[float, float, _core.Inputs] | None = None,
        air: Air | None = None,
    ) -> None:
        """States have reached `step`: a marching wake follows, a relaxation wake is renewed where that is due.

        stick, stick_rate: controls as the trim has them; a rotor on a stand has no use for the fourth. motion: modal coordinates
        and rates (n_blades, n_modes) that stand for those of `y`. flown: end and begin of the step [s] and what acted at its
        end; None: a step of azimuth at the nominal speed. air: wind where a step was flown; that at the hub carries the wake.
        """
        n = self.model.n_controls
        step_flown = None if flown is None else (*flown, air)
        self.core.advance(self.model.core, step, y, (stick[:n], stick_rate[:n]), motion, step_flown)

    @property
    def wash(self) -> np.ndarray | None:
        """Air at fuselage, stabilator, fin and tail rotor over the step that begins (4, 3) [m/s], body axes.

        Mean over the last passage of a blade; None where these parts feel tables on the mean inflow.
        """
        return self.core.wash(self.model.core)

    @property
    def wash_of_turn(self) -> np.ndarray | None:
        """The same of a marching wake, mean over the last revolution."""
        return self.core.wash(self.model.core, turn=True)

    def washing(self, inputs: _core.Inputs) -> _core.Inputs:
        """`inputs` with that air."""
        wash = self.wash
        return inputs if wash is None else inputs.washed(wash)

    def remembering(self, inputs: _core.Inputs, begun: float) -> _core.Inputs:
        """`inputs` of the step that begins at `begun` [s], with what the sections remember there."""
        sections = self.core.sections
        return inputs if sections is None else inputs.remembering(sections, begun)

    def tips(self, step: int) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Tip vortices after `step` steps, None without a wake.

        Nodes (n_blades, n_ages, 3) [m], hub axes, their circulation (n_blades, n_ages) [m2/s], core radii of the segments
        (n_blades, n_ages - 1) [m].
        """
        lattice = self.core.lattice(step)
        if lattice is None:
            return None
        position, circulation, core_radius = (np.ascontiguousarray(each[:, -1]) for each in lattice)
        return self._in_hub_axes(position), circulation, core_radius

    def lattice(self, step: int) -> tuple[np.ndarray, np.ndarray] | None:
        """Every trailer, root to tip: positions (n_blades, n_trailers, n_ages, 3) [m], hub axes, and circulation [m2/s]."""
        lattice = self.core.lattice(step)
        return None if lattice is None else (self._in_hub_axes(lattice[0]), lattice[1])

    def _in_hub_axes(self, position: np.ndarray) -> np.ndarray:
        """Of the mirror image of a clockwise rotor (..., 3)."""
        return position if self.model.hand > 0.0 else position * np.array([1.0, self.model.hand, 1.0])

    @property
    def monitors(self) -> dict[str, float]:
        """What the last exchange saw: largest motion of a marker, odd-even content (over R), closest vortex (cores)."""
        return self.core.monitors

    @property
    def counters(self) -> dict[str, int]:
        """Counted work by name; empty without a wake."""
        return self.core.counters

    @property
    def segment_evaluations(self) -> int:
        """Counted evaluations of the segment law."""
        return self.core.counters.get("segment_evaluations", 0)

    # --- of a marching wake ---------------------------------------------------------------------------------

    def copy(self) -> Exchange:
        """The same wake at the same moment, to be marched on its own."""
        return Exchange(self.model, self.core.copy())

    @property
    def step_index(self) -> int:
        """Steps of the wake since the start."""
        return self.core.steps

    @property
    def inflow(self) -> np.ndarray:
        """Total inflow that the wake gives (n_blades, n_stations), of thin sections at both lines of the chord."""
        return self.core.inflow

    @property
    def circulation(self) -> np.ndarray:
        """Bound circulation (n_blades, n_stations) [m2/s]."""
        return self.core.circulation

    @property
    def lambda_far(self) -> np.ndarray:
        """Inflow without that of the own near wake (n_blades, n_stations)."""
        return self.core.lambda_far

    def turn(self, problem: Any, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """A revolution with states and controls of the trim, circulation following the inflow.

        Inflow and circulation by azimuth (n, n_stations): means of all blades' passages.
        """
        motion, y = self._trimmed(problem, x)
        return self.core.turn(self.model.core, y, x[: self.model.n_controls], motion)

    def frozen_step(self, problem: Any, x: np.ndarray) -> tuple[list[int], np.ndarray, np.ndarray]:
        """One such step: azimuth index of every blade, its inflow and circulation."""
        (q, q_dot), y = self._trimmed(problem, x)
        step = self.step_index + 1
        rows = self.rows(step)
        self.reach(step, y, x, np.zeros_like(x), (q[rows], q_dot[rows]))
        return rows, self.inflow, self.circulation

    def _trimmed(self, problem: Any, x: np.ndarray) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray]:
        """Periodic motion (n, n_modes) and state of a trim."""
        if self._frozen is None or self._frozen[0] is not problem:
            core = self.model.core
            self._frozen = (problem, core.trim_motion(problem, x, self.n), core.trim_state(problem, x, 0.0)[0])
        return self._frozen[1:]

    def position(self) -> np.ndarray:
        """Tip vortices (n_blades, n_ages, 3) [m], hub axes."""
        return known(self.tips(self.step_index))[0]

    def marker_circulation(self) -> np.ndarray:
        """Circulation of the nodes of the tip vortices (n_blades, n_ages) [m2/s]."""
        return known(self.tips(self.step_index))[1]

    def wake(self) -> _core.TimeMarchingWake:
        """A copy of the wake as it is now."""
        return self.core.wake()


def exchange_of(
    model: CompiledRotor, trimmed: Trimmed | None, motion: Callable[[], Any], sections: _core.SectionMemory | None
) -> Exchange:
    """The exchange of `model` from the wake of a trim; `motion` gives the periodic motion of its blades, `sections` is what those
    remember at its start."""
    kinds: dict[str, Callable[[], Exchange]] = {
        "dynamic": lambda: Exchange.dynamic(model, sections),
        "relaxation": lambda: Exchange.relaxation(model, known(trimmed), motion()),
        "time-marching": lambda: Exchange.marching(model, known(trimmed)),
    }
    return kinds[model.inflow.name]()
