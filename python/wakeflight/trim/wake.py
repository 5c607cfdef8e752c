# SPDX-License-Identifier: MIT OR Apache-2.0
"""The free wake in trim: inflow and circulation brought into agreement at the trimmed motion.

The core solves circulation and near wake together at every azimuth and relaxes the inflow of everything else; here stands what
counts as rest of a trim, and what is said where there is none [ribera2004].
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .. import _core
from ..errors import InputError, known
from ..model import CompiledRotor

CONTROL_TOLERANCE = 1e-3
"""Change of a pitch control [rad] between trims on a free wake at which they rest."""
INFLOW_KNOWN = CONTROL_TOLERANCE / 1.5
"""Uncertainty of the inflow over the tip speed (rms) with which a wake that does not rest can be trimmed on its mean.

C_T = sigma a/2 [theta_75 (1/3 + mu^2/2) - lambda/2] at a thrust that is held: lambda moves the collective by 1.5 times itself in
hover, less in forward flight, so this is what the tolerance of the controls leaves of it."""


class WakeInTrim:
    """Relaxation wake of a trimmed or steady flight, with its periodic circulation: maps and wake are the core's."""

    def __init__(self, model: CompiledRotor, inflow_map: np.ndarray, steadied: bool = False):
        self.model = model
        try:
            self.core = _core.SteadyWake(model.core, model.wake_options, steadied, inflow_map)
        except ValueError as reason:
            raise InputError(f"wake: {reason}") from reason
        self.n = model.steps_per_revolution
        self.psi = 2 * np.pi * np.arange(self.n) / self.n
        self.counters = dict.fromkeys(("relaxation_iterations", "circulation_followed", "wake_segment_evaluations"), 0)

    @classmethod
    def unpacked(cls, model: CompiledRotor, core: _core.SteadyWake, counters: dict[str, int]) -> WakeInTrim:
        """The wake of `model` again, from the core's state."""
        wake = cls.__new__(cls)
        wake.model, wake.core, wake.counters = model, core, dict(counters)
        wake.n = model.steps_per_revolution
        wake.psi = 2 * np.pi * np.arange(wake.n) / wake.n
        return wake

    def __getstate__(self) -> dict[str, Any]:
        """The core's state by value."""
        return self.__dict__ | {"core": self.core.to_bytes()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """The core's state made again."""
        self.__dict__.update(state | {"core": _core.SteadyWake.from_bytes(state["core"])})

    @property
    def in_trim(self) -> WakeInTrim:
        """Itself: a free wake."""
        return self

    @property
    def circulation(self) -> np.ndarray:
        """Bound circulation (n, n_stations) [m2/s]."""
        return self.core.circulation

    @property
    def inflow_map(self) -> np.ndarray:
        """Total inflow (n, n_stations), of thin sections at both lines of the chord."""
        return self.core.inflow

    @property
    def wash(self) -> np.ndarray | None:
        """Air at the parts of the airframe (4, 3) [m/s], body axes, mean over a blade's passage; None where washes act."""
        return self.core.wash(self.model.core)

    @property
    def relaxation(self) -> _core.RelaxationWake:
        """A copy of the wake."""
        return known(self.core.relaxation)

    @property
    def converged(self) -> bool:
        """Whether the last pass ended at rest."""
        return self.core.converged

    @property
    def last(self) -> dict[str, float]:
        """Changes of the last iteration."""
        return self.core.last

    @property
    def wander(self) -> float:
        """Largest distance of the inflow from its mean in the last pass (rms), infinite where the wake does not circle."""
        return self.core.circling[1]

    def converge(self, problem: _core.TrimProblem, x: np.ndarray) -> np.ndarray:
        """Iterate wake and circulation at the trimmed motion; returns the total inflow map (n, n_stations)."""
        core = self.model.core
        motion = core.trim_motion(problem, x, self.n)
        y, _ = core.trim_state(problem, x, 0.0)
        try:
            self.core.converge(core, y, x[: self.model.n_controls], motion, self.model.inflow.relaxed.max_loops)
        except ValueError as reason:
            raise InputError(f"wake: {reason}") from reason
        self.counters = dict(zip(self.counters, self.core.counters, strict=True))
        return self.inflow_map

    @property
    def rests_in_the_mean(self) -> bool:
        """Whether the wake circles closely about an inflow that is known."""
        return self.mean_unrest() < 1.0

    def forget_means(self) -> None:
        """The motion has changed: means of passes before tell nothing of the inflow to come."""
        self.core.forget_means()

    def excess(self) -> dict[str, float]:
        """What the last iteration changed over what is allowed, below one where it has settled."""
        last, allowed = self.last, self.core.allowed
        return {name: last[name] / allowed[name] for name in allowed}

    def missing(self) -> float:
        """How far the wake is from rest, in multiples of what is allowed: by itself, or in the mean where it circles."""
        return min(max(self.excess().values()), self.mean_unrest())

    @property
    def widest(self) -> float:
        """Widest circle whose mean can be trimmed on, over the tip speed.

        Circulation follows the inflow in proportion, so that the mean of a circle of radius w is off its centre by the next
        order, w^2/lambda_0: no more than the inflow has to be known to.
        """
        mean = abs(self.model.disk_mean(self.inflow_map))
        return max(INFLOW_KNOWN, math.sqrt(INFLOW_KNOWN * mean))

    def mean_unrest(self) -> float:
        """How far the mean of a wake that circles is from being one to trim on, below one where it is."""
        error, wander = self.core.circling
        return max(error / INFLOW_KNOWN, wander / self.widest)

    def unrest(self) -> list[str]:
        """What has not settled, with figures."""
        excess, last, allowed = self.excess(), self.last, self.core.allowed
        said = {
            "inflow_change": "inflow changes by {:.1e} of the tip speed an iteration (allowed {:.1e})",
            "thrust_change": "circulation: thrust changes by {:.1e} of itself an iteration (allowed {:.1e})",
            "first_turn_change": "wake geometry: the first turn moves by {:.1e} R a sweep (allowed {:.1e})",
        }
        texts = [text.format(last[name], allowed[name]) for name, text in said.items() if excess[name] >= 1.0]
        error, wander = self.core.circling
        if np.isfinite(wander):
            texts.append(
                f"the wake circles: inflow within {wander:.1e} of its mean (allowed {self.widest:.1e}), which is known to "
                f"{error:.1e} (allowed {INFLOW_KNOWN:.1e})"
            )
        return texts
