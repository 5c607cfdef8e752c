# SPDX-License-Identifier: MIT OR Apache-2.0
"""Numbers of the paper's text, cost and conclusions: what the runs show where they do not fully hold."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ....._core import standard_atmosphere
from .....units import STANDARD_GRAVITY, convert
from ... import cost
from ... import quantities as q
from ...cases import CAPS, cap_name
from ..conclusions import HANDS_OFF, lag, transient
from ..descent import RX, TM
from .words import D, R, against, exceeds, where

if TYPE_CHECKING:
    from .words import Runs

PRINTED = 0.071
"""C_T/σ in the paper."""
LIKE = 0.3
"""Share by which two amounts of work, or two distances, may differ and still be of a size."""


def loading(runs: Runs) -> str:
    """C_T/sigma."""
    attrs = runs[f"{D}/{RX}"].attrs
    altitude, found = float(attrs["condition.altitude"]), float(attrs["ct_sigma"])
    # the same weight in denser air: C_T/σ goes with 1/ρ
    wanted = standard_atmosphere(altitude)[0] * found / PRINTED
    low, high = -2000.0, 11000.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if standard_atmosphere(middle)[0] > wanted else (low, middle)
    weight = float(attrs["condition.gross_mass"]) * STANDARD_GRAVITY
    return (
        f"{convert(weight, 'N', 'lbf'):.0f} lb in the standard atmosphere at {convert(altitude, 'm', 'ft'):.0f} ft is "
        f"C_T/σ = {found:.4f} for the "
        f"{attrs['aircraft']}'s rotor; the printed value fits about {round(convert(low, 'm', 'ft'), -2):.0f} ft."
    )


def lengths(runs: Runs) -> str:
    """Durations."""
    run = runs[f"{D}/{TM}"]
    turns = float(run.attrs["revolutions"])
    return f"{turns:g} revolutions of {q.period(run):.4f} s are {turns * q.period(run):.2f} s."


def rates(runs: Runs) -> str:
    """Rates of the sticks."""
    run = runs[f"{R}/{TM}"]
    stick, time = run["lateral"].values, run.time.values
    rate = np.diff(stick) / np.diff(time)
    asked = {"right": float(rate.max()), "left": float(-rate.min())}
    return (
        f"The paper's own steps ask for {asked['right']:.1f} in/s to the right and {asked['left']:.1f} in/s to the "
        "left; they are "
        "flown as given."
    )


def always_converges(runs: Runs) -> str:
    """Convergence of the loop."""
    text, strength = [], runs[f"{D}/{RX}"].attrs.get("configuration.inflow.tip_strength", "default")
    for cap in CAPS:
        missed = [
            f"{int(run.attrs['unconverged_revolutions'])} of {int(run.attrs['relaxation_updates'])}"
            for run in (runs[cap_name(m, cap)] for m in (D, R))
        ]
        text.append(f"{missed[0]} and {missed[1]} revolutions at a cap of {cap}")
    return (
        f"With a tip vortex of {strength} strength the loop misses its cap in {', '.join(text)} (descent and reversal)."
    )


def phase_cost(runs: Runs) -> str:
    """Cost over all."""
    descent, reversal = (runs[f"{maneuver}/{TM}"] for maneuver in (D, R))
    counted = cost.work(descent)
    share = {}
    for name, run in (("descent", descent), ("reversal", reversal)):
        wake, dynamics = (float(run.attrs[f"seconds_{part}"]) for part in ("wake", "dynamics"))
        share[name] = 100 * dynamics / (wake + dynamics)
    turns = float(descent.attrs["configuration.inflow.convergence_revolutions"])
    return (
        f"The {turns:g} revolutions of the convergence phase cost {counted.convergence / counted.flight:.2f} times the "
        "segments of "
        f"the descent ({counted.convergence / 1e6:.0f} against {counted.flight / 1e6:.0f} million), and the flight "
        "dynamics, which "
        f"count no segments, take {share['descent']:.0f} % of the time in flight there and {share['reversal']:.0f} % in "
        "the reversal."
    )


def small_transient(runs: Runs) -> str:
    """Conclusion 1."""
    settled, raw = runs[f"{D}/{TM}"], runs[f"{D}/no-convergence"]
    end = HANDS_OFF * q.period(settled)
    force = {name: 100 * transient(run) for name, run in (("with", settled), ("without", raw))}
    rate = {
        name: q.DEG * max(q.excursion(run, each, 0.0, end) for each in ("p", "q", "r"))
        for name, run in (("with", settled), ("without", raw))
    }
    drift = 100 * float(settled.attrs.get("convergence_lift_drift", 0.0))
    left = 100 * q.rms_difference(raw, settled, "q") / q.excursion(settled, "q")
    either_way = rate["with"] > 0.5 * rate["without"]
    return (
        f"Before the pilot moves the force is off by {force['without']:.1f} % without the phase and {force['with']:.1f} "
        "% with it, "
        f"body rates reach {rate['without']:.1f} and {rate['with']:.1f}°/s; in the manoeuvre q differs by {left:.1f} % "
        "of its "
        f"excursion. During the phase the lift drifts by {drift:+.1f} %"
        + where(either_way, ": what it cannot remove is that the trim was made with the other wake")
        + "."
    )


def sample_and_hold(runs: Runs) -> str:
    """Conclusions 2 and 3."""
    late = {m: lag(runs[f"{m}/{RX}"], runs[f"{m}/{TM}"], "inflow_mean") for m in (D, R)}
    mean = {m: [float(runs[f"{m}/{wake}"]["inflow_mean"].mean()) for wake in (RX, TM)] for m in (D, R)}
    words = {m: against(mean[m][0], mean[m][1], "more", "less", "the same") for m in (D, R)}
    delayed = 0.1 < late[D] < 1.0
    same = all(word == "the same" for word in words.values())
    return (
        f"The mean inflow of relaxation is {late[D]:.2f} revolutions late in the descent and {late[R]:.2f} in the reversal"
        + where(delayed, "; holding for a revolution delays by half of one on average")
        + f". Over the whole manoeuvre, beside time marching, it is {words[D]} in the descent ({mean[D][0]:.4f}, "
        f"{mean[D][1]:.4f}) and "
        f"{words[R]} in the reversal ({mean[R][0]:.4f}, {mean[R][1]:.4f})"
        + where(delayed and same, ": a delay gives less inflow while it grows and more while it falls")
        + "."
    )


def already_apart(runs: Runs) -> str:
    """Conclusion 5."""

    def apart(maneuver: str, revolution: float, old: bool = False) -> float:
        a, b = (q.filament(runs[f"{maneuver}/{m}"], revolution) for m in (RX, TM))
        return q.first_turn_rms(a[-73:], b[-73:], 73) if old else q.first_turn_rms(a, b, 73)

    trim = apart(D, 0.0)
    young = {D: [apart(D, n) for n in (5.0, 8.0, 10.0)], R: [apart(R, n) for n in (15.0, 18.0, 21.0)]}
    old = [apart(D, 8.0, True), apart(D, 0.0, True)]
    of_a_size = max(young[D] + young[R]) < 2.0 * trim * (1.0 + LIKE)
    descent, reversal = (", ".join(f"{x:.2f}" for x in young[m]) for m in (D, R))
    return (
        f"The two wakes are {trim:.2f} R apart at trim already (RMS over two turns), {descent} R after 5, 8, 10 "
        "revolutions of the "
        f"descent and {reversal} R after 15, 18, 21 of the reversal"
        + where(
            of_a_size, ": what the young wake misses is of the size of what the two schemes differ by in steady flight"
        )
        + f". Their last two turns are {old[1]:.2f} R apart at trim and {old[0]:.2f} R after 8 revolutions of the descent"
        + where(exceeds(*old), ": the old wake misses more")
        + "."
    )
