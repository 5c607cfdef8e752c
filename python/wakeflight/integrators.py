# SPDX-License-Identifier: MIT OR Apache-2.0
"""Time integration of F(y_dot, y, u; t) = 0 behind a thin interface."""

from __future__ import annotations

import json
from typing import Any, Protocol

import numpy as np

from . import _core
from .errors import NumericalFailure
from .model import CompiledRotor, Model


class Integrator(Protocol):
    """What the flight asks of a solver."""

    def consistent(self, t: float, y: np.ndarray, inputs: _core.Inputs) -> np.ndarray:
        """y_dot that satisfies F = 0 at the present state (t, y) with the inputs that begin there."""

    @property
    def begun(self) -> bool:
        """Whether it has been started."""

    @property
    def schedule(self) -> str:
        """When it begins anew, in words: part of what a flight depends on."""

    def restarts(self, step: int) -> bool:
        """Whether it begins anew after `step` coupling steps, whatever is kept there; only there `memory` disturbs nothing."""

    def restart(self) -> None:
        """Forget the past where `restarts` says so; where the memory can be read there is nothing to forget."""

    def start(self, t: float, y: np.ndarray, y_dot: np.ndarray) -> None:
        """Begin at a consistent state."""

    def memory(self) -> bytes:
        """What the steps to come depend on besides the state, exact."""

    def recall(self, t: float, y: np.ndarray, memory: bytes) -> None:
        """Go on at (t, y) with the `memory` of a solver of the same aircraft and tolerances."""

    def advance_to(self, t: float, inputs: _core.Inputs) -> None:
        """Integrate to `t` [s] with `inputs` held, and stop there."""

    @property
    def method(self) -> str:
        """What it does, in words."""

    @property
    def state(self) -> np.ndarray:
        """y at the present time."""

    @property
    def rate(self) -> np.ndarray:
        """y_dot at the present time."""

    @property
    def statistics(self) -> dict[str, int]:
        """Counted residual evaluations, Jacobians, steps."""


def consistent_rate(model: Model, t: float, y: np.ndarray, inputs: _core.Inputs) -> np.ndarray:
    """y_dot that satisfies F = 0 at (t, y): F is linear in y_dot, so one solve with its matrix gives it."""
    return model.core.consistent_rate(t, y, inputs)


KEPT = {"dF/dy": 10.0, "dF/dy_dot": 1.5}
"""Azimuth [deg] over which IDA's derivatives of F serve; dF/dy_dot costs a seventh of dF/dy and counts most."""


