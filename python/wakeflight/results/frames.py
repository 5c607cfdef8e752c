# SPDX-License-Identifier: MIT OR Apache-2.0
"""Frames of a run: rotations between hub, body and earth axes, and where the blades are in them, from what a run keeps.

Hub axes: x aft, y right, z up along the shaft. Body axes: x forward, y right, z down. Earth axes: north, east, down, from
where the body origin was at the start.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray as xr


def geometry(run: xr.Dataset) -> dict[str, Any]:
    """What a run says of its rotor's place and shape: see `Aircraft.geometry`; ValueError of a run that says nothing."""
    if "geometry" not in run.attrs:
        raise ValueError("the run does not say where its rotor is: it was written by an earlier version; fly it again")
    kept: dict[str, Any] = json.loads(run.attrs["geometry"])
    return kept


def body_of_hub(tilt_forward: float, tilt_lateral: float = 0.0) -> np.ndarray:
    """Matrix (3, 3) that takes hub axes to body axes; tilts of the shaft forward and to the right [rad] [howlett1981]."""
    st, ct = np.sin(-tilt_forward), np.cos(tilt_forward)
    sp, cp = np.sin(tilt_lateral), np.cos(tilt_lateral)
    hub_of_body = np.array([[-ct, 0.0, st], [st * sp, cp, ct * sp], [-st * cp, sp, -ct * cp]])
    return hub_of_body.T


def earth_of_body(roll: np.ndarray, pitch: np.ndarray, yaw: np.ndarray) -> np.ndarray:
    """Matrices (n, 3, 3) that take body axes to earth axes, of 3-2-1 Euler angles (n,) [rad]."""
    (sr, cr), (sp, cp), (sy, cy) = ((np.sin(each), np.cos(each)) for each in (roll, pitch, yaw))
    rows = [
        [cp * cy, sr * sp * cy - cr * sy, cr * sp * cy + sr * sy],
        [cp * sy, sr * sp * sy + cr * cy, cr * sp * sy - sr * cy],
        [-sp, sr * cp, cr * cp],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def hub_in_earth(run: xr.Dataset) -> tuple[np.ndarray, np.ndarray]:
    """Of every record the matrix from hub to earth axes (time, 3, 3) and the place of the hub (time, 3) [m]."""
    shape = geometry(run)
    turned = earth_of_body(*(run[name].values for name in ("roll", "pitch", "yaw")))
    origin = np.stack([run[name].values for name in ("north", "east", "down")], axis=1)
    hub = origin + turned @ np.array(shape["hub"])
    return turned @ body_of_hub(*shape["shaft_tilt"]), hub


def blade_points(
    shape: dict[str, Any], azimuth: np.ndarray, flap: np.ndarray, lead: np.ndarray, r: np.ndarray, behind: np.ndarray
) -> np.ndarray:
    """Points of straight blades in hub axes [m]: at distances `r` from the hub centre, `behind` the quarter chord.

    azimuth, flap, lead (...,) [rad]: of each blade, up and forward positive, about the hinge offset. r, behind (points,) [m].
    Returns (..., points, 3). Pitch is left out: chordwise points lie in the plane that the blade sweeps.
    """
    hinge = shape["hinge_offset"]
    out = np.maximum(r - hinge, 0.0)
    beta, zeta, psi = flap[..., None], lead[..., None], azimuth[..., None]
    radial = np.minimum(r, hinge) + out * np.cos(beta) * np.cos(zeta)
    forward = out * np.cos(beta) * np.sin(zeta) - behind
    x = radial * np.cos(psi) - forward * np.sin(psi)
    y = shape["rotation"] * (radial * np.sin(psi) + forward * np.cos(psi))
    return np.stack(np.broadcast_arrays(x, y, out * np.sin(beta)), axis=-1)
