# SPDX-License-Identifier: MIT OR Apache-2.0
"""From a periodic system to a constant one: averaging, and harmonic decomposition [johnson1980].

Harmonic decomposition writes z = z_0 + sum over n of (z_nc cos n psi + z_ns sin n psi) with amplitudes that move in time, and
orders A z by harmonics: with complex amplitudes z_n' = sum over m of A_(n-m) z_m - i n omega z_n + B_n u, y_0 = sum over m of
C_(-m) z_m + D_0 u. It is exact as harmonics grow; averaging is its zeroth harmonic alone and loses what harmonics of A do
together.

Rates of inputs are felt. The state of the constant system is what is left without them, x = z + B_rate u:
z_dot = A z + (B + A B_rate) u, y = C z + (D + C B_rate) u.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .periodic import Named, PeriodicSystem, complex_harmonics


@dataclass(frozen=True)
class Constant:
    """A constant linear system: A, B, C, D with names and units.

    rate (s, m): B_rate, by which the motion is more than the state per unit of input. harmonic (s,): 0 of states of the mean, n
    of the cosine and -n of the sine of the n-th harmonic.
    """

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    d: np.ndarray
    rate: np.ndarray
    states: Named
    harmonic: np.ndarray


def averaged(system: PeriodicSystem) -> Constant:
    """The mean of A, B, C, D over the revolution."""
    a, b, c, d, rate = (each.mean(axis=0) for each in (system.a, system.b, system.c, system.d, system.b_rate))
    return _felt(a, b, c, d, rate, system.states, np.zeros(len(system.states), int))


def _felt(
    a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray, rate: np.ndarray, states: Named, harmonic: np.ndarray
) -> Constant:
    """With the rates of the inputs in B and D."""
    return Constant(a, b + a @ rate, c, d + c @ rate, rate, states, harmonic)


def decomposed(system: PeriodicSystem, harmonics: tuple[int, ...]) -> Constant:
    """Mean and `harmonics` of the state as states of a constant system; those that nothing of the mean acts on are left out.

    With equal blades the next one finds what this one found. A coordinate that keeps its sign then has, of what constant inputs
    excite, harmonics of the blades' number alone; the differential one, which changes it, those halfway between.
    """
    if not harmonics:
        return averaged(system)
    orders = np.array([0, *(n for each in harmonics for n in (each, -each))])
    labels = [(0, ""), *((sign * k, f"_{k}{part}") for k in harmonics for sign, part in ((1, "cos"), (-1, "sin")))]
    most, s = int(2 * np.max(orders)), len(system.states)
    a, b, c, rate = (complex_harmonics(each, most) for each in (system.a, system.b, system.c, system.b_rate))
    harmonic = np.repeat([k for k, _ in labels], s)
    acts = np.flatnonzero(_acting(system, harmonic))
    place, state = np.divmod(acts, s)
    order = orders[place]
    hill = a[most + order[:, None] - order, state[:, None], state] - np.diag(1j * system.omega * order)
    real = _to_real(len(harmonics))
    to_real, back = (each[place[:, None], place] * (state[:, None] == state) for each in (real, np.linalg.inv(real)))
    whole_a = to_real @ hill @ back
    whole_b, whole_rate = (to_real @ each[most + order, state] for each in (b, rate))
    whole_c = c[most - order, :, state].T @ back
    return _felt(
        whole_a.real,
        whole_b.real,
        whole_c.real,
        complex_harmonics(system.d, 0)[0].real,
        whole_rate.real,
        tuple((f"{system.states[i][0]}{labels[k][1]}", system.states[i][1]) for k, i in zip(place, state, strict=True)),
        harmonic[acts],
    )


def _acting(system: PeriodicSystem, harmonic: np.ndarray) -> np.ndarray:
    """Which harmonics of which states constant inputs excite; all where states are those of single blades."""
    sign, n = np.diag(system.renumbering), system.passages
    slow = np.tile(np.arange(sign.size) >= sign.size - system.slow, harmonic.size // sign.size)
    moves = ~slow | (harmonic == 0)
    if not np.array_equal(np.diag(sign), system.renumbering):
        return np.asarray(moves)
    own = np.tile(np.where(sign < 0, n // 2, 0), harmonic.size // sign.size)
    found: np.ndarray = moves & ((np.abs(harmonic) - own) % n == 0)
    return found


def _to_real(n: int) -> np.ndarray:
    """z_0, then (z_nc, z_ns) of every harmonic by z_0, then (z_n, z_-n): z_nc = z_n + z_-n, z_ns = i (z_n - z_-n)."""
    whole = np.zeros((2 * n + 1, 2 * n + 1), complex)
    whole[0, 0] = 1.0
    for k in range(n):
        i = 1 + 2 * k
        whole[i : i + 2, i : i + 2] = [[1.0, 1.0], [1j, -1j]]
    return whole


def default_harmonics(n_blades: int, most: int = 0) -> tuple[int, ...]:
    """Harmonics that occur with equal blades: the blades' number, its half where a differential coordinate changes sign.

    Two of them, and those up to `most`.
    """
    first = n_blades // 2 if n_blades % 2 == 0 else n_blades
    return tuple(range(first, max(2 * first, most) + 1, first))
