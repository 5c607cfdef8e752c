# SPDX-License-Identifier: MIT OR Apache-2.0
"""The angles of an attitude."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np


def euler_angles(quaternion: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Roll, pitch, yaw (3-2-1) [rad] of quaternions (n, 4), body to inertial; roll and yaw without jumps."""
    w, x, y, z = (quaternion / np.linalg.norm(quaternion, axis=1, keepdims=True)).T
    roll = np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    pitch = np.arcsin(np.clip(2 * (w * y - z * x), -1, 1))
    yaw = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
    return np.unwrap(roll), pitch, np.unwrap(yaw)


def body_to_inertial(quaternion: np.ndarray) -> np.ndarray:
    """Rotation (3, 3) from body to inertial axes of a quaternion (4,)."""
    return np.array(axes(quaternion.tolist()))


def axes(quaternion: Sequence[float]) -> tuple[tuple[float, float, float], ...]:
    """The same as rows of plain numbers, at a tenth of the time: for what is asked at every step."""
    w, x, y, z = quaternion
    size = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / size, x / size, y / size, z / size
    return (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )


def turned_back(rows: Sequence[Sequence[float]], vector: Sequence[float]) -> tuple[float, float, float]:
    """A vector in inertial axes in those of the body whose axes `rows` (3, 3) has."""
    x, y, z = vector
    (a, b, c), (d, e, f), (g, h, i) = rows
    return a * x + d * y + g * z, b * x + e * y + h * z, c * x + f * y + i * z


def quaternion_of(roll: float, pitch: float, yaw: float) -> np.ndarray:
    """Unit quaternion (4,), body to inertial, of roll, pitch, yaw (3-2-1) [rad]; its first component is not negative."""
    (cr, sr), (cp, sp), (cy, sy) = ((np.cos(0.5 * each), np.sin(0.5 * each)) for each in (roll, pitch, yaw))
    found = np.array(
        [
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ]
    )
    return -found if found[0] < 0.0 else found
