# SPDX-License-Identifier: MIT OR Apache-2.0
"""Why a statement does not fully hold: what the data of the same runs show.

Numbers are computed from the runs; words that compare follow from them, and a cause is named only where
the data bear its premise.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from . import descent, reversal, text

if TYPE_CHECKING:
    from .words import Runs


def reason(key: str, runs: Runs) -> str:
    """The sentence for a row of the table; empty where none was found out."""
    make = REASONS.get(key)
    return make(runs) if make else ""


REASONS: dict[str, Callable[[Runs], str]] = {
    "Fig. 4": descent.roll_geometry,
    "Fig. 5b": descent.overshoot,
    "Fig. 5c": descent.moment_timing,
    "Fig. 6a": descent.climb,
    "Fig. 7b": descent.lateral_tilt,
    "Figs. 5–7, trim": descent.trims,
    "Fig. 8": descent.after_five,
    "Fig. 9": descent.after_five,
    "Fig. 10": descent.after_five,
    "Fig. 11": descent.equilibrium,
    "Fig. 12c": reversal.other_flight,
    "Fig. 13a": reversal.sideward,
    "Fig. 13b": reversal.never_right,
    "Fig. 13c": reversal.never_right,
    "Fig. 14a": reversal.flapping_apart,
    "Fig. 14b": reversal.flapping_apart,
    "Fig. 15": reversal.unloaded,
    "Fig. 16": reversal.unloaded,
    "Fig. 17": reversal.unloaded,
    "Fig. 18": reversal.unloaded,
    "Fig. 19": reversal.turning_helix,
    "text, condition": text.loading,
    "text, durations": text.lengths,
    "text, rates": text.rates,
    "cost, coupled": text.always_converges,
    "cost, over all": text.phase_cost,
    "conclusion 1": text.small_transient,
    "conclusion 2": text.sample_and_hold,
    "conclusion 3": text.sample_and_hold,
    "conclusion 4": text.phase_cost,
    "conclusion 5": text.already_apart,
}
