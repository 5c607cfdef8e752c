# SPDX-License-Identifier: MIT OR Apache-2.0
"""Handling qualities: bandwidth and phase delay against limits, and the responses they are read from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from .style import COLORS, GREY, blank, styled

if TYPE_CHECKING:
    import xarray as xr

AXES = ("roll", "pitch", "yaw")
MARKS = (
    ("bandwidth_phase", "phase bandwidth", COLORS[1]),
    ("bandwidth_gain", "gain bandwidth", COLORS[2]),
    ("w_180", "-180 deg", COLORS[3]),
)
"""Frequencies drawn in the responses."""
STICKS = {"roll": "lateral", "pitch": "longitudinal", "yaw": "pedal"}


@styled
def bandwidth(models: Mapping[str, xr.Dataset], limits: Mapping[str, Any]) -> Figure:
    """Bandwidth and phase delay in roll, pitch and yaw of handling qualities by name, beside the limits."""
    figure = blank(3.0)
    panels = figure.subplots(1, 3, sharey=True)
    for axes, axis in zip(panels, AXES, strict=True):
        most, longest = 1.0, 0.2
        for i, (name, data) in enumerate(models.items()):
            here = data.sel(axis=axis)
            x, y = float(here["bandwidth"]), float(here["phase_delay"])
            if np.isfinite(x) and np.isfinite(y):
                axes.plot(x, y, "o", color=COLORS[i % len(COLORS)], label=name, zorder=3)
                most, longest = max(most, x), max(longest, y)
        if not axes.lines:
            axes.text(0.5, 0.5, "no bandwidth", transform=axes.transAxes, ha="center", va="center", color=GREY)
        bounds = limits["bandwidth"][axis]
        for (label, value), line in zip(bounds.items(), ("--", "-", ":"), strict=True):
            axes.axvline(value, color=GREY, ls=line, lw=0.9, label=label.replace("_", " ") if axis == "roll" else None)
        axes.set(xlim=(0.0, 1.2 * max(most, *bounds.values())), ylim=(0.0, 1.3 * longest), xlabel="bandwidth [rad/s]")
        axes.set_title(axis, loc="left")
    panels[0].set_ylabel("phase delay [s]")
    handles = {
        label: handle for axes in panels for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    figure.legend(
        handles.values(), handles.keys(), loc="outside lower center", ncols=4, title=f"lines: {limits['source']}"
    )
    return figure


@styled
def attitudes(responses: xr.Dataset, data: xr.Dataset) -> Figure:
    """Attitude by stick in roll, pitch and yaw, with the frequencies that the metrics are read at."""
    figure = blank(3.8)
    panels = figure.subplots(2, 3, sharex=True)
    w = responses["frequency"].values
    for (gain, phase), axis in zip(panels.T, AXES, strict=True):
        values, here = responses[axis].values, data.sel(axis=axis)
        angle = np.degrees(np.unwrap(np.angle(values)))
        angle -= 360.0 * np.round((np.interp(2.0, w, angle) + 90.0) / 360.0)
        gain.semilogx(w, 20 * np.log10(np.abs(values)), color=COLORS[0])
        phase.semilogx(w, angle, color=COLORS[0])
        for level in (-135.0, -180.0):
            phase.axhline(level, color=GREY, lw=0.7, ls=":")
        for name, label, color in MARKS:
            at = float(here[name])
            if w[0] <= at <= w[-1]:
                for axes in (gain, phase):
                    axes.axvline(at, color=color, lw=0.9, label=label if axes is gain else None)
        gain.set_title(f"{axis} by {STICKS[axis]}", loc="left")
        phase.set(xlabel="frequency [rad/s]", ylim=(max(-400.0, angle.min() - 10), min(200.0, angle.max() + 10)))
    panels[0, 0].set_ylabel("gain [dB re 1 rad/in]")
    panels[1, 0].set_ylabel("phase [deg]")
    handles = {label: h for axes in panels[0] for h, label in zip(*axes.get_legend_handles_labels(), strict=True)}
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=3)
    return figure
