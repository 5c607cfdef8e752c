# SPDX-License-Identifier: MIT OR Apache-2.0
"""What a linear model puts out: body motion and attitude, climb and turn, specific force, flapping, inflow."""

from __future__ import annotations

import numpy as np

from ..model import Model
from ..units import STANDARD_GRAVITY
from .instants import angles
from .names import BODY, UNITS, Places
from .periodic import Named

OF_FLIGHT: Named = (
    ("climb_rate", "m/s"),
    ("turn_rate", "rad/s"),
    ("acceleration_x", "m/s2"),
    ("acceleration_y", "m/s2"),
    ("acceleration_z", "m/s2"),
)
"""Rate of climb; rate of the heading; specific force at the body origin, body axes, what an accelerometer there feels."""
FLAPPING = ("beta_0", "beta_1c", "beta_1s")


def outputs(
    model: Model, where: Places, states: Named, y: np.ndarray, a: np.ndarray, b: np.ndarray
) -> tuple[np.ndarray, np.ndarray, Named]:
    """C (n, k, s), D (n, k, m) and the outputs' names, for A and B in multiblade coordinates; y: the trimmed state."""
    n, s, m = a.shape[0], a.shape[1], b.shape[2]
    names = [name for name, _ in states]
    climb, turn, force = _flight(y[where.motion], angles(y[where.attitude]))
    body = len(BODY)
    rows_c, rows_d, named = [], [], []

    def put(name: str, unit: str, c: np.ndarray, d: np.ndarray | None = None) -> None:
        rows_c.append(np.broadcast_to(c, (n, s)))
        rows_d.append(np.zeros((n, m)) if d is None else d)
        named.append((name, unit))

    def of_body(row: np.ndarray) -> np.ndarray:
        return np.concatenate([row, np.zeros(s - body)])

    for i, (name, unit) in enumerate(UNITS.items()):
        put(name, unit, np.eye(s)[i])
    put(*OF_FLIGHT[0], of_body(climb))
    put(*OF_FLIGHT[1], of_body(turn))
    for i in range(3):
        put(*OF_FLIGHT[2 + i], a[:, i] + of_body(force[i]), b[:, i])
    flap = where.labels[model.rotor["flap_mode"]] if where.n_modes else ""
    # the equivalent flap angle, as results have it
    share = model.rotor["flap_per_coordinate"] / where.angle[model.rotor["flap_mode"]] if where.n_modes else 0.0
    for name, column in zip(FLAPPING, ("0", "1c", "1s"), strict=True):
        if f"{flap}_{column}" in names:
            put(name, "rad", share * np.eye(s)[names.index(f"{flap}_{column}")])
    for name, unit in where.rest_names:
        put(name, unit, np.eye(s)[names.index(name)])
    return np.stack(rows_c, 1), np.stack(rows_d, 1), tuple(named)


def _flight(motion: np.ndarray, attitude: tuple[float, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rows by the body's states: rate of climb (8,), rate of the heading (8,), specific force without v_dot (3, 8)."""
    u, v, w, p, q, r = motion
    (sr, sp), (cr, cp) = np.sin(attitude), np.cos(attitude)
    climb = np.array([sp, -sr * cp, -cr * cp, 0, 0, 0, (-v * cr + w * sr) * cp, u * cp + (v * sr + w * cr) * sp])
    turn = np.array([0, 0, 0, 0, sr / cp, cr / cp, (q * cr - r * sr) / cp, (q * sr + r * cr) * sp / cp**2])
    g = STANDARD_GRAVITY
    force = np.array(
        [
            [0, -r, q, 0, w, -v, 0, g * cp],
            [r, 0, -p, -w, 0, u, -g * cr * cp, g * sr * sp],
            [-q, p, 0, v, -u, 0, g * sr * cp, g * cr * sp],
        ]
    )
    return climb, turn, force
