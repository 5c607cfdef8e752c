# SPDX-License-Identifier: MIT OR Apache-2.0
"""Numbers in the paper's text: periods, steps, durations, limits, and what it says of cost [ribera2004]."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from .. import cost
from ..cases import CAPS, MANEUVERS, cap_name
from ..quantities import period
from .verdict import Condition, Statement, above, below, within

if TYPE_CHECKING:
    import xarray as xr

    Runs = Mapping[str, xr.Dataset]

SETTLED = 2e-3
"""Change of inflow in a revolution over its mean below which the convergence phase counts as done."""


def statements(runs: Runs) -> list[Statement]:
    """Rows of the table for the numbers; `runs` by case name."""
    return [
        coupling(runs),
        rotor_period(runs),
        condition(runs),
        exchange(runs),
        convergence(runs),
        durations(runs),
        rate_limit(runs),
        uncoupled_cost(runs),
        coupled_cost(runs),
        overall_cost(runs),
    ]


def coupling(runs: Runs) -> Statement:
    """Figure 2: the order of the phases, from the log of a flight."""
    log = [row[0] for row in phases(runs["arrested-descent/time-marching"])]
    expected = ["trim", "convergence of the wake", "flight"]
    return Statement(
        "Fig. 2",
        "Trim with the relaxation wake; convergence of the time-marching wake with states and controls "
        "frozen; then wake and flight "
        "dynamics in turn.",
        (
            Condition(f"phases logged: {', '.join(expected)}", ", ".join(log) or "none logged", log == expected),
            Condition(
                "the trim's inflow model is relaxation",
                str(runs["arrested-descent/time-marching"].attrs["configuration.trim_inflow"]),
                runs["arrested-descent/time-marching"].attrs["configuration.trim_inflow"] == "relaxation",
            ),
        ),
        figure="figure-02",
    )


def phases(run: xr.Dataset) -> list[tuple[str, float, float]]:
    """Phases a flight logged: name, steps, and seconds from its start."""
    return [(str(name), float(n or 0), float(at)) for name, n, at in json.loads(str(run.attrs.get("phases", "[]")))]


def rotor_period(runs: Runs) -> Statement:
    """Period of the rotor."""
    run = runs["roll-reversal/time-marching"]
    return Statement(
        "text, period",
        "36 revolutions take 8.38 s: a revolution lasts 0.2328 s.",
        (within("period of the rotor", period(run), 0.2328 * 0.995, 0.2328 * 1.005, "s"),),
    )


def condition(runs: Runs) -> Statement:
    """The flight condition."""
    attrs = runs["arrested-descent/relaxation"].attrs
    return Statement(
        "text, condition",
        "80 kt is µ = 0.185; 16 000 lb at 5250 ft is C_T/σ = 0.071.",
        (
            within("µ at trim", float(attrs["mu"]), 0.183, 0.188),
            within("C_T/σ at trim", float(attrs["ct_sigma"]), 0.069, 0.073),
        ),
    )


def exchange(runs: Runs) -> Statement:
    """Steps of the coupling."""
    marched, relaxed = runs["roll-reversal/time-marching"], runs["roll-reversal/relaxation"]
    step = np.rad2deg(np.diff(np.unwrap(marched["azimuth"].values[:, 0])))
    return Statement(
        "text, exchange",
        "Time marching exchanges data every 10° of azimuth; relaxation is updated once per revolution.",
        (
            within("azimuth between exchanges, largest", float(step.max()), 9.999, 10.001, "deg"),
            Condition(
                "updates of the relaxation wake = revolutions flown",
                f"{int(relaxed.attrs['relaxation_updates'])} in {float(relaxed.attrs['revolutions']):g} revolutions",
                int(relaxed.attrs["relaxation_updates"]) == round(float(relaxed.attrs["revolutions"])),
            ),
        ),
    )


def changes(run: xr.Dataset) -> list[float]:
    """Change of inflow over its mean in every revolution of the convergence phase."""
    kept = run.attrs.get("convergence_change", "[]")
    return [float(x) for x in (json.loads(kept) if isinstance(kept, str) else np.atleast_1d(kept))]


def convergence(runs: Runs) -> Statement:
    """Length of the convergence phase."""
    change = changes(runs["arrested-descent/time-marching"])
    enough = next((k + 1 for k, x in enumerate(change) if x < SETTLED), len(change) + 1)
    return Statement(
        "text, convergence",
        "About 40 iterations, 10 revolutions, are sufficient for the wake to converge.",
        (
            below("change of inflow in revolution 10 over its mean", change[-1], SETTLED),
            Condition(f"first revolution with a change below {SETTLED:g} ≤ 10", f"revolution {enough}", enough <= 10),
        ),
        figure="convergence",
    )


def durations(runs: Runs) -> Statement:
    """Lengths of the manoeuvres."""
    descent, roll = (float(runs[f"{m}/time-marching"].time[-1]) for m in MANEUVERS)
    return Statement(
        "text, durations",
        "The arrested descent lasts about 2.7 s, 12 revolutions; the roll reversal 8.38 s, 36 revolutions; "
        "revolution 5 ends at 1.16 s, "
        "revolution 15 at 3.49 s.",
        (
            within("12 revolutions", descent, 2.65, 2.75, "s"),
            within("36 revolutions", roll, 8.36, 8.40, "s"),
            within("5 revolutions", 5 * period(runs["arrested-descent/time-marching"]), 1.155, 1.165, "s"),
            within("15 revolutions", 15 * period(runs["roll-reversal/time-marching"]), 3.485, 3.495, "s"),
        ),
    )


def rate_limit(runs: Runs) -> Statement:
    """Rates of the sticks."""
    rates = {}
    for maneuver, stick in zip(MANEUVERS, ("collective", "lateral"), strict=True):
        run = runs[f"{maneuver}/time-marching"]
        rates[stick] = float(np.abs(np.diff(run[stick].values)).max() / np.diff(run.time.values).mean())
    return Statement(
        "text, rates",
        "10 in of travel moved at no more than 100 % per second, where the actuators are assumed to saturate.",
        tuple(below(f"fastest {stick}", rate, 10.0 * 1.001, "in/s") for stick, rate in rates.items()),
    )


def uncoupled_cost(runs: Runs) -> Statement:
    """Relaxation against marching without flight dynamics."""
    run = runs["arrested-descent/time-marching"]
    ratio = cost.per_revolution(run) / cost.per_sweep(run)
    return Statement(
        "cost, uncoupled",
        "Uncoupled and steady, relaxation is N_b = 4 times faster.",
        (within("segment evaluations: a revolution of marching over a sweep of relaxation", ratio, 3.2, 4.8),),
    )


def coupled_cost(runs: Runs) -> Statement:
    """Relaxation against marching in the manoeuvres."""
    ratios = {}
    for maneuver in MANEUVERS:
        marched = runs[f"{maneuver}/time-marching"]
        ratios[maneuver] = [cost.work_ratio(runs[cap_name(maneuver, cap)], marched) for cap in CAPS]
    largest = max(max(r) for r in ratios.values())
    return Statement(
        "cost, coupled",
        "In the coupled manoeuvre relaxation takes up to 3 times longer, its loop often not converging.",
        (
            *(
                above(f"segment evaluations at the default cap over time marching, {m}", r[CAPS.index(10)], 1.0)
                for m, r in ratios.items()
            ),
            within("largest ratio over caps 5 to 20", largest, 2.0, 4.0),
            above(
                "share of revolutions that did not converge at the default cap, roll reversal",
                float(runs["roll-reversal/relaxation"].attrs["unconverged_revolutions"])
                / float(runs["roll-reversal/relaxation"].attrs["relaxation_updates"]),
                0.25,
            ),
        ),
    )


def overall_cost(runs: Runs) -> Statement:
    """Time of the whole."""
    shares = [cost.processor(runs[f"{m}/time-marching"]) / cost.processor(runs[f"{m}/relaxation"]) for m in MANEUVERS]
    return Statement(
        "cost, over all",
        "Over all, time marching takes about one third less time.",
        tuple(
            within(f"processor time of convergence phase and flight over that of relaxation, {m}", share, 0.55, 0.8)
            for m, share in zip(MANEUVERS, shares, strict=True)
        ),
    )
