# SPDX-License-Identifier: MIT OR Apache-2.0
"""Figures 12 to 19: the roll reversal [ribera2004]."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ....plotting.disk import revolution_map
from .. import quantities as q
from .descent import DI, RX, TM, named, pair
from .verdict import Condition, Statement, above, larger, ordered, within

if TYPE_CHECKING:
    import xarray as xr

AFTER = 15.0
SECOND_RIGHT = (4.8, 7.0)
"""From the step back to the right to the last corner of the input [s]."""


def statements(runs: Mapping[str, xr.Dataset]) -> list[Statement]:
    """Rows of the table for Figures 12 to 19; `runs` by model."""
    return [
        lateral(runs),
        rolling_moment(runs),
        pitching_moment(runs),
        side_velocity(runs),
        roll_rate(runs),
        bank(runs),
        longitudinal_flapping(runs),
        lateral_flapping(runs),
        roll_contribution(runs),
        lift(runs),
        lift_coefficient(runs),
        inflow_change(runs),
        geometry(runs),
    ]


def lateral(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 12a: what the pilot does."""
    run = runs[TM]
    stick = run["lateral"].values - float(run["lateral"][0])
    at = {t: float(np.interp(t, run.time.values, stick)) for t in (1.5, 4.0, 6.5, 8.3)}
    return Statement(
        "Fig. 12a",
        "Lateral stick: 2.59 in right at 0.23 s, left by 7.72 in at 2.6 s, right by as much at 4.8 s, then to trim.",
        (
            within("after the first step", at[1.5], 2.58, 2.60, "in"),
            within("travel of the second step", at[4.0] - at[1.5], -7.73, -7.71, "in"),
            within("travel of the third step", at[6.5] - at[4.0], 7.71, 7.73, "in"),
            within("at the end", at[8.3], -0.01, 0.01, "in"),
        ),
        figure="figure-12a",
    )


