# SPDX-License-Identifier: MIT OR Apache-2.0
"""Figures 4 to 11: what trim and arrested descent show where the paper's sentence does not fully hold."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .....plotting.disk import harmonics, revolution_map
from ... import quantities as q
from ..descent import DI, RX, TM
from .words import D, against, at, exceeds, least, listed, most, where

if TYPE_CHECKING:
    from .words import Runs

SIZE = ("larger", "smaller", "no larger")
TIME = ("later", "earlier", "no later")
ALIKE = 0.25
"""Share of the larger of two distances by which they may differ and still count as alike."""


def roll_geometry(runs: Runs) -> str:
    """Figure 4."""
    a, b = q.filament(runs[f"{D}/{RX}"], 0.0), q.filament(runs[f"{D}/{TM}"], 0.0)
    apart, edge = np.linalg.norm(a - b, axis=1), np.abs(a[:, 1]) > 0.7
    turn = np.arange(apart.size) // 36

    def rms(k: int, where: np.ndarray) -> float:
        return float(np.sqrt(np.mean(apart[(turn == k) & where] ** 2)))

    first, third = (rms(0, edge), rms(0, ~edge)), (rms(2, edge), rms(2, ~edge))
    at_edges = exceeds(*first)
    everywhere = abs(third[0] - third[1]) < ALIKE * max(third)
    return (
        f"In the first turn the wakes differ {against(*first, 'more', 'less', 'no more')} at the edges than elsewhere "
        f"({first[0]:.3f} R against {first[1]:.3f} R), in the third "
        f"{where(everywhere, 'about alike everywhere', 'unevenly')} "
        f"({third[0]:.2f} R and {third[1]:.2f} R)"
        + where(at_edges and everywhere, ": a filament displaced where it rolls up goes on displaced")
        + "."
    )


def overshoot(runs: Runs) -> str:
    """Figure 5b."""
    peak = {m: q.extreme(runs[f"{D}/{m}"], "force_z", -1.0)[0] for m in (RX, TM)}
    when = q.extreme(runs[f"{D}/{RX}"], "force_z", -1.0)[1]
    inflow = {m: at(runs[f"{D}/{m}"], "inflow_mean", when) for m in (RX, TM)}
    late = exceeds(inflow[TM], inflow[RX]) and exceeds(peak[RX], peak[TM])
    return (
        f"When the force of relaxation peaks, at {when:.2f} s, its mean inflow is {inflow[RX]:.4f} where time marching has "
        f"{inflow[TM]:.4f}"
        + where(late, ": it flies with the inflow of up to a revolution ago, so its thrust overshoots")
        + "."
    )


def moment_timing(runs: Runs) -> str:
    """Figure 5c."""
    flights = {m: runs[f"{D}/{m}"] for m in (DI, RX, TM)}
    control = float(flights[TM].time[int(np.argmax(flights[TM]["collective"].values))])
    peak = {m: q.extreme(run, "inflow_mean", 1.0)[1] for m, run in flights.items()}
    after = {m: q.extreme(run, "moment_y", 1.0)[1] - control for m, run in flights.items()}
    top = q.extreme(flights[TM], "moment_y", 1.0)[0]
    late = [float(np.mean(flights[m]["moment_y"].values[q.window(flights[m], 2.0)])) for m in (TM, RX)]
    slower = against(peak[DI], peak[TM], "slower", "faster", "as fast")
    return (
        f"Our dynamic inflow is {slower}: its mean inflow peaks at {peak[DI]:.2f} s, that of time marching at "
        f"{peak[TM]:.2f} s. "
        f"The moment peaks {listed(after, '+.2f')} s after the control; after 2 s it is "
        f"{against(late[0], late[1], 'larger', 'smaller', 'equal')} with "
        f"time marching, by {100 * abs(late[0] - late[1]) / top:.1f} % of the peak ({top / 1e3:.0f} kN m)."
    )


def climb(runs: Runs) -> str:
    """Figure 6a."""
    flights = {m: runs[f"{D}/{m}"] for m in (DI, RX, TM)}
    rise = {
        m: float(np.mean([at(run, "inflow_mean", t) for t in np.linspace(0.47, 1.0, 20)])) - at(run, "inflow_mean", 0.3)
        for m, run in flights.items()
    }
    climbed = {m: q.extreme(run, "w", -1.0, 0.0, 1.5)[0] for m, run in flights.items()}
    opposed = most(rise) == least(climbed) and least(rise) == most(climbed)
    return (
        f"While the collective rises the mean inflow grows most with {most(rise)} (on average by {listed(rise)}), and "
        "it climbs "
        f"least with {least(climbed)}, most with {most(climbed)} (drop of w {listed(climbed, '.2f')} m/s)"
        + where(opposed, ": inflow takes thrust away")
        + "."
    )


def lateral_tilt(runs: Runs) -> str:
    """Figure 7b."""
    fore_aft = {
        m: [harmonics(revolution_map(runs[f"{D}/{m}"], "inflow", n))[1] for n in range(3, 9)] for m in (DI, RX, TM)
    }
    peak = {m: max(values) for m, values in fore_aft.items()}
    turn = {m: 3 + int(np.argmax(values)) for m, values in fore_aft.items()}
    tilt = [q.DEG * q.excursion(runs[f"{D}/{m}"], "beta_1s") for m in (DI, RX, TM)]
    return (
        f"The peak of the fore-and-aft inflow, which tilts the disk sideways, is {against(peak[RX], peak[TM], *SIZE)} with "
        f"relaxation than with time marching (λ₁c {listed(peak)}) and comes {against(turn[RX], turn[TM], *TIME)} "
        "(revolutions "
        f"{turn[RX]} and {turn[TM]}); the three peaks of β₁s lie within {max(tilt) - min(tilt):.2f}°."
    )


def trims(runs: Runs) -> str:
    """Trim."""
    a, b = runs[f"{D}/{DI}"], runs[f"{D}/{RX}"]
    inflow = [float(run["inflow_mean"][0]) for run in (a, b)]
    power = float(a.attrs["power"]) / float(b.attrs["power"]) - 1.0
    return (
        "At a given flight path θ and w say the same thing (tan(θ − γ) = w/u), so these are one difference, of "
        f"{q.DEG * (float(a['pitch'][0]) - float(b['pitch'][0])):+.2f}°; it goes with "
        f"{against(inflow[0], inflow[1], 'more', 'less', 'the same')} mean inflow ({inflow[0]:.4f} against {inflow[1]:.4f}) and "
        f"{100 * power:+.0f} % of power with dynamic inflow."
    )


def after_five(runs: Runs) -> str:
    """Figures 8 to 10."""
    five, six = (
        {m: q.sector_mean(q.change_from_trim(runs[f"{D}/{m}"], "inflow", n)) for m in (RX, TM)} for n in (5.0, 6.0)
    )
    lift = {m: q.sector_mean(revolution_map(runs[f"{D}/{m}"], "cl_m2", 6.0)) for m in (RX, TM)}
    words = ("more", "less", "as much")
    turns = against(five[RX], five[TM], *words) != against(six[RX], six[TM], *words)
    opposed = (six[RX] - six[TM]) * (lift[RX] - lift[TM]) < 0.0
    return (
        where(
            turns,
            "The order turns with the moment: relaxation repeats in one revolution what time marching does half a revolution "
            "before. ",
        )
        + f"In revolution 5 relaxation has {against(five[RX], five[TM], *words)} change of mean inflow ({five[RX]:.4f}, time "
        f"marching {five[TM]:.4f}), in revolution 6 {against(six[RX], six[TM], *words)} ({six[RX]:.4f} against "
        f"{six[TM]:.4f}) and "
        f"{against(lift[RX], lift[TM], *words)} lift (mean C_l M² {lift[RX]:.3f} against {lift[TM]:.3f})"
        + where(
            opposed,
            ": more inflow goes with less lift, which the paper's third conclusion has and its Figures 8 and 9 not",
        )
        + "."
    )


def equilibrium(runs: Runs) -> str:
    """Figure 11."""
    height = {
        (m, n): float(q.filament(runs[f"{D}/{m}"], n)[-73:, 2].mean()) for m in (RX, TM) for n in (4.75, 5.0, 8.0)
    }
    ahead = {n: height[RX, n] - height[TM, n] for n in (4.75, 5.0, 8.0)}
    as_steady = ahead[5.0] > 0.0 and ahead[8.0] > 0.0 and ahead[4.75] < 0.0
    return (
        f"The last two turns of relaxation lie {ahead[5.0]:+.2f} R and {ahead[8.0]:+.2f} R above those of time marching "
        "just after "
        f"an update (revolutions 5 and 8), {ahead[4.75]:+.2f} R just before one (4.75)"
        + where(
            as_steady,
            ". A relaxed wake is that of a steady flight in the state of the moment: its old turns lie where that state "
            "would "
            "have carried them, while marching's were left by blades up to four revolutions ago; while w grows it is ahead "
            "after its update and behind before it",
        )
        + "."
    )
