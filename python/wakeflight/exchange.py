# SPDX-License-Identifier: MIT OR Apache-2.0
"""What the flight gets from an inflow model at every exchange, and what it gives: the three models behind one door."""

from __future__ import annotations

from copy import copy
from typing import TYPE_CHECKING

import numpy as np

from . import _core
from .model import CompiledRotor

if TYPE_CHECKING:
    from .wake_trim import WakeInTrim


class MarchingExchange:
    """Time-marching free wake, exchanged every coupling step [ribera2004, bhagwat2001].

    The exchange itself is one call of the core: circulation from states and held far inflow, wake one step, far inflow
    anew, circulation again; `recorrect` and `extrapolate` of the model go beyond it.
    """

    def __init__(self, model: CompiledRotor, trimmed: WakeInTrim):
        self.model = model
        self.n = model.steps_per_revolution
        self.step_index = 0
        rows = self.rows(0)
        self.lambda_far = trimmed.lambda_far[rows]
        self.circulation = trimmed.circulation[rows]
        self.inflow = trimmed.inflow_map[rows]
        self.core = _core.MarchingExchange(
            trimmed.relaxation,
            model.wake_options,
            self.lambda_far,
            self.circulation,
            self.inflow,
        )
        # inflow at the latest passage of every azimuth, and the map held where it is renewed less often than every step
        self.passages = trimmed.inflow_map.copy()
        self.passed_circulation = trimmed.circulation.copy()
        interval = model.inflow.update_interval
        self.update_steps = None if interval is None else round(interval / (2 * np.pi) * self.n)
        self._held_map: np.ndarray | None = None
        self.monitors = {"max_displacement": 0.0, "odd_even": 0.0, "vortex_blade_distance": np.nan}
        self.circulation_followed = 0
        self._frozen: tuple | None = None

    def copy(self) -> MarchingExchange:
        """The same wake at the same moment, to be marched on its own."""
        other = copy(self)
        other.core = self.core.copy()
        other.passages = self.passages.copy()
        other.passed_circulation = self.passed_circulation.copy()
        return other

    def rows(self, step: int) -> list[int]:
        """Azimuth index of every blade after `step` steps."""
        return [(step + b * self.n // self.model.n_blades) % self.n for b in range(self.model.n_blades)]

    def held(self, step: int) -> tuple[np.ndarray, float]:
        """Total inflow (n_blades, n_stations) over the step that begins, and the mean over the disk.

        The mean is that of the latest passage of every azimuth: over the blades' present azimuths alone it would swing by
        n per revolution. With `update_interval` a map by azimuth is held from one renewal to the next, as with a relaxation wake.
        """
        if self.update_steps is None:
            return self.inflow, self.model.disk_mean(self.passages)
        if self._held_map is None or step % self.update_steps == 0:
            self._held_map = self.passages.copy()
        rows = 0.5 * (self._held_map[self.rows(step)] + self._held_map[self.rows(step + 1)])
        return rows, self.model.disk_mean(self._held_map)

    def advance(
        self,
        y: np.ndarray,
        stick: np.ndarray,
        stick_rate: np.ndarray,
        motion: tuple[np.ndarray, np.ndarray] | None = None,
    ) -> np.ndarray:
        """States have reached the next step; the wake follows. Returns the total inflow (n_blades, n_stations).

        motion: modal coordinates and rates (n_blades, n_modes) that stand for those of `y`.
        """
        self.step_index += 1
        rows = self.rows(self.step_index)
        if self.model.inflow.inboard_wake == "sheet":
            hub_velocity, _ = self.model.core.hub(y)
            self.core.set_mean_inflow(self.model.carrying_inflow(self.passed_circulation, hub_velocity))
        displacement, odd_even, distance, followed = self.core.advance(
            self.model.core, y, stick, stick_rate, rows[0], motion
        )
        self.monitors = {
            "max_displacement": displacement,
            "odd_even": odd_even,
            "vortex_blade_distance": distance,
        }
        self.circulation_followed += followed
        self.lambda_far, self.circulation, self.inflow = (
            self.core.lambda_far(),
            self.core.circulation(),
            self.core.inflow(),
        )
        self.passages[rows] = self.inflow
        self.passed_circulation[rows] = self.circulation
        return self.inflow

    def frozen_step(self, problem: _core.TrimProblem, x: np.ndarray) -> tuple[list[int], np.ndarray, np.ndarray]:
        """One step with states and controls of the trim, circulation following the inflow."""
        core = self.model.core
        if self._frozen is None or self._frozen[0] is not problem:
            q, q_dot = core.trim_motion(problem, x, self.n)
            self._frozen = (problem, q, q_dot, core.trim_state(problem, x, 0.0)[0])
        _, q, q_dot, y = self._frozen
        rows = self.rows(self.step_index + 1)
        controls = x[: self.model.n_controls]
        self.advance(y, controls, np.zeros(len(controls)), (q[rows], q_dot[rows]))
        return rows, self.inflow, self.circulation

    def periodic_map(self, records: list[tuple[list[int], np.ndarray, np.ndarray]]) -> tuple[np.ndarray, np.ndarray]:
        """Inflow and circulation by azimuth (n, n_stations): mean of all blades' passages of a revolution."""
        shape = (self.n, self.inflow.shape[1])
        inflow, circulation = np.zeros(shape), np.zeros(shape)
        for rows, lam, gamma in records:
            inflow[rows] += lam
            circulation[rows] += gamma
        return inflow / self.model.n_blades, circulation / self.model.n_blades

    def position(self) -> np.ndarray:
        """Tip vortices (n_blades, n_ages, 3) [m], hub axes."""
        return self.core.position()

    def marker_circulation(self, step: int) -> np.ndarray:
        """Circulation of the nodes of the tip vortices (n_blades, n_ages) [m2/s]."""
        return self.core.marker_circulation()

    def core_radius(self, step: int) -> np.ndarray:
        """Core radii of the segments of the tip vortices (n_blades, n_ages - 1) [m]."""
        return self.core.core_radius()

    def lattice(self, step: int) -> tuple[np.ndarray, np.ndarray]:
        """Every trailer, root to tip: positions (n_blades, n_trailers, n_ages, 3) [m], hub axes, and circulation [m2/s]."""
        position = self.core.lattice()
        return position, self.core.lattice_circulation().reshape(position.shape[:3])

    @property
    def segment_evaluations(self) -> int:
        """Counted evaluations of the segment law."""
        return int(self.core.segment_evaluations)


class RelaxationExchange:
    """Relaxation free wake in the response: inflow of the state taken as steady, renewed at every `update_interval`."""

    def __init__(self, model: CompiledRotor, trimmed: WakeInTrim):
        self.model = model
        self.n = model.steps_per_revolution
        self.trimmed = trimmed
        self.inflow_map = trimmed.inflow_map
        self.circulation_map = trimmed.circulation
        self.update_steps = round(model.inflow.update_interval / (2 * np.pi) * self.n)
        self.unconverged = 0
        self.updates = 0
        self._motion = [None] * self.n

    def rows(self, step: int) -> list[int]:
        """Azimuth index of every blade after `step` steps."""
        return [(step + b * self.n // self.model.n_blades) % self.n for b in range(self.model.n_blades)]

    def remember(self, step: int, q: np.ndarray, q_dot: np.ndarray) -> None:
        """Keep the motion of the blades (n_blades, n_modes) at their azimuths: the latest passage of each azimuth counts."""
        for b, row in enumerate(self.rows(step)):
            self._motion[row] = (q[b].copy(), q_dot[b].copy())

    def renew(self, y: np.ndarray, stick: np.ndarray) -> None:
        """Converge wake and circulation for the present hub motion, sticks and the blades' last passages."""
        q = np.array([motion[0] for motion in self._motion])
        q_dot = np.array([motion[1] for motion in self._motion])
        options = self.model.inflow
        converged = self.trimmed.converge_motion(y, stick, q, q_dot, options.max_loops_response)
        self.updates += 1
        self.unconverged += not converged
        self.inflow_map, self.circulation_map = self.trimmed.inflow_map, self.trimmed.circulation

    def inflow(self, step: int) -> np.ndarray:
        """Inflow (n_blades, n_stations) over the step that begins: mean of the map at its two ends, so that it does not lag."""
        return 0.5 * (self.inflow_map[self.rows(step)] + self.inflow_map[self.rows(step + 1)])

    def position(self, step: int) -> np.ndarray:
        """Tip vortices (n_blades, n_ages, 3) [m], hub axes, with the blades at their azimuths of `step`."""
        return self.trimmed.relaxation.position()[self.rows(step)]

    def marker_circulation(self, step: int) -> np.ndarray:
        """Circulation of the nodes of the tip vortices (n_blades, n_ages) [m2/s]: that of the azimuth of their release."""
        relaxation = self.trimmed.relaxation
        released = np.asarray(self.rows(step))[:, None] - np.arange(relaxation.position().shape[1])
        return np.asarray(relaxation.tip_circulation())[released % self.n]

    def core_radius(self, step: int) -> np.ndarray:
        """Core radii of the segments of the tip vortices (n_blades, n_ages - 1) [m]."""
        return self.trimmed.relaxation.core_radius()[self.rows(step)]

    def lattice(self, step: int) -> tuple[np.ndarray, np.ndarray]:
        """Every trailer as in `MarchingExchange.lattice`, with the blades at their azimuths of `step`."""
        wake, rows = self.trimmed.relaxation, np.asarray(self.rows(step))
        position = wake.lattice()[rows]
        born = (rows[:, None] - np.arange(position.shape[2])) % self.n
        return position, wake.released_circulation()[born].swapaxes(1, 2)

    @property
    def segment_evaluations(self) -> int:
        """Counted evaluations of the segment law."""
        return int(self.trimmed.relaxation.segment_evaluations)
