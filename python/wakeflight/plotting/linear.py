# SPDX-License-Identifier: MIT OR Apache-2.0
"""Linear models: modes in the complex plane, and frequency responses."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from .style import COLORS, GREY, blank, styled

if TYPE_CHECKING:
    import xarray as xr

SLOW = 5.0
"""Modes of the body are drawn beside those of all: slower than this [1/s]."""


@styled
def modes(found: xr.Dataset) -> Figure:
    """Eigenvalues of `LinearModel.modes()`: all of them, and those of the body with their names."""
    figure = blank(3.6)
    whole, body = figure.subplots(1, 2)
    root = found["eigenvalue"].values
    for axes in (whole, body):
        axes.axvline(0.0, color=GREY, lw=0.6)
        axes.set_xlabel("real part [1/s]")
    whole.plot(root.real, root.imag, "x", color=COLORS[0])
    whole.set_ylabel("imaginary part [1/s]")
    whole.set_title("all modes", loc="left")
    slow = np.flatnonzero(np.abs(root) < SLOW)
    lowest, highest = (0.0, 1.0) if not slow.size else (root[slow].imag.min(), max(root[slow].imag.max(), 0.1))
    for rank, i in enumerate(slow):
        color = COLORS[rank % len(COLORS)]
        label = f"{found['name'].values[i]}  {root[i].real:+.3f}" + (
            f" ± {root[i].imag:.3f}i" if root[i].imag > 1e-9 else ""
        )
        body.plot(root[i].real, root[i].imag, "x", ms=8, mew=1.8, color=color, label=label)
    body.set_ylim(lowest - 0.1 * highest, 1.15 * highest)
    body.margins(x=0.15)
    body.set_title("modes of the body", loc="left")
    if slow.size:
        figure.legend(loc="outside lower center", ncols=2)
    return figure


@styled
def responses(found: xr.Dataset) -> Figure:
    """Magnitude and phase of every pair in `LinearModel.frequency_response(...)`."""
    figure = blank(4.2)
    gain, phase = figure.subplots(2, 1, sharex=True)
    w = found["frequency"].values
    pairs = [(y, u) for y in found["output"].values for u in found["input"].values]
    for i, (output, stick) in enumerate(pairs):
        part = found.sel(output=output, input=stick)
        color = COLORS[i % len(COLORS)]
        gain.semilogx(w, 20 * np.log10(part["magnitude"]), color=color, label=f"{output} by {stick}")
        phase.semilogx(w, np.degrees(part["phase"]), color=color)
    gain.set_ylabel("magnitude [dB]")
    phase.set(xlabel="frequency [rad/s]", ylabel="phase [deg]")
    figure.legend(loc="outside lower center", ncols=min(4, len(pairs)))
    return figure
