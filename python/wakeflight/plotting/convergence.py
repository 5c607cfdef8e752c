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
GROUPS_OF_A_TRIM = (
    ("power [hp]", ("power",)),
    ("thrust coefficient, inflow [–]", ("ct", "lambda_0", "lambda_1c", "lambda_1s")),
    ("sticks [in]", ("lateral", "longitudinal", "collective", "pedal")),
    ("angles [deg]", ("pitch", "roll", "beta_0", "beta_1c", "beta_1s")),
)
HISTORIES = ("w", "p", "q", "roll", "pitch", "force_z", "beta_1c")


@styled
def figure(study: xr.Dataset) -> Figure:
    """Error against cost, log-log: a panel per unit for a trim, root mean square and largest for a manoeuvre."""
    drawn = _histories(study) if "time" in study.dims else _values(study)
    drawn.suptitle(_title(study), fontsize=10, x=0.01, ha="left")
    return drawn


def _title(study: xr.Dataset) -> str:
    return str(study.attrs["title"]).split(": ")[0] + f": error against cost, {study.attrs['parameter']} varied"


def _values(study: xr.Dataset) -> Figure:
    if "power" not in study["quantity"]:
        drawn = style.blank(3.2)
        axes = drawn.subplots()
        names = [str(name) for name in study["quantity"].values]
        _curves(axes, study, "error", names, np.ones(len(names)))
        axes.set_ylabel(f"error [{study['unit'].values[0]}]")
        _finish([axes], [axes], study)
        return drawn
    drawn = style.blank(5.2)
    grid = drawn.subplots(2, 2, sharex=True)
    for axes, (label, names) in zip(grid.ravel(), GROUPS_OF_A_TRIM, strict=True):
        _curves(axes, study, "error", names, np.ones(len(names)))
        axes.set_ylabel(f"error, {label}")
    _finish(grid.ravel(), grid[-1], study)
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
    """A line per quantity that changes at all."""
    cost = study["cpu_seconds"].values
    for k, (name, scale) in enumerate(zip(names, scales, strict=True)):
        one = study.sel(quantity=name)
        known = (one["error_known"].values > 0) & (one[error].values > 1e-12) & (scale > 0)
        if not known.any():
            continue
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


def _finish(panels: Sequence[Axes], bottom: Sequence[Axes], study: xr.Dataset, legends: Sequence[Axes] = ()) -> None:
    from matplotlib.ticker import NullFormatter, ScalarFormatter

    cost = study["cpu_seconds"].values
    for axes in panels:
        axes.set(xscale="log", yscale="log", xlim=(0.75 * cost.min(), 1.35 * cost.max()))
        # the settings themselves are the marks of the axis above
        for seconds, label in zip(cost, study["setting"].values, strict=True):
            axes.axvline(seconds, color=style.GREY, linewidth=0.5, linestyle=":")
            axes.annotate(
                str(label),
                (seconds, 1.0),
                xycoords=("data", "axes fraction"),
                xytext=(1, -2),
                textcoords="offset points",
                rotation=90,
                va="top",
                fontsize=7,
                color=style.GREY,
            )
        if not legends and axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=7)
    for axes in legends:
        axes.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    for axes in bottom:
        axes.set_xlabel("processor time of the run [s]")
        axes.xaxis.set_major_formatter(ScalarFormatter())
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.set_xticks(_ticks(cost))


def _ticks(cost: np.ndarray) -> list[float]:
    """Round numbers (1, 2, 5) over the range of cost."""
    low, high = 0.75 * cost.min(), 1.35 * cost.max()
    decades = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
    ticks = [m * 10.0**d for d in decades for m in (1, 2, 5) if low <= m * 10.0**d <= high]
    return ticks or [float(f"{np.median(cost):.2g}")]
