# SPDX-License-Identifier: MIT OR Apache-2.0
"""The paper's six conclusions [ribera2004]."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ....plotting.disk import revolution_map
from .. import cost
from .. import quantities as q
from ..cases import MANEUVERS
from .roll import roll_weight
from .verdict import Condition, Statement, above, larger, within

if TYPE_CHECKING:
    import xarray as xr

    Runs = Mapping[str, xr.Dataset]

HANDS_OFF = 2.0
"""Revolutions before the pilot moves anything in the arrested descent."""


def statements(runs: Runs) -> list[Statement]:
    """Rows of the table for the conclusions; `runs` by case name."""
    return [convergence(runs), delay(runs), inflow_and_lift(runs), cheaper(runs), geometry(runs), validation()]


def transient(run: xr.Dataset) -> float:
    """Largest departure of the vertical force from trim in the hands-off revolutions, over the force itself."""
    end = HANDS_OFF * q.period(run)
    trim = float(run["force_z"][0])
    inside = q.window(run, 0.0, end)
    return float(np.abs(q.smoothed(run, "force_z")[inside] - trim).max() / abs(trim))


def convergence(runs: Runs) -> Statement:
    """Conclusion 1."""
    settled, raw = runs["arrested-descent/time-marching"], runs["arrested-descent/no-convergence"]
    end = HANDS_OFF * q.period(settled)
    rates = {
        name: q.DEG * max(q.excursion(run, rate, 0.0, end) for rate in ("p", "q", "r"))
        for name, run in (("with", settled), ("without", raw))
    }
    return Statement(
        "conclusion 1",
        "The convergence phase is necessary: without it the mismatch of the two wakes disturbs the coupled "
        "simulation from the start.",
        (
            larger(
                "largest ΔZ in the two revolutions before the input",
                ("without", 100 * transient(raw)),
                ("with", 100 * transient(settled)),
                "% of Z",
            ),
            larger("largest body rate in them", ("without", rates["without"]), ("with", rates["with"]), "deg/s"),
            above(
                "RMS change of q by leaving it out, over the excursion of q",
                q.rms_difference(raw, settled, "q") / q.excursion(settled, "q"),
                0.05,
            ),
        ),
        figure="convergence",
    )


def lag(run: xr.Dataset, reference: xr.Dataset, name: str, most: float = 1.5) -> float:
    """Revolutions by which a history follows another: the shift, of either sign, at which they correlate best."""
    per_turn = round(q.period(run) / float(run.time[1] - run.time[0]))
    a, b = q.smoothed(run, name), q.smoothed(reference, name)
    most_steps = round(most * per_turn)

    def at(k: int) -> float:
        early, late = (b[: b.size - k], a[k:]) if k >= 0 else (b[-k:], a[:k])
        return float(np.corrcoef(early, late)[0, 1])

    return max(range(-most_steps, most_steps + 1), key=at) / per_turn


def delay(runs: Runs) -> Statement:
    """Conclusion 2."""
    lags = {m: lag(runs[f"{m}/relaxation"], runs[f"{m}/time-marching"], "inflow_mean") for m in MANEUVERS}
    return Statement(
        "conclusion 2",
        "The response with relaxation is delayed by up to one revolution.",
        tuple(within(f"lag of the mean inflow, {m}", n, 0.1, 1.0 + 1e-9, "revolutions") for m, n in lags.items()),
        figure="inflow-mean",
    )


def inflow_and_lift(runs: Runs) -> Statement:
    """Conclusion 3."""
    conditions = []
    for maneuver, start in (("arrested-descent", 2.0), ("roll-reversal", 1.0)):
        pair = {m: runs[f"{maneuver}/{m}"] for m in ("relaxation", "time-marching")}
        means = {m: _mean_after(run, "inflow_mean", start) for m, run in pair.items()}
        lift = {m: -_mean_after(run, "force_z", start) / 1e3 for m, run in pair.items()}
        conditions.append(
            larger(
                f"mean inflow after the first input, {maneuver}",
                ("relaxation", means["relaxation"]),
                ("time-marching", means["time-marching"]),
            )
        )
        conditions.append(
            larger(
                f"mean −Z after the first input, {maneuver}",
                ("time-marching", lift["time-marching"]),
                ("relaxation", lift["relaxation"]),
                "kN",
            )
        )
    roll = {
        m: abs(q.sector_mean(roll_weight(revolution_map(runs[f"roll-reversal/{m}"], "cl_m2", 15.0))))
        for m in ("relaxation", "time-marching")
    }
    conditions.append(
        larger(
            "contribution to the rolling moment, revolution 15 of the roll reversal",
            ("time-marching", roll["time-marching"]),
            ("relaxation", roll["relaxation"]),
        )
    )
    return Statement(
        "conclusion 3",
        "Relaxation gives generally more inflow, less lift and less rolling moment.",
        tuple(conditions),
        figure="inflow-mean",
    )


def _mean_after(run: xr.Dataset, name: str, revolutions: float) -> float:
    return float(run[name].values[q.window(run, revolutions * q.period(run))].mean())


def cheaper(runs: Runs) -> Statement:
    """Conclusion 4."""
    conditions = []
    for maneuver in MANEUVERS:
        marched, relaxed = runs[f"{maneuver}/time-marching"], runs[f"{maneuver}/relaxation"]
        conditions.append(
            larger(
                f"segment evaluations of the flight, {maneuver}",
                ("relaxation", cost.work(relaxed).flight / 1e6),
                ("time-marching", cost.work(marched).flight / 1e6),
                "10⁶",
            )
        )
        conditions.append(
            larger(
                f"processor time of convergence phase and flight, {maneuver}",
                ("relaxation", cost.processor(relaxed)),
                ("time-marching", cost.processor(marched)),
                "s",
            )
        )
    return Statement("conclusion 4", "Coupled to the flight dynamics, time marching is the cheaper.", tuple(conditions))


def geometry(runs: Runs) -> Statement:
    """Conclusion 5."""
    conditions: list[Condition] = []
    for maneuver, when in (("arrested-descent", (5.0, 8.0, 10.0)), ("roll-reversal", (15.0, 18.0, 21.0))):
        a, b = runs[f"{maneuver}/relaxation"], runs[f"{maneuver}/time-marching"]
        apart = {n: _apart(q.filament(a, n), q.filament(b, n)) for n in (0.0, *when)}
        conditions.append(
            above(
                f"RMS distance of the two wakes over their first two turns against that at trim, least of "
                f"revolutions "
                f"{', '.join(f'{n:g}' for n in when)}, {maneuver}",
                min(apart[n] for n in when) / apart[0.0],
                2.0,
            )
        )
    return Statement(
        "conclusion 5",
        "The relaxation wake's geometry misses the transients of the manoeuvre.",
        tuple(conditions),
        figure="figure-19",
    )


def _apart(a: np.ndarray, b: np.ndarray) -> float:
    # older wake differs at trim already
    return q.first_turn_rms(a, b, 73)


def validation() -> Statement:
    """Conclusion 6."""
    return Statement("conclusion 6", "Validation with flight tests is left open.", ())
