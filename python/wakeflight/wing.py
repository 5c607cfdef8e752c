# SPDX-License-Identifier: MIT OR Apache-2.0
"""A flat fixed wing by the blade's two models: what they must give where the answer is known."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from . import _core
from .errors import InputError
from .units import quantity, whole


class Wing(NamedTuple):
    """A solved wing; lengths in the unit of the span, circulation over the speed."""

    edges: np.ndarray
    """Edges of the elements along the span (n + 1,)."""
    stations: np.ndarray
    """Control points (n,)."""
    chords: np.ndarray
    """Chords at the control points (n,)."""
    circulation: np.ndarray
    """Bound circulation over the speed (n,)."""
    cl: float
    """Lift coefficient of the wing, over its own area."""


def wing(
    span: float,
    chord: float | Callable[[np.ndarray], np.ndarray],
    alpha: Any,
    blade_model: str = "weissinger",
    n: int = 40,
) -> Wing:
    """Untwisted wing with a straight quarter-chord line and a straight wake, sections of slope 2 pi.

    span, chord: in one unit of length; chord a number or a function of the place along the span, 0 in the middle.
    alpha: angle of attack, text with a unit. blade_model: `weissinger` or `lifting-line`. n: elements, in cosine spacing.
    """
    if not span > 0.0 or not np.isfinite(span):
        raise InputError.of("span", span, "must be a number above 0")
    n = whole("n", n, 2, 1000)
    if blade_model not in ("weissinger", "lifting-line"):
        raise InputError.of("blade_model", blade_model, "allowed: weissinger, lifting-line")
    edges = -0.5 * span * np.cos(np.pi * np.arange(n + 1) / n)
    stations = -0.5 * span * np.cos(np.pi * (np.arange(n) + 0.5) / n)
    chords = np.asarray(chord(stations) if callable(chord) else np.full(n, float(chord)), dtype=float)
    if chords.shape != (n,) or not np.all(np.isfinite(chords)) or not np.all(chords > 0.0):
        raise InputError.of("chord", "a number or function", "must be finite and above 0 along the span")
    gamma = _core.wing_circulation(
        edges, stations, chords, quantity(alpha, "rad", "alpha"), blade_model == "weissinger"
    )
    widths = np.diff(edges)
    return Wing(edges, stations, chords, gamma, float(2.0 * np.sum(gamma * widths) / np.sum(chords * widths)))
