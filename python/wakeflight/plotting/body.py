# SPDX-License-Identifier: MIT OR Apache-2.0
"""Body velocities, rates and attitude over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from .histories import DEG, Panel, histories
from .style import styled

if TYPE_CHECKING:
    from .histories import Runs

CAPTION = "Body states: velocities at the body origin along x forward, y right, z down; rates; 3-2-1 attitude."
PANELS = (
    Panel("u", "u [m/s]", span=1.0),
    Panel("v", "v [m/s]", span=1.0),
    Panel("w", "w [m/s]", span=1.0),
    Panel("p", "p [deg/s]", DEG, span=2.0),
    Panel("q", "q [deg/s]", DEG, span=2.0),
    Panel("r", "r [deg/s]", DEG, span=2.0),
    Panel("roll", "roll [deg]", DEG, span=2.0),
    Panel("pitch", "pitch [deg]", DEG, span=2.0),
    Panel("yaw", "yaw [deg]", DEG, span=2.0),
)


@styled
def figure(runs: Runs, units: str = "si") -> Figure:
    """Nine body states of one run or several: u v w, p q r, roll pitch yaw."""
    return histories(runs, PANELS, "Body states (x forward, y right, z down)", columns=3, units=units)
