# SPDX-License-Identifier: MIT OR Apache-2.0
"""The path flown: from the side and from above."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from . import style
from .histories import as_mapping, looks_of
from .shown import shown
from .style import styled

if TYPE_CHECKING:
    from .histories import Runs

CAPTION = "Path of the body origin from the start: height gained over distance north, and seen from above. Dots: 1 s."


@styled
def figure(runs: Runs, units: str = "si") -> Figure:
    """Side view and plan view of one run's path or of several."""
    length, factor = shown("[m]", units)
    runs = as_mapping(runs)
    figure = style.blank(4.4)
    side, plan = figure.subplots(2, 1, sharex=True)
    for (name, run), (color, line) in zip(runs.items(), looks_of(runs), strict=True):
        time = run.time.values
        marks = np.searchsorted(time, np.arange(0.0, time[-1] + 1e-9))
        for axes, vertical in ((side, -run.down.values), (plan, run.east.values)):
            north, across = factor * run.north.values, factor * vertical
            axes.plot(north, across, color=color, linestyle=line, label=name)
            axes.plot(north[marks], across[marks], ".", color=color)
    side.set_ylabel(f"height gained {length}")
    plan.set(xlabel=f"north {length}", ylabel=f"east {length}")
    for axes in (side, plan):
        style.least_span(axes, 4.0 * factor)
    # seen from above with north to the right, east points down the page
    plan.invert_yaxis()
    if len(runs) > 1:
        handles, labels = side.get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=len(runs))
    figure.suptitle("Flight path from the start", fontsize=10, x=0.01, ha="left")
    return figure
