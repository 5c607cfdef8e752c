# SPDX-License-Identifier: MIT OR Apache-2.0
"""Error estimates of a refined sequence: against the finest, and by Richardson extrapolation where it is entitled to be used.

With u_1, u_2, u_3 at sizes h, h/r, h/r^2 and u = U + C h^p: p = ln(|u_1 - u_2| / |u_2 - u_3|) / ln r, and
U = u_3 + (u_3 - u_2) / (r^p - 1) [roache1994]. A history counts as a vector.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

RATIO_TOLERANCE = 0.01
"""Largest relative difference of two refinement ratios that count as equal."""
LEAST_ORDER = 0.5
"""Below it a sequence falls too slowly to be extrapolated."""
ORDER_SLACK = 1.0
"""How far above the formal order an observed one may lie: the next term of the series may still lead."""
LEAST_ALIGNMENT = 0.9
"""Least cosine between successive differences: in the asymptotic range they point the same way."""
STEADY = 0.5
"""Largest change of the order along a sequence of four."""
ROUND_OFF = 1e-9
"""Differences below this share of the quantity are those of iteration and arithmetic."""
NOTHING = 1e-12
"""A quantity or an error below it, in the units shown, is zero."""


@dataclass(frozen=True)
class Estimate:
    """Errors of one quantity at every setting, coarse to fine; `order` is None where none was found, `note` says why.

    error: norm (root of the mean square) of the estimated error at every setting, against the limit where there is an
    order, otherwise against the finest, whose own error is then not known: None. largest: the same, largest magnitude.
    """

    order: float | None
    note: str
    limit: np.ndarray
    error: list[float | None]
    largest: list[float | None]


def estimate(sizes: np.ndarray, samples: np.ndarray, formal_order: float | None) -> Estimate:
    """Estimate for `samples` (n_settings, n_instants) at `sizes` (n_settings,), descending to the finest.

    formal_order: order of the scheme as the size goes to zero; None where no power of the size is expected.
    """
    order, note = None, "no power of the size is expected"
    if formal_order is not None:
        order, note = observed_order(sizes, samples, formal_order)
    limit = samples[-1]
    if order is not None:
        triple = geometric(sizes)
        assert triple is not None
        ratio = sizes[triple[1]] / sizes[triple[2]]
        limit = samples[-1] + (samples[-1] - samples[triple[1]]) / (ratio**order - 1.0)
    known = len(sizes) if order is not None else len(sizes) - 1
    error: list[float | None] = [_norm(u - limit) for u in samples[:known]]
    largest: list[float | None] = [float(np.max(np.abs(u - limit))) for u in samples[:known]]
    missing: list[float | None] = [None] * (len(sizes) - known)
    return Estimate(order, note, limit, error + missing, largest + missing)


def observed_order(sizes: np.ndarray, samples: np.ndarray, formal_order: float) -> tuple[float | None, str]:
    """Observed order of the finest three settings in geometric ratio, or None; and the reason in words."""
    triple = geometric(sizes)
    if triple is None:
        return None, "no three settings in geometric ratio"
    order, note = _order(sizes, samples, triple, formal_order)
    coarser = geometric(sizes, triple[1])
    if order is not None and coarser is not None and coarser[1] == triple[0]:
        before, _ = _order(sizes, samples, coarser, formal_order)
        if before is None or abs(before - order) > STEADY:
            return None, "not in the asymptotic range: the order is not the same along the sequence"
        return order, "observed, steady over four settings"
    return order, note


def geometric(sizes: np.ndarray, last: int | None = None) -> tuple[int, int, int] | None:
    """Indices (coarse, middle, `last`) of three sizes in geometric ratio, the smallest there is; None where there is none."""
    last = len(sizes) - 1 if last is None else last
    for middle in range(last - 1, 0, -1):
        ratio = sizes[middle] / sizes[last]
        for coarse in range(middle - 1, -1, -1):
            if abs(sizes[coarse] / sizes[middle] / ratio - 1.0) < RATIO_TOLERANCE:
                return coarse, middle, last
    return None


def _order(
    sizes: np.ndarray, samples: np.ndarray, triple: tuple[int, int, int], formal_order: float
) -> tuple[float | None, str]:
    coarse, middle, fine = (samples[i] for i in triple)
    before, after = coarse - middle, middle - fine
    a, b = _norm(before), _norm(after)
    if max(a, b) <= max(ROUND_OFF * _norm(fine), NOTHING):
        return None, "does not depend on it"
    if b == 0.0 or a <= b:
        return None, "not in the asymptotic range: differences do not fall"
    if float(np.mean(before * after)) < LEAST_ALIGNMENT * a * b:
        return None, "not in the asymptotic range: differences change direction"
    order = math.log(a / b) / math.log(sizes[triple[0]] / sizes[triple[1]])
    if order < LEAST_ORDER:
        return None, "not in the asymptotic range: differences fall too slowly"
    if order > formal_order + ORDER_SLACK:
        return None, f"not in the asymptotic range: differences fall faster than order {formal_order:g} allows"
    return order, "observed"


def _norm(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
