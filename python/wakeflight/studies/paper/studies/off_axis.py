# SPDX-License-Identifier: MIT OR Apache-2.0
"""Pitch from lateral stick, the off-axis response of the paper's introduction: rates in the wake, elastic blades."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ....inflow import DynamicInflow, TimeMarchingWake
from ....maneuvers import Maneuver
from ....plotting import style
from ....plotting.style import styled
from ..cases import Planned
from ..quantities import DEG
from .finding import Finding

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    Runs = Mapping[str, xr.Dataset]

REVOLUTIONS = 8.0
PULSE = Maneuver(
    "lateral-pulse",
    (("lateral", ((0.2327, 0.0), (0.2827, 0.5), (0.6981, 0.5), (0.7481, 0.0))),),
    revolutions=REVOLUTIONS,
    notes="Lateral stick 0.5 in to the right from revolution 1 to 3.",
)
HANDS_OFF = Maneuver(
    "hands-off",
    (("lateral", ((0.2327, 0.0), (0.7481, 0.0))),),
    revolutions=REVOLUTIONS,
    notes="No stick moves.",
)
FORWARD = (("speed", "80 kt"), ("flight_path", "0 deg"))
HOVER = (("speed", "0 kt"), ("flight_path", "0 deg"))
# hover needs a longer wake and what lies below it; marching leaves the periodic solution there, so no convergence phase
CONDITIONS = {
    "80 kt level": (FORWARD, {}),
    "hover": (HOVER, {"turns": 5.0, "far_wake_turns": 2, "convergence_revolutions": 0}),
}
# name: model options beyond those of the condition (None: dynamic inflow), and modes of a blade
WAYS = {
    "time marching": ({}, None),
    "no rates in the wake": ({"rates": False}, None),
    "rigid blades": ({}, 2),
    "dynamic inflow": (None, None),
}


def name(condition: str, way: str, maneuver: str) -> str:
    """Name of a flight."""
    return f"off-axis/{condition}-{way}-{maneuver}".replace(" ", "-")


def cases() -> list[Planned]:
    """A pulse and no pulse, each way in each condition."""
    made = []
    for condition, (given, options) in CONDITIONS.items():
        for way, (more, modes) in WAYS.items():
            model = DynamicInflow() if more is None else TimeMarchingWake.preset("paper", **{**options, **more})
            for maneuver in (PULSE, HANDS_OFF):
                made.append(Planned(name(condition, way, maneuver.name), maneuver, model, 10, None, given, modes))
    return made


def response(runs: Runs, condition: str, way: str, variable: str) -> tuple[np.ndarray, np.ndarray]:
    """Revolutions, and what the pulse adds to a history: the flight with it less the one without."""
    with_, without = (runs[name(condition, way, m.name)] for m in (PULSE, HANDS_OFF))
    n = min(with_.sizes["time"], without.sizes["time"])
    turns = with_.time.values[:n] * float(with_.attrs["omega"]) / (2 * np.pi)
    return turns, with_[variable].values[:n] - without[variable].values[:n]


def ratio(runs: Runs, condition: str, way: str) -> tuple[float, float]:
    """Roll gained by the end of revolution 6 [deg], and pitch over it."""
    turns, roll = response(runs, condition, way, "roll")
    _, pitch = response(runs, condition, way, "pitch")
    k = int(np.argmin(np.abs(turns - 6.0)))
    return DEG * float(roll[k]), float(pitch[k] / roll[k])


def finding(runs: Runs) -> Finding:
    """Pitch over roll, each way."""
    rows, found = [], {}
    for condition in CONDITIONS:
        for way in WAYS:
            roll, share = found[condition, way] = ratio(runs, condition, way)
            _, p = response(runs, condition, way, "p")
            rows.append([condition, way, f"{DEG * float(np.abs(p).max()):.2f}", f"{roll:.2f}", f"{share:+.3f}"])
    text = "; ".join(
        f"{condition}: {found[condition, 'time marching'][1]:+.3f} with time marching, "
        f"{found[condition, 'no rates in the wake'][1]:+.3f} without the rates, "
        f"{found[condition, 'rigid blades'][1]:+.3f} with rigid blades, "
        f"{found[condition, 'dynamic inflow'][1]:+.3f} with dynamic inflow"
        for condition in CONDITIONS
    )
    return Finding(
        "off-axis",
        "Off-axis response: pitch from lateral stick",
        "Half an inch of lateral stick to the right from revolution 1 to 3, in level flight at 80 kt and "
        "in hover, less the same flight hands off. "
        "The rates p, q, r act on the free filaments or are left out there (blades and near wake keep "
        "them); rigid blades have flap and lag "
        "hinges only.",
        figure(runs),
        ("condition", "way", "peak p [deg/s]", "roll at revolution 6 [deg]", "pitch over roll"),
        rows,
        f"Pitch over roll at the end of revolution 6: {text}.",
    )


@styled
def figure(runs: Runs) -> Figure:
    """Roll and pitch rates that the pulse adds."""
    figure = style.blank(4.6, width=9.6)
    grid = figure.subplots(2, 2, sharex=True)
    for column, condition in zip(grid.T, CONDITIONS, strict=True):
        for way, color, line in zip(WAYS, style.COLORS, style.LINES, strict=False):
            for axes, variable in zip(column, ("p", "q"), strict=True):
                turns, values = response(runs, condition, way, variable)
                axes.plot(turns, DEG * values, color=color, linestyle=line, label=way)
        column[0].set_title(condition)
        column[1].set_xlabel("rotor revolutions")
    grid[0, 0].set_ylabel("Δp [deg/s], right side down +")
    grid[1, 0].set_ylabel("Δq [deg/s], nose up +")
    figure.legend(*grid[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=len(WAYS))
    return figure