class IdaIntegrator:
    """SUNDIALS IDA (variable step, variable order BDF) with exact derivatives [hindmarsh2005].

    IDA asks for dF/dy + c dF/dy_dot whenever its step or order changes, some five times a coupling step. F is linearised
    where a coupling step begins, and its inertia again every few degrees from there (`KEPT`). Derivatives are the means by
    which IDA solves its equations: where they do not suffice, it takes a shorter step.

    IDA's own memory (history, order, step, last derivatives) cannot be read. It is therefore begun anew at every revolution,
    whether a flight is kept there or not: one that is cut there and goes on follows the bits of the uncut one. `memory` and
    `recall` begin it anew too: asked for elsewhere, they change the flight within the tolerances.
    """

    RESTART_TURNS = 1
    """Revolutions after which it is begun anew; a restart costs some ten residuals and the small steps of order one."""

    method = "BDF of variable step and order (SUNDIALS IDA)"

    def __init__(self, model: Model, rtol: float = 1e-5, atol_scale: float = 1.0):
        self.model = model
        self.rtol = rtol
        self.atol = atol_scale * absolute_tolerances(model)
        self._inputs: _core.Inputs
        # a hair more, so that a step of as many degrees counts as that; those of a free rotor miss it by what it gathers speed
        hair = 1e-3 if model.has_free_speed else 1e-6
        self._kept = {name: np.radians(angle) * (1.0 + hair) for name, angle in KEPT.items()}
        self._statistics = {"residual_evaluations": 0, "jacobians": 0}
        self._forget()

    def _forget(self) -> None:
        """Nothing is known of the past."""
        self._solver: Any = None
        self._linearised = self.model.linearised()
        self._found_at = dict.fromkeys(KEPT, -np.inf)
        self._rate: np.ndarray | None = None

    @property
    def begun(self) -> bool:
        """Whether it has been started."""
        return self._solver is not None

    @property
    def schedule(self) -> str:
        """When it begins anew, in words."""
        return f"begun anew every {self.RESTART_TURNS * self.model.steps_per_revolution} coupling steps"

    def restarts(self, step: int) -> bool:
        """Whether it begins anew after `step` coupling steps."""
        return step % (self.RESTART_TURNS * self.model.steps_per_revolution) == 0

    def restart(self) -> None:
        """Begin anew; at once twice is once."""
        if self.begun:
            self._forget()

    def memory(self) -> bytes:
        """Counted work: the rest is found anew, here too."""
        self._forget()
        return json.dumps(self._statistics).encode()

    def recall(self, t: float, y: np.ndarray, memory: bytes) -> None:
        """Start anew, with the counts of `memory`."""
        self._forget()
        self._statistics = json.loads(memory)

    def consistent(self, t: float, y: np.ndarray, inputs: _core.Inputs) -> np.ndarray:
        """y_dot that satisfies F = 0 at (t, y); the derivatives found for it serve the step that follows."""
        guess = np.zeros(y.size) if self._rate is None else self._rate
        renew = self._found(t, y) == "dF/dy"
        self._found_at["dF/dy_dot"] = self._turned(t, y)
        self._rate = self._linearised.consistent(self.model.core, (t, y), guess, inputs, renew)
        return self._rate

    def _turned(self, t: float, y: np.ndarray) -> float:
        """Azimuth of the first blade [rad]: a state, or by the clock."""
        if self.model.has_free_speed:
            return float(y[self.model.layout["turn"][0]])
        return self.model.core.turned(t)

    def _found(self, t: float, y: np.ndarray) -> str | None:
        """Which derivatives are to be found at (t, y): dF/dy and with it all, dF/dy_dot alone, or none."""
        azimuth = self._turned(t, y)
        for name, kept in self._kept.items():
            if azimuth - self._found_at[name] > kept:
                self._found_at["dF/dy_dot"] = azimuth
                if name == "dF/dy":
                    self._found_at[name] = azimuth
                    self._statistics["jacobians"] += 1
                return name
        return None

    def start(self, t: float, y: np.ndarray, y_dot: np.ndarray) -> None:
        """Begin at a consistent state."""
        from sksundae.ida import IDA

        self._solver = IDA(
            self._residual,
            rtol=self.rtol,
            atol=self.atol,
            linsolver="dense",
            jacfn=self._jacobian,
            max_num_steps=5000,
        )
        self._solver.init_step(t, np.array(y), np.array(y_dot))
        self._t, self._y, self._y_dot = t, np.array(y), np.array(y_dot)

    def _residual(self, t: float, y: np.ndarray, y_dot: np.ndarray, f: np.ndarray) -> None:
        self._statistics["residual_evaluations"] += 1
        self.model.core.residual(t, y, y_dot, self._inputs, f)

    def _jacobian(self, t: float, y: np.ndarray, y_dot: np.ndarray, f: np.ndarray, c_j: float, out: np.ndarray) -> None:
        which = self._found(t, y)
        if which is not None:
            self._linearised.renew(self.model.core, (t, y), y_dot, self._inputs, which == "dF/dy")
        self._linearised.matrix(c_j, out)

    def advance_to(self, t: float, inputs: _core.Inputs) -> None:
        """Integrate to `t` [s] with `inputs` held; the solver stops there and does not look beyond."""
        self._inputs = inputs
        result = self._solver.step(t, tstop=t)
        y = np.asarray(result.y)
        if not result.success or not np.all(np.isfinite(y)):
            worst = self._largest_residual(self._t, self._y, self._y_dot)
            raise NumericalFailure(f"integration stopped at t = {float(result.t):.4f} s: {result.message}; {worst}")
        self._t, self._y, self._y_dot = t, y.copy(), np.array(result.yp)

    def _largest_residual(self, t: float, y: np.ndarray, y_dot: np.ndarray) -> str:
        f = np.empty(y.size)
        self.model.core.residual(t, y, y_dot, self._inputs, f)
        i = int(np.nanargmax(np.abs(f)))
        name, _ = self.model.core.state_names()[i]
        return f"largest residual {f[i]:.3g} in the equation of {name}"

    @property
    def state(self) -> np.ndarray:
        """y at the present time."""
        return self._y

    @property
    def rate(self) -> np.ndarray:
        """y_dot at the present time."""
        return self._y_dot

    @property
    def statistics(self) -> dict[str, int]:
        """Counted residual evaluations and Jacobians."""
        return dict(self._statistics)


