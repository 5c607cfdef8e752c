# SPDX-License-Identifier: MIT OR Apache-2.0
"""The derivatives of F along a trimmed revolution, blade by blade: A, B, B_rate by azimuth of x_dot = A x + B u + B_rate u_dot.

F(y_dot, y, u; t) = 0 has M = dF/dy_dot, K = dF/dy, G = dF/du from the core, exact; A = -M^-1 K, B = -M^-1 G. They are taken at
the trim's own state *and rate*: accelerations act on the inertia coupling. Position and heading act on nothing and are left out;
the quaternion becomes roll and pitch, whose own rows are the kinematics of Euler angles.

Tables of an airframe have a break where the wind comes from straight ahead, and a trim without sideslip stands on it: the
derivatives are the mean of those a hair to the right and to the left, which is what small motions about such a trim see.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import _core
from ..attitude import euler_angles
from ..errors import InputError
from ..trim import INCH, Trim
from .names import BODY, MOTION, Places
from .over_ground import without_turn

STICKS = ("lateral", "longitudinal", "collective", "pedal")
OTHERS = {"stabilator": "rad", "wind_north": "m/s", "wind_east": "m/s", "wind_down": "m/s"}
"""Inputs beside the sticks, with their units."""
HAIR = 1e-4
"""Velocity to either side [m/s] at which derivatives are taken: far above rounding, far below any cell of a table."""


@dataclass(frozen=True)
class Instants:
    """Matrices along the first of n_blades equal parts of a revolution, inputs in SI.

    psi (n,) [rad]; a (n, s, s); b, b_rate (n, s, inputs), by inputs and by their rates; held (n, s, n_blades*n_stations + 1), by
    the held inflow of every station of every blade and its disk mean, no columns where inflow is a state.
    """

    psi: np.ndarray
    a: np.ndarray
    b: np.ndarray
    b_rate: np.ndarray
    held: np.ndarray


def check_inputs(inputs: tuple[str, ...], turning: bool) -> None:
    """Refuse inputs that there are not; wind of a fixed direction has no meaning in a turn."""
    allowed = STICKS if turning else (*STICKS, *OTHERS)
    if not inputs:
        raise InputError.of("inputs", "none", f"must name at least one of {', '.join(allowed)}")
    for name in inputs:
        if name not in allowed:
            where = " in a turn" if turning else ""
            raise InputError.of("inputs", str(name), f"allowed{where}: {', '.join(allowed)}")
        if inputs.count(name) > 1:
            raise InputError.of("inputs", name, "given twice")


def units_of(inputs: tuple[str, ...]) -> tuple[tuple[str, str, float], ...]:
    """Name, unit and SI units in one unit of every input: sticks are in inches."""
    return tuple((name, OTHERS.get(name, "in"), 1.0 if name in OTHERS else INCH) for name in inputs)


def along(start: Trim, where: Places, inputs: tuple[str, ...], n: int, over_ground: bool) -> Instants:
    """Derivatives at `n` azimuths of a revolution, of which the first of equal parts is gone through.

    over_ground: of a rotor constant in speed over the ground instead of about the airframe.
    """
    core = start.model.core.over_ground() if over_ground else start.model.core
    psi = 2 * np.pi * np.arange(n // where.n_blades) / n
    sides = [[_at(start, core, where, inputs, t, side) for t in psi / start.model.omega] for side in (-HAIR, HAIR)]
    a, b, b_rate, held = (
        0.5 * (np.array(left) + np.array(right)) for left, right in zip(*map(_columns, sides), strict=True)
    )
    return Instants(psi, a, b, b_rate, held)


def _columns(instants: list[tuple[np.ndarray, ...]]) -> list[tuple[np.ndarray, ...]]:
    return list(zip(*instants, strict=True))


def _at(
    start: Trim, core: _core.System, where: Places, inputs: tuple[str, ...], t: float, side: float
) -> tuple[np.ndarray, ...]:
    """A, B, B_rate, B_held at one instant, the air `side` [m/s] further to one side."""
    layout = core.layout()
    total, (azimuth, after) = layout["size"], layout["turn"]
    y, y_dot = core.trim_state(start.problem, start.x, t)
    y[where.motion[1]] += side
    acting = start.inputs(t)
    stiffness, mass = np.empty((total, total)), np.empty((total, total))
    core.jacobian(t, y, y_dot, acting, (1.0, 0.0), stiffness)
    core.jacobian(t, y, y_dot, acting, (0.0, 1.0), mass)
    names, by_inputs = core.input_slopes(t, y, y_dot, acting)
    if after > azimuth:
        turn = (azimuth, azimuth + 1)
        stiffness, mass, left = without_turn(stiffness, mass, y_dot, turn, where.motion[3:], start.model.omega)
        y, by_inputs = y[left], by_inputs[left]
    column = {name: i for i, (name, _) in enumerate(names)}
    by_asked = by_inputs[:, [column[name] for name in inputs]]
    by_rates = np.zeros_like(by_asked)
    for i, name in enumerate(inputs):
        if f"{name}_rate" in column:
            # inputs begin at t = 0: a rate has moved the stick by rate x t
            by_rates[:, i] = by_inputs[:, column[f"{name}_rate"]] - t * by_asked[:, i]
    by_held = by_inputs[:, [i for name, i in column.items() if ".inflow_" in name]]
    whole = _solved(where, y, mass, stiffness, np.hstack([by_asked, by_rates, by_held]))
    m = len(inputs)
    return tuple(np.split(whole, np.cumsum([where.size, m, m]), axis=1))


def _solved(where: Places, y: np.ndarray, mass: np.ndarray, stiffness: np.ndarray, by_inputs: np.ndarray) -> np.ndarray:
    """A and B beside each other at one instant, in the states of the linear model."""
    kept, n = where.kept, where.kept.size
    slopes = attitude_slopes(y[where.attitude])
    by_attitude = stiffness[np.ix_(kept, where.attitude)] @ slopes
    right = np.hstack([stiffness[np.ix_(kept, kept)], by_attitude, by_inputs[kept]])
    found = -np.linalg.solve(mass[np.ix_(kept, kept)], right)
    # blades as angles
    found *= where.scale[:, None]
    found[:, :n] /= where.scale
    whole = np.zeros((where.size, where.size + by_inputs.shape[1]))
    rows = np.concatenate([np.arange(len(MOTION)), np.arange(len(BODY), where.size)])
    whole[np.ix_(rows, rows)] = found[:, :n]
    whole[rows, 6:8] = found[:, n : n + 2]
    whole[rows, where.size :] = found[:, n + 2 :]
    whole[6:8, :8] = kinematics(y[where.motion], y[where.attitude])
    return whole


def attitude_slopes(quaternion: np.ndarray) -> np.ndarray:
    """Derivatives (4, 2) of the quaternion body to inertial by roll and by pitch, the heading as it is.

    dq = q * (0, d_phi, cos phi d_theta, -sin phi d_theta)/2: roll turns about the body's x, pitch about the level line.
    """
    w, x, y, z = quaternion
    product = np.array([[-x, -y, -z], [w, -z, y], [z, w, -x], [-y, x, w]])
    roll, _ = angles(quaternion)
    turns = np.array([[1.0, 0.0], [0.0, np.cos(roll)], [0.0, -np.sin(roll)]])
    found: np.ndarray = 0.5 * product @ turns
    return found


def angles(quaternion: np.ndarray) -> tuple[float, float]:
    """Roll and pitch [rad]."""
    (roll,), (pitch,), _ = euler_angles(quaternion[None])
    return float(roll), float(pitch)


def kinematics(motion: np.ndarray, quaternion: np.ndarray) -> np.ndarray:
    """Rows of roll and pitch (2, 8): phi_dot = p + (q sin phi + r cos phi) tan theta, theta_dot = q cos phi - r sin phi."""
    _, q, r = motion[3:]
    roll, pitch = angles(quaternion)
    s, c, tangent, cosine = np.sin(roll), np.cos(roll), np.tan(pitch), np.cos(pitch)
    return np.array(
        [
            [0, 0, 0, 1.0, s * tangent, c * tangent, (q * c - r * s) * tangent, (q * s + r * c) / cosine**2],
            [0, 0, 0, 0.0, c, -s, -q * s - r * c, 0.0],
        ]
    )
