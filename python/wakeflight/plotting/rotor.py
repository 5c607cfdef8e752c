# SPDX-License-Identifier: MIT OR Apache-2.0
"""The main rotor's hub loads over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from .histories import Panel, histories
from .style import styled

if TYPE_CHECKING:
    from .histories import Runs

CAPTION = (
    "Main rotor loads at the hub centre in hub axes (x aft, y right, z up along the shaft), blade inertia"
    " and weight included. The moment about z is minus the shaft torque. Lines are means over one revolution."
)
PANELS = (
    Panel("hub_force", "$F_x$, aft [kN]", 1e-3, "x", span=1.0, vibrates=True),
    Panel("hub_force", "$F_y$, right [kN]", 1e-3, "y", span=1.0, vibrates=True),
    Panel("hub_force", "$F_z$, up [kN]", 1e-3, "z", span=5.0, vibrates=True),
    Panel("hub_moment", "$M_x$ [kN m]", 1e-3, "x", span=1.0, vibrates=True),
    Panel("hub_moment", "$M_y$ [kN m]", 1e-3, "y", span=1.0, vibrates=True),
    Panel("hub_moment", "$M_z$ [kN m]", 1e-3, "z", span=1.0, vibrates=True),
)


@styled
def figure(runs: Runs, units: str = "si") -> Figure:
    """Hub force and moment of one run or several."""
    return histories(runs, PANELS, "Main rotor loads at the hub, hub axes", units=units)
