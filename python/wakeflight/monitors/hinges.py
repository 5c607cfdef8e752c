# SPDX-License-Identifier: MIT OR Apache-2.0
"""Monitors of what blades and wakes may meet: the stops of the hinges, the ground."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from .monitor import Monitor, since


def stops(hinge: str, angle: np.ndarray, given: Mapping[str, Any], time: np.ndarray) -> Monitor:
    """Angles of the blades at a `hinge` (n_times, n_blades) [rad] against its stops, `given` with low, high [rad], either None.

    Share of the time that any blade lies on one; beyond a stop the number stands: the stop is in the equations.
    """
    low = -np.inf if given["low"] is None else given["low"]
    high = np.inf if given["high"] is None else given["high"]
    beyond = np.maximum(angle - high, low - angle)
    on_stop = np.asarray((beyond > 0.0).any(axis=1))
    span = f"{np.degrees(angle.min()):.2f} to {np.degrees(angle.max()):.2f} deg"
    ends = " to ".join("none" if each is None else f"{np.degrees(each):.4g}" for each in (given["low"], given["high"]))
    warning = None
    if on_stop.any():
        blade, share = int(np.argmax(beyond.max(axis=0))) + 1, 100.0 * float(on_stop.mean())
        what = f"blade {blade} pushes its {hinge} stop in by {np.degrees(beyond.max()):.2f} deg"
        warning = f"{what}; blades lie on it {share:.0f} % of the time{since(time, on_stop)}"
    return Monitor(f"{hinge} hinge", f"{span} (stops {ends} deg)", warning=warning)


def below_ground(share: np.ndarray) -> Monitor:
    """Share of the nodes of the tip vortices that are below the ground, in every wake that is kept (n_snapshots,).

    Their vortices are held in the plane, where they cancel with their images.
    """
    mean, most = 100.0 * float(share.mean()), 100.0 * float(share.max())
    return Monitor("nodes of the wake below the ground", f"{mean:.1f} % on average, {most:.1f} % at most")
