# SPDX-License-Identifier: MIT OR Apache-2.0
"""Inflow and section load of the baseline on five wakes: `python benchmarks/wake_defaults_figure.py FOLDER FILE.png`."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from wake_defaults_table import read

SHOWN = {
    "full-span": "full span, 12 trailers (judge)",
    "standard": "standard, 3 trailers (default)",
    "equivalent": "tip vortex, equivalent",
    "equivalent, sheet": "the same with sheet",
    "max": "tip vortex, max",
}
MAPS = {
    "inflow": (-0.03, 0.08, 0.02, r"inflow $\lambda$, down positive"),
    "cl_m2": (-0.02, 0.22, 0.05, r"$c_l M^2$"),
}


def main(folder: Path, path: Path) -> None:
    """Draw and save."""
    figure = Figure(figsize=(13.5, 5.6), layout="constrained")
    grid = figure.subplots(len(MAPS), len(SHOWN), subplot_kw={"projection": "polar"})
    for axes_row, (field, (low, high, tick, label)) in zip(grid, MAPS.items(), strict=True):
        for axes, (name, title) in zip(axes_row, SHOWN.items(), strict=True):
            case = read(folder, "baseline", name)
            closed = np.array([*case[field], case[field][0]])
            psi = np.linspace(0, 2 * np.pi, len(closed))
            levels = np.linspace(low, high, 23)
            filled = axes.contourf(psi, case["station"], closed.T, levels, cmap="viridis", extend="both")
            axes.set(xticks=[], yticks=[], ylim=(0, 1), title=title if field == "inflow" else "")
            axes.title.set_size(10)
        figure.colorbar(
            filled, ax=axes_row, shrink=0.8, label=label, ticks=tick * np.arange(np.ceil(low / tick), high // tick + 1)
        )
    figure.suptitle("Baseline descent in trim: nose left, advancing side at the top", fontsize=10)
    figure.savefig(path, dpi=80)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
