# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pilot's sticks over time, in inches from their stops."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from .histories import Panel, histories
from .style import styled

if TYPE_CHECKING:
    from .histories import Runs

CAPTION = "Stick positions from their stops, as commanded."
PANELS = (
    Panel("collective", "collective [in]", span=1.0),
    Panel("longitudinal", "longitudinal [in]", span=1.0),
    Panel("lateral", "lateral [in]", span=1.0),
    Panel("pedal", "pedal [in]", span=1.0),
)


@styled
def figure(runs: Runs) -> Figure:
    """Collective, longitudinal, lateral and pedal of one run or several."""
    return histories(runs, PANELS, "Stick positions from the stop")
