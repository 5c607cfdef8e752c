# SPDX-License-Identifier: MIT OR Apache-2.0
"""The BO-105 with other moments on its fuselage: to see what they do.

Moments are over dynamic pressure [m3], nose up and nose right positive, about the table's reference point: a pitching moment
M(alpha) cos(beta) and a yawing moment N(beta), written into the columns of the fuselage's table. Two of them come from the same
appendix of the source (Padfield, 4B): polynomials for small angles, stated in N m for 30.48 m/s, and piecewise linear ones
as coefficients on plan or side area and length, which the source calls typical of a wide range of fuselages.
"""

import shutil
from collections.abc import Callable
from pathlib import Path

import numpy as np

import wakeflight as wf

LENGTH, PLAN_AREA, SIDE_AREA = 8.56, 7.5, 8.3  # m, m2
VOLUME = 8.2  # m3, estimate: elliptic sections 1.58 m wide, pod and boom of the two areas
APPARENT_MASS = 0.84  # k2 - k1 of a spheroid five times as long as thick
TUNNEL = 0.5 * 1.225 * 30.48**2  # N/m2
GENERAL_PITCH = (
    (-205, -160, -130, -60, -25, 25, 60, 130, 155, 200),
    (0.02, -0.03, 0.1, 0.1, -0.04, 0.02, -0.1, -0.1, 0.02, -0.03),
)
GENERAL_YAW = (-180, -120, -70, -25, 0, 25, 70, 120, 180), (0, -0.1, -0.1, 0.005, 0, -0.005, 0.1, 0.1, 0)
SMALL, LARGE = np.radians([20.0, 60.0])

Moment = Callable[[np.ndarray], np.ndarray]


def general_pitch(alpha: np.ndarray) -> np.ndarray:
    """Pitching moment by the source's general coefficients."""
    return LENGTH * PLAN_AREA * np.interp(np.degrees(alpha), *GENERAL_PITCH)


def general_yaw(beta: np.ndarray) -> np.ndarray:
    """Yawing moment by the source's general coefficients."""
    return LENGTH * SIDE_AREA * np.interp(np.degrees(beta), *GENERAL_YAW)


def printed_pitch(alpha: np.ndarray) -> np.ndarray:
    """Pitching moment by the source's polynomial within 20 deg, straight from there to the general one at 60 deg."""
    return _faired(alpha, np.polynomial.Polynomial([-1191.8, 12752.0, 8201.3, -5796.7]), general_pitch)


def printed_yaw(beta: np.ndarray) -> np.ndarray:
    """Yawing moment by the source's polynomial within 20 deg, straight from there to the general one at 60 deg."""
    return _faired(beta, np.polynomial.Polynomial([0.0, -10028.0]), general_yaw)


def _faired(angle: np.ndarray, polynomial: Moment, general: Moment) -> np.ndarray:
    edge = np.sign(angle)
    share = np.clip((np.abs(angle) - SMALL) / (LARGE - SMALL), 0.0, 1.0)
    near = polynomial(np.clip(angle, -SMALL, SMALL)) / TUNNEL
    far = np.where(share < 1.0, general(edge * LARGE), general(angle))
    return (1.0 - share) * near + share * far


def slender_body() -> float:
    """Slope of an ideal fluid's moment on the fuselage [m3/rad], 2 (k2 - k1) volume [Munk]."""
    return 2.0 * APPARENT_MASS * VOLUME


def sloped(slope: float, at_zero: float = 0.0) -> Moment:
    """A moment with a constant slope [m3/rad]."""
    return lambda angle: at_zero + slope * angle


def with_moments(folder: Path, name: str, pitch: Moment, yaw: Moment) -> wf.Aircraft:
    """The BO-105 with these moments on its fuselage, written into `folder`."""
    target = folder / name
    shutil.copytree(Path(wf.aircraft.__file__).parent / "bo105", target)
    path = target / "fuselage.csv"
    lines = path.read_text().splitlines()
    remarks = [line for line in lines if line.startswith("#")]
    head, *rows = [line for line in lines if not line.startswith("#")]
    columns = head.split(",")
    table = np.array([[float(x) for x in row.split(",")] for row in rows])
    alpha, beta = np.radians(table[:, :2]).T
    body = np.stack([np.zeros_like(alpha), pitch(alpha) * np.cos(beta), yaw(beta)])
    for column, axis in zip(("Rq_m3", "Mq_m3", "Nq_m3"), directions(alpha, beta), strict=True):
        table[:, columns.index(column)] = np.sum(axis * body, axis=0)
    written = [",".join(f"{value:.4f}".removesuffix(".0000") for value in row) for row in table + 0.0]
    path.write_text("\n".join([*remarks, head, *written]) + "\n")
    return wf.load_aircraft(target / "bo105.toml")


def directions(alpha: np.ndarray, beta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Axes of the table's rolling, pitching and yawing moment in body axes, (3, n) each."""
    ca, sa, cb, sb = np.cos(alpha), np.sin(alpha), np.cos(beta), np.sin(beta)
    return (
        np.stack([ca * cb, sb, sa * cb]),
        np.stack([-ca * sb, cb, -sa * sb]),
        np.stack([-sa, np.zeros_like(sa), ca]),
    )
