# SPDX-License-Identifier: MIT OR Apache-2.0
"""Multiblade coordinates: what all blades do together, seen from the hub that does not turn [johnson1980].

q_b = sum over columns of T_b(psi) z:  T = 1, cos n psi_b, sin n psi_b for n up to (N - 1)/2, and for an even number of blades
(-1)^b. Coordinates and their own rates are states: y = R z with R = (T, 0; T_dot, T), and x_dot = A x becomes
z_dot = L (A R - R_dot) z, L = R^-1.
"""

from __future__ import annotations

import numpy as np

from .names import Places


def columns(n_blades: int) -> tuple[str, ...]:
    """Names of the coordinates: 0, 1c, 1s, ..., d."""
    cyclic = [f"{n}{part}" for n in range(1, (n_blades - 1) // 2 + 1) for part in "cs"]
    return ("0", *cyclic, *(["d"] if n_blades % 2 == 0 else []))


def transformation(n_blades: int, psi: np.ndarray, derivative: int = 0) -> np.ndarray:
    """T (n, n_blades, n_blades) at azimuths `psi` (n,) of the first blade, or its derivative by azimuth."""
    blade = np.arange(n_blades)
    at = psi[:, None] + 2 * np.pi * blade / n_blades
    whole = np.zeros((psi.size, n_blades, n_blades))
    constant = 1.0 if derivative == 0 else 0.0
    whole[:, :, 0] = constant
    for n in range(1, (n_blades - 1) // 2 + 1):
        turned = n * at + 0.5 * np.pi * derivative
        whole[:, :, 2 * n - 1], whole[:, :, 2 * n] = n**derivative * np.cos(turned), n**derivative * np.sin(turned)
    if n_blades % 2 == 0:
        whole[:, :, -1] = constant * (-1.0) ** blade
    return whole


def rotation(where: Places, psi: np.ndarray, omega: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """R, its time derivative and its inverse (n, s, s): states blade by blade of those in multiblade coordinates."""
    n_blades, eye = where.n_blades, np.eye(where.n_modes)
    t0, t1, t2 = (omega**k * transformation(n_blades, psi, k) for k in range(3))
    inverse = np.linalg.inv(t0)

    def whole(coordinates: np.ndarray, mixed: np.ndarray, rates: np.ndarray, others: float) -> np.ndarray:
        """Blocks of coordinates, of rates by coordinates, of rates, in the order of the states."""
        blade = np.zeros((psi.size, n_blades, 2, n_blades, 2))
        blade[:, :, 0, :, 0], blade[:, :, 1, :, 0], blade[:, :, 1, :, 1] = coordinates, mixed, rates
        spread = np.einsum("tbicj,mk->tbimcjk", blade, eye).reshape(psi.size, *(2 * (2 * n_blades * where.n_modes,)))
        out = np.zeros((psi.size, where.size, where.size))
        out[:] = others * np.eye(where.size)
        out[:, where.blades, where.blades] = spread
        return out

    r = whole(t0, t1, t0, 1.0)
    r_dot = whole(t1, t2, t1, 0.0)
    left = whole(inverse, -inverse @ t1 @ inverse, inverse, 1.0)
    return r, r_dot, left


def to_multiblade(
    where: Places, psi: np.ndarray, omega: float, a: np.ndarray, b: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """A and B in multiblade coordinates at azimuths `psi`."""
    r, r_dot, left = rotation(where, psi, omega)
    return left @ (a @ r - r_dot), left @ b


def renumbered(where: Places, part: int) -> np.ndarray:
    """Place (s,) of every state after `part` passages of the blades: each does what the next one did."""
    order = np.arange(where.size)
    own = 2 * where.n_modes
    blades = order[where.blades].reshape(where.n_blades, own)
    order[where.blades] = np.roll(blades, -part, axis=0).ravel()
    return order
