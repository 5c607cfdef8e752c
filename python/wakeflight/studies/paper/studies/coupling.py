# SPDX-License-Identifier: MIT OR Apache-2.0
"""Coupling error: inflow held against extrapolated, at three steps of azimuth, in the first half of the arrested descent."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ....inflow import TimeMarchingWake
from ....plotting import style
from ....plotting.style import styled
from ..cases import Planned
from ..quantities import DEG, smoothed
from .finding import Finding

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    Runs = Mapping[str, xr.Dataset]

STEPS = (10.0, 5.0, 2.5)
REVOLUTIONS = 6.0
WAYS = {"held": False, "extrapolated": True}


def name(step: float, way: str) -> str:
    """Name of a flight."""
    return f"coupling/{step:g}-deg-{way}"


def cases() -> list[Planned]:
    """Every step held and extrapolated."""
    return [
        Planned(
            name(step, way),
            "arrested-descent",
            TimeMarchingWake.preset("paper", azimuth_step=f"{step:g} deg", extrapolate=extrapolate),
            12 * (10 / step) ** 2.5,
            revolutions=REVOLUTIONS,
        )
        for step in STEPS
        for way, extrapolate in WAYS.items()
    ]


def error(run: xr.Dataset, reference: xr.Dataset, variable: str) -> float:
    """RMS difference from the reference at the run's own instants, over the excursion of the reference."""
    values = np.interp(run.time.values, reference.time.values, smoothed(reference, variable))
    change = smoothed(reference, variable) - smoothed(reference, variable)[0]
    return float(np.sqrt(np.mean((smoothed(run, variable) - values) ** 2)) / np.abs(change).max())


VARIABLES = {"inflow_mean": "λ₀", "force_z": "Z", "q": "q"}


def finding(runs: Runs) -> Finding:
    """Difference from the finest extrapolated flight."""
    reference = runs[name(STEPS[-1], "extrapolated")]
    rows = []
    for step in STEPS:
        for way in WAYS:
            run = runs[name(step, way)]
            rows.append(
                [
                    f"{step:g}°, {way}",
                    f"{DEG * float(run['q'].values.max()):.3f}",
                    *(f"{100 * error(run, reference, v):.2f}" for v in VARIABLES),
                ]
            )
    apart = {step: error(runs[name(step, "held")], runs[name(step, "extrapolated")], "force_z") for step in STEPS}
    return Finding(
        "coupling",
        "Coupling error: held or extrapolated inflow",
        "Six revolutions of the arrested descent; the step of azimuth is that of coupling, wake and "
        "filaments at once, so the difference from the "
        "finest flight holds the error of all three; held against extrapolated at one step is the coupling alone.",
        figure(runs, reference),
        (
            "flight",
            "peak q [deg/s]",
            *(f"{label}: RMS difference from the finest [% of the excursion]" for label in VARIABLES.values()),
        ),
        rows,
        "Held against extrapolated changes the vertical force by "
        + ", ".join(f"{100 * x:.2f} % at {step:g}°" for step, x in apart.items())
        + " of its excursion.",
    )


@styled
def figure(runs: Runs, reference: xr.Dataset) -> Figure:
    """Differences by step."""
    figure = style.blank(2.8, width=9.6)
    for axes, (variable, label) in zip(figure.subplots(1, 3), VARIABLES.items(), strict=True):
        for way, color, mark in zip(WAYS, style.COLORS, "os", strict=False):
            steps = [s for s in STEPS if runs[name(s, way)] is not reference]
            axes.plot(
                steps,
                [100 * error(runs[name(s, way)], reference, variable) for s in steps],
                mark + "-",
                color=color,
                label=way,
            )
        axes.set(xlabel="step of azimuth [deg]", ylabel=f"{label}: difference [% of the excursion]")
        axes.set_xticks(STEPS, [f"{s:g}" for s in STEPS])
        axes.set_ylim(bottom=0.0)
        axes.legend()
    return figure
