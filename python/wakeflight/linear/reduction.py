# SPDX-License-Identifier: MIT OR Apache-2.0
"""Smaller linear models: quasi-static to named states, or balanced to any order; and up to which frequency they are good."""

from __future__ import annotations

import numpy as np

from ..errors import InputError, NumericalFailure
from .names import BODY, MOTION
from .response import Matrices, frequency_response

RIGID = ("u", "w", "q", "pitch", "v", "p", "roll", "r")
FLAPPING = ("flap_1_1c", "flap_1_1s")
KEPT: dict[int, tuple[str, ...]] = {
    6: ("u", "w", "q", "v", "p", "r"),
    8: RIGID,
    9: (*RIGID, "inflow_0"),
    10: (*RIGID, *FLAPPING),
}
"""States of the orders that have a meaning; 6 holds the attitude."""
ON_AXIS = (("lateral", "p"), ("longitudinal", "q"), ("collective", "w"), ("pedal", "r"))
"""Responses by which a reduced model is judged."""
GAIN_DB, PHASE_DEG = 2.0, 10.0
"""Largest differences from the full model up to the frequency to which a reduced one is called good."""
RANGE = np.geomspace(0.1, 60.0, 120)
"""Frequencies at which it is judged [rad/s]."""


def quasi_static(system: Matrices, kept: np.ndarray) -> Matrices:
    """The states `kept`, the others at once in the equilibrium that belongs to them: A_ss - A_sf A_ff^-1 A_fs ..."""
    a, b, c, d = system
    fast = np.setdiff1d(np.arange(a.shape[0]), kept)
    try:
        follow = np.linalg.solve(a[np.ix_(fast, fast)], np.hstack([a[np.ix_(fast, kept)], b[fast]]))
    except np.linalg.LinAlgError as reason:
        raise NumericalFailure(
            f"reduction: the states left out have no equilibrium of their own ({reason})"
        ) from reason
    by_state, by_input = np.split(follow, [kept.size], axis=1)
    return (
        a[np.ix_(kept, kept)] - a[np.ix_(kept, fast)] @ by_state,
        b[kept] - a[np.ix_(kept, fast)] @ by_input,
        c[:, kept] - c[:, fast] @ by_state,
        d - c[:, fast] @ by_input,
    )


def without(system: Matrices, left_out: np.ndarray) -> Matrices:
    """The system with some states held."""
    a, b, c, d = system
    kept = np.setdiff1d(np.arange(a.shape[0]), left_out)
    return a[np.ix_(kept, kept)], b[kept], c[:, kept], d


def balanced(system: Matrices, order: int, judged: np.ndarray) -> Matrices:
    """Balanced truncation to `order` states; what is not stable is kept as it is [moore1981].

    judged: outputs (of C's rows) by which states are weighed.
    """
    from scipy.linalg import schur, solve_continuous_lyapunov, solve_sylvester, svd

    a, b, c, d = system
    n = a.shape[0]
    triangle, basis, n_stable = schur(a, output="real", sort="lhp")
    if not n - n_stable <= order <= n:
        raise InputError.of("order", order, f"must lie between {n - n_stable}, the unstable states, and {n}")
    stable, unstable = slice(0, n_stable), slice(n_stable, n)
    coupling = solve_sylvester(triangle[stable, stable], -triangle[unstable, unstable], -triangle[stable, unstable])
    change, back = np.eye(n), np.eye(n)
    change[stable, unstable], back[stable, unstable] = coupling, -coupling
    b_split, c_split = back @ basis.T @ b, c @ basis @ change
    a_s, b_s, c_s = triangle[stable, stable], b_split[stable], c_split[:, stable]
    seen = c_s[judged]
    reach = solve_continuous_lyapunov(a_s, -b_s @ b_s.T)
    observe = solve_continuous_lyapunov(a_s.T, -seen.T @ seen)
    roots = [root_of(gramian) for gramian in (reach, observe)]
    left, sizes, right = svd(roots[1].T @ roots[0])
    k = order - (n - n_stable)
    if k and sizes[k - 1] <= 1e-14 * sizes[0]:
        raise InputError.of(
            "order",
            order,
            f"must be at most {n - n_stable + int(np.sum(sizes > 1e-14 * sizes[0]))}: no more states act",
        )
    scale = 1.0 / np.sqrt(sizes[:k])
    into, out = roots[0] @ right[:k].T * scale, (roots[1] @ left[:, :k] * scale).T
    small = np.zeros((order, order))
    small[:k, :k], small[k:, k:] = out @ a_s @ into, triangle[unstable, unstable]
    return (
        small,
        np.vstack([out @ b_s, b_split[unstable]]),
        np.hstack([c_s @ into, c_split[:, unstable]]),
        d,
    )


def root_of(gramian: np.ndarray) -> np.ndarray:
    """R with R R^T = gramian, by eigenvalues: gramians are singular to rounding."""
    value, vector = np.linalg.eigh(0.5 * (gramian + gramian.T))
    found: np.ndarray = vector * np.sqrt(np.clip(value, 0.0, None))
    return found


def good_to(full: Matrices, reduced: Matrices, pairs: list[tuple[int, int]]) -> float:
    """Frequency [rad/s] up to which (output, input) pairs of a reduced model are within 2 dB and 10 deg of the full one's.

    Zero where they are not at the lowest frequency judged, 0.1 rad/s; infinite where they are at the highest, 60.
    """
    whole, part = (frequency_response(each, RANGE) for each in (full, reduced))
    rows, columns = (list(each) for each in zip(*pairs, strict=True))
    ratio = part[:, rows, columns] / whole[:, rows, columns]
    off = (np.abs(20 * np.log10(np.abs(ratio))) > GAIN_DB) | (np.abs(np.degrees(np.angle(ratio))) > PHASE_DEG)
    first = np.flatnonzero(off.any(axis=1))
    if first.size == 0:
        return float("inf")
    return float(RANGE[first[0] - 1]) if first[0] else 0.0


def kept_states(order: int, names: tuple[str, ...]) -> tuple[str, ...] | None:
    """States of an order that has a meaning; None where it is one for balanced reduction."""
    kept = KEPT.get(order)
    if kept is None:
        return None
    missing = [name for name in kept if name not in names]
    if missing:
        raise InputError.of("order", order, f"keeps {', '.join(kept)}; this model has no {', '.join(missing)}")
    return kept


def is_attitude_held(order: int) -> bool:
    """Whether roll and pitch are held at this order: they have no equilibrium of their own."""
    return order == len(MOTION) < len(BODY)
