# SPDX-License-Identifier: MIT OR Apache-2.0
"""Aircraft whose fuselage has other moment slopes than its file says: to see what the slopes do.

A table of loads over dynamic pressure is read into moments about the body axes, its slopes scaled, and written back. Pitching moment
M(alpha) cos(beta) and yawing moment N(beta), as the BO-105's table is made.
"""

import shutil
from pathlib import Path

import numpy as np

import wakeflight as wf


def read(path: Path) -> tuple[list[str], dict[str, np.ndarray]]:
    """Lines of remarks and columns of a fuselage table."""
    lines = path.read_text().splitlines()
    remarks = [line for line in lines if line.startswith("#")]
    head, *rows = [line for line in lines if not line.startswith("#")]
    values = np.array([[float(x) for x in row.split(",")] for row in rows])
    return remarks, dict(zip(head.split(","), values.T, strict=True))


def directions(alpha: np.ndarray, beta: np.ndarray) -> np.ndarray:
    """Axes of the table's rolling, pitching and yawing moment in body axes (3, n, 3)."""
    ca, sa, cb, sb = np.cos(alpha), np.sin(alpha), np.cos(beta), np.sin(beta)
    zero = np.zeros_like(ca)
    stream = np.stack([ca * cb, sb, sa * cb], axis=-1)
    side = np.stack([-ca * sb, cb, -sa * sb], axis=-1)
    lift = np.stack([-sa, zero, ca], axis=-1)
    return np.stack([stream, side, lift])


def moment_slopes(aircraft: wf.Aircraft) -> tuple[float, float]:
    """Slopes of pitching moment by angle of attack and of yawing moment by sideslip, over dynamic pressure [m3/rad].

    Nose up and nose right positive, within ten degrees of zero.
    """
    fuselage = aircraft.core_data(wf.FlightCondition(speed="80 kt", flight_path="0 deg", altitude="0 m"))["fuselage"]
    pitching, yawing = fuselage["pitching"], fuselage["yawing"]
    a, b = np.array(pitching["x"]), np.array(yawing["y"])
    zero_a, zero_b = int(np.argmin(np.abs(a))), int(np.argmin(np.abs(b)))
    m, n = np.array(pitching["values"])[:, zero_b], np.array(yawing["values"])[zero_a]
    near_a, near_b = np.abs(a) < np.radians(10.1), np.abs(b) < np.radians(10.1)
    return float(np.polyfit(a[near_a], m[near_a], 1)[0]), float(np.polyfit(b[near_b], n[near_b], 1)[0])


def with_moments(folder: Path, pitch: float, yaw: float, at_zero: float = 1.0) -> wf.Aircraft:
    """The BO-105 with its fuselage's pitching and yawing moments scaled, written into `folder`.

    pitch: factor of what the pitching moment changes by from zero angle of attack; at_zero: factor of its value there; yaw: factor of
    the yawing moment.
    """
    source = Path(wf.aircraft.__file__).parent / "bo105"
    target = folder / f"bo105_{pitch:g}_{yaw:g}_{at_zero:g}"
    shutil.copytree(source, target)
    remarks, table = read(target / "fuselage.csv")
    alpha, beta = np.radians(table["alpha_deg"]), np.radians(table["beta_deg"])
    axes = directions(alpha, beta)
    loads = np.stack([table["Rq_m3"], table["Mq_m3"], table["Nq_m3"]])
    body = np.einsum("kn,kni->in", loads, axes)
    level = np.isclose(beta, 0.0)
    along = np.interp(alpha, alpha[level], body[1][level])
    zero = np.interp(0.0, alpha[level], body[1][level])
    body[1] = np.cos(beta) * (at_zero * zero + pitch * (along - zero))
    body[2] = yaw * body[2]
    table["Rq_m3"], table["Mq_m3"], table["Nq_m3"] = np.einsum("in,kni->kn", body, axes)
    rows = [",".join(f"{value:.6g}" for value in row) for row in np.array(list(table.values())).T]
    (target / "fuselage.csv").write_text("\n".join([*remarks, ",".join(table), *rows]) + "\n")
    return wf.load_aircraft(target / "bo105.toml")
