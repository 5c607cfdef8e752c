# SPDX-License-Identifier: MIT OR Apache-2.0
"""A free wake that follows at once: how its inflow answers slow motion of hub, controls and disk.

The relaxation wake of the trim is converged anew for the hub moving a little differently, for other blade pitch and for the
disk tilted or coned, to either side; half the difference is what the inflow at every azimuth and station answers. That is the
steady gain of the wake. What it needs time for is not in it, nor what it answers to blade modes other than the first flap mode.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import _core
from ..errors import NumericalFailure, known
from ..model import Model
from ..trim import Trim
from .names import MOTION, Places

SIZES = {**dict.fromkeys(("u", "v", "w"), 0.5), **dict.fromkeys(("p", "q", "r"), 0.03)}
"""Changes of the hub's motion to either side [m/s, rad/s]."""
PITCH = 0.005
"""Of a blade pitch control [rad]."""
TILT = 0.005
"""Of coning and tilt of the disk [rad]."""
PASSES, ITERATIONS = 3, 60
"""Passes to rest, each of at most so many iterations: later ones start where the wake has come to rest within its tolerance."""


@dataclass(frozen=True)
class WakeGains:
    """Inflow (n_azimuths, n_stations) over the tip speed by each of `names`, per SI unit or rad.

    curvature: largest part of the answers' first harmonics that does not change sign with the cause, over that which does.
    """

    names: tuple[str, ...]
    values: np.ndarray
    curvature: float

    def first_harmonics(self, model: Model) -> dict[str, tuple[float, float, float]]:
        """Mean, cosine and sine of the inflow by each cause."""
        return {name: model.first_harmonics(self.values[i]) for i, name in enumerate(self.names)}


CONTROLS = ("theta_1c", "theta_1s", "theta_0")
DISK = ("beta_0", "beta_1c", "beta_1s")


def wake_gains(start: Trim) -> WakeGains:
    """Answers of the relaxation wake of a trim; where it does not come to rest there are none."""
    model = start.model
    where = (*MOTION, *CONTROLS, *DISK)
    at_trim = _settled(start, known(start.wake).core, "the trim")
    base = np.array(at_trim.inflow)
    found, curved, scale = [], [], []
    for name in where:
        size = SIZES.get(name, PITCH if name in CONTROLS else TILT)
        up, down = (np.array(_settled(start, at_trim, name, side * size).inflow) for side in (1.0, -1.0))
        found.append((up - down) / (2 * size))
        curved.append(model.first_harmonics(up + down - 2 * base))
        scale.append(model.first_harmonics(up - down))
    curvature = np.abs(np.array(curved)).max(axis=1) / np.maximum(np.abs(np.array(scale)).max(axis=1), 1e-12)
    return WakeGains(where, np.array(found), float(curvature.max()))


def _settled(start: Trim, known: _core.SteadyWake, name: str, change: float = 0.0) -> _core.SteadyWake:
    """The wake `known` come to rest with one cause changed."""
    model = start.model
    n = start.inflow_map.shape[0]
    psi = 2 * np.pi * np.arange(n) / n
    y = np.array(start.state(0.0))
    stick = start.stick_si
    q, q_dot = (np.array(each) for each in model.core.trim_motion(start.problem, start.x, n))
    if name in MOTION:
        y[MOTION.index(name)] += change
    elif name in CONTROLS:
        matrix = np.asarray(model.data["rigging"]["matrix"])[:3, :3]
        stick[:3] += np.linalg.solve(matrix, change * np.eye(3)[CONTROLS.index(name)])
    elif name in DISK:
        i, coordinate = model.rotor["flap_mode"], change / model.rotor["flap_per_coordinate"]
        shape = (np.ones(n), np.cos(psi), np.sin(psi))[DISK.index(name)]
        slope = (np.zeros(n), -np.sin(psi), np.cos(psi))[DISK.index(name)]
        q[:, i] += coordinate * shape
        q_dot[:, i] += coordinate * model.omega * slope
    wake = _core.SteadyWake.from_bytes(known.to_bytes())
    wake.forget_means()
    for _ in range(PASSES):
        try:
            wake.converge(model.core, y, stick, (q, q_dot), ITERATIONS)
        except ArithmeticError as reason:
            raise NumericalFailure(f"linearize: the wake beside the trim, {name} changed: {reason}") from reason
        if not wake.converged:
            last, allowed = wake.last["inflow_change"], wake.allowed["inflow_change"]
            raise NumericalFailure(
                f"linearize: wake = quasi-static: no periodic wake was found with {name} changed: its inflow still changes by "
                f"{last:.1e} of the tip speed an iteration (allowed {allowed:.1e})"
            )
    return wake


def by_states(
    start: Trim, where: Places, gains: WakeGains, multiblade: tuple[str, ...]
) -> tuple[np.ndarray, np.ndarray]:
    """Held inflow of all stations of all blades and its mean by states in multiblade coordinates (n, lambdas, s) and by sticks
    (n, lambdas, 4) [1/m]."""
    model, n = start.model, start.inflow_map.shape[0]
    rows = (np.arange(n)[:, None] + np.arange(where.n_blades) * n // where.n_blades) % n
    stations = gains.values.shape[2]

    def felt(values: np.ndarray) -> np.ndarray:
        """A map as it is met: blade after blade, then the mean of the disk."""
        return np.hstack([values[rows].reshape(n, -1), np.full((n, 1), model.disk_mean(values))])

    column = dict(zip(gains.names, (felt(each) for each in gains.values), strict=True))
    states = np.zeros((n, where.n_blades * stations + 1, where.size))
    for i, name in enumerate(MOTION):
        states[:, :, i] = column[name]
    flap = where.labels[model.rotor["flap_mode"]]
    names = [name for name, _ in where.named(multiblade)]
    share = model.rotor["flap_per_coordinate"] / where.angle[model.rotor["flap_mode"]]
    for name, part in zip(DISK, ("0", "1c", "1s"), strict=True):
        if f"{flap}_{part}" in names:
            states[:, :, names.index(f"{flap}_{part}")] = share * column[name]
    matrix = np.asarray(model.data["rigging"]["matrix"])[:3]
    sticks = np.einsum("tlc,cs->tls", np.stack([column[name] for name in CONTROLS], axis=2), matrix)
    return states, sticks
