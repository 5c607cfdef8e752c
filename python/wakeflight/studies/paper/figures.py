# SPDX-License-Identifier: MIT OR Apache-2.0
"""The paper's Figures 3 to 19, drawn as it draws them: file name, caption, and what draws each from the runs.

Histories show the three models together; disk maps have the nose on the left, time marching above relaxation; wake
geometry is that of the first blade.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from ...plotting import disk, histories, trim_maps
from ...plotting.histories import DEG, Panel
from ...plotting.style import styled
from . import drawings
from .quantities import change_from_trim
from .statements.roll import roll_weight

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    Runs = Mapping[str, xr.Dataset]

DESCENT, ROLL = "arrested-descent", "roll-reversal"


@dataclass(frozen=True)
class PaperFigure:
    """One figure: `name` of its file, caption, manoeuvre, and what draws it from the runs of that by model."""

    name: str
    caption: str
    maneuver: str
    draw: Callable[[Runs], Figure]


def history(name: str, maneuver: str, panel: Panel, caption: str) -> PaperFigure:
    """One quantity over time, the three models together."""
    return PaperFigure(name, caption, maneuver, partial(_history, panel=panel, title=caption))


@styled
def _history(runs: Runs, panel: Panel, title: str) -> Figure:
    return histories.histories(runs, [panel], title, columns=1, height=2.3)


def maps(name: str, maneuver: str, variable: str, revolution: float, label: str, caption: str) -> PaperFigure:
    """A disk map after some revolutions, time marching above relaxation, and their difference."""
    return PaperFigure(name, caption, maneuver, partial(_maps, variable=variable, revolution=revolution, label=label))


def _maps(runs: Runs, variable: str, revolution: float, label: str) -> Figure:
    makers: dict[str, Callable[[xr.Dataset], xr.DataArray]] = {
        "inflow change": lambda run: change_from_trim(run, "inflow", revolution),
        "roll contribution": lambda run: roll_weight(disk.revolution_map(run, "cl_m2", revolution)),
    }
    make: Any = makers.get(variable, lambda run: disk.revolution_map(run, variable, revolution))
    fields = {model: make(runs[model]) for model in ("time-marching", "relaxation")}
    return drawings.stacked_maps(fields, label, symmetric=variable in makers, revolution=revolution)


FIGURES: tuple[PaperFigure, ...] = (
    PaperFigure(
        "figure-03",
        "Figure 3: induced inflow at trim by relaxation, by time marching after ten revolutions with states "
        "and controls frozen, and "
        "their difference. λ₀ is the area mean, λ₁c and λ₁s the first harmonics.",
        DESCENT,
        lambda runs: trim_maps.figure(
            runs["time-marching"]["inflow_trim"],
            runs["time-marching"]["inflow_start"],
            ("relaxation", "time marching, revolution 10"),
        ),
    ),
    PaperFigure(
        "figure-04",
        "Figure 4: tip vortex of the first blade at trim by relaxation and time marching.",
        DESCENT,
        lambda runs: drawings.three_views(runs, (0.0,)),
    ),
    history(
        "figure-05a",
        DESCENT,
        Panel("collective", "collective [in]"),
        "Figure 5a: collective stick from its stop, arrested descent",
    ),
    history(
        "figure-05b",
        DESCENT,
        Panel("force_z", "Z [kN], down +", 1e-3),
        "Figure 5b: vertical force in body axes, gravity left out",
    ),
    history(
        "figure-05c",
        DESCENT,
        Panel("moment_y", "M [kN m], nose up +", 1e-3),
        "Figure 5c: pitching moment about the body origin",
    ),
    history("figure-06a", DESCENT, Panel("w", "w [m/s], down +"), "Figure 6a: body velocity w"),
    history("figure-06b", DESCENT, Panel("q", "q [deg/s], nose up +", DEG), "Figure 6b: pitch rate q"),
    history("figure-06c", DESCENT, Panel("pitch", "θ [deg], nose up +", DEG), "Figure 6c: pitch attitude θ"),
    history(
        "figure-07a",
        DESCENT,
        Panel("beta_1c", "β₁c [deg], disk front down +", DEG),
        "Figure 7a: longitudinal flapping β₁c",
    ),
    history(
        "figure-07b",
        DESCENT,
        Panel("beta_1s", "β₁s [deg], advancing side up +", DEG),
        "Figure 7b: lateral flapping β₁s",
    ),
    maps(
        "figure-08",
        DESCENT,
        "cl_m2",
        5,
        "$C_l M^2$ [–]",
        "Figure 8: lift $C_l M^2$ in revolution 5 of the arrested descent.",
    ),
    maps(
        "figure-09",
        DESCENT,
        "cl",
        5,
        "$C_l$ [–]",
        "Figure 9: lift coefficient $C_l$ in revolution 5 of the arrested descent.",
    ),
    maps(
        "figure-10",
        DESCENT,
        "inflow change",
        5,
        "Δλ [–], down +",
        "Figure 10: induced inflow in revolution 5 of the arrested descent less that of trim.",
    ),
    PaperFigure(
        "figure-11",
        "Figure 11: tip vortex of the first blade after 5, 8 and 10 revolutions of the arrested descent.",
        DESCENT,
        lambda runs: drawings.three_views(runs, (5.0, 8.0, 10.0)),
    ),
    history(
        "figure-12a",
        ROLL,
        Panel("lateral", "lateral [in], right +"),
        "Figure 12a: lateral stick from its stop, roll reversal",
    ),
    history(
        "figure-12b",
        ROLL,
        Panel("moment_x", "L [kN m], right +", 1e-3),
        "Figure 12b: rolling moment about the body origin",
    ),
    history(
        "figure-12c",
        ROLL,
        Panel("moment_y", "M [kN m], nose up +", 1e-3),
        "Figure 12c: pitching moment about the body origin",
    ),
    history("figure-13a", ROLL, Panel("v", "v [m/s], right +"), "Figure 13a: body velocity v"),
    history("figure-13b", ROLL, Panel("p", "p [deg/s], right side down +", DEG), "Figure 13b: roll rate p"),
    history(
        "figure-13c",
        ROLL,
        Panel("roll", "φ [deg], right side down +", DEG),
        "Figure 13c: roll attitude φ (3-2-1 angles)",
    ),
    history(
        "figure-14a",
        ROLL,
        Panel("beta_1c", "β₁c [deg], disk front down +", DEG),
        "Figure 14a: longitudinal flapping β₁c",
    ),
    history(
        "figure-14b", ROLL, Panel("beta_1s", "β₁s [deg], advancing side up +", DEG), "Figure 14b: lateral flapping β₁s"
    ),
    maps(
        "figure-15",
        ROLL,
        "roll contribution",
        15,
        "$C_l M^2$ (r/R) sin ψ [–]",
        "Figure 15: contributions to the rolling moment, $C_l M^2$ (r/R) sin ψ, in revolution 15 of the roll "
        "reversal; "
        "positive rolls to the left.",
    ),
    maps(
        "figure-16",
        ROLL,
        "cl_m2",
        15,
        "$C_l M^2$ [–]",
        "Figure 16: lift $C_l M^2$ in revolution 15 of the roll reversal.",
    ),
    maps(
        "figure-17",
        ROLL,
        "cl",
        15,
        "$C_l$ [–]",
        "Figure 17: lift coefficient $C_l$ in revolution 15 of the roll reversal.",
    ),
    maps(
        "figure-18",
        ROLL,
        "inflow change",
        15,
        "Δλ [–], down +",
        "Figure 18: induced inflow in revolution 15 of the roll reversal less that of trim.",
    ),
    PaperFigure(
        "figure-19",
        "Figure 19: tip vortex of the first blade from the side after 15, 18 and 21 revolutions of the roll reversal.",
        ROLL,
        lambda runs: drawings.side_views(runs, (15.0, 18.0, 21.0)),
    ),
)
