# SPDX-License-Identifier: MIT OR Apache-2.0
"""Attitude quickness: peak rate over peak change of attitude after a pulse of the stick [ads33e2000, 3.3.3]."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import InputError

ONSET = 0.05
"""Share of the largest rate by which the answer has begun."""


def quickness(time: Any, rate: Any, attitude: Any) -> tuple[float, float, float]:
    """Quickness [1/s], peak and least change of attitude [rad], from histories after a pulse; of a flight as of a model.

    time [s], rate [rad/s], attitude [rad], each (n,). The peak change is where the rate first goes back through zero, or at the
    end where it does not; the least change is the smallest one after the peak.
    """
    t, p, change = (np.asarray(each, dtype=float) for each in (time, rate, attitude))
    if t.ndim != 1 or t.size < 3 or p.shape != t.shape or change.shape != t.shape:
        raise InputError.of(
            "quickness", f"arrays of shape {t.shape}, {p.shape}, {change.shape}", "must be equally long histories"
        )
    change, p = change - change[0], p - p[0]
    onset = int(np.argmax(np.abs(p) >= ONSET * np.abs(p).max()))
    side = np.sign(p[onset])
    if side == 0.0:
        raise InputError.of("rate", "does not move", "must answer the pulse")
    change, p = side * change, side * p
    back = np.flatnonzero(p[onset:] <= 0.0)
    i = onset + int(back[0]) if back.size else t.size - 1
    return float(p[: i + 1].max() / change[i]), float(change[i]), float(change[i:].min())
