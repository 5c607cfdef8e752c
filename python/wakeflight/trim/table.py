# SPDX-License-Identifier: MIT OR Apache-2.0
"""A trimmed flight as a table to print."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..model import flight_regime
from ..regime import REGIMES
from ..sticks import STICKS
from ..views import text_table
from .solved import Solved

HORSEPOWER = 745.6998715822702  # W
KNOT = 0.514444  # m/s


def table(start: Solved, said: Sequence[tuple[str, str]]) -> str:
    """Sticks, attitude, pitch controls, power, inflow, residuals: one line each; `said`: what monitors and warnings say."""
    mean, residuals, deg = start.mean_outputs(), start.residuals, np.degrees
    stick, c = start.stick, start.pitch_controls
    travel = start.aircraft.stick_travel_in
    lam = start.inflow_harmonics()
    condition = start.condition
    precone = float(start.aircraft.rotor.blade.precone)
    beyond = f" beyond {deg(precone):.1f} deg precone" if precone else ""
    turning = f", turn {deg(start.turn_rate):.2f} deg/s, load factor {start.load_factor:.3f}" if start.turn_rate else ""
    rows = [
        (
            "condition",
            f"{condition.speed / KNOT:.1f} kt, flight path {deg(condition.flight_path):.2f} deg, "
            f"{condition.altitude / 0.3048:.0f} ft, {condition.gross_mass / 0.45359237:.0f} lb{turning}",
        ),
        *_found(start),
        ("inflow model", start.inflow.name + _wake_length(start)),
        *[(f"{name} stick", f"{stick[name]:7.3f} in of {full:.2f}") for name, full in zip(STICKS, travel, strict=True)],
        ("roll, pitch", f"{deg(start.roll):7.3f} deg, {deg(start.pitch):.3f} deg"),
        ("heading against track", f"{deg(start.yaw):7.3f} deg (nose right +)"),
        (
            "theta_0, 1c, 1s, tail",
            ", ".join(f"{deg(c[k]):.3f}" for k in ("theta_0", "theta_1c", "theta_1s", "theta_tr")) + " deg",
        ),
        (
            f"coning{beyond}, beta_1c, beta_1s",
            ", ".join(f"{deg(mean[k]):.3f}" for k in ("beta_0", "beta_1c", "beta_1s")) + " deg",
        ),
        ("stabilator", f"{deg(start.stabilator_incidence):7.3f} deg"),
        ("lambda_0, 1c, 1s", ", ".join(f"{v:.5f}" for v in lam)),
        (
            "C_T, C_T/sigma, mu",
            f"{mean['ct']:.6f}, {mean['ct'] / start.aircraft.solidity:.4f}, {mean['mu']:.4f}",
        ),
        (
            "power",
            f"{mean['power'] / HORSEPOWER:.1f} hp (main {mean['power_main'] / HORSEPOWER:.1f}, "
            f"tail {mean['power_tail'] / HORSEPOWER:.1f})",
        ),
        (
            "residuals",
            f"linear {residuals['linear']:.1e} m/s2, angular {residuals['angular']:.1e} rad/s2, "
            f"blade harmonics {residuals['harmonics']:.1e} rad",
        ),
    ]
    if not start.inflow.is_dynamic and start.history:
        last = start.history[-1]
        rows.append(
            (
                "wake",
                f"inflow changes by {last['inflow_change']:.1e} of the tip speed per iteration, first turn by "
                f"{last['first_turn_change']:.1e} R, pitch controls by {last['control_change']:.1e} rad",
            )
        )
    return text_table([*rows, *said])


def _found(start: Solved) -> list[tuple[str, str]]:
    """What trim found of the path for what it was asked to meet."""
    asked = start.model.target
    if asked is None:
        return []
    descent = start.rate_of_descent
    return [
        (
            "found",
            f"{asked.free.replace('_', ' ')} for {asked.name} {asked.shown(asked.value)}: "
            f"{'descent' if descent >= 0.0 else 'climb'} at {abs(descent):.2f} m/s ({abs(descent) / 0.00508:.0f} ft/min)",
        )
    ]


def _wake_length(start: Solved) -> str:
    """Regime and length of a free wake, to follow its name."""
    if start.inflow.is_dynamic:
        return ""
    regime = flight_regime(start.aircraft, start.condition)
    wake = start.inflow.free_wake
    return f", {wake.turns:g} turns free, {wake.far_wake_turns} repeated ({REGIMES[regime]})"
