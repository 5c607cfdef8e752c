# SPDX-License-Identifier: MIT OR Apache-2.0
"""Blade modes: shapes along the span, and the fan plot."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from . import style
from .histories import DEG
from .style import styled

SHAPES_CAPTION = (
    "Mode shapes in ascending order of frequency: flap (up) and lead (forward) per unit of the larger tip"
    " deflection, and elastic twist (nose up) in degrees at a tip deflection of 0.1 R (each on its own "
    "scale)."
)
FAN_CAPTION = (
    "Blade frequencies over rotor speed, named by what each mode mostly is at the nominal speed; dashed: harmonics of the rotor"
    " speed."
)


@styled
def shapes(
    station: np.ndarray,
    flap: np.ndarray,
    lead: np.ndarray,
    twist: np.ndarray,
    frequencies: Sequence[float] | np.ndarray,
    radius: float,
    names: Sequence[str] | None = None,
) -> Figure:
    """Mode shapes, a column per mode.

    station (n_stations,) r/R; flap, lead (n_modes, n_stations) [m] and twist (n_modes, n_stations) [rad] of
    each mode on one common scale; frequencies (n_modes,) [1/rev]; radius [m].
    """
    n_modes = len(frequencies)
    figure = style.blank(3.9, width=max(1.7 * n_modes, 5.0) + 0.6)
    grid = figure.subplots(2, n_modes, sharex=True, squeeze=False)
    for k in range(n_modes):
        tip = max(abs(flap[k][-1]), abs(lead[k][-1]))
        # a torsion mode hardly bends: without a bound by its twist, its scale would be noise
        scale = max(tip, float(np.max(np.abs(twist[k]))) * radius * 0.1)
        above, below = grid[:, k]
        above.plot(station, flap[k] / scale, color=style.COLORS[0], linestyle="-", label="flap, up")
        above.plot(station, lead[k] / scale, color=style.COLORS[1], linestyle="--", label="lead, forward")
        below.plot(
            station,
            DEG * twist[k] / scale * 0.1 * radius,
            color=style.COLORS[2],
            label="elastic twist, nose up",
        )
        name = f"{names[k]}\n" if names is not None else ""
        above.set_title(f"{name}{frequencies[k]:.3f}/rev")
        below.set_xlabel("r/R")
        for axes in (above, below):
            axes.axhline(0, color=style.GREY, linewidth=0.6)
            axes.set_xlim(0, 1)
        above.set_ylim(-1.05, 1.05)
        above.tick_params(labelleft=k == 0)
        style.least_span(below, 0.5)
    grid[0, 0].set_ylabel("deflection [–]")
    grid[1, 0].set_ylabel("twist at 0.1 R [deg]")
    handles = [*grid[0, 0].get_legend_handles_labels()[0], *grid[1, 0].get_legend_handles_labels()[0]]
    figure.legend(handles=handles, loc="outside lower center", ncols=3)
    figure.suptitle("Rotating blade modes", fontsize=10, x=0.01, ha="left")
    return figure


@styled
def fan_plot(
    speed: np.ndarray,
    frequencies: np.ndarray,
    names: Sequence[str] | None = None,
    reference: dict[str, tuple[np.ndarray, np.ndarray]] | None = None,
    n_harmonics: int = 8,
) -> Figure:
    """Frequencies [rad/s] (n_speeds, n_modes) over rotor speed [rad/s] (n_speeds,).

    Drawn in Hz over per cent of the last speed, the nominal one. `names`: what each mode is at that speed. `reference`: label ->
    (speed, frequency), both in rad/s, drawn as points.
    """
    nominal = float(speed[-1])
    figure = style.blank(4.2, width=7.2)
    axes = figure.subplots()
    percent = 100 * np.asarray(speed) / nominal
    top = 1.05 * float(np.max(frequencies)) / (2 * np.pi)
    for n in range(1, n_harmonics + 1):
        ray = n * np.asarray(speed) / (2 * np.pi)
        axes.plot(percent, ray, color=style.GREY, linestyle=(0, (4, 4)), linewidth=0.6)
        if ray[-1] < top:
            axes.text(101, ray[-1], f"{n}/rev", fontsize=7, color=style.GREY, va="center")
    for k in range(frequencies.shape[1]):
        label = f"{names[k] if names is not None else f'mode {k + 1}'}: {frequencies[-1, k] / nominal:.3f}/rev"
        axes.plot(percent, frequencies[:, k] / (2 * np.pi), color=style.COLORS[k % 7], label=label)
    for (label, (at, value)), marker in zip((reference or {}).items(), "os^Dv", strict=False):
        axes.plot(
            100 * np.asarray(at) / nominal,
            np.asarray(value) / (2 * np.pi),
            marker,
            color="black",
            markersize=3.5,
            fillstyle="none",
            label=style.plain(label),
        )
    axes.set(xlabel="rotor speed [% of nominal]", ylabel="frequency [Hz]", ylim=(0, top), xlim=(percent.min(), 108))
    figure.legend(loc="outside right upper")
    figure.suptitle("Fan plot", fontsize=10, x=0.01, ha="left")
    return figure
