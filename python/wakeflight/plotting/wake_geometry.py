# SPDX-License-Identifier: MIT OR Apache-2.0
"""Tip vortices seen from the side, from above and from behind, at the snapshots of a run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from . import style
from .style import styled

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

CAPTION = (
    "Tip vortices in hub axes, in rotor radii: side view (nose left), from above (nose left, advancing "
    "side at the top) and from behind. The rotor's plane is the grey line or circle."
)
# (title, horizontal component, vertical component, labels)
VIEWS = (
    ("side", "x", "z", "$x_h/R$, aft", "$z_h/R$, up"),
    ("top", "x", "y", "$x_h/R$, aft", "$y_h/R$, right"),
    ("rear", "y", "z", "$y_h/R$, right", "$z_h/R$, up"),
)


@styled
def figure(run: xr.Dataset, snapshots: Sequence[int] | None = None, all_blades: bool = False) -> Figure:
    """Side, top and rear view of the first blade's tip vortex or of all, one row per snapshot, one scale."""
    chosen = list(range(run.sizes["snapshot"])) if snapshots is None else list(snapshots)
    if snapshots is None and len(chosen) > 4:
        chosen = sorted({round(k) for k in np.linspace(0, chosen[-1], 4)})
    wake = run["wake"].isel(snapshot=chosen)
    wake = (wake if all_blades else wake.isel(blade=slice(0, 1))) / float(run.attrs["radius"])
    limits = {c: _limits(wake.sel(xyz=c).values, c) for c in ("x", "y", "z")}
    widths = [limits[across][1] - limits[across][0] for _, across, _, _, _ in VIEWS]
    tall = max(limits["y"][1] - limits["y"][0], limits["z"][1] - limits["z"][0])
    scale = 8.0 / sum(widths)
    figure = style.blank(len(chosen) * (tall * scale + 0.75) + 0.4, width=9.6)
    grid = figure.subplots(len(chosen), 3, squeeze=False, width_ratios=widths)
    for row, k in enumerate(chosen):
        for column, (title, across, upward, x_label, y_label) in enumerate(VIEWS):
            axes = grid[row, column]
            _rotor(axes, title)
            for blade in range(wake.sizes["blade"]):
                line = wake.isel(snapshot=row, blade=blade)
                axes.plot(
                    line.sel(xyz=across),
                    line.sel(xyz=upward),
                    color=style.COLORS[blade % len(style.COLORS)],
                    linewidth=1.0,
                    zorder=2,
                    label=f"blade {blade + 1}",
                )
            axes.set(xlim=limits[across], ylim=limits[upward], xlabel=x_label, ylabel=y_label)
            axes.set_aspect("equal")
            axes.set_title(title if column else f"revolution {_revolution(run, k):g}: {title}", loc="left")
    if all_blades:
        handles, labels = grid[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))
    of = "all blades" if all_blades else "blade 1"
    figure.suptitle(f"Tip vortex geometry, {of}", fontsize=10, x=0.01, ha="left")
    return figure


def _revolution(run: xr.Dataset, snapshot: int) -> float:
    return round(float(run["snapshot_revolution"][snapshot]), 2)


def _limits(values: np.ndarray, component: str) -> tuple[float, float]:
    """Range common to all snapshots, with the rotor inside."""
    rotor = 0.1 if component == "z" else 1.05
    low, high = min(float(values.min()), -rotor), max(float(values.max()), rotor)
    margin = 0.03 * (high - low)
    return low - margin, high + margin


def _rotor(axes: Axes, view: str) -> None:
    """The rotor's plane: a line from the side, a circle from above; the hub as a dot."""
    around = np.linspace(0, 2 * np.pi, 121)
    if view == "top":
        axes.plot(np.cos(around), np.sin(around), color=style.GREY, linewidth=0.9, zorder=1)
    else:
        axes.plot((-1, 1), (0, 0), color=style.GREY, linewidth=1.6, zorder=1)
    axes.plot(0, 0, "o", color=style.GREY, markersize=3, zorder=1)
