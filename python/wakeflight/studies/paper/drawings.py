# SPDX-License-Identifier: MIT OR Apache-2.0
"""What the paper draws and no other report needs: maps of two models stacked, filaments of two models over each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...plotting import style
from ...plotting.disk import difference, draw, mark_directions, tidy
from ...plotting.style import styled
from ...plotting.wake_geometry import VIEWS, extent
from .quantities import axis_of, filament

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WAKES = ("relaxation", "time-marching")
# the colours the models have in histories of all three
LOOKS = {
    model: {"color": color, "linestyle": line} for model, (color, line) in style.looks(("dynamic", *WAKES)).items()
}


@styled
def stacked_maps(fields: Mapping[str, xr.DataArray], label: str, symmetric: bool, revolution: float) -> Figure:
    """Disk maps of two models above each other on one scale, and beside them the first less the second."""
    limits = style.levels(*(field.values for field in fields.values()), symmetric=symmetric)
    upper, lower = fields.values()
    change = difference(upper, lower)
    span = style.levels(change.values, symmetric=True)
    figure = style.blank(6.6, width=7.2)
    grid = figure.subplots(2, 2)
    for axes, (model, field) in zip(grid[:, 0], fields.items(), strict=True):
        filled = draw(axes, field, limits, style.DIVERGING if symmetric else style.SEQUENTIAL)
        mark_directions(axes)
        axes.set_title(f"{model}, revolution {revolution:g}")
        tidy(figure.colorbar(filled, ax=axes, shrink=0.8, pad=0.02), label, limits)
    filled = draw(grid[0, 1], change, span, style.DIVERGING)
    mark_directions(grid[0, 1])
    grid[0, 1].set_title("time marching less relaxation")
    tidy(figure.colorbar(filled, ax=grid[0, 1], shrink=0.8, pad=0.02), f"difference of {label}", span)
    _ring_means(grid[1, 1], fields, label)
    return figure


def _ring_means(axes: Axes, fields: Mapping[str, xr.DataArray], label: str) -> None:
    """Means over the azimuth by radius."""
    for model, field in fields.items():
        look: dict[str, Any] = {**LOOKS[model]}
        axes.plot(field["station"].values, field.values.mean(axis=0), label=model, **look)
    axes.set(xlabel="r/R [–]", ylabel=f"{label}, mean over ψ", title="mean over the azimuth")
    axes.legend()


@styled
def three_views(runs: Mapping[str, xr.Dataset], revolutions: Sequence[float]) -> Figure:
    """Tip vortex of the first blade from the side, from above and from behind; a row per revolution, both wakes."""
    shapes = {(model, n): filament(runs[model], n) for model in WAKES for n in revolutions}
    limits = {c: _limits(shapes.values(), k, c) for k, c in enumerate("xyz")}
    widths = [limits[across][1] - limits[across][0] for _, across, _, _, _ in VIEWS]
    tall = max(limits[upward][1] - limits[upward][0] for _, _, upward, _, _ in VIEWS)
    figure = style.blank(len(revolutions) * (tall * 8.0 / sum(widths) + 0.8) + 0.4, width=9.6)
    grid = figure.subplots(len(revolutions), 3, squeeze=False, width_ratios=widths)
    for row, n in zip(grid, revolutions, strict=True):
        for axes, (title, across, upward, x_label, y_label) in zip(row, VIEWS, strict=True):
            _rotor(axes, title)
            for model in WAKES:
                nodes = shapes[model, n]
                axes.plot(
                    nodes[:, "xyz".index(across)],
                    nodes[:, "xyz".index(upward)],
                    linewidth=1.0,
                    label=model,
                    **LOOKS[model],
                )
            axes.set(xlim=limits[across], ylim=limits[upward], xlabel=x_label, ylabel=y_label, aspect="equal")
            axes.set_title(title if axes is not row[0] else f"revolution {n:g}: {title}", loc="left")
    _legend(figure, grid[0, 0])
    return figure


@styled
def side_views(runs: Mapping[str, xr.Dataset], revolutions: Sequence[float]) -> Figure:
    """Tip vortex of the first blade from the side, with the centre line of each; a row per revolution, a column per wake."""
    shapes = {(model, n): filament(runs[model], n) for model in WAKES for n in revolutions}
    limits = {c: _limits(shapes.values(), "xyz".index(c), c) for c in "xz"}
    width, tall = (limits[c][1] - limits[c][0] for c in "xz")
    figure = style.blank(len(revolutions) * (3.9 * tall / width + 0.75) + 0.3, width=9.6)
    grid = figure.subplots(len(revolutions), 2, squeeze=False, sharex=True, sharey=True)
    for row, n in zip(grid, revolutions, strict=True):
        for axes, model in zip(row, WAKES[::-1], strict=True):
            nodes = shapes[model, n]
            line = axis_of(nodes)
            _rotor(axes, "side")
            axes.plot(nodes[:, 0], nodes[:, 2], linewidth=0.9, **LOOKS[model])
            axes.plot(
                line[:, 0], line[:, 2], color="black", linewidth=1.4, label="centre line (mean over a turn of age)"
            )
            axes.set(xlim=limits["x"], ylim=limits["z"], aspect="equal")
            axes.set_title(f"{model}, revolution {n:g}", loc="left")
        row[0].set_ylabel("$z_h/R$, up")
    for axes in grid[-1]:
        axes.set_xlabel("$x_h/R$, aft (nose left)")
    _legend(figure, grid[0, 0])
    return figure


def _legend(figure: Figure, axes: Axes) -> None:
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))


def _limits(shapes: Iterable[np.ndarray], component: int, name: str) -> tuple[float, float]:
    """Range of a coordinate common to all filaments, with the rotor inside."""
    return extent(np.concatenate([nodes[:, component] for nodes in shapes]), name)


def _rotor(axes: Axes, view: str) -> None:
    """The rotor's plane: a circle from above, a line else."""
    around = np.linspace(0, 2 * np.pi, 121)
    if view == "top":
        axes.plot(np.cos(around), np.sin(around), color=style.GREY, linewidth=0.9)
    else:
        axes.plot((-1, 1), (0, 0), color=style.GREY, linewidth=1.6)
