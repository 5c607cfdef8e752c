# SPDX-License-Identifier: MIT OR Apache-2.0
"""The whole comparison again with tip vortices of the largest bound circulation instead of the equivalent one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ....inflow import InflowModel, RelaxationWake, TimeMarchingWake
from ....plotting import style
from ....plotting.style import styled
from ..cases import MANEUVERS, MODELS, Planned
from ..drawings import LOOKS
from ..quantities import period, smoothed
from ..statements import descent, roll
from .finding import Finding, verdict_changes

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    Runs = Mapping[str, xr.Dataset]

WAKES: dict[str, InflowModel] = {
    "relaxation": RelaxationWake.preset("paper", tip_strength="max"),
    "time-marching": TimeMarchingWake.preset("paper", tip_strength="max"),
}


def cases() -> list[Planned]:
    """Both wakes in both manoeuvres; dynamic inflow has no tip vortex."""
    return [
        Planned(f"max/{maneuver}/{name}", maneuver, model, cost)
        for maneuver, cost in zip(MANEUVERS, (30, 80), strict=True)
        for name, model in WAKES.items()
    ]


def judged(runs: Runs, prefix: str = "") -> list[Any]:
    """Rows of Figures 3 to 19 with the wakes of `prefix`."""
    flights = {
        maneuver: {model: runs[f"{prefix if model != 'dynamic' else ''}{maneuver}/{model}"] for model in MODELS}
        for maneuver in MANEUVERS
    }
    return [*descent.statements(flights[MANEUVERS[0]]), *roll.statements(flights[MANEUVERS[1]])]


def finding(runs: Runs) -> Finding:
    """Which verdicts depend on the rule."""
    changed = verdict_changes(judged(runs), judged(runs, "max/"))
    trim = {rule: runs[f"{rule}arrested-descent/relaxation"] for rule in ("", "max/")}
    missed = {maneuver: runs[f"max/{maneuver}/relaxation"].attrs for maneuver in MANEUVERS}
    missed_text = ", ".join(
        f"{int(a['unconverged_revolutions'])} of {int(a['relaxation_updates'])} revolutions of the "
        f"{m.replace('-', ' ')}"
        for m, a in missed.items()
    )
    return Finding(
        "strength",
        "Strength of the tip vortex",
        "The four flights with a wake again, the tip vortex as strong as the largest bound circulation of "
        "the outer half, the "
        "literal reading of common practice; nothing else changed. Rows of the table are the statements "
        "of Figures 3 to 19 whose "
        "verdict differs.",
        figure(runs),
        ("statement", "equivalent", "max"),
        [list(row) for row in changed] or [["none", "–", "–"]],
        f"{len(changed)} of {len(judged(runs))} verdicts depend on the rule. Mean inflow at trim goes from "
        f"{float(trim[''].inflow_mean[0]):.4f} to {float(trim['max/'].inflow_mean[0]):.4f}, power by "
        f"{100 * (float(trim['max/'].attrs['power']) / float(trim[''].attrs['power']) - 1):+.0f} %; the "
        f"relaxation loop does not "
        f"converge within its cap in {missed_text}.",
    )


@styled
def figure(runs: Runs) -> Figure:
    """Mean inflow of both wakes under both rules, beside dynamic inflow."""
    figure = style.blank(4.4)
    for axes, maneuver in zip(figure.subplots(2, 1), MANEUVERS, strict=True):
        for model in MODELS:
            run = runs[f"{maneuver}/{model}"]
            axes.plot(run.time.values / period(run), smoothed(run, "inflow_mean"), label=model, **LOOKS[model])
            if model in WAKES:
                run = runs[f"max/{maneuver}/{model}"]
                look = {**LOOKS[model], "linewidth": 0.8, "alpha": 0.7}
                axes.plot(run.time.values / period(run), smoothed(run, "inflow_mean"), label=f"{model}, max", **look)
        axes.set(ylabel="λ₀ [–], down +", title=maneuver.replace("-", " "))
        axes.margins(x=0)
    axes.set_xlabel("rotor revolutions")
    axes.legend(ncols=2)
    return figure