def rolling_moment(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 12b: rolling moment."""
    left = {m: q.extreme(runs[m], "moment_x", -1.0, 2.6, 4.0)[0] / 1e3 for m in runs}
    first = {m: q.extreme(runs[m], "moment_x", -1.0, 0.0, 2.6)[0] / 1e3 for m in runs}
    alike = min(q.correlation(runs[TM], runs[m], "moment_x") for m in (DI, RX))
    return Statement(
        "Fig. 12b",
        "The rolling moment falls strongly at the quick input to the left; all three models are similar.",
        (
            above("least correlation with time marching", alike, 0.9),
            *(larger(f"largest −ΔL, {m}", ("2.6–4 s", left[m]), ("before", first[m]), "kN m") for m in (DI, RX, TM)),
        ),
        figure="figure-12b",
    )


def pitching_moment(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 12c: pitching moment."""
    rise = min(_rise(runs[m], "moment_y", 2.6, 4.0) for m in runs) / 1e3
    right = named(runs, lambda run: q.extreme(run, "moment_y", 1.0, *SECOND_RIGHT)[0] / 1e3, RX, TM, DI)
    return Statement(
        "Fig. 12c",
        "The pitching moment rises strongly at the same instant; at the second roll to the right it is much "
        "larger with relaxation "
        "and time marching than with dynamic inflow, largest with relaxation.",
        (
            above("rise of M within 2.6–4 s from its value at 2.6 s, least of the models", rise, 5.0, "kN m"),
            *ordered("largest ΔM of 4.8–7 s", right, "kN m"),
        ),
        figure="figure-12c",
    )


def _rise(run: xr.Dataset, name: str, start: float, end: float) -> float:
    """Largest rise of a history, averaged over a blade passage, over its value at the start of a window [s]."""
    values = q.smoothed(run, name)[q.window(run, start, end)]
    return float(values.max() - values[0])


def side_velocity(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 13a: v."""
    alike = min(q.correlation(runs[TM], runs[m], "v") for m in (DI, RX))
    peak = named(runs, lambda run: q.excursion(run, "v", *SECOND_RIGHT), RX, TM, DI)
    return Statement(
        "Fig. 13a",
        "v agrees well; relaxation has the larger peak at the second roll to the right.",
        (
            above("least correlation with time marching", alike, 0.9),
            larger("largest change of v in 4.8–7 s", peak[0], peak[1], "m/s"),
            larger("largest change of v in 4.8–7 s", peak[0], peak[2], "m/s"),
        ),
        figure="figure-13a",
    )


def roll_rate(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 13b: p."""
    peaks = {m: [q.DEG * q.extreme(runs[m], "p", sign, *span)[0] for sign, span in _ROLLS] for m in runs}
    nearly = [a / b for a, b in zip(peaks[RX], peaks[TM], strict=True)]
    over = [a / b for m in (RX, TM) for a, b in zip(peaks[m], peaks[DI], strict=True)]
    again = {m: q.DEG * q.extreme(runs[m], "p", 1.0, *SECOND_RIGHT)[0] for m in runs}
    return Statement(
        "Fig. 13b",
        "p agrees very well; relaxation and time marching are nearly equal, both slightly above dynamic "
        "inflow at the "
        "peaks.",
        (
            above(
                "least correlation with time marching",
                min(q.correlation(runs[TM], runs[m], "p") for m in (DI, RX)),
                0.95,
            ),
            _between("first peaks to the right and to the left, relaxation over time marching", nearly, 0.95, 1.05),
            _between("the same peaks, wakes over dynamic inflow", over, 1.0, 1.15),
            above(
                "roll rate to the right after the third step, least of the models", min(again.values()), 5.0, "deg/s"
            ),
        ),
        figure="figure-13b",
    )


# the first roll to the right and the roll to the left; direction and time [s]
_ROLLS = ((1.0, (0.23, 2.6)), (-1.0, (2.6, 4.8)))


def _between(what: str, numbers: list[float], low: float, high: float) -> Condition:
    text = ", ".join(f"{x:.3f}" for x in numbers)
    return Condition(f"{what}, all between {low:g} and {high:g}", text, all(low <= x <= high for x in numbers))


def bank(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 13c: bank."""
    left = {m: q.DEG * q.extreme(runs[m], "roll", -1.0, 2.6)[0] for m in runs}
    return_ = {m: _rolled_back(runs[m]) for m in runs}
    return Statement(
        "Fig. 13c",
        "φ: relaxation and time marching overshoot dynamic inflow at the leftmost and at the following rightmost bank.",
        (
            larger("leftmost bank", (RX, left[RX]), (DI, left[DI]), "deg"),
            larger("leftmost bank", (TM, left[TM]), (DI, left[DI]), "deg"),
            above(
                "bank regained to the right after the leftmost one, least of the models",
                min(return_.values()),
                5.0,
                "deg",
            ),
        ),
        figure="figure-13c",
    )


def _rolled_back(run: xr.Dataset) -> float:
    """Change of bank to the right after the leftmost bank [deg]."""
    roll = q.DEG * run["roll"].values
    k = int(np.argmin(roll))
    return float(roll[k:].max() - roll[k])


def longitudinal_flapping(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 14a: cosine flapping."""
    alike = min(q.correlation(runs[TM], runs[m], "beta_1c", SECOND_RIGHT[0]) for m in (DI, RX))
    peak = named(runs, lambda run: q.DEG * q.excursion(run, "beta_1c", *SECOND_RIGHT), RX, TM, DI)
    return Statement(
        "Fig. 14a",
        "Longitudinal flapping is similar until the second roll to the right, where dynamic inflow is much smaller.",
        (
            above("least correlation with time marching before 4.8 s", alike, 0.9),
            larger("largest change of β₁c in 4.8–7 s", peak[0], peak[2], "deg"),
            larger("largest change of β₁c in 4.8–7 s", peak[1], peak[2], "deg"),
        ),
        figure="figure-14a",
    )


def lateral_flapping(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 14b: sine flapping."""
    alike = min(q.correlation(runs[TM], runs[m], "beta_1s") for m in (DI, RX))
    return Statement(
        "Fig. 14b",
        "Lateral flapping is similar with all three models.",
        (above("least correlation with time marching", alike, 0.9),),
        figure="figure-14b",
    )


def roll_weight(field: xr.DataArray) -> xr.DataArray:
    """C_l M² times r/R sin ψ: what a section adds to the rolling moment, as in Figure 15."""
    psi, station = field[field.dims[0]].values, field["station"].values
    return field.copy(data=field.values * np.sin(psi)[:, None] * station)


def pitch_weight(field: xr.DataArray) -> xr.DataArray:
    """C_l M² times −r/R cos ψ: what a section adds to the nose-up moment."""
    psi, station = field[field.dims[0]].values, field["station"].values
    return field.copy(data=-field.values * np.cos(psi)[:, None] * station)


def roll_contribution(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 15: contributions to the rolling moment after 15 revolutions."""
    lifts = {m: revolution_map(runs[m], "cl_m2", AFTER) for m in (RX, TM)}
    maps = {m: roll_weight(lifts[m]) for m in lifts}
    advancing = q.sector_mean(maps[TM], (0, 90), (0.6, 1))
    retreating = q.sector_mean(maps[TM], (270, 360), (0.6, 1))
    ends = {
        part: q.sector_mean(abs(maps[TM]), span, (0.6, 1)) for part, span in (("rear", (-90, 90)), ("front", (90, 270)))
    }
    roll = pair(maps, lambda f: abs(q.sector_mean(f)), TM, RX)
    down = pair(lifts, lambda f: -q.sector_mean(pitch_weight(f)), TM, RX)
    return Statement(
        "Fig. 15",
        "Contributions to the rolling moment (C_l M² r̄ sin ψ) after 15 revolutions come mainly from the "
        "outer rear, positive on the "
        "advancing and negative on the retreating side; they are larger with time marching and biased to the "
        "rear, which is "
        "slightly more so with time marching (larger nose-down moment).",
        (
            above("mean of the outer advancing rear, time marching", advancing, 0.0),
            Condition("mean of the outer retreating rear, time marching < 0", f"{retreating:.4g}", retreating < 0),
            larger("mean magnitude beyond 0.6 R, time marching", ("rear", ends["rear"]), ("front", ends["front"])),
            larger("magnitude of the disk integral", *roll),
            larger("nose-down moment of the lift", *down),
        ),
        figure="figure-15",
    )


def lift(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 16: lift after 15 revolutions."""
    maps = {m: revolution_map(runs[m], "cl_m2", AFTER) for m in (RX, TM)}
    psi, radius, _ = q.place_of_largest(maps[TM], absolute=False)
    rear = pair(maps, lambda f: q.sector_mean(f, (-90, 90), (0.6, 1)), TM, RX)
    front = pair(maps, lambda f: q.sector_mean(f, (90, 270), (0.6, 1)), RX, TM)
    return Statement(
        "Fig. 16",
        "Lift (C_l M²) after 15 revolutions is largest at the rear of the advancing side; time marching has "
        "more in the rear and less "
        "in front.",
        (
            Condition("largest value at ψ in 0–90°", f"ψ = {psi:.0f}°, r/R = {radius:.2f}", 0 <= psi <= 90),
            larger("mean of the rear half, r/R > 0.6", *rear),
            larger("mean of the front half, r/R > 0.6", *front),
        ),
        figure="figure-16",
    )


def lift_coefficient(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 17: lift coefficient after 15 revolutions."""
    maps = {m: revolution_map(runs[m], "cl", AFTER) for m in (RX, TM)}
    psi, radius, value = q.place_of_largest(maps[TM], absolute=False)
    rear = psi <= 90 or psi >= 270
    return Statement(
        "Fig. 17",
        "C_l after 15 revolutions is largest in the rear half, inboard; relaxation has the larger area near stall.",
        (
            Condition(
                "largest value in the rear half at r/R < 0.7",
                f"{value:.2f} at ψ = {psi:.0f}°, r/R = {radius:.2f}",
                bool(rear and radius < 0.7),
            ),
            larger("share of the disk with C_l > 0.9", *pair(maps, lambda f: q.area_above(f, 0.9), RX, TM)),
        ),
        figure="figure-17",
    )


def inflow_change(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 18: change of inflow after 15 revolutions."""
    maps = {m: q.change_from_trim(runs[m], "inflow", AFTER) for m in (RX, TM)}
    alike = float(np.corrcoef(maps[RX].values.ravel(), maps[TM].values.ravel())[0, 1])
    return Statement(
        "Fig. 18",
        "The change of inflow after 15 revolutions is similar over most of the disk; relaxation is higher "
        "toward the tips at the rear.",
        (
            above("correlation of the two maps", alike, 0.8),
            larger(
                "mean over ψ = −60…60°, r/R > 0.7",
                *pair(maps, lambda f: q.sector_mean(f, (-60, 60), (0.7, 1)), RX, TM),
            ),
        ),
        figure="figure-18",
    )


def geometry(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 19: side views after 15, 18 and 21 revolutions."""
    bends = {m: [q.bend(q.filament(runs[m], n)) for n in (15.0, 18.0, 21.0)] for m in (RX, TM)}
    return Statement(
        "Fig. 19",
        "The time-marching wake bends with the changing attitude; the relaxation wake looks like that of a "
        "steady flight each time.",
        tuple(
            larger(
                f"bend of the centre line over its length, revolution {n}",
                (TM, abs(bends[TM][k])),
                (RX, abs(bends[RX][k])),
            )
            for k, n in enumerate((15, 18, 21))
        ),
        figure="figure-19",
    )
