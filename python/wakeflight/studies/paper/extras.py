# SPDX-License-Identifier: MIT OR Apache-2.0
"""Figures the paper does not have: the logged phases, the transient without a convergence phase, inflow and cost."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ...plotting import style
from ...plotting.histories import DEG
from ...plotting.style import styled
from . import cost
from .cases import CAPS, MANEUVERS, MODELS, UNTIL_CONVERGED, cap_name
from .drawings import LOOKS
from .quantities import period, smoothed
from .statements.conclusions import HANDS_OFF
from .statements.numbers import SETTLED, changes, phases

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    Runs = Mapping[str, xr.Dataset]

SEQUENCE_CAPTION = (
    "Figure 2 as logged: the phases of the arrested descent with the time-marching wake over "
    "wall clock, with the number of steps of each."
)
CONVERGENCE_CAPTION = (
    "The convergence phase. Left: change of the inflow between revolutions over its mean, states and controls "
    "frozen; the dashed line is the criterion. Middle and right: the first revolutions of the arrested "
    "descent flown with the phase and "
    "without it; before 2 revolutions no control moves."
)
INFLOW_CAPTION = "Mean induced inflow over the disk, averaged over a blade passage, in both manoeuvres."
CAPS_CAPTION = (
    "The relaxation wake under caps on its iterations. Left: revolutions that did not converge. Right: "
    "segment evaluations "
    "in flight over those of time marching."
)


@styled
def sequence(runs: Runs) -> Figure:
    """Phases of a flight over wall clock."""
    run = runs["arrested-descent/time-marching"]
    log = phases(run)
    begins = [at for _, _, at in log]
    ends = [*begins[1:], float(run.attrs["seconds_logged"])]
    figure = style.blank(0.5 * max(len(log), 1) + 1.0)
    axes = figure.subplots()
    for row, ((_, n, begin), end) in enumerate(zip(log, ends, strict=True)):
        axes.barh(row, end - begin, left=begin, color=style.COLORS[row % len(style.COLORS)], height=0.6)
        unit = "revolutions" if n else "outer iterations until the trim holds"
        axes.text(end, row, f"  {n:g} {unit}" if n else f"  {unit}", va="center", fontsize=8)
    axes.set_yticks(range(len(log)), [name for name, _, _ in log])
    axes.invert_yaxis()
    axes.set_xlabel("wall clock [s]")
    axes.margins(x=0.35)
    axes.grid(axis="y", visible=False)
    return figure


@styled
def convergence(runs: Runs) -> Figure:
    """Settling of the wake, and the flight's first revolutions with and without the phase."""
    settled, raw = runs["arrested-descent/time-marching"], runs["arrested-descent/no-convergence"]
    figure = style.blank(3.0, width=9.6)
    left, middle, right = figure.subplots(1, 3)
    change = changes(settled)
    left.semilogy(np.arange(1, len(change) + 1), change, "o-", color=style.COLORS[0], markersize=3)
    left.axhline(SETTLED, color=style.GREY, linestyle="--", linewidth=0.8)
    left.set(xlabel="revolution of the convergence phase", ylabel="change of inflow over its mean [–]")
    turn = period(settled)
    for name, run, color, line in (
        ("with convergence phase", settled, style.COLORS[2], "-"),
        ("without", raw, style.COLORS[1], "--"),
    ):
        inside = run.time.values <= 3 * turn
        revolutions = run.time.values[inside] / turn
        middle.plot(revolutions, run["force_z"].values[inside] / 1e3, color=color, linestyle=line, label=name)
        right.plot(revolutions, DEG * run["p"].values[inside], color=color, linestyle=line, label=f"p, {name}")
    middle.set(xlabel="rotor revolutions", ylabel="Z [kN], down +")
    right.set(xlabel="rotor revolutions", ylabel="p [deg/s], right side down +")
    for axes in (middle, right):
        axes.axvline(HANDS_OFF, color=style.GREY, linewidth=0.8, linestyle=":")
    figure.legend(*middle.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure


@styled
def inflow(runs: Runs) -> Figure:
    """Mean inflow of the three models, both manoeuvres."""
    figure = style.blank(4.4)
    for axes, maneuver in zip(figure.subplots(2, 1), MANEUVERS, strict=True):
        for model in MODELS:
            run = runs[f"{maneuver}/{model}"]
            axes.plot(run.time.values / period(run), smoothed(run, "inflow_mean"), label=model, **LOOKS[model])
        axes.set(ylabel="λ₀ [–], down +", title=maneuver.replace("-", " "))
        axes.margins(x=0)
    axes.set_xlabel("rotor revolutions")
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=len(MODELS))
    return figure


@styled
def caps(runs: Runs) -> Figure:
    """Relaxation under its caps."""
    figure = style.blank(2.7)
    left, right = figure.subplots(1, 2)
    names = [*(str(cap) for cap in CAPS), "until\nconverged"]
    for k, maneuver in enumerate(MANEUVERS):
        flights = [runs[cap_name(maneuver, cap)] for cap in (*CAPS, UNTIL_CONVERGED)]
        at = np.arange(len(flights)) + 0.36 * (k - 0.5)
        share = [
            100 * float(r.attrs["unconverged_revolutions"]) / float(r.attrs["relaxation_updates"]) for r in flights
        ]
        marched = runs[f"{maneuver}/time-marching"]
        ratio = [cost.work_ratio(run, marched) for run in flights]
        for axes, values, digits in ((left, share, "%.0f"), (right, ratio, "%.1f")):
            bars = axes.bar(at, values, width=0.34, color=style.COLORS[k], label=maneuver.replace("-", " "))
            # a bar of no height is told by its number
            axes.bar_label(bars, fmt=digits, fontsize=7)
    for axes in (left, right):
        axes.set_xticks(np.arange(len(names)), names)
        axes.set_xlabel("cap on iterations per revolution")
        axes.grid(axis="x", visible=False)
    left.set(ylabel="revolutions not converged [%]", ylim=(0, 100))
    right.axhline(1.0, color=style.GREY, linewidth=0.8, linestyle="--")
    right.set_ylabel("work over time marching [–]")
    right.margins(y=0.1)
    left.legend()
    return figure
