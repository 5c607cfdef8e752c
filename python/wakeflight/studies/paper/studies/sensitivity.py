# SPDX-License-Identifier: MIT OR Apache-2.0
"""Conclusions against the numbers of the wake: cores, turns, near wake, inboard wake; the arrested descent."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ....inflow import RelaxationWake, TimeMarchingWake
from ....plotting import style
from ....plotting.style import styled
from ..cases import Planned
from ..quantities import change_from_trim, extreme, sector_mean
from ..statements import descent
from ..statements.conclusions import lag
from .finding import Finding, verdict_changes

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    Runs = Mapping[str, xr.Dataset]

VARIANTS: dict[str, dict[str, Any]] = {
    "core 0.01 R": {"core_radius": 0.01},
    "core 0.05 R": {"core_radius": 0.05},
    "growth 1e-4": {"core_growth": 1e-4},
    "3 turns": {"turns": 3.0},
    "6 turns": {"turns": 6.0},
    "near wake 60°": {"near_wake_angle": "60 deg", "near_wake_segments": 12},
    "inboard sheet": {"inboard_wake": "sheet"},
}


def cases() -> list[Planned]:
    """Both wakes with each variant."""
    return [
        Planned(
            f"wake/{name.replace(' ', '-').replace('°', '-deg')}/{model.name}",
            "arrested-descent",
            model.preset("paper", **options),
            25,
        )
        for name, options in VARIANTS.items()
        for model in (RelaxationWake, TimeMarchingWake)
    ]


def pairs(runs: Runs) -> dict[str, dict[str, xr.Dataset]]:
    """Relaxation and time marching by variant, the default first."""
    found = {"default": {m: runs[f"arrested-descent/{m}"] for m in ("relaxation", "time-marching")}}
    for name in VARIANTS:
        folder = f"wake/{name.replace(' ', '-').replace('°', '-deg')}"
        found[name] = {m: runs[f"{folder}/{m}"] for m in ("relaxation", "time-marching")}
    return found


def measures(pair: Mapping[str, xr.Dataset]) -> list[float]:
    """Peak force of relaxation over that of marching, lag, and the difference of mean inflow in revolution 6 over its change."""
    peak = [extreme(pair[m], "force_z", -1.0)[0] for m in ("relaxation", "time-marching")]
    change = [sector_mean(change_from_trim(pair[m], "inflow", 6.0)) for m in ("relaxation", "time-marching")]
    return [
        peak[0] / peak[1],
        lag(pair["relaxation"], pair["time-marching"], "inflow_mean"),
        change[0] / change[1],
    ]


HEAD = (
    "wake",
    "peak −ΔZ, relaxation over marching",
    "lag of relaxation [rev]",
    "mean Δλ in revolution 6, relaxation over marching",
    "λ₀ at trim",
    "not converged",
    "verdicts that change",
)


def finding(runs: Runs) -> Finding:
    """What moves and what does not."""
    found, rows = pairs(runs), []
    dynamic = runs["arrested-descent/dynamic"]
    base = descent.statements({"dynamic": dynamic, **found["default"]})
    for name, pair in found.items():
        changed = verdict_changes(base, descent.statements({"dynamic": dynamic, **pair}))
        peak, late, change = measures(pair)
        attrs = pair["relaxation"].attrs
        rows.append(
            [
                name,
                f"{peak:.3f}",
                f"{late:.2f}",
                f"{change:.3f}",
                f"{float(pair['relaxation'].inflow_mean[0]):.4f}",
                f"{int(attrs['unconverged_revolutions'])} of {int(attrs['relaxation_updates'])}",
                "; ".join(f"{key}: {b}" for key, _, b in changed) or "none",
            ]
        )
    spread = np.array([measures(pair) for pair in found.values()])
    return Finding(
        "sensitivity",
        "Core, length, near wake and inboard wake",
        "The arrested descent with both wakes, one number of the wake changed at a time, trim included.",
        figure(found),
        HEAD,
        rows,
        f"Over all variants relaxation's peak force is {spread[:, 0].min():.2f} to "
        f"{spread[:, 0].max():.2f} times that of time marching, its lag "
        f"{spread[:, 1].min():.2f} to {spread[:, 1].max():.2f} revolutions, and its mean change of inflow "
        f"in revolution 6 "
        f"{spread[:, 2].min():.2f} to {spread[:, 2].max():.2f} times as large.",
    )


@styled
def figure(found: Mapping[str, Mapping[str, xr.Dataset]]) -> Figure:
    """The three measures by variant."""
    figure = style.blank(2.9, width=9.6)
    names = list(found)
    numbers = np.array([measures(found[name]) for name in names])
    labels = (
        "peak −ΔZ,\nrelaxation over marching [–]",
        "lag of relaxation [rev]",
        "mean Δλ, revolution 6,\nrelaxation over marching [–]",
    )
    grid = figure.subplots(1, 3, sharey=True)
    for k, (axes, label) in enumerate(zip(grid, labels, strict=True)):
        axes.plot(numbers[:, k], np.arange(len(names)), "o", color=style.COLORS[k])
        axes.axvline(numbers[0, k], color=style.GREY, linewidth=0.8, linestyle="--")
        axes.set_xlabel(label)
    grid[0].set_yticks(np.arange(len(names)), names)
    grid[0].invert_yaxis()
    return figure
