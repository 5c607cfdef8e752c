# SPDX-License-Identifier: MIT OR Apache-2.0
"""Responses of a constant linear system: to harmonic inputs, and to a history of them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

Matrices = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
"""A, B, C, D."""


def harmonic_response(system: Matrices) -> Callable[[np.ndarray], np.ndarray]:
    """C (i w - A)^-1 B + D (len(w), outputs, inputs) as a function of `w` [rad/s]; one Schur form serves all calls."""
    from scipy.linalg import schur

    a, b, c, d = system
    triangle, basis = schur(a, output="complex")
    right, left = basis.conj().T @ b, c @ basis

    def response(w: np.ndarray) -> np.ndarray:
        x = np.empty((a.shape[0], w.size * b.shape[1]), complex)
        s = 1j * np.repeat(w, b.shape[1])
        # from the last row of the triangle upwards, all frequencies and inputs at once
        for i in range(a.shape[0] - 1, -1, -1):
            x[i] = (np.tile(right[i], w.size) + triangle[i, i + 1 :] @ x[i + 1 :]) / (s - triangle[i, i])
        found: np.ndarray = (left @ x).reshape(c.shape[0], w.size, b.shape[1]).transpose(1, 0, 2) + d
        return found

    return response


def frequency_response(system: Matrices, w: np.ndarray) -> np.ndarray:
    """The same at frequencies `w`."""
    return harmonic_response(system)(w)


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
