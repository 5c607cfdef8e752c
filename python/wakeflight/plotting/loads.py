# SPDX-License-Identifier: MIT OR Apache-2.0
"""Forces and moments on the airframe over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from .histories import Panel, histories
from .style import styled

if TYPE_CHECKING:
    from .histories import Runs

CAPTION = (
    "All loads on the airframe except gravity, in body axes at the fixed body origin: rotor hub, "
    "fuselage, tail surfaces, tail rotor. Z is positive down, so lift is negative Z; M is positive nose "
    "up, L right side down. Lines are means over one revolution, the loads themselves lie lightly behind them."
)
PANELS = (
    Panel("force_x", "X [kN]", 1e-3, span=1.0, vibrates=True),
    Panel("force_y", "Y [kN]", 1e-3, span=1.0, vibrates=True),
    Panel("force_z", "Z [kN]", 1e-3, span=5.0, vibrates=True),
    Panel("moment_x", "L [kN m]", 1e-3, span=1.0, vibrates=True),
    Panel("moment_y", "M [kN m]", 1e-3, span=1.0, vibrates=True),
    Panel("moment_z", "N [kN m]", 1e-3, span=1.0, vibrates=True),
)


@styled
def figure(runs: Runs, units: str = "si") -> Figure:
    """X Y Z and L M N of one run or several."""
    return histories(runs, PANELS, "Loads on the airframe except gravity, body axes", units=units)
