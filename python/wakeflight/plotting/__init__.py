# SPDX-License-Identifier: MIT OR Apache-2.0
"""Figures: one file each, pure functions from a dataset to a figure; `FIGURES` lists those of a run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from . import environment as environment  # isort: skip  # before whatever else draws

from matplotlib.figure import Figure

from . import (
    body,
    comparison,
    flapping,
    flight_path,
    inflow_maps,
    loads,
    monitors,
    rotor,
    section_maps,
    sticks,
    trim_maps,
    wake_geometry,
)
from .disk import revolutions_flown

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr


@dataclass(frozen=True)
class Plot:
    """A figure of the report: its file name, what draws it, its caption, and whether given data suffice."""

    name: str
    figure: Callable[..., Figure]
    caption: str
    drawable: Callable[..., bool]
    has_units: bool = False
    """Whether it can be drawn in several units."""

    def draw(self, data: object, units: str = "si") -> Figure:
        """The figure of `data`, in the units asked for where it has some."""
        return self.figure(data, units=units) if self.has_units else self.figure(data)


def _one_revolution(run: xr.Dataset) -> bool:
    return revolutions_flown(run) >= 1 - 1e-3


def _always(_: object) -> bool:
    return True


FIGURES: tuple[Plot, ...] = (
    Plot("sticks", sticks.figure, sticks.CAPTION, _always),
    Plot("body-states", body.figure, body.CAPTION, _always, has_units=True),
    Plot("forces-moments", loads.figure, loads.CAPTION, _always, has_units=True),
    Plot("flapping", flapping.figure, flapping.CAPTION, _always, has_units=True),
    Plot("hub-loads", rotor.figure, rotor.CAPTION, _always, has_units=True),
    Plot("monitors", monitors.figure, monitors.CAPTION, lambda run: bool(monitors.present(run)), has_units=True),
    Plot(
        "inflow-trim",
        trim_maps.from_run,
        trim_maps.CAPTION,
        lambda run: "inflow_trim" in run and "inflow_start" in run,
    ),
    Plot("inflow-maps", inflow_maps.figure, inflow_maps.CAPTION, _one_revolution),
    Plot("section-maps", section_maps.figure, section_maps.CAPTION, _one_revolution),
    Plot("wake", wake_geometry.figure, wake_geometry.CAPTION, lambda run: "wake" in run),
    Plot(
        "wake-all-blades",
        lambda run: wake_geometry.figure(run, snapshots=[run.sizes["snapshot"] - 1], all_blades=True),
        wake_geometry.ALL_CAPTION,
        lambda run: "wake" in run,
    ),
    Plot("flight-path", flight_path.figure, flight_path.CAPTION, _always, has_units=True),
)


def _all_one_revolution(runs: Mapping[str, xr.Dataset]) -> bool:
    return all(_one_revolution(run) for run in runs.values())


COMPARISONS: tuple[Plot, ...] = (
    Plot("sticks", sticks.figure, sticks.CAPTION, _always),
    Plot("body-states", body.figure, body.CAPTION, _always, has_units=True),
    Plot("forces-moments", loads.figure, loads.CAPTION, _always, has_units=True),
    Plot("flapping", flapping.figure, flapping.CAPTION, _always, has_units=True),
    Plot("hub-loads", rotor.figure, rotor.CAPTION, _always, has_units=True),
    Plot("monitors", monitors.figure, monitors.CAPTION, lambda runs: bool(monitors.present(runs)), has_units=True),
    Plot("inflow-maps", comparison.inflow_maps, comparison.INFLOW_CAPTION, _all_one_revolution),
    Plot(
        "wake",
        comparison.wake_side_views,
        comparison.WAKE_CAPTION,
        lambda runs: len(comparison.wakes(runs)) > 0,
    ),
    Plot("flight-path", flight_path.figure, flight_path.CAPTION, _always, has_units=True),
    Plot("cost", comparison.cost, comparison.COST_CAPTION, _always),
)
