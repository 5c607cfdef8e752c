# SPDX-License-Identifier: MIT OR Apache-2.0
"""The second reading of the paper's condition: C_T/sigma = 0.071 as printed, at the altitude that gives it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ....plotting import histories
from ....plotting.histories import DEG, Panel
from ....plotting.style import styled
from ....units import convert
from ..cases import MODELS, Planned
from ..statements import descent
from .finding import Finding, verdict_changes

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    Runs = Mapping[str, xr.Dataset]

CONDITION = "ct-sigma-0071"
PRINTED = 0.071
"""C_T/σ in the paper."""
PANELS = (
    Panel("force_z", "Z [kN], down +", 1e-3),
    Panel("moment_y", "M [kN m], nose up +", 1e-3),
    Panel("w", "w [m/s], down +"),
    Panel("pitch", "θ [deg], nose up +", DEG),
)


def cases() -> list[Planned]:
    """The arrested descent with the three models."""
    return [
        Planned(f"{CONDITION}/{name}", "arrested-descent", model, 20, condition=CONDITION)
        for name, model in MODELS.items()
    ]


def finding(runs: Runs) -> Finding:
    """Which verdicts depend on the reading."""
    base = descent.statements({m: runs[f"arrested-descent/{m}"] for m in MODELS})
    flights = {m: runs[f"{CONDITION}/{m}"] for m in MODELS}
    changed = verdict_changes(base, descent.statements(flights))
    attrs = {"as flown": runs["arrested-descent/relaxation"].attrs, "as printed": flights["relaxation"].attrs}
    feet = [f"{convert(float(each['condition.altitude']), 'm', 'ft'):.0f} ft" for each in attrs.values()]
    return Finding(
        "loading",
        "The printed blade loading",
        f"The arrested descent at {feet[1]} instead of {feet[0]}, the weight the same: C_T/σ is printed as {PRINTED:g}.",
        figure(flights),
        ("statement", *feet),
        [list(row) for row in changed] or [["none", "–", "–"]],
        f"{len(changed)} of {len(base)} verdicts of Figures 3 to 11 depend on the reading; C_T/σ at trim "
        f"is {_loading(flights):.4f}.",
    )


@styled
def figure(flights: Runs) -> Figure:
    """Force, moment, velocity and attitude of the three models."""
    return histories.histories(flights, PANELS, f"Arrested descent at C_T/σ = {_loading(flights):.4f}", height=1.8)


def _loading(flights: Runs) -> float:
    return float(flights["relaxation"].attrs["ct_sigma"])
