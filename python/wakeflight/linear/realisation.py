# SPDX-License-Identifier: MIT OR Apache-2.0
"""A continuous system of few states from answers to a pulse: Laguerre functions, then their balanced realisation [juang1985].

Answers are fitted by y = sum over k of c_k (phi_k * u), phi_k(s) = sqrt(2a)/(s + a) ((s - a)/(s + a))^(k - 1). With
1/z = (s - a)/(s + a) that is the impulse response of a discrete system that has the Hankel singular values of the continuous one:
realised as such it needs no logarithm of a matrix, which does not exist near the negative axis, and no sample is held. The chain
of the functions is itself a realisation with orthonormal states, so that the algorithm is a balanced truncation of the chain.
Inputs count up to the frequency `CORNER` alone: a weight on one side, with which what is kept is stable for certain.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .response import Matrices, time_response

FINE = 8
"""Pieces of a step in which the functions are computed."""
RIDGE = 2e-3
"""Least singular value of a fit over the largest that counts: the pulse says nothing below."""
CORNER = 20.0
"""Frequency [rad/s] beyond which inputs of the wake count less and less, with the square of it."""


@dataclass(frozen=True)
class Realisation:
    """A, B, C (D is zero) and the Hankel singular values over the largest."""

    matrices: tuple[np.ndarray, np.ndarray, np.ndarray]
    hankel: np.ndarray

    @property
    def order(self) -> int:
        """States."""
        return int(self.matrices[0].shape[0])

    def order_for(self, tolerance: float) -> int:
        """States for which each that is left out is below `tolerance`."""
        return int(np.sum(self.hankel > tolerance))

    def driven(self, by: np.ndarray) -> Realisation:
        """The same by causes of which each stands for so much of its inputs, `by` (inputs, causes)."""
        a, b, c = self.matrices
        return Realisation((a, b @ by, c), self.hankel)

    @classmethod
    def none(cls, inputs: int, outputs: int) -> Realisation:
        """No states: nothing is answered later."""
        return cls((np.zeros((0, 0)), np.zeros((0, inputs)), np.zeros((outputs, 0))), np.zeros(0))


def laguerre(pole: float, count: int) -> Matrices:
    """The functions phi_1 .. phi_count of one input as outputs; its states are they."""
    a = -pole * np.eye(count) - 2.0 * pole * np.tril(np.ones((count, count)), -1)
    return a, np.full((count, 1), np.sqrt(2.0 * pole)), np.eye(count), np.zeros((count, 1))


def filtered(pole: float, count: int, dt: float, pulse: np.ndarray) -> np.ndarray:
    """phi_k * u (steps, count) for u (FINE (steps - 1) + 1,) at pieces of steps `dt`."""
    time = dt / FINE * np.arange(pulse.size)
    found: np.ndarray = time_response(laguerre(pole, count), time, pulse[:, None])[1][::FINE]
    return found


def coefficients(functions: np.ndarray, answers: np.ndarray) -> np.ndarray:
    """c (count, ...) with which `functions` (samples, count) are nearest to `answers` (samples, ...), large ones shunned."""
    left, size, right = np.linalg.svd(functions, full_matrices=False)
    gain = size / (size**2 + (RIDGE * size[0]) ** 2)
    found = (right.T * gain) @ (left.T @ answers.reshape(answers.shape[0], -1))
    return np.asarray(found.reshape(-1, *answers.shape[1:]))


def realised(c: np.ndarray, pole: float, tolerance: float, scales: tuple[np.ndarray, np.ndarray]) -> Realisation:
    """The system of coefficients c (count, outputs, inputs), to `tolerance` of its largest Hankel singular value.

    scales: outputs times and inputs over these count alike.
    """
    from scipy.linalg import cholesky, toeplitz

    from .reduction import root_of

    count, n_out, n_in = c.shape
    one_a, one_b, _, _ = laguerre(pole, count)
    a, b = np.kron(one_a, np.eye(n_in)), np.kron(one_b, np.diag(1.0 / scales[1]))
    whole = (c * scales[1]).transpose(1, 0, 2).reshape(n_out, -1)
    seen = scales[0][:, None] * whole
    # phi_i phi_j* is z^(j - i), and z = -1 at no frequency
    theta = 2 * np.pi * (np.arange(4096) + 0.5) / 4096
    weight = 1.0 / (1.0 + (pole / CORNER / np.tan(0.5 * theta)) ** 2) ** 2
    felt = np.array([np.mean(weight * np.cos(k * theta)) for k in range(count)])
    reach = np.kron(cholesky(toeplitz(felt) + 1e-12 * np.eye(count), lower=True), np.eye(n_in))
    observe = root_of(observability(seen, pole, count))
    left, sizes, right = np.linalg.svd(observe.T @ reach)
    order = int(np.sum(sizes > tolerance * sizes[0]))
    scale = 1.0 / np.sqrt(sizes[:order])
    into, out = reach @ right[:order].T * scale, (observe @ left[:, :order] * scale).T
    return Realisation((out @ a @ into, out @ b, whole @ into), sizes / sizes[0])


def observability(seen: np.ndarray, pole: float, count: int) -> np.ndarray:
    """Observability gramian of the chains with outputs `seen` (outputs, count inputs).

    In 1/z = (s - a)/(s + a) the chain is a shift, -S, with outputs (c_k - c_(k+1))/sqrt(2 a), and has the same gramian:
    W_ij = C_i' C_j + W_(i+1)(j+1).
    """
    n_out = seen.shape[0]
    by_function = seen.reshape(n_out, count, -1)
    shifted = np.concatenate([by_function[:, 1:], np.zeros_like(by_function[:, :1])], axis=1)
    discrete = ((by_function - shifted) / np.sqrt(2.0 * pole)).reshape(n_out, -1)
    n_in = discrete.shape[1] // count
    whole: np.ndarray = discrete.T @ discrete
    for k in range(count - 2, -1, -1):
        here, after = slice(k * n_in, (k + 1) * n_in), slice((k + 1) * n_in, None)
        whole[here, : -n_in or None] += whole[(k + 1) * n_in : (k + 2) * n_in, n_in:]
        whole[after, here] = whole[here, after].T
    return whole
