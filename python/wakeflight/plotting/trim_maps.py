# SPDX-License-Identifier: MIT OR Apache-2.0
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
    "Induced inflow at trim by the relaxation wake, by the time-marching wake in the first and the last "
    "revolution of its convergence phase, and their difference (marching less relaxation). "
    "λ₀ is the area mean, λ₁c and λ₁s the first harmonics. Nose left."
)


def from_run(run: xr.Dataset) -> Figure:
    """The figure from a run that kept the inflow of its trim, of the first revolution marched, and at its start."""
    trim, rows = run["inflow_trim"], []
    if "inflow_before" in run:
        rows.append((trim, run["inflow_before"], ("relaxation", "time marching, revolution 1")))
    revolutions = run.attrs.get("configuration.inflow.convergence_revolutions", "")
    after = f"time marching, revolution {revolutions}" if revolutions else "time marching"
    rows.append((trim, run["inflow_start"], ("relaxation", after)))
    return rows_figure(rows)


def figure(
    first: xr.DataArray,
    second: xr.DataArray,
    titles: tuple[str, str] = ("relaxation", "time marching"),
) -> Figure:
    """Two inflow maps (azimuth, station) on one colour scale, and second less first on its own about zero."""
    return rows_figure([(first, second, titles)])


@styled
def rows_figure(rows: list[tuple[xr.DataArray, xr.DataArray, tuple[str, str]]]) -> Figure:
    """A row per pair of inflow maps: first, second, second less first; the same scales in every row.

    The maps of a pair may differ in azimuth and stations: the second is brought to the first's by interpolation.
    """
    changes = [difference(second, first) for first, second, _ in rows]
    limits = style.levels(*(field.values for first, second, _ in rows for field in (first, second)))
    spans = style.levels(*(change.values for change in changes), symmetric=True)
    figure = style.blank(3.4 * len(rows), width=8.4)
    axes = figure.subplots(len(rows), 3, squeeze=False)
    for row, (first, second, titles), change in zip(axes, rows, changes, strict=True):
        panels = (
            (first, titles[0], limits, style.SEQUENTIAL, "λ [–]"),
            (second, titles[1], limits, style.SEQUENTIAL, "λ [–]"),
            (change, "difference", spans, style.DIVERGING, "Δλ [–]"),
        )
        for axis, (field, title, span, cmap, label) in zip(row, panels, strict=True):
            filled = draw(axis, field, span, cmap)
            mark_directions(axis)
            mean, f_1c, f_1s = harmonics(field)
            axis.set_title(f"{title}\nλ₀ {mean:.4f}  λ₁c {f_1c:.4f}  λ₁s {f_1s:.4f}")
            tidy(figure.colorbar(filled, ax=axis, orientation="horizontal", shrink=0.8, pad=0.02), label, span)
    return figure
