# SPDX-License-Identifier: MIT OR Apache-2.0
"""What tells whether the wake and the power behave: monitors over time, as far as the run has them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from .histories import Panel, as_mapping, histories
from .style import styled

if TYPE_CHECKING:
    from .histories import Runs

CAPTION = (
    "Power, thrust coefficient and monitors of the run (largest inflow of any station, share of the disk beyond stall over "
    "a passage of the blades, largest step of a wake node, odd-even content of the wake)."
)
PANELS = (
    Panel("power", "power [kW]", 1e-3, span=50.0, vibrates=True),
    Panel("ct", "$C_T$ [$10^{-3}$]", 1e3, span=0.5, vibrates=True),
    Panel("inflow_mean", "mean inflow λ₀ [–]", span=2e-3),
    Panel("inflow_max", "largest inflow [–]", span=0.02, vibrates=True),
    Panel("stalled_share", "stalled [% of disk]", 1e2, span=2.0),
    Panel("odd_even", "odd–even [R]", span=1e-6, vibrates=True, of_a_part=True),
    Panel("max_displacement", "node step [m]", vibrates=True, of_a_part=True),
    Panel("energy", "energy [kJ]", 1e-3),
)


def present(runs: Runs) -> tuple[Panel, ...]:
    """The panels whose variable every run has, but for those that are nothing in all: a wake's, of a run without one."""
    named = as_mapping(runs).values()
    return tuple(
        panel
        for panel in PANELS
        if all(panel.name in run for run in named) and any(bool(np.any(run[panel.name].values)) for run in named)
    )


@styled
def figure(runs: Runs, units: str = "si") -> Figure:
    """Monitors present in one run or in all of several."""
    panels = present(runs)
    if not panels:
        raise ValueError("no monitor is in the dataset")
    return histories(runs, panels, "Power, thrust and monitors", columns=min(2, len(panels)), units=units)
