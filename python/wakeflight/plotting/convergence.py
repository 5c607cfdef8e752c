# SPDX-License-Identifier: MIT OR Apache-2.0
"""Error against cost of the settings of a convergence study."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from . import style
from .style import styled

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

CAPTION = (
    "Estimated error of every setting against the processor time of its run. Solid with filled marks: against the limit, "
    "extrapolated with the observed order. Dashed with hollow marks: against the finest setting, whose own error is not known."
)
GROUPS = {
    "hp": "power [hp]",
    "1": "coefficients, inflow [–]",
    "in": "sticks [in]",
    "deg": "angles [deg]",
    "1/rev": "frequency [1/rev]",
}
HISTORIES = ("w", "p", "q", "roll", "pitch", "force_z", "beta_1c")


@styled
def figure(study: xr.Dataset) -> Figure:
    """Error against cost, log-log: a panel per unit for a trim, root mean square and largest for a manoeuvre."""
    drawn = _histories(study) if "time" in study.dims else _values(study)
    drawn.suptitle(_title(study), fontsize=10, x=0.01, ha="left")
    return drawn


def _title(study: xr.Dataset) -> str:
    return (
        style.plain(str(study.attrs["title"]).split(": ")[0])
        + f": error against cost, {study.attrs['parameter']} varied"
    )


def _values(study: xr.Dataset) -> Figure:
    units = [str(unit) for unit in study["unit"].values]
    present = [unit for unit in GROUPS if unit in units]
    columns = min(2, len(present))
    rows = -(-len(present) // columns)
    drawn = style.blank(2.6 * rows)
    grid = drawn.subplots(rows, columns, sharex=True, squeeze=False)
    for axes, unit in zip(grid.ravel(), present, strict=False):
        names = [str(name) for name, its in zip(study["quantity"].values, units, strict=True) if its == unit]
        _curves(axes, study, "error", names, np.ones(len(names)))
        axes.set_ylabel(f"error, {GROUPS[unit]}")
    for axes in grid.ravel()[len(present) :]:
        axes.set_visible(False)
    panels = list(grid.ravel())[: len(present)]
    _finish(panels, panels[-columns:], study)
    return drawn


def _histories(study: xr.Dataset) -> Figure:
    drawn = style.blank(3.6)
    grid = drawn.subplots(1, 2, sharex=True, sharey=True)
    scales = study["scale"].sel(quantity=list(HISTORIES)).values
    for axes, name, label in zip(grid, ("error", "error_largest"), ("root mean square", "largest"), strict=True):
        _curves(axes, study, name, HISTORIES, 0.01 * scales)
        axes.set_title(label, loc="left")
    grid[0].set_ylabel("error [% of the excursion]")
    _finish(grid, grid, study, legends=grid[-1:])
    return drawn


def _curves(axes: Axes, study: xr.Dataset, error: str, names: Sequence[str], scales: np.ndarray) -> None:
    """A line per quantity that changes at all; settings are named beside the uppermost points."""
    cost = study["cpu_seconds"].values
    top = np.zeros(cost.size)
    for k, (name, scale) in enumerate(zip(names, scales, strict=True)):
        one = study.sel(quantity=name)
        known = (one["error_known"].values > 0) & (one[error].values > 1e-12) & (scale > 0)
        if not known.any():
            continue
        top[known] = np.maximum(top[known], one[error].values[known] / scale)
        extrapolated = float(one["order"]) > 0
        label = f"{name}, order {float(one['order']):.1f}" if extrapolated else name
        axes.plot(
            cost[known],
            one[error].values[known] / scale,
            color=style.COLORS[k % len(style.COLORS)],
            linestyle="-" if extrapolated else "--",
            marker="os^Dv<>"[k % 7],
            markersize=4,
            markerfacecolor=style.COLORS[k % len(style.COLORS)] if extrapolated else "white",
            label=label,
        )
    for seconds, value, setting in zip(cost, top, study["setting"].values, strict=True):
        if value > 0.0:
            place, offset, rotation = ("data", "data"), (5, 3), 0
        else:  # the finest, whose error is not known: a line where its cost lies
            axes.axvline(seconds, color=style.GREY, linewidth=0.5, linestyle=":")
            place, offset, rotation, value = ("data", "axes fraction"), (1, 3), 90, np.float64(0.0)
        axes.annotate(
            str(setting),
            (seconds, value),
            xycoords=place,
            xytext=offset,
            textcoords="offset points",
            rotation=rotation,
            va="bottom",
            fontsize=7,
            color=style.GREY,
        )


def _finish(panels: Sequence[Axes], bottom: Sequence[Axes], study: xr.Dataset, legends: Sequence[Axes] = ()) -> None:
    from matplotlib.ticker import FixedLocator, NullLocator, ScalarFormatter

    cost = study["cpu_seconds"].values
    low, high = 0.75 * cost.min(), 1.6 * cost.max()
    for axes in panels:
        axes.set(xscale="log", yscale="log", xlim=(low, high))
        axes.margins(y=0.12)
        least, most = axes.get_ylim()
        if most < 10.0 * least:
            # whole decades, or the axis has no round number to read it by
            axes.set_ylim(10.0 ** np.floor(np.log10(least)), 10.0 ** np.ceil(np.log10(most)))
        axes.xaxis.set_major_locator(FixedLocator(_ticks(low, high)))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.xaxis.set_major_formatter(ScalarFormatter())
        if not legends and axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=7)
    for axes in legends:
        axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    for axes in bottom:
        axes.set_xlabel("processor time of the run [s]")


def _ticks(low: float, high: float) -> list[float]:
    """Round numbers between two costs: 1, 2, 5 of each decade, more of them in a narrow range."""
    decades = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
    for steps in ((1, 2, 5), (1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9)):
        ticks = [m * 10.0**d for d in decades for m in steps if low <= m * 10.0**d <= high]
        if len(ticks) >= 3:
            break
    return ticks
