# SPDX-License-Identifier: MIT OR Apache-2.0
"""How close the tip vortices of a periodic wake come to the blades, in core radii: what a marching wake tells of every step."""

from __future__ import annotations

import numpy as np


def closest(
    position: np.ndarray,
    core: np.ndarray,
    psi: np.ndarray,
    n_blades: int,
    hinge: float,
    root: float,
    release: float,
    tip: float,
    young: int,
) -> float:
    """Smallest distance between a blade, root to tip, and a tip-vortex segment over the segment's core radius.

    position (n_azimuths, n_ages, 3) [m], core (n_azimuths, n_ages - 1) [m]: tip vortex of the blade at each azimuth of psi
    (n_azimuths,) [rad], evenly spaced, hub axes; its first node where it leaves the blade, at `release`. hinge, root, release,
    tip [m]: radii of the blade's hinge, of the ends of its span, and of that node. young: segments of the blade's own vortex
    that are left out, of its near wake.
    """
    n = position.shape[0]
    at_hinge = hinge * np.stack([np.cos(psi), np.sin(psi), np.zeros(n)], axis=1)
    along = (position[:, 0] - at_hinge) / (release - hinge)
    ends = at_hinge + along * (root - hinge), at_hinge + along * (tip - hinge)
    smallest = np.inf
    for other in range(n_blades):
        filament = (np.arange(n) + other * n // n_blades) % n
        # the blade at every azimuth against the vortex of the blade `other` places ahead
        apart = _distance(position[filament, :-1], position[filament, 1:], ends[0][:, None], ends[1][:, None])
        first = max(young, 1) if other == 0 else 0
        smallest = min(smallest, float((apart / core[filament])[:, first:].min()))
    return smallest


def _distance(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> np.ndarray:
    """Smallest distance between the straight segments a-b and c-d (..., 3)."""
    u, v, w = b - a, d - c, a - c
    uu, uv, vv, uw, vw = (np.sum(p * q, axis=-1) for p, q in ((u, u), (u, v), (v, v), (u, w), (v, w)))

    def share(numerator: np.ndarray, squared: np.ndarray) -> np.ndarray:
        whole = np.where(squared > 0.0, squared, 1.0)
        return np.where(squared > 0.0, np.clip(numerator / whole, 0.0, 1.0), 0.0)

    # nearest points of the two lines, then held within the segments, one after the other
    s = share(uv * vw - vv * uw, uu * vv - uv * uv)
    t = share(uv * s + vw, vv)
    s = share(uv * t - uw, uu)
    t = share(uv * s + vw, vv)
    found: np.ndarray = np.linalg.norm(w + s[..., None] * u - t[..., None] * v, axis=-1)
    return found
