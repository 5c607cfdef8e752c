# SPDX-License-Identifier: MIT OR Apache-2.0
"""Tilt of the rotor disk over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from .histories import DEG, Panel, histories
from .style import styled

if TYPE_CHECKING:
    from .histories import Runs

CAPTION = (
    "First flap mode by the multiblade transform, β = β₀ + β₁c cos ψ + β₁s sin ψ: β₁c > 0 is disk "
    "forward-down, β₁s > 0 is advancing side up. Lines are means over one revolution."
)
PANELS = (
    Panel("beta_1c", "β₁c [deg]\n(+ forward-down)", DEG, span=1.0, vibrates=True),
    Panel("beta_1s", "β₁s [deg]\n(+ advancing side up)", DEG, span=1.0, vibrates=True),
)


@styled
def figure(runs: Runs, units: str = "si") -> Figure:
    """Longitudinal and lateral flapping of one run or several."""
    return histories(runs, PANELS, "Flapping of the first flap mode", height=2.2, units=units)