class FixedIntegrator:
    """One step of order five to wherever it is asked to go; a corner of the stick history ends a step.

    Blades that bend: Radau IIA [hairer1996], L-stable, so that no mode of a blade limits the step. Exact derivatives, those of
    the inertia in every step, blades eliminated before the body; the stages are solved until what Newton's iteration still
    lacks is 0.3 of IDA's tolerances: 0.1 costs a fifth more iterations and moves nothing, 1 doubles the error of the body
    rates. A secant takes off what old derivatives miss [anderson1965].

    Rigid blades: nothing in the aircraft is fast beside a step, y_dot is had in closed form, and six explicit stages do
    [cash1990]. Where orders five and four differ by more than ten times IDA's tolerances the step is halved (counted), up to
    six times.
    """

    NEWTON_SHARE = 0.3
    KEPT = 40.0
    """Azimuth [deg] over which dF/dy is kept: with the secant, four times that costs 7 % more iterations."""

    def __init__(self, model: CompiledRotor, rtol: float = 1e-5, atol_scale: float = 1.0, parts: int = 1):
        self.model, self.rtol, self.parts = model, rtol, parts
        # a speed that is a state shares the inertia of blades and body
        self.explicit = not (model.flexible or model.has_free_speed)
        self.atol = atol_scale * absolute_tolerances(model)
        self._begun = False
        self._solver: _core.FixedStep
        self._y: np.ndarray

    @property
    def begun(self) -> bool:
        """Whether it has been started."""
        return self._begun

    @property
    def schedule(self) -> str:
        """Its memory is read: it never begins anew."""
        return "never begun anew"

    def restarts(self, step: int) -> bool:
        """Its memory is read at any step, and nothing changes."""
        return True

    def restart(self) -> None:
        """Nothing to forget."""

    def memory(self) -> bytes:
        """State, rates at the last stages, where dF/dy was found, counted work; nothing before the first step."""
        return self._solver.memory() if self._begun else b""

    def recall(self, t: float, y: np.ndarray, memory: bytes) -> None:
        """Go on at (t, y); without a memory as from a start there."""
        self._begin(t, y)
        if memory:
            self._solver.recall(self.model.core, memory)

    @property
    def method(self) -> str:
        """Which of the two."""
        return "explicit Runge-Kutta of order 5 (4)" if self.explicit else "Radau IIA of order 5"

    def start(self, t: float, y: np.ndarray, y_dot: np.ndarray) -> None:
        """Begin at a state; its rate is found by the solver."""
        if not self._begun:
            self._begin(t, y)

    def _begin(self, t: float, y: np.ndarray) -> None:
        core = self.model.core
        if self.explicit:
            self._solver = _core.FixedStep.explicit(core, t, y, self.rtol, self.atol)
        else:
            self._solver = _core.FixedStep(core, t, y, self.rtol, self.atol, self.NEWTON_SHARE, np.radians(self.KEPT))
        self._y, self._begun = y, True

    def consistent(self, t: float, y: np.ndarray, inputs: _core.Inputs) -> np.ndarray:
        """y_dot that satisfies F = 0 at the present state; the derivatives found for it serve the step that follows."""
        if not self._begun:
            self._begin(t, y)
        self._solver.prepare(self.model.core, inputs)
        return self._solver.rate()

    def advance_to(self, t: float, inputs: _core.Inputs) -> None:
        """Integrate to `t` [s] with `inputs` held."""
        self._solver.advance(self.model.core, t, inputs, self.parts)
        self._y = self._solver.state()

    @property
    def state(self) -> np.ndarray:
        """y at the present time."""
        return self._y

    @property
    def rate(self) -> np.ndarray:
        """y_dot at the present time."""
        return self._solver.rate()

    @property
    def statistics(self) -> dict[str, int]:
        """Counted work."""
        names = (
            "residual_evaluations",
            "jacobians",
            "factorisations",
            "newton_iterations",
            "solver_steps",
            "halved_steps",
        )
        counted = self._solver.counters() if self._begun else [0] * len(names)
        return dict(zip(names, counted, strict=True))


RTOL = 1e-5
"""Relative tolerance of the solver that the absolute ones belong to."""

INTEGRATORS = {"ida": IdaIntegrator, "fixed": FixedIntegrator}
"""Solvers by the name the command line uses."""


TOLERANCES = {"m/s": 1e-5, "rad/s": 1e-6, "m": 1e-4, "1": 1e-6, "rad": 1e-6, "W": 1.0}
"""What does not matter in flight of a state, by its unit: attitude (quaternion) and inflow are numbers."""
ANGLE = 1e-6
"""The same of a blade's modal coordinate, as an angle [rad]."""


def absolute_tolerances(model: CompiledRotor) -> np.ndarray:
    """Absolute tolerance per state: what does not matter in flight."""
    atol = np.array([TOLERANCES.get(unit, np.nan) for _, unit in model.core.state_names()])
    modal = ANGLE / np.asarray(model.rotor["angle_per_coordinate"])
    fastest = np.maximum(np.asarray(model.rotor["frequencies"]), model.omega)
    for (a, b), (c, d) in zip(model.layout["modal"], model.layout["modal_rate"], strict=True):
        atol[a:b] = modal
        atol[c:d] = modal * fastest
    return atol
