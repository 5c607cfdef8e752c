# SPDX-License-Identifier: MIT OR Apache-2.0
"""Every sentence of the paper that claims something, judged by the runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from . import conclusions, descent, numbers, roll
from .reasons import reason
from .verdict import HOLDS, NO_CLAIM, VERDICTS, Condition, Statement, counts

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["VERDICTS", "Condition", "Statement", "counts", "judge"]


def judge(runs: Mapping[str, xr.Dataset]) -> list[Statement]:
    """The table, with the reason where a statement does not fully hold; `runs` by case name."""
    by_model = {
        maneuver: {name.split("/")[1]: run for name, run in runs.items() if name.startswith(f"{maneuver}/")}
        for maneuver in ("arrested-descent", "roll-reversal")
    }
    table = [
        *numbers.statements(runs)[:1],
        *descent.statements(by_model["arrested-descent"]),
        *roll.statements(by_model["roll-reversal"]),
        *numbers.statements(runs)[1:],
        *conclusions.statements(runs),
    ]
    return [row if row.verdict in (HOLDS, NO_CLAIM) else replace(row, why=reason(row.key, runs)) for row in table]
