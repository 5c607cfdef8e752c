# SPDX-License-Identifier: MIT OR Apache-2.0
"""The study the paper left open: holding the inflow for a revolution, or imposing periodicity, which makes the difference."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ....inflow import RelaxationWake, TimeMarchingWake
from ....plotting import style
from ....plotting.style import styled
from ..cases import Planned
from ..quantities import DEG, excursion, extreme, period, rms_difference, smoothed
from ..statements.conclusions import lag
from .finding import Finding

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    Runs = Mapping[str, xr.Dataset]

D = "arrested-descent"
FLIGHTS = {
    "time marching, every 10°": f"{D}/time-marching",
    "time marching, held for a revolution": "held/time-marching",
    "relaxation, every quarter revolution": "held/relaxation",
    "relaxation, once per revolution": f"{D}/relaxation",
}


def cases() -> list[Planned]:
    """The two mixed ways."""
    return [
        Planned("held/time-marching", D, TimeMarchingWake.preset("paper", update_interval="360 deg"), 20),
        Planned("held/relaxation", D, RelaxationWake.preset("paper", update_interval="90 deg"), 80),
    ]


def finding(runs: Runs) -> Finding:
    """Differences from time marching, each way."""
    reference = runs[f"{D}/time-marching"]
    rows, share = [], {}
    for name, flight in FLIGHTS.items():
        run = runs[flight]
        apart = [
            rms_difference(run, reference, v) / excursion(reference, v) for v in ("inflow_mean", "force_z", "w", "q")
        ]
        share[name] = apart
        rows.append(
            [
                name,
                f"{extreme(run, 'force_z', -1.0)[0] / 1e3:.1f}",
                f"{DEG * extreme(run, 'q', 1.0)[0]:.2f}",
                f"{lag(run, reference, 'inflow_mean'):.2f}",
                *(f"{100 * x:.1f}" for x in apart),
            ]
        )
    names = list(FLIGHTS)
    held, periodic, both = (np.array(share[names[k]]) for k in (1, 2, 3))
    return Finding(
        "holding",
        "Holding for a revolution, or imposing periodicity",
        "The arrested descent with time marching whose inflow the flight dynamics keep for a revolution, "
        "and with relaxation updated every "
        "quarter of one: each has one of the two properties by which the paper's two wakes differ.",
        figure(runs),
        (
            "inflow",
            "peak −ΔZ [kN]",
            "peak q [deg/s]",
            "lag [rev]",
            "RMS difference from the first, share of the excursion: λ₀ [%]",
            "Z [%]",
            "w [%]",
            "q [%]",
        ),
        rows,
        f"Holding alone moves the mean inflow by {100 * held[0]:.0f} % of its excursion and the force by "
        f"{100 * held[1]:.0f} %, periodicity "
        f"with a quarter revolution of holding by {100 * periodic[0]:.0f} % and {100 * periodic[1]:.0f} %, "
        f"both together as in the paper by "
        f"{100 * both[0]:.0f} % and {100 * both[1]:.0f} %.",
    )


@styled
def figure(runs: Runs) -> Figure:
    """Mean inflow and vertical force of the four."""
    figure = style.blank(4.4)
    upper, lower = figure.subplots(2, 1, sharex=True)
    for (name, flight), color, line in zip(FLIGHTS.items(), style.COLORS, style.LINES, strict=False):
        run = runs[flight]
        turns = run.time.values / period(run)
        upper.plot(turns, smoothed(run, "inflow_mean"), color=color, linestyle=line, label=name)
        lower.plot(turns, smoothed(run, "force_z") / 1e3, color=color, linestyle=line)
    upper.set_ylabel("λ₀ [–], down +")
    lower.set(ylabel="Z [kN], down +", xlabel="rotor revolutions")
    # beside the curves: they take the whole of both panels
    figure.legend(*upper.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure
