# SPDX-License-Identifier: MIT OR Apache-2.0
"""Time histories in panels: one run, or several runs of one manoeuvre over each other."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from ..results import by_name
from ..results.turns import revolutions
from . import style
from .shown import shown

if TYPE_CHECKING:
    import xarray as xr

    Runs = xr.Dataset | Mapping[str, xr.Dataset]

DEG = float(np.rad2deg(1.0))


@dataclass(frozen=True)
class Panel:
    """One panel: a variable (or the xyz component of one), its label with unit, and the factor to that unit.

    `span` is the least extent of the vertical axis, in the unit drawn. `vibrates`: blades passing shake it, so that the mean over
    one revolution is drawn and the history itself lightly behind it. `of_a_part`: nothing where the run has no such part.
    """

    name: str
    label: str
    factor: float = 1.0
    component: str | None = None
    span: float = 0.0
    vibrates: bool = False
    of_a_part: bool = False

    def in_units(self, units: str) -> Panel:
        """This panel drawn in other units: see `plotting.shown`."""
        label, factor = shown(self.label, units)
        return replace(self, label=label, factor=self.factor * factor, span=self.span * factor)

    def belongs_to(self, run: xr.Dataset) -> bool:
        """Whether the run has it: what is nothing all the time is of a part that is not there, such as a wake that marches."""
        return not self.of_a_part or bool(np.any(run[self.name].values))

    def values(self, run: xr.Dataset) -> np.ndarray:
        """The history (time,) in the unit drawn."""
        variable = run[self.name]
        if self.component is not None:
            variable = variable.sel(xyz=self.component)
        return self.factor * variable.values


def as_mapping(runs: Runs) -> Mapping[str, xr.Dataset]:
    """Several runs by name; a single dataset becomes one run without a name."""
    return {style.plain(name): run for name, run in by_name(runs, "").items()}


def seconds_per_revolution(run: xr.Dataset) -> float:
    """Duration of one rotor revolution [s]."""
    return 2 * np.pi / float(run.attrs["omega"])


def histories(
    runs: Runs, panels: Sequence[Panel], title: str, columns: int = 2, height: float = 1.45, units: str = "si"
) -> Figure:
    """Panels over time, in columns filled downwards; a second scale on top counts rotor revolutions.

    Several runs are drawn over each other with a legend. A run that failed ends with a cross. units: see `plotting.shown`.
    """
    runs = as_mapping(runs)
    rows = -(-len(panels) // columns)
    figure = style.blank(height * rows + 0.75)
    grid = figure.subplots(rows, columns, sharex=True, squeeze=False)
    for k, panel in enumerate(each.in_units(units) for each in panels):
        axes = grid[k % rows, k // rows]
        for (name, run), (color, line) in zip(runs.items(), looks_of(runs), strict=True):
            if not panel.belongs_to(run):
                continue
            values = panel.values(run)
            smooth = one_revolution_mean(run, values) if panel.vibrates else None
            if smooth is not None:
                axes.plot(run.time.values, values, color=color, linewidth=0.5, alpha=0.35)
                values = smooth
            axes.plot(run.time.values, values, color=color, linestyle=line, label=name)
            if not run.attrs.get("finished", 1):
                axes.plot(run.time.values[-1], values[-1], "x", color=color)
        axes.set_ylabel(panel.label)
        axes.margins(x=0)
        style.least_span(axes, panel.span)
    for k in range(len(panels), rows * columns):
        grid[k % rows, k // rows].set_visible(False)
    _time_axes(grid, next(iter(runs.values())), len(panels))
    if len(runs) > 1:
        # every run has what stands in the first panel
        handles, labels = grid[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=len(runs))
    figure.suptitle(title, fontsize=10, x=0.01, ha="left")
    figure.align_ylabels()
    return figure


def looks_of(runs: Mapping[str, xr.Dataset]) -> list[tuple[str, str]]:
    """Colour and line of each run; a single one has those of its inflow model, drawn through."""
    if len(runs) == 1:
        model = str(next(iter(runs.values())).attrs.get("inflow_model", ""))
        return [(style.looks([model])[model][0], "-")]
    return list(style.looks(runs).values())


def one_revolution_mean(run: xr.Dataset, values: np.ndarray) -> np.ndarray | None:
    """The mean over the revolution about each record (time,), None in short runs.

    At the ends over what there is of that revolution, moved from its middle to the record along the slope between the two halves
    of the last whole one: blades' passages leave both as they are, and a ramp stays a ramp.
    """
    step = float(np.median(np.diff(revolutions(run)))) if values.size > 1 else 1.0
    n = max(round(1.0 / step), 1)
    if n < 3 or values.size < n:
        return None
    # a whole revolution counts both its ends by half: blades pass it n times, whatever n is
    weights = np.ones(n + 1)
    weights[[0, -1]] = 0.5
    there = np.convolve(np.ones(values.size), weights, mode="same")
    mean: np.ndarray = np.convolve(values, weights, mode="same") / there
    half = n // 2
    if values.size > n:
        # where the records lie in the mean that each mean is of
        middle = np.convolve(np.arange(values.size), weights, mode="same") / there
        for end, outward in ((slice(0, half), values), (slice(-half, None), values[::-1])):
            outer, inner = _trapezoidal_mean(outward[: half + 1]), _trapezoidal_mean(outward[half : 2 * half + 1])
            inward = 1.0 if end.start == 0 else -1.0
            mean[end] += inward * (inner - outer) / half * (np.arange(values.size) - middle)[end]
    return mean


def _trapezoidal_mean(values: np.ndarray) -> float:
    """Mean of equally spaced values, both ends by half."""
    return float((np.sum(values) - 0.5 * (values[0] + values[-1])) / (values.size - 1))


def _scale_of_revolutions(run: xr.Dataset) -> tuple[Callable[[Any], Any], Callable[[Any], Any]]:
    """Revolutions by seconds, and seconds by revolutions; beyond the run at the nominal speed."""
    period = seconds_per_revolution(run)
    if "rotor_speed" not in run:
        return lambda t: t / period, lambda n: n * period
    beyond = 1e3 * np.array([-1.0, 1.0])
    turns, time = revolutions(run), run.time.values
    turns = np.concatenate([turns[:1] + beyond[0], turns, turns[-1:] + beyond[1]])
    time = np.concatenate([time[:1] + period * beyond[0], time, time[-1:] + period * beyond[1]])
    return lambda t: np.interp(t, time, turns), lambda n: np.interp(n, turns, time)


def _time_axes(grid: np.ndarray, run: xr.Dataset, n_panels: int) -> None:
    """Seconds below, revolutions above each column."""
    rows, columns = grid.shape
    forward, back = _scale_of_revolutions(run)
    for column in range(columns):
        last = min(rows, n_panels - column * rows) - 1
        grid[last, column].set_xlabel("time [s]")
        grid[last, column].tick_params(labelbottom=True)
        top = grid[0, column].secondary_xaxis("top", functions=(forward, back))
        top.set_xlabel("rotor revolutions")
        top.spines["top"].set_visible(True)
