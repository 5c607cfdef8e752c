# SPDX-License-Identifier: MIT OR Apache-2.0
"""The regime a rotor works in, and the wake options whose default depends on it: the same for trim, flight and stand.

In forward flight the wake is blown clear of the disk; in hover and climb it stays below it, and what lies below the turns kept
is felt; in axial descent the old end lies about the rotor.
"""

from __future__ import annotations

import math
from typing import Any

AXIAL_ADVANCE_RATIO = 0.03
"""Advance ratio below which a condition counts as axial: hover, climb or descent."""

REGIMES = {"forward": "forward", "hover": "hover and climb", "descent": "axial descent"}
"""Regimes by name, each in words."""

BY_REGIME: dict[str, dict[str, Any]] = {
    "turns": {"forward": 4.0, "hover": 5.0, "descent": 8.0},
    "far_wake_turns": {"forward": 0, "hover": 2, "descent": 0},
    "sheet_factor": {"forward": 1.0, "hover": 1.4, "descent": 1.0},
    "relaxation": {"forward": 0.5, "hover": 0.3, "descent": 0.3},
}
"""Wake options whose default depends on the regime: five free turns and two repeated ones in hover and climb; eight free turns,
none repeated, in axial descent. The same for every rotor."""

REVOLUTIONS = {"forward": (12, 4), "hover": (24, 12), "descent": (40, 20)}
"""Revolutions marched on the stand and, of them, the last ones averaged. Axial wakes do not become periodic: they need more."""


def regime(in_plane: float, climb: float, tip_speed: float) -> str:
    """Name of the regime of a rotor that moves through the air at `in_plane` in its disk and at `climb` up its shaft.

    Both speeds and the tip speed in one unit. Axial descent begins where the hub descends at all.
    """
    if math.fabs(in_plane) >= AXIAL_ADVANCE_RATIO * tip_speed:
        return "forward"
    return "descent" if -climb > 1e-6 * tip_speed else "hover"


def resolved(options: dict[str, Any], regime: str) -> dict[str, Any]:
    """Those of `options` that are None because their default depends on the regime, with the number of `regime`.

    No turns are repeated in any regime where a vortex cylinder closes the wake, or where trailers all over the span are
    free: their old end tumbles, and its repeats would drive it.
    """
    found = {name: BY_REGIME[name][regime] for name, value in options.items() if value is None and name in BY_REGIME}
    if "far_wake_turns" in found and (options["far_wake"] == "cylinder" or options["trailers"] == "full-span"):
        found["far_wake_turns"] = 0
    return found


def described(name: str) -> str:
    """The defaults of an option in words: `by regime: 4 forward, 5 hover and climb, 8 axial descent`."""
    return "by regime: " + ", ".join(f"{BY_REGIME[name][each]:g} {words}" for each, words in REGIMES.items())
