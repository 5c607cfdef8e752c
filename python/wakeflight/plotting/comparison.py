# SPDX-License-Identifier: MIT OR Apache-2.0
"""Several runs of one manoeuvre side by side: inflow maps and wakes by model, and what each model cost."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from . import style
from .disk import chosen_revolutions, revolution_map, rows_of_maps
from .style import styled

if TYPE_CHECKING:
    import xarray as xr

INFLOW_CAPTION = (
    "Induced inflow by model at the same revolutions, positive down; one colour scale. Nose left, "
    "advancing side at the top."
)
WAKE_CAPTION = "Blade 1's tip vortex from the side in hub axes, by model, at the last snapshot common to all."
COST_CAPTION = "Wall-clock time by phase and model."
PHASES = ("trim", "convergence", "wake", "dynamics")


@styled
def inflow_maps(runs: Mapping[str, xr.Dataset], revolutions: Sequence[float] | None = None) -> Figure:
    """Inflow maps, a row per run and a column per revolution, on one colour scale."""
    shortest = min(runs.values(), key=lambda run: float(run.time[-1]))
    when = [1.0, *chosen_revolutions(shortest, revolutions)]
    rows = [[revolution_map(run, "inflow", n) for n in when] for run in runs.values()]
    return rows_of_maps(
        rows,
        list(runs),
        ["revolution 1 (trim)", *(f"revolution {n:g}" for n in when[1:])],
        ["λ [–]"] * len(rows),
        [False] * len(rows),
        "Induced inflow over the disk by model, positive down",
    )


def wakes(runs: Mapping[str, xr.Dataset]) -> dict[str, xr.Dataset]:
    """The runs that have a wake."""
    return {name: run for name, run in runs.items() if "wake" in run}


@styled
def wake_side_views(runs: Mapping[str, xr.Dataset]) -> Figure:
    """Side views of blade 1's tip vortex, runs over each other, a panel per common snapshot."""
    runs = wakes(runs)
    marks = [np.round(run["snapshot_revolution"].values, 2) for run in runs.values()]
    common = sorted(set(marks[0]).intersection(*marks[1:]))
    if not common:
        raise ValueError("the runs have no wake snapshot in common")
    if len(common) > 4:
        common = [common[round(k)] for k in np.linspace(0, len(common) - 1, 4)]
    figure = style.blank(1.6 * len(common) + 0.7)
    grid = figure.subplots(len(common), 1, sharex=True, squeeze=False)[:, 0]
    for axes, mark in zip(grid, common, strict=True):
        axes.plot((-1, 1), (0, 0), color=style.GREY, linewidth=1.6)
        for (name, run), (color, line) in zip(runs.items(), style.looks(runs).values(), strict=True):
            k = int(np.argmin(np.abs(run["snapshot_revolution"].values - mark)))
            blade = run["wake"].isel(snapshot=k, blade=0) / float(run.attrs["radius"])
            axes.plot(blade.sel(xyz="x"), blade.sel(xyz="z"), color=color, linestyle=line, linewidth=1.0, label=name)
        axes.set_ylabel("$z_h/R$, up")
        axes.set_title(f"revolution {mark:g}", loc="left")
    low, high = (
        f(limits) for f, limits in zip((min, max), zip(*(a.get_ylim() for a in grid), strict=True), strict=True)
    )
    for axes in grid:
        axes.set(ylim=(low, high), aspect="equal")
    grid[-1].set_xlabel("$x_h/R$, aft (nose left)")
    handles, labels = grid[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(runs))
    figure.suptitle("Tip vortex of blade 1, side view", fontsize=10, x=0.01, ha="left")
    return figure


@styled
def cost(runs: Mapping[str, xr.Dataset]) -> Figure:
    """Stacked bars of the wall-clock seconds each phase took, one bar per run."""
    figure = style.blank(0.45 * len(runs) + 1.3)
    axes = figure.subplots()
    names = list(runs)[::-1]
    left = np.zeros(len(names))
    for phase, color in zip(PHASES, style.COLORS, strict=False):
        seconds = np.array([float(runs[name].attrs.get(f"seconds_{phase}", 0.0)) for name in names])
        axes.barh([style.plain(name) for name in names], seconds, left=left, color=color, label=phase, height=0.6)
        left += seconds
    for y, total in enumerate(left):
        axes.text(total, y, f" {total:.1f} s", va="center", fontsize=8)
    axes.set_xlabel("wall clock [s]")
    axes.margins(x=0.12)
    axes.grid(axis="y", visible=False)
    figure.legend(loc="outside lower center", ncols=len(PHASES))
    figure.suptitle("Cost by phase", fontsize=10, x=0.01, ha="left")
    return figure
