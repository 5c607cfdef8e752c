# SPDX-License-Identifier: MIT OR Apache-2.0
"""Figures 3 to 11: trim, convergence of the wake, and the arrested descent [ribera2004]."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ....plotting.disk import difference, revolution_map
from .. import quantities as q
from .verdict import Condition, Statement, above, at_least, below, larger, ordered, within

if TYPE_CHECKING:
    import xarray as xr

AFTER = 5.0
DI, RX, TM = "dynamic", "relaxation", "time-marching"


def statements(runs: Mapping[str, xr.Dataset]) -> list[Statement]:
    """Rows of the table for Figures 3 to 11; `runs` by model."""
    return [
        trim_inflow(runs),
        trim_geometry(runs),
        collective(runs),
        vertical_force(runs),
        pitching_moment(runs),
        vertical_velocity(runs),
        pitch(runs),
        longitudinal_flapping(runs),
        lateral_flapping(runs),
        trims(runs),
        lift(runs),
        lift_coefficient(runs),
        inflow_change(runs),
        geometry(runs),
    ]


Named = tuple[str, float]
"""A quantity with the name of its model."""


def named(runs: Mapping[str, Any], quantity: Callable[[Any], Any], *models: str) -> list[Named]:
    """A quantity of several models, each with its name."""
    return [(model, float(quantity(runs[model]))) for model in models]


def pair(runs: Mapping[str, Any], quantity: Callable[[Any], Any], first: str, second: str) -> tuple[Named, Named]:
    """A quantity of two models, each with its name."""
    a, b = named(runs, quantity, first, second)
    return a, b


def trim_inflow(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 3: inflow of the two wakes at trim."""
    run = runs[TM]
    change = difference(run["inflow_start"], run["inflow_trim"])
    mean = q.sector_mean(run["inflow_trim"])
    psi, radius, value = q.place_of_largest(change)
    at_tip = radius > 0.8 and (45 <= psi <= 120 or 240 <= psi <= 315)
    sectors = {a: _sector_rms(change, a) for a in range(0, 360, 30)}
    retreating = max(sectors[a] for a in (180, 210, 240, 270, 300, 330))
    front_and_rear = np.mean([sectors[a] for a in (120, 150, 180, 210)])
    return Statement(
        "Fig. 3",
        "At trim the inflow of relaxation and of time marching after about 40 iterations agree well overall; "
        "the largest "
        "differences are at the blade tips near 90° and on the retreating side.",
        (
            below("RMS over the disk of the difference, over the mean inflow", q.disk_rms(change) / mean, 0.2),
            Condition(
                "largest difference at r/R > 0.8, ψ in 45–120° or 240–315°",
                f"{value:+.4f} at ψ = {psi:.0f}°, r/R = {radius:.2f}",
                at_tip,
            ),
            above(
                "RMS at the tips (r/R > 0.8), largest of the retreating side over that of 120–240°",
                float(retreating / front_and_rear),
                2.0,
            ),
        ),
        figure="figure-03",
    )


def _sector_rms(field: xr.DataArray, azimuth: float) -> float:
    inside = q.in_sector(field, (azimuth, azimuth + 30.0), (0.8, 1.0))
    area = np.where(inside, q.weights(field), 0.0)
    return float(np.sqrt((field.values**2 * area).sum() / area.sum()))


