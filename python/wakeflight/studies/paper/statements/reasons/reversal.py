# SPDX-License-Identifier: MIT OR Apache-2.0
"""Figures 12 to 19: what the roll reversal shows where the paper's sentence does not fully hold."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .....plotting.disk import harmonics, revolution_map
from ... import quantities as q
from ..descent import DI, RX, TM
from ..roll import AFTER, pitch_weight
from .words import R, against, at, exceeds, listed, where

if TYPE_CHECKING:
    import xarray as xr

    from .words import Runs

LEFT, THIRD, HELD = 2.6, 4.8, 6.0
"""When the step to the left begins, the third one begins, and is held [s]."""
PARTED = 1.0
"""Difference of flapping [deg] or attitude [deg] from which flights count as different."""
NEAR_STALL = 0.9


def _steps(run: xr.Dataset) -> tuple[float, float, float]:
    """Lateral stick of the first step from trim [in], seconds it is held, and how far the left one is from trim."""
    stick = run["lateral"].values - float(run["lateral"][0])
    early = q.window(run, 0.0, LEFT)
    first = float(stick[early].max())
    held = float(np.ptp(run.time.values[early & (stick > 0.99 * first)]))
    return first, held, float(-stick.min())


def _bank(run: xr.Dataset) -> str:
    first, held, left = _steps(run)
    right = q.DEG * q.extreme(run, "roll", 1.0)[0]
    per_inch = q.DEG * q.extreme(run, "p", 1.0, 0.0, LEFT)[0] / first
    return (
        f"At {per_inch:.0f}°/s per inch the first step, held for {held:.1f} s, rolls the aircraft to {right:.0f}° of "
        "bank, and the "
        f"left one is {left / first:.1f} times as far from trim"
    )


def other_flight(runs: Runs) -> str:
    """Figure 12c."""
    pitch = {m: q.DEG * at(runs[f"{R}/{m}"], "pitch", THIRD) for m in (DI, TM)}
    w = {m: at(runs[f"{R}/{m}"], "w", THIRD) for m in (DI, TM)}
    parted = abs(pitch[DI] - pitch[TM]) > PARTED
    return (
        f"{_bank(runs[f'{R}/{TM}'])}; at {THIRD:g} s, when the third step begins, θ = {listed(pitch, '.0f')} [deg], w = "
        f"{listed(w, '.0f')} [m/s]"
        + where(parted, ": the flights are no longer the same, and moments of different states are compared")
        + "."
    )


def sideward(runs: Runs) -> str:
    """Figure 13a."""
    flights = {m: runs[f"{R}/{m}"] for m in (DI, TM)}
    turn = q.period(flights[TM])
    w = {m: at(run, "w", 10 * turn) for m, run in flights.items()}
    inflow = {m: at(run, "inflow_mean", 5 * turn) for m, run in flights.items()}
    trim = float(flights[DI]["inflow_mean"][0])
    thrust = at(flights[DI], "ct", 5 * turn) / float(flights[DI].attrs["ct"])
    raised = exceeds(inflow[DI], trim) and thrust < 1.0
    return (
        f"v collects p·w: at 10 revolutions w = {listed(w, '.1f')} [m/s], at p = "
        f"{q.DEG * at(flights[TM], 'p', 10 * turn):.0f}°/s. "
        f"At 5 revolutions, the thrust at {100 * thrust:.0f} % of trim, the mean inflow is {listed(inflow)}; at trim it was "
        f"{trim:.4f} with dynamic inflow"
        + where(
            raised,
            ": in the three-state model only the aerodynamic pitching moment that precesses the rolling rotor can raise it",
        )
        + "."
    )


def never_right(runs: Runs) -> str:
    """Figures 13b and 13c."""
    run = runs[f"{R}/{TM}"]
    roll, w, force = (at(run, name, HELD) for name in ("roll", "w", "force_z"))
    again = q.DEG * q.extreme(run, "p", 1.0, THIRD, THIRD + 2.2)[0]
    inverted, regained = abs(q.DEG * roll) > 90.0, again > 5.0
    return (
        f"{_bank(run)}: it goes on to {q.DEG * float(run['roll'].values.min()):.0f}°. When the third step is held, at "
        f"{HELD:g} s, "
        f"φ = {q.DEG * roll:.0f}°, w = {w:.0f} m/s, Z = {force / 1e3:+.0f} kN, q = {q.DEG * at(run, 'q', HELD):.0f}°/s"
        + where(inverted and w < 0.0, ": inverted, the aircraft falls roof first")
        + f"; after that step it rolls to the right at up to {again:.0f}°/s"
        + where(
            not regained,
            ", no second roll to the right. The paper's cannot be the manoeuvre it describes, or its aircraft rolled "
            "less per inch",
        )
        + "."
    )


def flapping_apart(runs: Runs) -> str:
    """Figure 14."""
    flights = {m: runs[f"{R}/{m}"] for m in (DI, TM)}
    apart = q.DEG * np.abs(np.subtract(*(q.smoothed(run, "beta_1c") for run in flights.values())))
    beyond = np.flatnonzero(apart > PARTED)
    parting = float(flights[TM].time[beyond[0]]) if beyond.size else None
    gradients = {m: harmonics(revolution_map(run, "inflow", 20.0))[1:] for m, run in flights.items()}
    kind = {m: "fore and aft" if abs(c) > abs(s) else "lateral" for m, (c, s) in gradients.items()}
    tilt = {m: q.DEG * at(run, "beta_1c", 4.4) for m, run in flights.items()}
    when = "never" if parting is None else f"from {parting:.1f} s on"
    step = where(parting is not None and parting < THIRD, " (before the third step)")
    return (
        f"β₁c of the models differs by more than {PARTED:g}° {when}{step}; at 4.4 s it is {listed(tilt, '.1f')} [deg]. In "
        f"revolution 20 the gradients of inflow are λ₁c = {gradients[DI][0]:.3f}, λ₁s = {gradients[DI][1]:.3f} with "
        "dynamic inflow, "
        f"mostly {kind[DI]}, {gradients[TM][0]:.3f} and {gradients[TM][1]:.3f} with time marching, mostly {kind[TM]}."
    )


def unloaded(runs: Runs) -> str:
    """Figures 15 to 18."""
    flights = {m: runs[f"{R}/{m}"] for m in (RX, TM)}
    maps = {m: revolution_map(run, "cl_m2", AFTER) for m, run in flights.items()}
    mean = {m: q.sector_mean(field) for m, field in maps.items()}
    trim = q.sector_mean(revolution_map(flights[TM], "cl_m2", 1))
    seconds = AFTER * q.period(flights[TM])
    front, rear = (q.sector_mean(maps[TM], span) for span in ((90, 270), (-90, 90)))
    largest = q.place_of_largest(revolution_map(flights[TM], "cl", AFTER), absolute=False)[2]
    down = {m: -q.sector_mean(pitch_weight(field)) for m, field in maps.items()}
    p = {m: q.DEG * at(run, "p", seconds) for m, run in flights.items()}
    goes_with = (down[RX] - down[TM]) * (abs(p[RX]) - abs(p[TM])) > 0.0
    return (
        f"At {q.DEG * at(flights[TM], 'roll', seconds):.0f}° of bank the rotor carries {100 * mean[TM] / trim:.0f} % of "
        "trim (mean "
        f"C_l M² {listed(mean, '+.3f')}), the front {front:+.3f} and the rear {rear:+.3f}; the largest C_l is {largest:.2f}"
        + where(largest < NEAR_STALL, ", so nothing is near stall")
        + f". The nose-down moment ({listed(down)}) goes with the roll rate ({listed(p, '.0f')} [deg/s])"
        + where(goes_with, ", at which it precesses the rotor: the faster roll has the larger one")
        + "."
    )


def turning_helix(runs: Runs) -> str:
    """Figure 19."""
    bends = {m: [abs(q.bend(q.filament(runs[f"{R}/{m}"], n))) for n in (15.0, 21.0)] for m in (RX, TM)}
    curved = all(exceeds(a, b) for a, b in zip(bends[RX], bends[TM], strict=True))
    words = [against(a, b, "more than", "less than", "as much as") for a, b in zip(bends[RX], bends[TM], strict=True)]
    return (
        f"The relaxed wake bends {words[0]} the marching one after 15 revolutions ({bends[RX][0]:.3f}, {bends[TM][0]:.3f}), "
        f"{words[1]} it after 21 ({bends[RX][1]:.3f}, {bends[TM][1]:.3f})"
        + where(
            curved,
            ". Bend is no mark of memory: the relaxed wake is the curved helix of a steady turn at the p and q of the "
            "moment, the "
            "marching one lies along the path that was flown",
        )
        + "."
    )
