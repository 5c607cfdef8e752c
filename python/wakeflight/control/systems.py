# SPDX-License-Identifier: MIT OR Apache-2.0
"""Linear systems of python-control as controllers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..arguments import checked
from ..errors import InputError
from ..sticks import STICKS
from . import gains
from .controller import Controller
from .sensors import SIGNALS, Sensors
from .start import Start


class LinearController(Controller):
    """x_dot = A x + B u, y = C x + D u, or the discrete x+ = A x + B u: u signals less those of the beginning, y inches.

    A continuous one is advanced exactly for signals that go straight from one call to the next.
    """

    def __init__(
        self,
        matrices: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray],
        signals: tuple[str, ...],
        outputs: tuple[str, ...],
        discrete: bool,
        rate: str | None,
        authority: str | None,
    ):
        self.matrices, self.signals, self.outputs = matrices, signals, outputs
        self.discrete, self.rate, self.authority = discrete, rate, authority
        self.limit = gains.authority("authority", authority, (10.0,) * 4)
        self._forget()

    def _forget(self) -> None:
        n = len(self.matrices[0])
        self.t: float | None = None
        self.x, self.u, self.reference = np.zeros(n), np.zeros(len(self.signals)), np.zeros(len(self.signals))
        self.held: tuple[str, ...] = ()
        self.step_of: tuple[float, np.ndarray] | None = None

    def reset(self, start: Start) -> None:
        """At rest."""
        self.limit = gains.authority("authority", self.authority, start.aircraft.stick_travel_in)
        self._forget()

    def step(self, t: float, sensors: Sensors, stick: Mapping[str, float]) -> dict[str, float]:
        """Inches by stick."""
        seen = np.array([sensors[name] for name in self.signals])
        if self.t is None:
            self.t, self.reference = t, seen
        u, dt = seen - self.reference, t - self.t
        a, b, c, d = self.matrices
        if self.discrete:
            y = c @ self.x + d @ u
            self.x = a @ self.x + b @ u
        else:
            if dt > 0.0:
                self.x = self._over(dt) @ np.concatenate([self.x, self.u, u - self.u])
            y = c @ self.x + d @ u
        self.t, self.u = t, u
        limits = np.array([self.limit[STICKS.index(name)] for name in self.outputs])
        self.held = tuple(
            name for name, inches, most in zip(self.outputs, y, limits, strict=True) if abs(inches) > most
        )
        return dict(zip(self.outputs, np.clip(y, -limits, limits).tolist(), strict=True))

    def _over(self, dt: float) -> np.ndarray:
        """x after `dt` from x, u at its beginning and the change of u over it: exact for a straight u."""
        if self.step_of is None or self.step_of[0] != dt:
            from scipy.linalg import expm

            a, b, _, _ = self.matrices
            n, m = b.shape
            whole = np.zeros((n + 2 * m, n + 2 * m))
            whole[:n, :n], whole[:n, n : n + m] = a * dt, b * dt
            whole[n : n + m, n + m :] = np.eye(m)
            self.step_of = dt, expm(whole)[:n]
        return self.step_of[1]

    @property
    def saturated(self) -> tuple[str, ...]:
        """Sticks that the authority held back in the last call."""
        return self.held

    def state(self) -> dict[str, Any]:
        """States, signals of the last call and of the beginning."""
        return {name: getattr(self, name) for name in ("t", "x", "u", "reference", "held")}

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on from what `state` gave."""
        for name in ("t", "x", "u", "reference", "held"):
            setattr(self, name, state[name])

    def described(self) -> dict[str, Any]:
        """What it was made with."""
        matrices = dict(zip("ABCD", (each.tolist() for each in self.matrices), strict=True))
        own = {"signals": list(self.signals), "outputs": list(self.outputs), "discrete": self.discrete, **matrices}
        return super().described() | own | ({} if self.authority is None else {"authority": self.authority})


@checked
def from_control(
    system: Any,
    signals: Sequence[str] | None = None,
    outputs: Sequence[str] | None = None,
    rate: str | None = None,
    authority: str | None = None,
) -> LinearController:
    """A controller from a system of python-control: state space or transfer function, continuous or discrete.

    signals: what its inputs are, by the names of `wf.Sensors`, SI and radians, less their values where the flight begins; by
    default the names of its inputs. outputs: which sticks its outputs move [in], by default their names. No sign is turned: a
    damper has a negative gain. rate: of a discrete one whose time step is not stated, or how often a continuous one looks.
    authority: most inches on each stick.
    """
    try:
        import control
    except ImportError as reason:
        needed = "needs the package python-control: pip install control"
        raise InputError.of("from_control", type(system).__name__, needed) from reason
    try:
        space = control.ss(system)
    except Exception as reason:  # python-control raises kinds of its own
        allowed = f"must be a state space or a transfer function of python-control: {reason}"
        raise InputError.of("system", type(system).__name__, allowed) from reason
    matrices = tuple(np.array(each, dtype=float) for each in (space.A, space.B, space.C, space.D))
    if not all(np.isfinite(each).all() for each in matrices):
        raise InputError.of("system", "its matrices", "must be finite")
    n_outputs, n_inputs = matrices[3].shape
    seen = _named("signals", signals, space.input_labels, SIGNALS, n_inputs)
    moved = _named("outputs", outputs, space.output_labels, STICKS, n_outputs)
    discrete = bool(space.isdtime(strict=True))
    if discrete and space.dt is not True:
        stated = f"{1.0 / space.dt!r} Hz"
        if rate is not None:
            raise InputError.of("rate", rate, f"is that of the system, {stated}")
        rate = stated
    elif discrete and rate is None:
        raise InputError.of("rate", rate, "must be given: the system is discrete and does not state its time step")
    return LinearController(matrices, seen, moved, discrete, rate, authority)  # type: ignore[arg-type]


def _named(
    field: str, given: Sequence[str] | None, labels: Sequence[str], allowed: Sequence[str], n: int
) -> tuple[str, ...]:
    """Names of the inputs or outputs of a system."""
    names = (given,) if isinstance(given, str) else tuple(labels if given is None else given)
    for name in names:
        if name not in allowed:
            raise InputError.of(field, name, f"allowed: {', '.join(allowed)}; name them in the system or by {field}=")
    if len(names) != n or len(set(names)) != n:
        raise InputError.of(field, ", ".join(names), f"must be {n} different names")
    return names
