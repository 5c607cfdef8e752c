# SPDX-License-Identifier: MIT OR Apache-2.0
"""Tip vortices seen from the side, from above and from behind, at the snapshots of a run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from ..results import frames
from ..results.turns import revolutions
from . import disk, style
from .style import styled

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

CAPTION = (
    "Tip vortices in hub axes, in rotor radii: side view (nose left), from above (nose left, advancing "
    "side at the top) and from behind. Blade 1's vortex is coloured by its circulation, the others are thin, blades are black; "
    "the rotor's plane is the grey line or circle. Rows: trim, and the revolutions where the load stands farthest from it."
)
ALL_CAPTION = (
    "Tip vortices of all blades at the end of the flight, each in its own colour, in hub axes and rotor radii."
)
# (title, horizontal component, vertical component, labels)
VIEWS = (
    ("side", "x", "z", "$x_h/R$, aft", "$z_h/R$, up"),
    ("top", "x", "y", "$x_h/R$, aft", "$y_h/R$, right"),
    ("rear", "y", "z", "$y_h/R$, right", "$z_h/R$, up"),
)


@styled
def figure(run: xr.Dataset, snapshots: Sequence[int] | None = None, all_blades: bool = False) -> Figure:
    """Side, top and rear view of tip vortices and blades, one row per snapshot, one scale; see `CAPTION`."""
    chosen = _eventful(run) if snapshots is None else list(snapshots)
    wake = run["wake"].isel(snapshot=chosen) / float(run.attrs["radius"])
    limits = {c: extent(wake.sel(xyz=c).values, c) for c in ("x", "y", "z")}
    widths = [limits[across][1] - limits[across][0] for _, across, _, _, _ in VIEWS]
    tall = max(limits["y"][1] - limits["y"][0], limits["z"][1] - limits["z"][0])
    scale = 8.0 / sum(widths)
    figure = style.blank(len(chosen) * (tall * scale + 0.75) + 0.8, width=9.6)
    grid = figure.subplots(len(chosen), 3, squeeze=False, width_ratios=widths)
    strength = run["wake_circulation"].isel(snapshot=chosen, blade=0).values if "wake_circulation" in run else None
    norm = Normalize(*style.robust(strength)) if strength is not None else None
    for row, k in enumerate(chosen):
        blades = _blades(run, k)
        for column, (title, across, upward, x_label, y_label) in enumerate(VIEWS):
            axes = grid[row, column]
            _rotor(axes, title)
            for blade in range(wake.sizes["blade"]):
                line = wake.isel(snapshot=row, blade=blade)
                points = np.stack([line.sel(xyz=across), line.sel(xyz=upward)], axis=1)
                color = style.COLORS[blade % len(style.COLORS)]
                if all_blades:
                    axes.plot(*points.T, color=color, linewidth=1.0, zorder=2, label=f"blade {blade + 1}")
                elif blade > 0:
                    axes.plot(*points.T, color="#BBBBBB", linewidth=0.5, zorder=2)
                elif norm is None or strength is None:
                    axes.plot(*points.T, color=style.COLORS[0], linewidth=1.4, zorder=3)
                else:
                    axes.add_collection(_coloured(points, strength[row], norm))
            for ends in blades:
                axes.plot(
                    ends[:, "xyz".index(across)], ends[:, "xyz".index(upward)], color="black", linewidth=1.8, zorder=4
                )
            axes.set(xlim=limits[across], ylim=limits[upward], xlabel=x_label, ylabel=y_label)
            axes.set_aspect("equal")
            axes.set_title(title if column else f"revolution {_revolution(run, k):g}: {title}", loc="left")
    if all_blades:
        handles, labels = grid[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))
    elif norm is not None:
        bar = figure.colorbar(
            ScalarMappable(norm, style.SEQUENTIAL),
            ax=grid.ravel().tolist(),
            location="bottom",
            shrink=0.4,
            aspect=40,
            pad=0.02,
        )
        bar.set_label("circulation of blade 1's vortex [m²/s]")
    of = "all blades" if all_blades else "blade 1"
    figure.suptitle(f"Tip vortex geometry, {of}", fontsize=10, x=0.01, ha="left")
    return figure


def _coloured(points: np.ndarray, strength: np.ndarray, norm: Normalize) -> LineCollection:
    """A line (n, 2) coloured by what it carries at its nodes (n,)."""
    pieces = np.stack([points[:-1], points[1:]], axis=1)
    lines = LineCollection(pieces.tolist(), cmap=style.SEQUENTIAL, norm=norm, linewidths=1.8, zorder=3)
    lines.set_array((strength[1:] + strength[:-1]) / 2)
    return lines


def _blades(run: xr.Dataset, snapshot: int) -> np.ndarray:
    """Root and tip of every blade (blade, 2, 3) in hub axes over R; none where a run does not say how they stand."""
    if "geometry" not in run.attrs or "flap" not in run:
        return np.zeros((0, 2, 3))
    radius = float(run.attrs["radius"])
    shape = frames.geometry(run)
    row = int(np.argmin(np.abs(revolutions(run) - float(run["snapshot_revolution"][snapshot]))))
    azimuth, flap, lead = (run[name].values[row] for name in ("azimuth", "flap", "lead"))
    ends = np.array([shape["root_cutout"], radius])
    return frames.blade_points(shape, azimuth, flap, lead, ends, np.zeros(2)) / radius


def _eventful(run: xr.Dataset) -> list[int]:
    """Snapshots nearest to the start and to the eventful revolutions, at most four."""
    marks = run["snapshot_revolution"].values
    whole = [0.0, *disk.eventful(run, int(np.floor(disk.revolutions_flown(run) + 1e-3)))]
    if len(whole) == 1:
        return sorted({round(k) for k in np.linspace(0, marks.size - 1, min(marks.size, 4))})
    return sorted({int(np.argmin(np.abs(marks - n))) for n in whole})


def _revolution(run: xr.Dataset, snapshot: int) -> float:
    return round(float(run["snapshot_revolution"][snapshot]), 2)


def extent(values: np.ndarray, component: str) -> tuple[float, float]:
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