def trim_geometry(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 4: geometry of the two wakes at trim."""
    a, b = q.filament(runs[RX], 0.0), q.filament(runs[TM], 0.0)
    apart = np.linalg.norm(a - b, axis=1)
    edge = np.abs(a[:, 1]) > 0.7
    return Statement(
        "Fig. 4",
        "The tip vortex of the first blade is alike in both wakes; differences are confined to the roll-up "
        "at the lateral edges.",
        (
            below("RMS distance over the first turn", q.first_turn_rms(a, b), 0.08, "R"),
            larger(
                "RMS distance",
                ("edges |y| > 0.7 R", float(np.sqrt(np.mean(apart[edge] ** 2)))),
                ("|y| < 0.7 R", float(np.sqrt(np.mean(apart[~edge] ** 2)))),
                "R",
            ),
        ),
        figure="figure-04",
    )


def collective(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 5a: what the pilot does."""
    run = runs[TM]
    stick = run["collective"].values - float(run["collective"][0])
    top = float(run.time[int(np.argmax(stick))])
    moving = run.time.values[stick > 1e-9]
    others = max(float(np.ptp(run[name].values)) for name in ("longitudinal", "lateral", "pedal"))
    step = float(run.time[1] - run.time[0])
    return Statement(
        "Fig. 5a",
        "Collective up by 3.7 in within 0.5 s, back within another 0.5 s; the other controls stay at trim.",
        (
            within("largest collective above trim", float(stick.max()), 3.6, 3.71, "in"),
            within("time of the rise", top - float(moving[0]) + step, 0.47, 0.53, "s"),
            within("time of the return", float(moving[-1]) - top + step, 0.47, 0.53, "s"),
            below("largest motion of another stick", others, 1e-9, "in"),
        ),
        figure="figure-05a",
    )


def vertical_force(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 5b: Z force."""
    peak = dict(named(runs, lambda run: q.extreme(run, "force_z", -1.0)[0] / 1e3, DI, RX, TM))
    alike = min(q.correlation(runs[TM], runs[model], "force_z") for model in (DI, RX))
    return Statement(
        "Fig. 5b",
        "The vertical force is alike with the three models; time marching has the largest amplitude.",
        (
            above("least correlation with time marching", alike, 0.9),
            larger("largest −ΔZ", (TM, peak[TM]), (RX, peak[RX]), "kN"),
            larger("largest −ΔZ", (TM, peak[TM]), (DI, peak[DI]), "kN"),
        ),
        figure="figure-05b",
    )


def pitching_moment(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 5c: pitching moment."""
    top = {m: q.extreme(runs[m], "moment_y", 1.0) for m in runs}
    control = float(runs[TM].time[int(np.argmax(runs[TM]["collective"].values))])
    late = {m: float(np.mean(runs[m]["moment_y"].values[q.window(runs[m], 2.0)])) / 1e3 for m in (RX, TM)}
    later = top[DI][1] - np.mean([top[RX][1], top[TM][1]])
    return Statement(
        "Fig. 5c",
        "Pitching moment: relaxation and time marching similar, largest just after the peak of the control, "
        "then falling; time "
        "marching slightly more nose-up late; dynamic inflow slower, its maximum about 0.5 s later.",
        (
            above("correlation of relaxation and time marching", q.correlation(runs[RX], runs[TM], "moment_y"), 0.9),
            within("maximum after the control's, time marching", top[TM][1] - control, -0.1, 0.25, "s"),
            within("maximum after the control's, relaxation", top[RX][1] - control, -0.1, 0.25, "s"),
            larger("mean moment after 2 s", (TM, late[TM]), (RX, late[RX]), "kN m"),
            within("maximum with dynamic inflow after those of the wakes", float(later), 0.3, 0.7, "s"),
        ),
        figure="figure-05c",
    )


def vertical_velocity(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 6a: w."""
    drop = dict(named(runs, lambda run: q.extreme(run, "w", -1.0, 0.0, 1.5)[0], DI, RX, TM))
    rise = dict(named(runs, lambda run: float(run["w"][-1] - run["w"].values[: run.sizes["time"]].min()), DI, RX, TM))
    return Statement(
        "Fig. 6a",
        "w: relaxation and time marching drop alike shortly after the peak and rise alike after the return; "
        "dynamic inflow "
        "clearly less in both.",
        (
            above("ratio of the drops, smaller over larger wake", _ratio(drop[RX], drop[TM]), 0.8),
            above("ratio of the rises, smaller over larger wake", _ratio(rise[RX], rise[TM]), 0.8),
            larger("largest drop of w", (RX, drop[RX]), (DI, drop[DI]), "m/s"),
            larger("largest drop of w", (TM, drop[TM]), (DI, drop[DI]), "m/s"),
            larger("rise of w after it", (RX, rise[RX]), (DI, rise[DI]), "m/s"),
            larger("rise of w after it", (TM, rise[TM]), (DI, rise[DI]), "m/s"),
        ),
        figure="figure-06a",
    )


def _ratio(a: float, b: float) -> float:
    return min(a, b) / max(a, b)


def pitch(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figures 6b and 6c: pitch rate and attitude."""
    rate = {m: q.extreme(runs[m], "q", 1.0) for m in runs}
    when = [rate[m][1] / q.period(runs[m]) for m in (RX, TM)]
    alike = min(q.correlation(runs[TM], runs[m], name) for m in (DI, RX) for name in ("q", "pitch"))
    return Statement(
        "Fig. 6b, c",
        "q and θ are similar with all three; time marching has slightly the highest peak of q, dynamic "
        "inflow the lowest; the "
        "peaks of w and q lie in the sixth revolution.",
        (
            above("least correlation of q and θ with time marching", alike, 0.9),
            at_least("peak of q", (TM, q.DEG * rate[TM][0]), (RX, q.DEG * rate[RX][0]), "deg/s"),
            at_least("peak of q", (RX, q.DEG * rate[RX][0]), (DI, q.DEG * rate[DI][0]), "deg/s"),
            Condition(
                "peak of q with both wakes in revolution 6 (5.0 to 6.0 revolutions)",
                f"{when[0]:.2f} (relaxation), {when[1]:.2f} (time marching) revolutions",
                all(5.0 - 1e-6 <= n <= 6.0 + 0.03 for n in when),
            ),
        ),
        figure="figure-06b",
    )


def longitudinal_flapping(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 7a: cosine flapping."""
    size = q.excursion(runs[TM], "beta_1c")
    return Statement(
        "Fig. 7a",
        "Longitudinal flapping is very similar with relaxation and time marching.",
        (
            below(
                "RMS difference over the excursion",
                q.rms_difference(runs[RX], runs[TM], "beta_1c") / size,
                0.2,
            ),
        ),
        figure="figure-07a",
    )


def lateral_flapping(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 7b: sine flapping."""
    peak = named(runs, lambda run: q.DEG * q.excursion(run, "beta_1s"), RX, DI, TM)
    return Statement(
        "Fig. 7b",
        "Lateral flapping: relaxation much larger in magnitude, time marching the smallest of the three.",
        ordered("largest change of β₁s", peak, "deg"),
        figure="figure-07b",
    )


def trims(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figures 5 to 7: where the models start."""
    start = {m: {n: float(runs[m][n][0]) for n in ("pitch", "w", "beta_1c")} for m in (DI, RX)}
    return Statement(
        "Figs. 5–7, trim",
        "Dynamic inflow trims at a higher pitch attitude, a higher w and with more longitudinal flapping "
        "(disk front lower) than "
        "the wakes.",
        (
            larger("pitch attitude", (DI, q.DEG * start[DI]["pitch"]), (RX, q.DEG * start[RX]["pitch"]), "deg"),
            larger("w", (DI, start[DI]["w"]), (RX, start[RX]["w"]), "m/s"),
            larger("β₁c", (DI, q.DEG * start[DI]["beta_1c"]), (RX, q.DEG * start[RX]["beta_1c"]), "deg"),
        ),
        figure="figure-06c",
    )


def lift(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 8: lift after five revolutions."""
    maps = {m: revolution_map(runs[m], "cl_m2", AFTER) for m in (RX, TM)}
    ahead = pair(maps, lambda field: q.sector_mean(field, (90, 180), (0.6, 1)), RX, TM)
    outer = {m: q.sector_mean(maps[m], radius=(0.7, 1.0)) / q.sector_mean(maps[m], radius=(0.0, 0.5)) for m in maps}
    return Statement(
        "Fig. 8",
        "Lift (C_l M²) after 5 revolutions is carried at the tips; relaxation has more of it at the front of "
        "the advancing side.",
        (
            above("mean beyond 0.7 R over mean inside 0.5 R, time marching", outer[TM], 2.0),
            above("the same, relaxation", outer[RX], 2.0),
            larger("mean over ψ = 90–180°, r/R > 0.6", *ahead),
        ),
        figure="figure-08",
    )


def lift_coefficient(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 9: lift coefficient after five revolutions."""
    maps = {m: revolution_map(runs[m], "cl", AFTER) for m in (RX, TM)}
    sides = {
        side: q.sector_mean(maps[TM], (a, a + 180), (0.5, 1)) for side, a in (("retreating", 180), ("advancing", 0))
    }
    return Statement(
        "Fig. 9",
        "The retreating side is nearest the largest C_l; relaxation has the higher C_l overall and is near 1 "
        "over more of the disk.",
        (
            larger(
                "mean C_l beyond 0.5 R, time marching",
                ("retreating", sides["retreating"]),
                ("advancing", sides["advancing"]),
            ),
            larger("share of the disk with C_l > 0.9", *pair(maps, lambda f: q.area_above(f, 0.9), RX, TM)),
            larger("mean C_l over the disk", *pair(maps, q.sector_mean, RX, TM)),
        ),
        figure="figure-09",
    )


def inflow_change(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 10: change of inflow after five revolutions."""
    maps = {m: q.change_from_trim(runs[m], "inflow", AFTER) for m in (RX, TM)}
    return Statement(
        "Fig. 10",
        "The change of inflow from trim after 5 revolutions is higher in the mean with relaxation, more "
        "positive aft and less "
        "negative forward.",
        (
            larger("mean change over the disk", *pair(maps, q.sector_mean, RX, TM)),
            larger("mean change aft (|ψ| < 90°)", *pair(maps, lambda f: q.sector_mean(f, (-90, 90)), RX, TM)),
            larger(
                "most negative change forward",
                *pair(maps, lambda f: float(f.values[q.in_sector(f, (90, 270))].min()), RX, TM),
            ),
        ),
        figure="figure-10",
    )


def geometry(runs: Mapping[str, xr.Dataset]) -> Statement:
    """Figure 11: geometry after 5, 8 and 10 revolutions."""
    height = {m: [_height(q.filament(runs[m], n)) for n in (5.0, 8.0, 10.0)] for m in (RX, TM)}
    moved = {m: [x - _height(q.filament(runs[m], 0.0)) for x in height[m]] for m in (RX, TM)}
    # steady flow is ahead where the state keeps changing one way: lag means less of the change
    conditions = tuple(
        larger(
            f"mean height of the last two turns against trim, revolution {n}",
            (TM, moved[TM][k]),
            (RX, moved[RX][k]),
            "R",
        )
        for k, n in enumerate((5, 8, 10))
    )
    return Statement(
        "Fig. 11",
        "After 5, 8 and 10 revolutions the relaxation wake lags behind the time-marching one.",
        conditions,
        figure="figure-11",
    )


def _height(nodes: np.ndarray) -> float:
    """Mean height of the last two turns over the rotor plane, over R."""
    return float(nodes[-73:, 2].mean())
