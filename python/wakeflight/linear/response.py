# SPDX-License-Identifier: MIT OR Apache-2.0
"""Responses of a constant linear system: to harmonic inputs, and to a history of them."""

from __future__ import annotations

import numpy as np

Matrices = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""A, B, C, D."""


def frequency_response(system: Matrices, w: np.ndarray) -> np.ndarray:
    """C (i w - A)^-1 B + D (len(w), outputs, inputs) at frequencies `w` [rad/s]; one Schur form serves all of them."""
    from scipy.linalg import schur, solve_triangular

    a, b, c, d = system
    triangle, basis = schur(a, output="complex")
    right, left, eye = basis.conj().T @ b, c @ basis, np.eye(a.shape[0])
    return np.array([left @ solve_triangular(1j * each * eye - triangle, right) + d for each in w])


def time_response(system: Matrices, time: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Outputs (n, outputs) and states (n, s) from rest, for inputs (n, inputs) linear between equally spaced times."""
    from scipy.linalg import expm

    a, b, c, d = system
    s, m, dt = a.shape[0], b.shape[1], float(time[1] - time[0])
    # exact for inputs linear over a step: x' = a x + b u, u' = slope
    block = np.zeros((s + 2 * m, s + 2 * m))
    block[:s, :s], block[:s, s : s + m] = a * dt, b * dt
    block[s : s + m, s + m :] = np.eye(m)
    step = expm(block)
    over, begin, slope = step[:s, :s].T, step[:s, s : s + m], step[:s, s + m :]
    forced = u[:-1] @ begin.T + np.diff(u, axis=0) @ slope.T
    x = np.zeros((time.size, s))
    for k in range(time.size - 1):
        x[k + 1] = x[k] @ over + forced[k]
    return x @ c.T + u @ d.T, x
