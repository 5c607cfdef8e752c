# SPDX-License-Identifier: MIT OR Apache-2.0
"""Why a statement does not fully hold: what the data of the same runs show, with its numbers computed from them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from ....plotting.disk import harmonics, revolution_map
from .. import cost
from .. import quantities as q
from .descent import DI, RX, TM
from .roll import AFTER, pitch_weight

if TYPE_CHECKING:
    import xarray as xr

    Runs = Mapping[str, xr.Dataset]

D, R = "arrested-descent", "roll-reversal"


def reason(key: str, runs: Runs) -> str:
    """The sentence for a row of the table; empty where none was found out."""
    make = REASONS.get(key)
    return make(runs) if make else ""


def at(run: xr.Dataset, name: str, seconds: float) -> float:
    """A history, averaged over a blade passage, at a time."""
    return float(np.interp(seconds, run.time.values, q.smoothed(run, name)))


def roll_geometry(runs: Runs) -> str:
    """Figure 4."""
    a, b = q.filament(runs[f"{D}/{RX}"], 0.0), q.filament(runs[f"{D}/{TM}"], 0.0)
    apart, edge = np.linalg.norm(a - b, axis=1), np.abs(a[:, 1]) > 0.7
    turn = np.arange(apart.size) // 36

    def rms(k: int, where: np.ndarray) -> float:
        return float(np.sqrt(np.mean(apart[(turn == k) & where] ** 2)))

    return (
        f"In the first turn the wakes do differ most at the edges ({rms(0, edge):.3f} R against "
        f"{rms(0, ~edge):.3f} R); "
        f"from the second on they differ everywhere alike ({rms(2, edge):.2f} R and {rms(2, ~edge):.2f} R in "
        f"the third), "
        "for a filament displaced where it rolls up goes on displaced."
    )


def overshoot(runs: Runs) -> str:
    """Figure 5b."""
    when = q.extreme(runs[f"{D}/{RX}"], "force_z", -1.0)[1]
    inflow = {m: at(runs[f"{D}/{m}"], "inflow_mean", when) for m in (RX, TM)}
    return (
        f"Relaxation flies with the inflow of up to a revolution ago: when its force peaks, at {when:.2f} s, "
        f"its mean inflow is "
        f"{inflow[RX]:.4f} where time marching has {inflow[TM]:.4f}, so its thrust overshoots."
    )


def moment_timing(runs: Runs) -> str:
    """Figure 5c."""
    peak = {m: q.extreme(runs[f"{D}/{m}"], "inflow_mean", 1.0)[1] for m in (DI, TM)}
    top = q.extreme(runs[f"{D}/{TM}"], "moment_y", 1.0)[0] / 1e3
    return (
        f"Our dynamic inflow is no slower: its mean inflow peaks at {peak[DI]:.2f} s, that of time marching "
        f"at {peak[TM]:.2f} s, and "
        f"the moment follows the control with all three; the late difference of the wakes is a hundredth of "
        f"the peak ({top:.0f} kN m)."
    )


def climb(runs: Runs) -> str:
    """Figure 6a."""
    rise = {
        m: np.mean([at(runs[f"{D}/{m}"], "inflow_mean", t) for t in np.linspace(0.47, 1.0, 20)])
        - at(runs[f"{D}/{m}"], "inflow_mean", 0.3)
        for m in (DI, RX, TM)
    }
    return (
        f"While the collective rises the mean inflow grows most with time marching (by {rise[TM]:.4f} on "
        f"average, dynamic inflow "
        f"{rise[DI]:.4f}, relaxation {rise[RX]:.4f}), which takes thrust away: it climbs least, relaxation, "
        f"whose inflow is late, most."
    )


def lateral_tilt(runs: Runs) -> str:
    """Figure 7b."""
    peak = {
        m: max(harmonics(revolution_map(runs[f"{D}/{m}"], "inflow", n))[1] for n in range(3, 9)) for m in (DI, RX, TM)
    }
    return (
        "The fore-and-aft inflow that tilts the disk sideways reaches the same peak with both wakes "
        f"(λ₁c {peak[RX]:.4f} and {peak[TM]:.4f}; dynamic inflow {peak[DI]:.4f}), later with relaxation but "
        f"not larger; the three peaks "
        "of β₁s lie within an eighth of a degree."
    )


def trims(runs: Runs) -> str:
    """Trim."""
    a, b = runs[f"{D}/{DI}"], runs[f"{D}/{RX}"]
    return (
        "At a given flight path θ and w say the same thing (tan(θ − γ) = w/u), so these are one difference, of "
        f"{q.DEG * abs(float(a['pitch'][0] - b['pitch'][0])):.2f}°; it goes with less mean inflow "
        f"({float(a['inflow_mean'][0]):.4f} against "
        f"{float(b['inflow_mean'][0]):.4f}) and "
        f"{100 * (1 - float(a.attrs['power']) / float(b.attrs['power'])):.0f} % less power with dynamic "
        "inflow."
    )


def after_five(runs: Runs) -> str:
    """Figures 8 to 10."""
    mean = {
        (m, n): q.sector_mean(q.change_from_trim(runs[f"{D}/{m}"], "inflow", n)) for m in (RX, TM) for n in (5.0, 6.0)
    }
    lift = {m: q.sector_mean(revolution_map(runs[f"{D}/{m}"], "cl_m2", 6.0)) for m in (RX, TM)}
    return (
        "The order turns with the moment: relaxation repeats in one revolution what time marching does half "
        "a revolution before. In "
        f"revolution 5 the mean changes of inflow are equal ({mean[RX, 5.0]:.4f}, {mean[TM, 5.0]:.4f}), in "
        f"revolution 6, the control "
        f"falling, relaxation has more ({mean[RX, 6.0]:.4f} against {mean[TM, 6.0]:.4f}) and with it less lift "
        f"(mean C_l M² {lift[RX]:.3f} against {lift[TM]:.3f}), as the paper's third conclusion has it and its "
        f"Figures 8 and 9 do not."
    )


def equilibrium(runs: Runs) -> str:
    """Figure 11."""
    height = {
        (m, n): float(q.filament(runs[f"{D}/{m}"], n)[-73:, 2].mean()) for m in (RX, TM) for n in (4.75, 5.0, 8.0)
    }
    return (
        "A relaxed wake is that of a steady flight in the state of the moment: its old turns lie where that "
        "state would have carried "
        "them, while marching's were left by blades up to four revolutions ago. So while w grows relaxation "
        "is ahead just after its "
        f"update (last two turns at {height[RX, 5.0]:.2f} R against {height[TM, 5.0]:.2f} R, "
        f"{height[RX, 8.0]:.2f} against "
        f"{height[TM, 8.0]:.2f}) and behind just before it ({height[RX, 4.75]:.2f} R against "
        f"{height[TM, 4.75]:.2f} R at 4.75 revolutions)."
    )


def _bank(runs: Runs) -> str:
    run = runs[f"{R}/{TM}"]
    right = q.DEG * q.extreme(run, "roll", 1.0)[0]
    per_inch = q.DEG * q.extreme(run, "p", 1.0, 0.0, 2.6)[0] / 2.59
    return (
        f"At {per_inch:.0f}°/s per inch the first step, held for 2.2 s, rolls the aircraft to {right:.0f}° of "
        f"bank, and the left one is twice "
        "as far from trim"
    )


def other_flight(runs: Runs) -> str:
    """Figure 12c."""
    state = {m: (q.DEG * at(runs[f"{R}/{m}"], "pitch", 4.8), at(runs[f"{R}/{m}"], "w", 4.8)) for m in (DI, TM)}
    return (
        f"{_bank(runs)}; by the third step the flights are no longer the same: at 4.8 s θ = "
        f"{state[DI][0]:.0f}° and w = "
        f"{state[DI][1]:.0f} m/s with dynamic inflow, {state[TM][0]:.0f}° and {state[TM][1]:.0f} m/s with "
        f"time marching. Moments of "
        "different states are compared."
    )


def sideward(runs: Runs) -> str:
    """Figure 13a."""
    seconds = 10 * q.period(runs[f"{R}/{TM}"])
    w = {m: at(runs[f"{R}/{m}"], "w", seconds) for m in (DI, TM)}
    p = at(runs[f"{R}/{TM}"], "p", seconds)
    five = 5 * q.period(runs[f"{R}/{TM}"])
    inflow = {m: at(runs[f"{R}/{m}"], "inflow_mean", five) for m in (DI, TM)}
    thrust = at(runs[f"{R}/{DI}"], "ct", five) / float(runs[f"{R}/{DI}"].attrs["ct"])
    return (
        f"v collects p·w, and w differs: at 10 revolutions {w[DI]:.1f} m/s with dynamic inflow, {w[TM]:.1f} "
        f"m/s with time marching, at "
        f"p = {q.DEG * p:.0f}°/s. w differs because the mean inflow does: at 5 revolutions, the thrust at "
        f"{100 * thrust:.0f} % of trim, it is "
        f"{inflow[DI]:.4f} with dynamic inflow, above that of trim "
        f"({float(runs[f'{R}/{DI}']['inflow_mean'][0]):.4f}), and {inflow[TM]:.4f} with "
        "time marching; in the three-state model only the aerodynamic pitching moment that precesses the "
        "rolling rotor can raise it."
    )


def never_right(runs: Runs) -> str:
    """Figures 13b and 13c."""
    run = runs[f"{R}/{TM}"]
    return (
        f"{_bank(runs)}: it goes on to {q.DEG * float(run['roll'].values.min()):.0f}°. When the third step is "
        f"held, at 6 s, the aircraft is "
        f"inverted and falls roof first (w = {at(run, 'w', 6.0):.0f} m/s, Z = "
        f"{at(run, 'force_z', 6.0) / 1e3:+.0f} kN) at q = "
        f"{q.DEG * at(run, 'q', 6.0):.0f}°/s, and full right stick of the step only stops the roll: no second "
        f"roll to the right takes place. The "
        "paper's cannot be the manoeuvre it describes, or its aircraft rolled less per inch."
    )


def flapping_apart(runs: Runs) -> str:
    """Figure 14."""
    tilt = {m: q.DEG * at(runs[f"{R}/{m}"], "beta_1c", 4.4) for m in (DI, TM)}
    inflow = {m: harmonics(revolution_map(runs[f"{R}/{m}"], "inflow", 20.0)) for m in (DI, TM)}
    w = {m: at(runs[f"{R}/{m}"], "w", 4.4) for m in (DI, TM)}
    return (
        f"The models part at the left step, not at the third: at 4.4 s β₁c is {tilt[DI]:.1f}° with dynamic "
        f"inflow and "
        f"{tilt[TM]:.1f}° with time marching, w {w[DI]:.0f} and {w[TM]:.0f} m/s; in revolution 20 the "
        f"gradients of inflow are "
        f"λ₁c = {inflow[DI][1]:.3f}, λ₁s = {inflow[DI][2]:.3f} with dynamic inflow, {inflow[TM][1]:.3f} and "
        f"{inflow[TM][2]:.3f} with time marching: the one lateral, the other fore and aft."
    )


def unloaded(runs: Runs) -> str:
    """Figures 15 to 18."""
    maps = {m: revolution_map(runs[f"{R}/{m}"], "cl_m2", AFTER) for m in (RX, TM)}
    seconds = AFTER * q.period(runs[f"{R}/{TM}"])
    p = {m: q.DEG * at(runs[f"{R}/{m}"], "p", seconds) for m in (RX, TM)}
    down = {m: -q.sector_mean(pitch_weight(maps[m])) for m in (RX, TM)}
    return (
        f"At {q.DEG * at(runs[f'{R}/{TM}'], 'roll', seconds):.0f}° of bank the rotor is unloaded: mean C_l M² "
        f"{q.sector_mean(maps[RX]):+.3f} with "
        f"relaxation, {q.sector_mean(maps[TM]):+.3f} with time marching, largest C_l "
        f"{q.place_of_largest(revolution_map(runs[f'{R}/{TM}'], 'cl', AFTER), absolute=False)[2]:.2f}, so the "
        f"front pushes down harder than the "
        f"rear lifts and nothing is near stall. The nose-down moment ({down[RX]:.4f}, {down[TM]:.4f}) is what "
        f"precesses the rotor at the roll "
        f"rate, larger with relaxation (p = {p[RX]:.0f}°/s against {p[TM]:.0f}°/s)."
    )


def turning_helix(runs: Runs) -> str:
    """Figure 19."""
    bends = {(m, n): q.bend(q.filament(runs[f"{R}/{m}"], n)) for m in (RX, TM) for n in (15.0, 21.0)}
    return (
        "Bend is no mark of memory: the relaxed wake is the curved helix of a steady turn at the p and q of "
        "the moment "
        f"(bend {bends[RX, 15.0]:.3f} and {bends[RX, 21.0]:.3f} after 15 and 21 revolutions), the marching "
        f"one ({bends[TM, 15.0]:.3f}, "
        f"{bends[TM, 21.0]:.3f}) lies along the path that was flown, which the view in three dimensions shows."
    )


def loading(runs: Runs) -> str:
    """C_T/sigma."""
    return (
        f"16 000 lb in the standard atmosphere at 5250 ft is C_T/σ = "
        f"{float(runs[f'{D}/{RX}'].attrs['ct_sigma']):.4f} for the UH-60A's rotor; the "
        "printed value fits about 900 ft."
    )


def lengths(runs: Runs) -> str:
    """Durations."""
    return f"12 revolutions of {q.period(runs[f'{D}/{TM}']):.4f} s are {12 * q.period(runs[f'{D}/{TM}']):.2f} s; all else agrees."


def rates(_: Runs) -> str:
    """Rates of the sticks."""
    return "The paper's own steps, 2.59 in within 0.2 s and 7.72 in within 0.7 s, ask for 13.0 and 11.0 in/s; flown as given."


def always_converges(runs: Runs) -> str:
    """Convergence of the loop."""
    capped = {m: runs[f"{m}/relaxation-cap-5"].attrs["unconverged_revolutions"] for m in (D, R)}
    return (
        "With a tip vortex of the uniform circulation of equal thrust the loop converges within ten "
        "iterations in every revolution; only a cap "
        f"of 5 leaves revolutions unconverged ({int(capped[D])} of 12 and {int(capped[R])} of 36)."
    )


def phase_cost(runs: Runs) -> str:
    """Cost over all."""
    descent, reversal = (runs[f"{maneuver}/{TM}"] for maneuver in (D, R))
    counted = cost.work(descent)
    share = {}
    for name, run in (("descent", descent), ("reversal", reversal)):
        wake, dynamics = (float(run.attrs[f"seconds_{part}"]) for part in ("wake", "dynamics"))
        share[name] = 100 * dynamics / (wake + dynamics)
    return (
        f"The ten revolutions of the convergence phase ({counted.convergence / 1e6:.0f} million segments) cost nearly as much "
        f"as the twelve of the descent ({counted.flight / 1e6:.0f}), and the flight dynamics, the same for both wakes, take "
        f"{share['descent']:.0f} % of the time in flight there and {share['reversal']:.0f} % in the reversal: what is counted in "
        "segments is diluted in time, the more the faster segments are evaluated."
    )


def small_transient(runs: Runs) -> str:
    """Conclusion 1."""
    run = runs[f"{D}/{TM}"]
    drift = 100 * float(run.attrs.get("convergence_lift_drift", 0.0))
    return (
        "The transient is there and dies out within two revolutions, before it matters. What the phase "
        "cannot remove is that the trim was "
        f"made with the other wake: the lift drifts by {drift:+.1f} % during the phase, and body rates of "
        f"half a degree per second follow with "
        "or without it."
    )


def sample_and_hold(runs: Runs) -> str:
    """Conclusions 2 and 3."""
    return (
        "Holding for a revolution delays by half of one on average, which shows where the inflow rises and "
        "falls within two revolutions, as in "
        "the arrested descent; in the roll reversal it changes over five and more and the steps straddle it. "
        "A delay gives less inflow while "
        "it grows and more while it falls, so that over a manoeuvre the mean is the same."
    )


def already_apart(runs: Runs) -> str:
    """Conclusion 5."""

    def apart(maneuver: str, revolution: float) -> float:
        return q.first_turn_rms(*(q.filament(runs[f"{maneuver}/{m}"], revolution) for m in (RX, TM)), 73)

    descent = ", ".join(f"{apart(D, n):.2f}" for n in (5.0, 8.0, 10.0))
    reversal = ", ".join(f"{apart(R, n):.2f}" for n in (15.0, 18.0, 21.0))
    return (
        f"The two wakes are {apart(D, 0.0):.2f} R apart at trim already (RMS over two turns), {descent} R "
        f"after 5, 8, 10 "
        f"revolutions of the descent and {reversal} R after 15, 18, 21 of the reversal: what the young "
        f"wake misses is of the "
        "size of what the two schemes differ by in steady flight. The old wake misses more, Figures 11 and 19."
    )


REASONS: dict[str, Callable[[Runs], str]] = {
    "Fig. 4": roll_geometry,
    "Fig. 5b": overshoot,
    "Fig. 5c": moment_timing,
    "Fig. 6a": climb,
    "Fig. 7b": lateral_tilt,
    "Figs. 5–7, trim": trims,
    "Fig. 8": after_five,
    "Fig. 9": after_five,
    "Fig. 10": after_five,
    "Fig. 11": equilibrium,
    "Fig. 12c": other_flight,
    "Fig. 13a": sideward,
    "Fig. 13b": never_right,
    "Fig. 13c": never_right,
    "Fig. 14a": flapping_apart,
    "Fig. 14b": flapping_apart,
    "Fig. 15": unloaded,
    "Fig. 16": unloaded,
    "Fig. 17": unloaded,
    "Fig. 18": unloaded,
    "Fig. 19": turning_helix,
    "text, condition": loading,
    "text, durations": lengths,
    "text, rates": rates,
    "cost, coupled": always_converges,
    "cost, over all": phase_cost,
    "conclusion 1": small_transient,
    "conclusion 2": sample_and_hold,
    "conclusion 3": sample_and_hold,
    "conclusion 4": phase_cost,
    "conclusion 5": already_apart,
}
