"""Inflow at trim by two models, side by side with their difference: the paper's Figure 3."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from . import style
from .disk import difference, draw, harmonics, mark_directions, tidy
from .style import styled

if TYPE_CHECKING:
    import xarray as xr

CAPTION = (
    "Induced inflow at trim by the relaxation wake, by the time-marching wake after its convergence "
    "phase, and their difference (marching less relaxation). λ₀ is the area mean, λ₁c and λ₁s the first "
    "harmonics. Nose left."
)


def from_run(run: xr.Dataset) -> Figure:
    """The figure from a run that kept the inflow of its trim and that at its start."""
    return figure(run["inflow_trim"], run["inflow_start"])


@styled
def figure(
    first: xr.DataArray,
    second: xr.DataArray,
    titles: tuple[str, str] = ("relaxation", "time marching"),
) -> Figure:
    """Two inflow maps (azimuth, station) on one colour scale, and second less first on its own about zero.

    The maps may differ in azimuth and stations: the second is brought to the first's by interpolation.
    """
    change = difference(second, first)
    limits = style.levels(first.values, second.values)
    figure = style.blank(3.4, width=8.4)
    axes = figure.subplots(1, 3)
    panels = (
        (first, titles[0], limits, style.SEQUENTIAL, "λ [–]"),
        (second, titles[1], limits, style.SEQUENTIAL, "λ [–]"),
        (change, "difference", style.levels(change.values, symmetric=True), style.DIVERGING, "Δλ [–]"),
    )
    for axis, (field, title, span, cmap, label) in zip(axes, panels, strict=True):
        filled = draw(axis, field, span, cmap)
        mark_directions(axis)
        mean, f_1c, f_1s = harmonics(field)
        axis.set_title(f"{title}\nλ₀ {mean:.4f}  λ₁c {f_1c:.4f}  λ₁s {f_1s:.4f}")
        tidy(figure.colorbar(filled, ax=axis, orientation="horizontal", shrink=0.8, pad=0.02), label, span)
    return figure
