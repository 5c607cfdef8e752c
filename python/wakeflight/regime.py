# SPDX-License-Identifier: MIT OR Apache-2.0
"""The regime a rotor works in: the same for trim, flight and stand.

In forward flight the wake is blown clear of the disk; at low speed it stays about it for turns and rolls up beside it; in hover
and climb it stays below it, and what lies below the turns kept is felt; in axial descent the old end lies about the rotor.
"""

from __future__ import annotations

import math

AXIAL_ADVANCE_RATIO = 0.03
"""Advance ratio below which a condition counts as axial: hover, climb or descent."""

LOW_ADVANCE_RATIO = 0.085
"""Advance ratio from which the wake is blown clear of the disk: two turns of far wake are enough. Below it a relaxation wake
circles about its answer at 25 to 35 kt of the UH-60A (0.06 to 0.08), a marching one becomes periodic."""

REGIMES = {"forward": "forward", "slow": "low speed", "hover": "hover and climb", "descent": "axial descent"}
"""Regimes by name, each in words."""

AXIAL = ("hover", "descent")
"""Regimes in which wakes do not become periodic."""

REVOLUTIONS = {"forward": (12, 4), "slow": (12, 4), "hover": (24, 12), "descent": (40, 20)}
"""Revolutions marched on the stand and, of them, the last ones averaged. Axial wakes do not become periodic: they need more."""


def regime(in_plane: float, climb: float, tip_speed: float) -> str:
    """Name of the regime of a rotor that moves through the air at `in_plane` in its disk and at `climb` up its shaft.

    Both speeds and the tip speed in one unit. Axial descent begins where the hub descends at all.
    """
    if math.fabs(in_plane) >= AXIAL_ADVANCE_RATIO * tip_speed:
        return "forward" if math.fabs(in_plane) >= LOW_ADVANCE_RATIO * tip_speed else "slow"
    return "descent" if -climb > 1e-6 * tip_speed else "hover"
